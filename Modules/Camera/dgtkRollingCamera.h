// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRollingCamera_h
#define dgtkRollingCamera_h

#include "dgtkCameraModel.h"

#include <memory>

namespace dgtk
{

/// A camera whose rows or columns are seen one after another. Times that its rays have already come on top.
std::shared_ptr<const CameraModel> withRollingShutter(
  std::shared_ptr<const CameraModel> camera, const RollingShutter& shutter);

} // namespace dgtk

#endif
