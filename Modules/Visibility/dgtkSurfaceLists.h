// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceLists_h
#define dgtkSurfaceLists_h

#include "dgtkVisibility.h"

#include "dgtkLayer.h"

#include <cstdint>
#include <vector>

namespace dgtk
{

/// All surfaces along the rays of a rectangle's pixels, near to far.
struct SurfaceLists
{
  PixelRect rect;
  std::vector<std::uint32_t> first; ///< of each pixel, rows top to bottom, and the end of the last one's
  std::vector<Hit> hits;
  std::vector<float> rgba; ///< 4 a surface: shaded colour in [0, 1] and opacity
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
