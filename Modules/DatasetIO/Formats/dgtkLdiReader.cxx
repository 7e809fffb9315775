// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInputFile.h"
#include "dgtkLdi.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::uint64_t headerBytes = 8;
constexpr std::uint64_t countBytes = 4;
constexpr std::uint64_t recordBytes = 16;
constexpr std::size_t ldiBlockBytes = 1 << 20;
} // namespace

struct LdiReader::Impl
{
  explicit Impl(const std::string& path)
    : File(path)
  {
    if (this->File.size() < headerBytes)
    {
      this->File.fail(this->File.size(), "is cut off in its header", "8 bytes", std::to_string(this->File.size()));
    }
    this->Width = this->File.value<std::int32_t>(0);
    this->Height = this->File.value<std::int32_t>(4);
    checkImageSize(this->File, 0, this->Width, this->Height);
    const std::uint64_t least = headerBytes + countBytes * std::uint64_t(this->Width) * std::uint64_t(this->Height);
    if (this->File.size() < least)
    {
      this->File.fail(this->File.size(),
        "is too short for its size of " + std::to_string(this->Width) + " x " + std::to_string(this->Height),
        "at least " + std::to_string(least) + " bytes", std::to_string(this->File.size()) + " bytes");
    }
  }

  // The next bytes of the file, which stay valid until the next call.
  const unsigned char* take(std::uint64_t bytes)
  {
    if (this->At < this->BlockStart || this->At + bytes > this->BlockStart + this->Block.size())
    {
      this->BlockStart = this->At;
      this->Block.resize(std::size_t(std::min<std::uint64_t>(
        std::max<std::uint64_t>(ldiBlockBytes, bytes), this->File.size() - std::min(this->At, this->File.size()))));
      if (this->Block.size() < bytes)
      {
        this->File.fail(this->At, "is cut off", std::to_string(bytes) + " bytes", std::to_string(this->Block.size()));
      }
      this->File.read(this->At, this->Block.data(), this->Block.size());
    }
    const unsigned char* data = this->Block.data() + (this->At - this->BlockStart);
    this->At += bytes;
    return data;
  }

  std::uint32_t takeCount(int x)
  {
    std::uint32_t count;
    std::memcpy(&count, this->take(countBytes), sizeof count);
    const std::uint64_t pixelsLeft =
      std::uint64_t(this->Height - this->Row) * std::uint64_t(this->Width) - std::uint64_t(x) - 1;
    const std::uint64_t left = this->File.size() - this->At;
    if (count * recordBytes + pixelsLeft * countBytes > left)
    {
      this->File.fail(this->At - countBytes, "has more records in a pixel than the rest of the file holds",
        "at most " + std::to_string((left - std::min(left, pixelsLeft * countBytes)) / recordBytes),
        std::to_string(count));
    }
    return count;
  }

  void takeRecord(double& nearest, LdiRecord& record)
  {
    const unsigned char* data = this->take(recordBytes);
    std::memcpy(record.rgba.data(), data, 4);
    std::memcpy(&record.depth, data + 4, 8);
    std::memcpy(&record.splatIndex, data + 12, 4);
    if (!std::isfinite(record.depth) || record.depth < nearest)
    {
      this->File.fail(this->At - recordBytes + 4, "has a depth that is not finite or nearer than the one before");
    }
    nearest = record.depth;
  }

  InputFile File;
  int Width = 0;
  int Height = 0;
  int Row = 0;
  std::uint64_t At = headerBytes;
  std::uint64_t BlockStart = 0;
  std::vector<unsigned char> Block;
};

bool isDeepExr(const std::string& path)
{
  constexpr std::uint32_t exrMagic = 20000630;
  constexpr std::uint32_t deepData = 0x800; // of the version field
  std::uint32_t words[2] = {};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(words), sizeof words);
  return file && words[0] == exrMagic && (words[1] & deepData) != 0;
}

LdiReader::LdiReader(const std::string& path)
  : Self(std::make_unique<Impl>(path))
{
}

LdiReader::~LdiReader() = default;

int LdiReader::width() const { return this->Self->Width; }
int LdiReader::height() const { return this->Self->Height; }

void LdiReader::rewind()
{
  this->Self->Row = 0;
  this->Self->At = headerBytes;
}

bool LdiReader::read(LdiRow& row)
{
  row.counts.clear();
  row.records.clear();
  Impl& self = *this->Self;
  if (self.Row == self.Height)
  {
    return false;
  }
  for (int x = 0; x < self.Width; ++x)
  {
    row.counts.push_back(self.takeCount(x));
    double nearest = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < row.counts.back(); ++i)
    {
      row.records.emplace_back();
      self.takeRecord(nearest, row.records.back());
    }
  }
  ++self.Row;
  if (self.Row == self.Height && self.At != self.File.size())
  {
    self.File.fail(self.At, "goes on behind its last pixel", std::to_string(self.At) + " bytes",
      std::to_string(self.File.size()) + " bytes");
  }
  return true;
}

} // namespace dgtk
