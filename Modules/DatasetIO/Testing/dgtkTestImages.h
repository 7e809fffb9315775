// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTestImages_h
#define dgtkTestImages_h

#include "dgtkLayerReader.h"
#include "dgtkLayerWriter.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace dgtk::test
{

/// A layer of a type, with a meaning such that every format that can take the type does.
inline LayerSpec specOf(PixelType type, int channels, const std::string& name = "depth")
{
  static const std::map<std::string, Meaning> meanings{ { "depth", Meaning::Depth }, { "distance", Meaning::Distance },
    { "color", Meaning::Picture }, { "objects", Meaning::Id }, { "alpha", Meaning::Id }, { "parts", Meaning::Index },
    { "triangles", Meaning::Index }, { "normal", Meaning::Direction }, { "uv", Meaning::TextureCoordinates },
    { "flow_forward", Meaning::Displacement }, { "flow_class", Meaning::Visibility } };
  LayerSpec spec;
  spec.name = name;
  spec.meaning = meanings.at(name);
  spec.type = type;
  spec.channels = channels;
  spec.unit = "1";
  return spec;
}

/// The specifications that the tests over the whole registry try.
inline std::vector<LayerSpec> allSpecs()
{
  std::vector<LayerSpec> specs;
  for (const PixelType type :
    { PixelType::UInt8, PixelType::UInt16, PixelType::UInt32, PixelType::Float32, PixelType::Float64 })
  {
    for (int channels = 1; channels <= 5; ++channels)
    {
      for (const char* name : { "depth", "color", "objects", "normal" })
      {
        specs.push_back(specOf(type, channels, name));
      }
    }
  }
  return specs;
}

/// Mixes bits; the test images come from it (a counter-based generator).
inline std::uint64_t mixed(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Areas of one value, ramps and noise; floats with infinities and NaN of their own layers. Integers of 32 bits stay
/// below `most`.
inline Rows testImage(const LayerSpec& spec, int width, int height, std::uint32_t most = 0xffff)
{
  Rows rows(spec.type, spec.channels, width, 0, height);
  const std::size_t count = rows.bytes() / bytesOf(spec.type);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t noise = mixed(i);
    const std::uint64_t value = i % 97 < 40 ? 7 : i % 97 < 70 ? i * 3 : noise;
    switch (spec.type)
    {
      case PixelType::UInt8:
        rows.row<std::uint8_t>(0)[i] = static_cast<std::uint8_t>(value);
        break;
      case PixelType::UInt16:
        rows.row<std::uint16_t>(0)[i] = static_cast<std::uint16_t>(value);
        break;
      case PixelType::UInt32:
        rows.row<std::uint32_t>(0)[i] = static_cast<std::uint32_t>(value) & most;
        break;
      case PixelType::Float32:
      case PixelType::Float64:
      {
        const double v = i % 31 == 0 ? std::numeric_limits<double>::infinity() : double(value % 100003) / 1024 + 0.5;
        spec.type == PixelType::Float32 ? void(rows.row<float>(0)[i] = float(v)) : void(rows.row<double>(0)[i] = v);
        break;
      }
    }
  }
  return rows;
}

/// Writes an image in blocks of `block` rows.
inline FileRecord writeImage(const std::string& format, const std::string& path, const LayerSpec& spec,
  const Rows& image, int block, const LayerWriterContext& context)
{
  const auto writer = makeLayerWriter(format, path, spec, image.width(), image.height(), context);
  for (int y = 0; y < image.height(); y += block)
  {
    Rows part(spec.type, spec.channels, image.width(), y, std::min(block, image.height() - y));
    std::memcpy(part.data(), image.data() + image.rowBytes() * std::size_t(y), part.bytes());
    writer->write(part);
  }
  return writer->finish();
}

inline LayerWriterContext testContext()
{
  LayerWriterContext context;
  context.projection << 2, 0, 0.5, 0, 0, 3, 0.25, 0, 0, 0, -1.5, -2.5, 0, 0, -1, 0;
  context.modelView << 0, 1, 0, 4, -1, 0, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1;
  context.near = 0.5;
  context.far = 100;
  return context;
}

} // namespace dgtk::test

#endif
