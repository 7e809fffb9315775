// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureSource_h
#define dgtkPictureSource_h

#include "dgtkVisibilityModule.h"

#include "dgtkPixelFilter.h"
#include "dgtkSurfaceLayer.h"

#include <functional>

namespace dgtk
{

/// An engine of whole pictures: several samples a pixel, and what stands behind what is seen.
class DGTKVISIBILITY_EXPORT PictureSource : public ColorSource
{
public:
  /// Of drawColor() with several samples a pixel; box unless set.
  virtual void setFilter(PixelFilter filter) = 0;
  /// Peels all surfaces along the rays through the pixel centres of `rect` (as in render()), nearest first; surfaces at
  /// one depth in the order of (object, triangle). Calls `visit` for each rank until it returns false or no pixel has a
  /// surface of that rank.
  virtual void peel(const PixelRect& rect, const std::function<bool(const SurfaceLayer&)>& visit) = 0;
};

} // namespace dgtk

#endif
