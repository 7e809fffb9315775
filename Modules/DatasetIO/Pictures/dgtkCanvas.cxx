// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCanvas.h"

#include "dgtkLayerWriter.h"

#include <algorithm>
#include <cstring>

namespace dgtk
{

Canvas::Canvas(int width, int height, Rgb background)
  : Width(width)
  , Height(height)
  , Pixels(std::size_t(width) * static_cast<std::size_t>(height), background)
{
}

void Canvas::paste(const Canvas& picture, int x, int y)
{
  const int columns = std::min(picture.Width, this->Width - x);
  for (int row = 0; row < std::min(picture.Height, this->Height - y); ++row)
  {
    std::copy_n(&picture.Pixels[std::size_t(row) * static_cast<std::size_t>(picture.Width)], std::max(0, columns),
      &this->at(x, y + row));
  }
}

void Canvas::text(const std::string& text, int x, int y, int width, Rgb color)
{
  std::string shown = text;
  if (textWidth(shown) > width)
  {
    shown = text.substr(0, std::size_t(std::max(0, width / 6 - 2))) + "..";
  }
  for (std::size_t i = 0; i < shown.size(); ++i)
  {
    const std::array<std::uint8_t, 7>& rows = glyphOf(shown[i]);
    for (int row = 0; row < 7; ++row)
    {
      for (int column = 0; column < 5; ++column)
      {
        const int px = x + static_cast<int>(i) * 6 + column;
        if ((rows[std::size_t(row)] >> (4 - column) & 1) != 0 && px >= 0 && px < this->Width && y + row >= 0 &&
            y + row < this->Height)
        {
          this->at(px, y + row) = color;
        }
      }
    }
  }
}

DatasetFile Canvas::write(const FilePlace& path) const
{
  LayerSpec spec;
  spec.name = "picture";
  spec.meaning = Meaning::Picture;
  spec.channels = 3;
  const std::unique_ptr<LayerWriter> writer = makeLayerWriter("png", path, spec, this->Width, this->Height);
  Rows rows(PixelType::UInt8, 3, this->Width, 0, this->Height);
  std::memcpy(rows.data(), this->Pixels.data(), rows.bytes());
  writer->write(rows);
  const FileRecord record = writer->finish();
  return { record.path, record.bytes, record.sha256, {}, {}, -1 };
}

} // namespace dgtk
