// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPcx.h"

#include "dgtkFile.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::size_t headerBytes = 128;
constexpr std::size_t paletteBytes = 768;

/// Bytes of the picture's rows, `rowBytes` each, all planes of a row one after another. What is missing stays 0.
std::vector<std::uint8_t> unpack(const std::string& file, std::size_t bytes)
{
  std::vector<std::uint8_t> out;
  out.reserve(bytes);
  for (std::size_t at = headerBytes; at < file.size() && out.size() < bytes; ++at)
  {
    auto value = static_cast<std::uint8_t>(file[at]);
    std::size_t run = 1;
    if (value >= 0xc0 && at + 1 < file.size())
    {
      run = value & 0x3fu;
      value = static_cast<std::uint8_t>(file[++at]);
    }
    out.insert(out.end(), std::min(run, bytes - out.size()), value);
  }
  out.resize(bytes, 0);
  return out;
}
} // namespace

std::shared_ptr<Image> decodePcx(const std::string& path, int largestSide, std::string& problem)
{
  const std::string file = readFile(path, std::uint64_t(1) << 30);
  const auto byte = [&file](std::size_t at) { return std::size_t(static_cast<std::uint8_t>(file[at])); };
  const auto word = [&byte](std::size_t at) { return byte(at) + 256 * byte(at + 1); };
  if (file.size() < headerBytes || byte(0) != 10 || byte(2) != 1 || byte(3) != 8)
  {
    problem = "is not an 8-bit run-length coded PCX picture";
    return nullptr;
  }
  const std::size_t planes = byte(65);
  const std::size_t lineBytes = word(66);
  const std::size_t width = word(8) - word(4) + 1;
  const std::size_t height = word(10) - word(6) + 1;
  const auto limit = static_cast<std::size_t>(largestSide);
  const bool paletted = planes == 1;
  if (word(8) < word(4) || word(10) < word(6) || width > limit || height > limit || lineBytes < width ||
      (planes != 1 && planes != 3))
  {
    problem = "is a PCX picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels in " +
              std::to_string(planes) + " planes, which cannot be read";
    return nullptr;
  }
  if (paletted && (file.size() < headerBytes + paletteBytes + 1 || byte(file.size() - paletteBytes - 1) != 12))
  {
    problem = "is a PCX picture without its palette";
    return nullptr;
  }
  // a run of 63 takes two bytes: a file cannot hold more pixels than this
  if (lineBytes * planes * height > (file.size() - headerBytes) * 32)
  {
    problem = "is a PCX picture cut short";
    return nullptr;
  }
  const std::vector<std::uint8_t> rows = unpack(file, lineBytes * planes * height);
  auto image = std::make_shared<Image>();
  image->width = static_cast<int>(width);
  image->height = static_cast<int>(height);
  image->rgba.resize(width * height * 4, 255);
  for (std::size_t y = 0; y < height; ++y)
  {
    const std::uint8_t* line = &rows[y * lineBytes * planes];
    for (std::size_t x = 0; x < width; ++x)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        image->rgba[(y * width + x) * 4 + c] =
          paletted ? static_cast<std::uint8_t>(file[file.size() - paletteBytes + std::size_t(line[x]) * 3 + c])
                   : line[c * lineBytes + x];
      }
    }
  }
  return image;
}

} // namespace dgtk
