// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPcx.h"

#include <algorithm>
#include <vector>

namespace dgtk
{

const char* const pcxCutShort = "is a PCX picture cut short";

namespace
{
constexpr std::size_t pcxHeader = 128;
constexpr std::size_t paletteBytes = 768;

/// Bytes of the picture's rows, all planes of a row one after another; fewer than `bytes` where the file lacks some.
std::vector<std::uint8_t> unpack(const std::uint8_t* data, std::size_t size, std::size_t bytes)
{
  std::vector<std::uint8_t> out;
  out.reserve(bytes);
  for (std::size_t at = pcxHeader; at < size && out.size() < bytes; ++at)
  {
    std::uint8_t value = data[at];
    std::size_t run = 1;
    if (value >= 0xc0 && at + 1 < size)
    {
      run = value & 0x3fu;
      value = data[++at];
    }
    out.insert(out.end(), std::min(run, bytes - out.size()), value);
  }
  return out;
}
} // namespace

PcxPicture::PcxPicture(const std::uint8_t* data, std::size_t bytes, int largestSide)
  : Data(data)
  , Bytes(bytes)
{
  if (bytes < pcxHeader || data[0] != 10 || data[2] != 1 || data[3] != 8)
  {
    this->Problem = "is not an 8-bit run-length coded PCX picture";
    return;
  }
  const auto word = [data](std::size_t at) { return std::size_t(data[at]) + 256 * std::size_t(data[at + 1]); };
  this->Planes = data[65];
  this->LineBytes = word(66);
  this->Width = word(8) - word(4) + 1;
  this->Height = word(10) - word(6) + 1;
  const auto limit = static_cast<std::size_t>(largestSide);
  if (word(8) < word(4) || word(10) < word(6) || this->Width > limit || this->Height > limit ||
      this->LineBytes < this->Width || (this->Planes != 1 && this->Planes != 3))
  {
    this->Problem = "is a PCX picture of " + std::to_string(this->Width) + " x " + std::to_string(this->Height) +
                    " pixels in " + std::to_string(this->Planes) + " planes, which cannot be read";
  }
  else if (this->Planes == 1 && (bytes < pcxHeader + paletteBytes + 1 || data[bytes - paletteBytes - 1] != 12))
  {
    this->Problem = "is a PCX picture without its palette";
  }
  // a run of 63 takes two bytes: a file cannot hold more pixels than this
  else if (this->LineBytes * this->Planes * this->Height > (bytes - pcxHeader) * 32)
  {
    this->Problem = pcxCutShort;
  }
}

bool PcxPicture::decode(std::uint8_t* rgb) const
{
  const std::size_t end = this->Planes == 1 ? this->Bytes - paletteBytes - 1 : this->Bytes;
  const std::size_t wanted = this->LineBytes * this->Planes * this->Height;
  const std::vector<std::uint8_t> rows = unpack(this->Data, end, wanted);
  if (rows.size() < wanted)
  {
    return false;
  }
  const std::uint8_t* palette = this->Data + end + 1;
  for (std::size_t y = 0; y < this->Height; ++y)
  {
    const std::uint8_t* line = &rows[y * this->LineBytes * this->Planes];
    for (std::size_t x = 0; x < this->Width; ++x)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        *rgb++ = this->Planes == 1 ? palette[std::size_t(line[x]) * 3 + c] : line[c * this->LineBytes + x];
      }
    }
  }
  return true;
}

} // namespace dgtk
