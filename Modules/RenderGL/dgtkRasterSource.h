// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterSource_h
#define dgtkRasterSource_h

#include "dgtkRenderGLModule.h"

#include "dgtkGLContext.h"
#include "dgtkPictureSource.h"

#include <functional>
#include <memory>

namespace dgtk
{

/// A picture that OpenGL may still be at work on.
struct UnreadColor
{
  /// Reads its pixels, in the thread of the source, which must still be there; nothing where they were read.
  std::function<void()> read;
  std::function<void()> rest = [] {}; ///< to be done then, in any thread, until the colours are there
};

/// The raster engine: draws with VTK. All calls come from one thread.
class DGTKRENDERGL_EXPORT RasterSource : public PictureSource
{
public:
  /// The OpenGL that it draws with.
  virtual GLChoice choice() const = 0;
  /// Whether hits and layers are asked for at all; true unless set. Colours alone are drawn faster. To be called before
  /// the first scene.
  virtual void setHits(bool wanted) = 0;
  /// drawColor() that leaves its pixels with OpenGL, where it can: with one sample a pixel and nothing translucent.
  /// OpenGL transforms the vertices of a picture while it fills the one before.
  virtual UnreadColor startColor(const PixelRect& rect, int samples, ColorBuffer& colors) = 0;
};

/// Throws MachineError or UsageError as chooseGL() does.
DGTKRENDERGL_EXPORT std::unique_ptr<RasterSource> makeRasterSource(GLBackend backend = GLBackend::Auto);

} // namespace dgtk

#endif
