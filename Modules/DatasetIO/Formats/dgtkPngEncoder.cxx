// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPngEncoder.h"

#include "dgtkError.h"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace dgtk
{

namespace
{
constexpr int wholeLevel = 1;  // libdeflate
constexpr int streamLevel = 1; // zlib
constexpr std::size_t chunkBytes = std::size_t(1) << 20;

void putBig32(unsigned char* to, std::uint32_t value)
{
  for (int i = 0; i < 4; ++i)
  {
    to[i] = static_cast<unsigned char>(value >> (24 - 8 * i));
  }
}

// Residuals as signed bytes; the row with the smallest sum is usually the one that compresses best.
std::uint64_t sumOfResiduals(const unsigned char* bytes, std::size_t count)
{
  std::uint64_t sum = 0;
  for (std::size_t start = 0; start < count; start += 4096)
  {
    const std::size_t stop = std::min(count, start + 4096);
    std::uint32_t part = 0;
    for (std::size_t i = start; i < stop; ++i)
    {
      const unsigned char v = bytes[i];
      part += std::min<unsigned char>(v, static_cast<unsigned char>(-v));
    }
    sum += part;
  }
  return sum;
}

inline unsigned char paeth(int a, int b, int c)
{
  const int pa = std::abs(b - c);
  const int pb = std::abs(a - c);
  const int pc = std::abs(a + b - 2 * c);
  const int bc = pb <= pc ? b : c;
  return static_cast<unsigned char>(pa <= pb && pa <= pc ? a : bc);
}
} // namespace

class PngEncoder::Compressor
{
public:
  explicit Compressor(PngEncoder& owner)
    : Owner(owner)
  {
  }
  virtual ~Compressor() = default;
  /// A filtered row with its filter's number in front.
  virtual void add(const unsigned char* bytes, std::size_t count) = 0;
  virtual void finish() = 0;

protected:
  PngEncoder& Owner;
};

class PngEncoder::WholeCompressor : public PngEncoder::Compressor
{
public:
  WholeCompressor(PngEncoder& owner, std::size_t bytes)
    : Compressor(owner)
  {
    this->Raw.reserve(bytes);
  }

  void add(const unsigned char* bytes, std::size_t count) override
  {
    this->Raw.insert(this->Raw.end(), bytes, bytes + count);
  }

  void finish() override
  {
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(wholeLevel), &libdeflate_free_compressor);
    if (!compressor)
    {
      throw MachineError("out of memory while a PNG file is compressed");
    }
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), this->Raw.size());
    const std::unique_ptr<unsigned char[]> packed(new unsigned char[bound]);
    const std::size_t size =
      libdeflate_zlib_compress(compressor.get(), this->Raw.data(), this->Raw.size(), packed.get(), bound);
    this->Owner.chunk("IDAT", packed.get(), size);
  }

private:
  std::vector<unsigned char> Raw;
};

class PngEncoder::StreamCompressor : public PngEncoder::Compressor
{
public:
  explicit StreamCompressor(PngEncoder& owner)
    : Compressor(owner)
    , Packed(chunkBytes)
  {
    if (deflateInit(&this->Stream, streamLevel) != Z_OK)
    {
      throw MachineError("out of memory while a PNG file is compressed");
    }
    this->rewind();
  }
  ~StreamCompressor() override { deflateEnd(&this->Stream); }

  void add(const unsigned char* bytes, std::size_t count) override
  {
    this->Stream.next_in = const_cast<unsigned char*>(bytes);
    this->Stream.avail_in = static_cast<uInt>(count);
    while (this->Stream.avail_in > 0)
    {
      deflate(&this->Stream, Z_NO_FLUSH);
      if (this->Stream.avail_out == 0)
      {
        this->flush();
      }
    }
  }

  void finish() override
  {
    while (deflate(&this->Stream, Z_FINISH) != Z_STREAM_END)
    {
      this->flush();
    }
    this->flush();
  }

private:
  void rewind()
  {
    this->Stream.next_out = this->Packed.data();
    this->Stream.avail_out = static_cast<uInt>(this->Packed.size());
  }
  void flush()
  {
    const std::size_t size = this->Packed.size() - this->Stream.avail_out;
    if (size > 0)
    {
      this->Owner.chunk("IDAT", this->Packed.data(), size);
    }
    this->rewind();
  }

  z_stream Stream = {};
  std::vector<unsigned char> Packed;
};

