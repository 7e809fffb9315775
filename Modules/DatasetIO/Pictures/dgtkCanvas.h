// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCanvas_h
#define dgtkCanvas_h

#include "dgtkDatasetDocuments.h"
#include "dgtkFile.h"
#include "dgtkLayerColors.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// A small 8-bit RGB picture to draw on. Letters and thumbnails are not OpenImageIO's: loading it takes 0.15 s, more
/// than most sheets, and FreeType's letters differ between its versions, while a sheet's hash stands in the manifest.
class Canvas
{
public:
  Canvas(int width, int height, Rgb background);
  int width() const { return this->Width; }
  int height() const { return this->Height; }
  Rgb& at(int x, int y) { return this->Pixels[std::size_t(y) * static_cast<std::size_t>(this->Width) + x]; }
  const std::vector<Rgb>& pixels() const { return this->Pixels; } ///< rows top to bottom
  void paste(const Canvas& picture, int x, int y);
  /// Text in 5 x 7 pixel letters, 6 apart, cut off with dots after `width` pixels; (x, y) is the top left corner.
  void text(const std::string& text, int x, int y, int width, Rgb color);
  static int textWidth(const std::string& text) { return 6 * static_cast<int>(text.size()); }
  /// Writes a PNG file and describes it.
  DatasetFile write(const FilePlace& path) const;

private:
  int Width;
  int Height;
  std::vector<Rgb> Pixels;
};

/// The seven rows of a letter, the leftmost of five pixels in bit 4.
const std::array<std::uint8_t, 7>& glyphOf(char letter);

/// Reads an image and draws it in readable colours, `width` x `height` pixels. Memory is bounded by the thumbnail and a
/// few rows. Colours are averaged; values are taken at the centres.
Canvas makeThumbnail(const std::string& path, const LayerSpec& spec, int width, int height);

} // namespace dgtk

#endif
