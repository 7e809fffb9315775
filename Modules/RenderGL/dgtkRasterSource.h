// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterSource_h
#define dgtkRasterSource_h

#include "dgtkRenderGLModule.h"

#include "dgtkGLContext.h"
#include "dgtkVisibility.h"

#include <functional>
#include <memory>
#include <vector>

namespace dgtk
{

/// The surfaces of one rank along the rays of a rectangle's pixels: rank 0 is what render() gives, rank 1 what stands
/// behind it, and so on.
struct SurfaceLayer
{
  PixelRect rect;
  std::vector<float> rgba; ///< 4 per pixel, rows top to bottom: shaded colour in [0, 1] and opacity; 0 without surface
  std::vector<Hit> hits;   ///< object 0 where the ray meets no surface of this rank
};

/// The raster engine: draws with VTK. All calls come from one thread.
class DGTKRENDERGL_EXPORT RasterSource : public ColorSource
{
public:
  /// The OpenGL that it draws with.
  virtual GLChoice choice() const = 0;
  /// Peels all surfaces along the rays through the pixel centres of `rect` (as in render()), nearest first; surfaces at
  /// one depth in the order of (object, triangle). Calls `visit` for each rank until it returns false or no pixel has a
  /// surface of that rank.
  virtual void peel(const PixelRect& rect, const std::function<bool(const SurfaceLayer&)>& visit) = 0;
};

/// Throws MachineError or UsageError as chooseGL() does.
DGTKRENDERGL_EXPORT std::unique_ptr<RasterSource> makeRasterSource(GLBackend backend = GLBackend::Auto);

} // namespace dgtk

#endif
