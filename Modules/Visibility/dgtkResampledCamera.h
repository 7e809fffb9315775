// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkResampledCamera_h
#define dgtkResampledCamera_h

#include "dgtkVisibilityModule.h"

#include "dgtkCameraModel.h"

#include <memory>

namespace dgtk
{

/// A camera of width x height pixels whose image point p is the point scale * p + offset of `model`: the same lens on
/// another grid of pixels. scale > 0.
DGTKVISIBILITY_EXPORT std::shared_ptr<const CameraModel> resampledCamera(
  std::shared_ptr<const CameraModel> model, int width, int height, double scale, const Eigen::Vector2d& offset);

} // namespace dgtk

#endif
