// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayer.h"

namespace dgtk
{

namespace
{
struct TypeRow
{
  PixelType type;
  std::size_t bytes;
  const char* name;
};
constexpr TypeRow typeTable[] = { { PixelType::UInt8, 1, "uint8" }, { PixelType::UInt16, 2, "uint16" },
  { PixelType::UInt32, 4, "uint32" }, { PixelType::Float32, 4, "float32" }, { PixelType::Float64, 8, "float64" } };
} // namespace

std::size_t bytesOf(PixelType type) { return typeTable[static_cast<int>(type)].bytes; }

const char* nameOf(PixelType type) { return typeTable[static_cast<int>(type)].name; }

Rows::Rows(PixelType type, int channels, int width, int y, int height)
  : Type(type)
  , Channels(channels)
  , Width(width)
  , Y(y)
  , Height(height)
  , Data(new std::byte[bytesOf(type) * std::size_t(channels) * width * height])
{
}

} // namespace dgtk
