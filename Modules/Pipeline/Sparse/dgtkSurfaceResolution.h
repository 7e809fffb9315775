// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceResolution_h
#define dgtkSurfaceResolution_h

#include "dgtkPipelineModule.h"

#include <cstddef>

namespace dgtk
{

class Stage;

/// World units per pixel over the surfaces that a camera sees at one frame: at each pixel the side of the square that
/// the pixel covers in a plane parallel to the image through the surface point, depth / sqrt(fx fy) for a pinhole. Of a
/// lens the plane is across the ray, and pixels at whose sides no rays are do not count.
struct SurfaceResolution
{
  std::size_t pixels = 0; ///< pixels that see a surface; the values below are 0 when there are none
  double smallest = 0;
  double median = 0; ///< the lower one of an even number
  double largest = 0;
};

/// Throws like Stage::view.
DGTKPIPELINE_EXPORT SurfaceResolution surfaceResolution(
  const Stage& stage, std::size_t camera, double frame, int width = 0, int height = 0);

} // namespace dgtk

#endif
