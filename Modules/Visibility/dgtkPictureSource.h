// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureSource_h
#define dgtkPictureSource_h

#include "dgtkVisibilityModule.h"

#include "dgtkPixelFilter.h"
#include "dgtkSurfaceLists.h"

#include <functional>

namespace dgtk
{

/// An engine of whole pictures: several samples a pixel, and what stands behind what is seen.
class DGTKVISIBILITY_EXPORT PictureSource : public ColorSource
{
public:
  /// Of drawColor() with several samples a pixel; box unless set.
  virtual void setFilter(PixelFilter filter) = 0;
  /// renderColor() of one sample a pixel with its hits; colours are asked for only of those that are `wanted`.
  virtual void renderWanted(
    const PixelRect& rect, ColorBuffer& colors, VisibilityBuffer& hits, const std::function<bool(const Hit&)>&)
  {
    this->renderColor(rect, 1, colors, &hits);
  }
  /// All surfaces along the rays through the pixel centres of `rect` (as in render()); surfaces at one depth in the
  /// order of (object, triangle). Draws, and returns what remains to be done until `lists` is filled, as drawColor().
  virtual std::function<void()> peel(const PixelRect& rect, SurfaceLists& lists) = 0;
};

} // namespace dgtk

#endif
