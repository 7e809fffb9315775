// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFinerCamera_h
#define dgtkFinerCamera_h

#include "dgtkCameraModel.h"

#include <memory>

namespace dgtk
{

/// A lens on an image of `times` as many pixels a side, whose rays and projections are to the bit those of `model`
/// there, and are kept for the next frames as those of an image of that size. Null where there is none: of models
/// without an image plane, with a rolling shutter, or unless `times` is a power of 2.
DGTKCAMERA_EXPORT std::shared_ptr<const CameraModel> finerCamera(const CameraModel& model, int times);

} // namespace dgtk

#endif
