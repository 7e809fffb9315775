// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMattingSource_h
#define dgtkMattingSource_h

#include "dgtkPictureSource.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Draws what mattes are made of with samples x samples samples a pixel. Uses the raster engine in the calling thread.
class MattingSource
{
public:
  MattingSource(PictureSource& pictures, std::vector<std::uint32_t> objects, int samples);

  void setScene(const std::shared_ptr<const SceneState>& state, const View& view);
  /// One for each object. Leaves the raster engine with the scene and view of setScene().
  std::vector<MattePixels> draw(const PixelRect& rect);

private:
  void drawForegrounds(const PixelRect& rect, std::vector<MattePixels>& mattes);
  void drawPiece(const PixelRect& piece, const PixelRect& rect, std::vector<MattePixels>& mattes);
  PictureSource& Pictures;
  std::vector<std::uint32_t> Objects;
  int Samples;
  std::shared_ptr<const SceneState> State;
  View TheView;
};

} // namespace dgtk

#endif
