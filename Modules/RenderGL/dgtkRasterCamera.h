// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterCamera_h
#define dgtkRasterCamera_h

#include "dgtkCameraModel.h"
#include "dgtkLayer.h"

#include <Eigen/Core>

namespace dgtk
{

/// A View as OpenGL draws a rectangle of its image. View axes are OpenGL's: x right, y up, z towards the viewer.
struct RasterCamera
{
  Eigen::Matrix4d clip_from_view;
  Eigen::Matrix4d view_from_world;
  bool perspective = true;
  double near = 0; ///< depths that are seen
  double far = 0;
  double focal = 0; ///< the larger focal length, pixels (parallel projection: pixels per scene unit)
};

/// The frustum of `rect` of the view's image enlarged `samples` times in each direction, for a viewport of the size of
/// `rect`. z_clip / w_clip is 1 at near and 0 at far: near / (far - near) * (far / z - 1) for a perspective, linear in
/// z for a parallel projection; where `zeroToOne` is false, that is stretched to [-1, 1].
/// Throws UsageError for a camera that is not linear.
RasterCamera rasterCamera(const View& view, const PixelRect& rect, int samples, bool zeroToOne);

} // namespace dgtk

#endif
