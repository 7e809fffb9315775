// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayer.h"

#include <algorithm>
#include <iterator>

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

constexpr const char* meaningTable[] = { "", "picture", "id", "class", "index", "visibility", "depth", "distance",
  "inverse depth", "point", "direction", "displacement", "texture coordinates", "weights", "coverage", "mask",
  "surfaces", "record" };
} // namespace

const char* nameOf(Meaning meaning) { return meaningTable[static_cast<int>(meaning)]; }

Meaning meaningFromName(const std::string& name)
{
  const auto* const found = std::find(std::begin(meaningTable), std::end(meaningTable), name);
  return found == std::end(meaningTable) ? Meaning::Unknown : static_cast<Meaning>(found - meaningTable);
}

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
