// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceLayer_h
#define dgtkSurfaceLayer_h

#include "dgtkVisibility.h"

#include "dgtkLayer.h"

#include <cstdint>
#include <vector>

namespace dgtk
{

/// The surfaces of one rank along the rays of a rectangle's pixels: rank 0 is the nearest, rank 1 what stands behind
/// it, and so on.
struct SurfaceLayer
{
  PixelRect rect;
  std::vector<float> rgba; ///< 4 per pixel, rows top to bottom: shaded colour in [0, 1] and opacity; 0 without surface
  std::vector<Hit> hits;   ///< object 0 where the ray meets no surface of this rank
};

/// What is drawn of an object for its matte, for the pixels of a rectangle.
struct MattePixels
{
  std::vector<std::uint16_t> count; ///< samples that show the object, one a pixel
  std::vector<float> foreground;    ///< mean colour of these samples, 3 a pixel; 0 where there is none
  std::vector<float> background;    ///< mean colour of all samples without the object, 3 a pixel
};

} // namespace dgtk

#endif