PngEncoder::PngEncoder(const Header& header, Sink sink)
  : Out(std::move(sink))
  , Head(header)
  , RowBytes(std::size_t(header.width) * header.channels * (header.bitDepth / 8))
  , Previous(RowBytes + 8)
  , Current(RowBytes + 8)
  , Filtered((RowBytes + 1) * 3)
{
  constexpr unsigned char colorTypes[] = { 0, 4, 2, 6 };
  unsigned char start[13] = {};
  putBig32(start, static_cast<std::uint32_t>(header.width));
  putBig32(start + 4, static_cast<std::uint32_t>(header.height));
  start[8] = static_cast<unsigned char>(header.bitDepth);
  constexpr unsigned char indices = 3;
  start[9] = header.palette.empty() ? colorTypes[header.channels - 1] : indices;
  this->Out("\x89PNG\r\n\x1a\n", 8);
  this->chunk("IHDR", start, sizeof start);
  if (header.srgb)
  {
    this->chunk("sRGB", "\0", 1);
  }
  if (!header.palette.empty())
  {
    this->chunk("PLTE", header.palette.data(), header.palette.size());
  }
  if (header.nothing)
  {
    this->chunk("tRNS", "\xff\xff", 2);
  }
  const std::uint64_t raw = std::uint64_t(this->RowBytes + 1) * static_cast<std::uint64_t>(header.height);
  if (raw <= wholeImageBytes)
  {
    this->Deflate = std::make_unique<WholeCompressor>(*this, static_cast<std::size_t>(raw));
  }
  else
  {
    this->Deflate = std::make_unique<StreamCompressor>(*this);
  }
}

PngEncoder::~PngEncoder() = default;

void PngEncoder::chunk(const char* type, const void* data, std::size_t bytes)
{
  unsigned char head[8];
  putBig32(head, static_cast<std::uint32_t>(bytes));
  std::memcpy(head + 4, type, 4);
  unsigned char tail[4];
  const std::uint32_t crc = libdeflate_crc32(0, type, 4);
  putBig32(tail, bytes > 0 ? libdeflate_crc32(crc, data, bytes) : crc); // a null pointer would start over
  this->Out(head, 8);
  this->Out(data, bytes);
  this->Out(tail, 4);
}

void PngEncoder::row(const unsigned char* bytes)
{
  const std::size_t count = this->RowBytes;
  unsigned char* const candidate = this->Filtered.data();
  std::memcpy(this->Current.data() + 8, bytes, count);
  if (this->Head.prediction == PngPrediction::Smooth)
  {
    this->filterSmooth(this->Current.data() + 8, candidate);
  }
  else
  {
    const unsigned char* above = this->Previous.data() + 8;
    candidate[0] = 2;
    for (std::size_t i = 0; i < count; ++i)
    {
      candidate[i + 1] = static_cast<unsigned char>(bytes[i] - above[i]);
    }
    this->Deflate->add(candidate, count + 1);
  }
  this->Previous.swap(this->Current);
}

void PngEncoder::filterSmooth(const unsigned char* bytes, unsigned char* out)
{
  const std::size_t count = this->RowBytes;
  const std::size_t step = std::size_t(this->Head.channels) * (this->Head.bitDepth / 8);
  const unsigned char* above = this->Previous.data() + 8;
  unsigned char* const sub = out;
  unsigned char* const up = out + (count + 1);
  unsigned char* const mixed = out + 2 * (count + 1);
  sub[0] = 1;
  up[0] = 2;
  mixed[0] = 4;
  // up to 8 zero bytes stand in front of both rows
  const unsigned char* left = bytes - step;
  const unsigned char* aboveLeft = above - step;
  for (std::size_t i = 0; i < count; ++i)
  {
    sub[i + 1] = static_cast<unsigned char>(bytes[i] - left[i]);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    up[i + 1] = static_cast<unsigned char>(bytes[i] - above[i]);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    mixed[i + 1] = static_cast<unsigned char>(bytes[i] - paeth(left[i], above[i], aboveLeft[i]));
  }
  const std::uint64_t sums[] = { sumOfResiduals(sub + 1, count), sumOfResiduals(up + 1, count),
    sumOfResiduals(mixed + 1, count) };
  const auto best = std::min_element(sums, sums + 3) - sums;
  this->Deflate->add(out + static_cast<std::size_t>(best) * (count + 1), count + 1);
}

void PngEncoder::finish()
{
  this->Deflate->finish();
  this->chunk("IEND", nullptr, 0);
}

} // namespace dgtk
