// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterSource_h
#define dgtkRasterSource_h

#include "dgtkRenderGLModule.h"

#include "dgtkGLContext.h"
#include "dgtkSurfaceLayer.h"
#include "dgtkVisibility.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// How the samples of a neighbourhood become the colour of a pixel. Separable; the weights of the samples at hand sum
/// to 1.
enum class PixelFilter
{
  Box,      ///< the pixel itself, radius 0.5 pixel
  Triangle, ///< radius 1
  Gaussian, ///< of standard deviation 0.5, cut off at radius 1.5
  Mitchell, ///< radius 2, B = C = 1/3 (Mitchell and Netravali 1988)
  Lanczos   ///< radius 3 (Duchon 1979)
};
/// Throws UsageError for an unknown name: box, triangle, gaussian, mitchell, lanczos.
DGTKRENDERGL_EXPORT PixelFilter pixelFilterFromName(const std::string& name);
/// Weights of `samples` samples a pixel along one axis, from `margin` pixels before the pixel to `margin` after it.
DGTKRENDERGL_EXPORT std::vector<double> pixelFilterWeights(PixelFilter filter, int samples, int& margin);

/// A picture that OpenGL may still be at work on.
struct UnreadColor
{
  /// Reads its pixels, in the thread of the source, which must still be there; nothing where they were read.
  std::function<void()> read;
  std::function<void()> rest = [] {}; ///< to be done then, in any thread, until the colours are there
};

/// The raster engine: draws with VTK. All calls come from one thread.
class DGTKRENDERGL_EXPORT RasterSource : public ColorSource
{
public:
  /// The OpenGL that it draws with.
  virtual GLChoice choice() const = 0;
  /// Whether hits and layers are asked for at all; true unless set. Colours alone are drawn faster. To be called before
  /// the first scene.
  virtual void setHits(bool wanted) = 0;
  /// Of drawColor() with several samples a pixel; box unless set.
  virtual void setFilter(PixelFilter filter) = 0;
  /// drawColor() that leaves its pixels with OpenGL, where it can: with one sample a pixel and nothing translucent.
  /// OpenGL transforms the vertices of a picture while it fills the one before.
  virtual UnreadColor startColor(const PixelRect& rect, int samples, ColorBuffer& colors) = 0;
  /// Peels all surfaces along the rays through the pixel centres of `rect` (as in render()), nearest first; surfaces at
  /// one depth in the order of (object, triangle). Calls `visit` for each rank until it returns false or no pixel has a
  /// surface of that rank.
  virtual void peel(const PixelRect& rect, const std::function<bool(const SurfaceLayer&)>& visit) = 0;
};

/// Throws MachineError or UsageError as chooseGL() does.
DGTKRENDERGL_EXPORT std::unique_ptr<RasterSource> makeRasterSource(GLBackend backend = GLBackend::Auto);

} // namespace dgtk

#endif
