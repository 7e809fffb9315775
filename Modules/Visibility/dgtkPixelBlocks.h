// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPixelBlocks_h
#define dgtkPixelBlocks_h

#include "dgtkLayer.h"

#include <algorithm>

namespace dgtk
{

constexpr int pixelBlock = 4; ///< side of what is asked about at once

/// How many rows from y on, at most `rows`, do not reach into the next row of blocks.
inline int rowsOfBlocks(int y, int rows) { return std::min(rows, (y / pixelBlock + 1) * pixelBlock - y); }

/// body(x, y) for all pixels, those of a block of 4 x 4 after one another. The blocks are the image's: which pixels are
/// together does not depend on the rectangle's top.
template <typename Body>
void forPixelBlocks(const PixelRect& rect, const Body& body)
{
  const int right = rect.x + rect.width;
  const int bottom = rect.y + rect.height;
  for (int top = rect.y; top < bottom; top += rowsOfBlocks(top, bottom - top))
  {
    const int next = top + rowsOfBlocks(top, bottom - top);
    for (int left = rect.x; left < right; left += pixelBlock)
    {
      for (int y = top; y < next; ++y)
      {
        for (int x = left; x < std::min(right, left + pixelBlock); ++x)
        {
          body(x, y);
        }
      }
    }
  }
}

} // namespace dgtk

#endif
