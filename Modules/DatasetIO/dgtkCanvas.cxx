// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCanvas.h"

#include "dgtkLayerWriter.h"

#include <algorithm>
#include <cmath>
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

DatasetFile Canvas::write(const std::string& path) const
{
  LayerSpec spec;
  spec.name = "color";
  spec.channels = 3;
  const std::unique_ptr<LayerWriter> writer = makeLayerWriter("png", path, spec, this->Width, this->Height);
  Rows rows(PixelType::UInt8, 3, this->Width, 0, this->Height);
  std::memcpy(rows.data(), this->Pixels.data(), rows.bytes());
  writer->write(rows);
  const FileRecord record = writer->finish();
  return { record.path, record.bytes, record.sha256, {}, {}, -1 };
}

Rgb rampColor(double value)
{
  // lightness rises evenly from 10 to 95 % along these
  constexpr double stops[][3] = { { 24, 15, 61 }, { 84, 31, 107 }, { 146, 47, 105 }, { 203, 75, 79 }, { 241, 122, 50 },
    { 250, 184, 62 }, { 250, 245, 170 } };
  constexpr int last = 6;
  const double at = std::min(std::max(value, 0.0), 1.0) * last;
  const int i = std::min(static_cast<int>(at), last - 1);
  Rgb color{};
  for (int c = 0; c < 3; ++c)
  {
    color[std::size_t(c)] = static_cast<std::uint8_t>(stops[i][c] + (at - i) * (stops[i + 1][c] - stops[i][c]) + 0.5);
  }
  return color;
}

namespace
{
Rgb hueColor(double hue, double saturation, double value)
{
  Rgb color{};
  constexpr double shift[] = { 5, 3, 1 };
  for (int c = 0; c < 3; ++c)
  {
    const double k = std::fmod(shift[c] + hue * 6, 6.0);
    const double level = value * (1 - saturation * std::max(0.0, std::min({ k, 4 - k, 1.0 })));
    color[std::size_t(c)] = static_cast<std::uint8_t>(level * 255 + 0.5);
  }
  return color;
}
} // namespace

Rgb idColor(std::uint32_t id)
{
  if (id == 0)
  {
    return { 40, 40, 44 };
  }
  // golden section: hues of neighbouring ids lie far apart; the rest comes from mixed bits
  std::uint32_t mixed = id * 2654435761u;
  mixed ^= mixed >> 15;
  const double hue = std::fmod(id * 0.61803398874989485, 1.0);
  return hueColor(hue, 0.45 + 0.5 * (mixed & 255) / 255.0, 0.65 + 0.35 * (mixed >> 8 & 255) / 255.0);
}

} // namespace dgtk
