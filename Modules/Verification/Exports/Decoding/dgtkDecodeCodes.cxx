// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace dgtk
{

namespace
{
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void requireChannels(const std::string& path, const DecodedPixels& pixels, int channels)
{
  if (pixels.channels != channels)
  {
    throw InputError(
      path, "expected " + std::to_string(channels) + " channels, found " + std::to_string(pixels.channels));
  }
}
} // namespace

// KITTI's development kit, io_flow.h: u = (R - 2^15) / 64, v = (G - 2^15) / 64, valid where B is not 0.
DecodedPixels decodeKittiFlow(const std::string& path, const PixelEncoding& encoding)
{
  const DecodedPixels codes = decodePng(path, encoding);
  requireChannels(path, codes, 3);
  DecodedPixels flow{ codes.width, codes.height, 2, {} };
  for (std::size_t i = 0; i + 2 < codes.values.size(); i += 3)
  {
    const bool valid = codes.values[i + 2] != 0;
    if (!valid && (codes.values[i] != 0 || codes.values[i + 1] != 0))
    {
      throw InputError(path, "has flow where it is marked as not valid");
    }
    flow.values.push_back(valid ? (codes.values[i] - 32768) / 64 : nothing);
    flow.values.push_back(valid ? (codes.values[i + 1] - 32768) / 64 : nothing);
  }
  return flow;
}

// sintel_io.py: d = R 4 + G / 64 + B / 16384.
DecodedPixels decodeSintelDisparity(const std::string& path, const PixelEncoding& encoding)
{
  const DecodedPixels codes = decodePng(path, encoding);
  requireChannels(path, codes, 3);
  DecodedPixels pixels{ codes.width, codes.height, 1, {} };
  for (std::size_t i = 0; i + 2 < codes.values.size(); i += 3)
  {
    const double d = codes.values[i] * 4 + codes.values[i + 1] / 64 + codes.values[i + 2] / 16384;
    pixels.values.push_back(d == 0 ? nothing : d);
  }
  return pixels;
}

// sintel_io.py: float32 202021.25, int32 width, int32 height, float32 rows.
DecodedPixels decodeDpt(const std::string& path, const PixelEncoding&)
{
  const std::string bytes = readFile(path);
  float tag = 0;
  std::int32_t size[2] = { 0, 0 };
  if (bytes.size() >= 12)
  {
    std::memcpy(&tag, bytes.data(), 4);
    std::memcpy(size, bytes.data() + 4, 8);
  }
  const std::size_t count = std::size_t(std::max(size[0], 0)) * std::size_t(std::max(size[1], 0));
  if (tag != 202021.25F || count == 0 || bytes.size() != 12 + 4 * count)
  {
    throw InputError(path, "is no depth map of Sintel");
  }
  DecodedPixels pixels{ size[0], size[1], 1, {} };
  for (std::size_t i = 0; i < count; ++i)
  {
    float value = 0;
    std::memcpy(&value, bytes.data() + 12 + 4 * i, 4);
    pixels.values.push_back(std::isfinite(value) ? double(value) : nothing);
  }
  return pixels;
}

// SceneFlow's flow as colour .pfm: u, v, 0.
DecodedPixels decodeFlowPfm(const std::string& path, const PixelEncoding& encoding)
{
  const DecodedPixels codes = decodePng(path, {});
  requireChannels(path, codes, 3);
  const double none = numberOf(encoding, "nothing", nothing);
  DecodedPixels flow{ codes.width, codes.height, 2, {} };
  for (std::size_t i = 0; i + 2 < codes.values.size(); i += 3)
  {
    if (codes.values[i + 2] != 0)
    {
      throw InputError(path, "has a third component");
    }
    for (std::size_t c = 0; c < 2; ++c)
    {
      const double value = codes.values[i + c];
      flow.values.push_back(std::isfinite(value) && value != none ? value : nothing);
    }
  }
  return flow;
}

void fillPolygon(const std::vector<double>& polygon, int width, int height, std::vector<char>& mask)
{
  const std::size_t corners = polygon.size() / 2;
  for (int y = 0; y < height; ++y)
  {
    std::vector<double> crossings;
    for (std::size_t i = 0; i < corners; ++i)
    {
      const std::size_t j = (i + 1) % corners;
      const double y0 = polygon[2 * i + 1] - (y + 0.5);
      const double y1 = polygon[2 * j + 1] - (y + 0.5);
      if ((y0 < 0) != (y1 < 0))
      {
        crossings.push_back(polygon[2 * i] + (polygon[2 * j] - polygon[2 * i]) * y0 / (y0 - y1));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    {
      for (int x = std::max(0, int(std::ceil(crossings[i] - 0.5))); x < width && x + 0.5 < crossings[i + 1]; ++x)
      {
        mask[std::size_t(y) * width + x] = 1;
      }
    }
  }
}

// mvs/mat.h: "width&height&channels&", then float32, channel after channel.
DecodedPixels decodeColmap(const std::string& path, const PixelEncoding& encoding)
{
  const std::string bytes = readFile(path);
  DecodedPixels pixels;
  char end = 0;
  int length = 0;
  const int read = std::sscanf(
    bytes.substr(0, 64).c_str(), "%d&%d&%d%c%n", &pixels.width, &pixels.height, &pixels.channels, &end, &length);
  const std::size_t plane = std::size_t(std::max(pixels.width, 0)) * std::size_t(std::max(pixels.height, 0));
  const std::size_t channels = std::size_t(std::max(pixels.channels, 0));
  if (read != 4 || end != '&' || plane * channels == 0 || bytes.size() != std::size_t(length) + 4 * plane * channels)
  {
    throw InputError(path, "is no map of COLMAP");
  }
  const double none = numberOf(encoding, "nothing", 0);
  pixels.values.resize(plane * channels);
  for (std::size_t i = 0; i < plane; ++i)
  {
    bool there = false;
    for (std::size_t c = 0; c < channels; ++c)
    {
      float value = 0;
      std::memcpy(&value, bytes.data() + length + 4 * (c * plane + i), 4);
      pixels.values[i * channels + c] = double(value);
      there = there || double(value) != none;
    }
    for (std::size_t c = 0; c < channels && !there; ++c)
    {
      pixels.values[i * channels + c] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return pixels;
}

} // namespace dgtk
