// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInputFile.h"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace dgtk
{

namespace
{
constexpr std::uint64_t largestRatio = 1032; // of deflate
constexpr std::size_t windowBytes = std::size_t(1) << 18;

/// The compressed data: the contents of the IDAT chunks, one behind the other, their checksums checked.
class ImageBytes
{
public:
  explicit ImageBytes(const InputFile& file)
    : File(file)
  {
  }

  /// The length of the next chunk and its type; `at()` is its data.
  std::uint32_t nextChunk(char (&type)[5])
  {
    const std::uint32_t length = this->big32(this->Position);
    this->File.read(this->Position + 4, type, 4);
    type[4] = '\0';
    this->Position += 8;
    if (length > this->File.size() - this->Position || this->File.size() - this->Position - length < 4)
    {
      this->File.fail(this->Position - 8, "a chunk ends beyond the end of the file");
    }
    this->Checksum = libdeflate_crc32(0, type, 4);
    this->Left = length;
    return length;
  }
  std::uint64_t at() const { return this->Position; }
  void skip()
  {
    this->Position += this->Left + std::uint64_t(4);
    this->Left = 0;
  }

  /// Reads the next bytes of the chunk, at most `bytes`; checks it at its end.
  std::size_t read(unsigned char* to, std::size_t bytes)
  {
    const std::size_t n = std::min<std::size_t>(bytes, this->Left);
    this->File.read(this->Position, to, n);
    this->Checksum = libdeflate_crc32(this->Checksum, to, n);
    this->Position += n;
    this->Left -= static_cast<std::uint32_t>(n);
    if (this->Left == 0)
    {
      if (this->big32(this->Position) != this->Checksum)
      {
        this->File.fail(this->Position, "the checksum of a chunk is wrong");
      }
      this->Position += 4;
    }
    return n;
  }
  bool chunkDone() const { return this->Left == 0; }

  std::uint32_t big32(std::uint64_t offset) const
  {
    unsigned char b[4];
    this->File.read(offset, b, 4);
    return std::uint32_t(b[0]) << 24 | std::uint32_t(b[1]) << 16 | std::uint32_t(b[2]) << 8 | b[3];
  }

private:
  const InputFile& File;
  std::uint64_t Position = 8;
  std::uint32_t Left = 0;
  std::uint32_t Checksum = 0;
};

inline unsigned char paeth(int a, int b, int c)
{
  const int pa = std::abs(b - c);
  const int pb = std::abs(a - c);
  const int pc = std::abs(a + b - 2 * c);
  return static_cast<unsigned char>(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

/// 8 and 16 bits, gray to RGBA, without palette and interlace: what DGTk writes. 16-bit gray with a transparent value
/// is read as uint32, 4294967295 in its place.
class PngReader : public RowReader
{
public:
  explicit PngReader(const std::string& path)
    : File(path)
    , Data(File)
    , Window(windowBytes)
  {
    this->readHeader();
    this->findPixels();
    // in front of both rows stand zeros: the pixel to the left of the first
    this->Row.resize(this->RowBytes + 8);
    this->Above.resize(this->RowBytes + 8);
    if (inflateInit(&this->Stream) != Z_OK)
    {
      this->File.fail(0, "cannot be decompressed: out of memory");
    }
  }
  ~PngReader() override { inflateEnd(&this->Stream); }

protected:
  void readRows(Rows& rows) override
  {
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      unsigned char filter = 0;
      this->unpack(&filter, 1);
      this->unpack(this->Row.data() + 8, this->RowBytes);
      this->reconstruct(filter);
      switch (rows.type())
      {
        case PixelType::UInt8:
          std::memcpy(rows.row<unsigned char>(y), this->Row.data() + 8, this->RowBytes);
          break;
        case PixelType::UInt16:
          this->words(rows.row<std::uint16_t>(y), [](std::uint16_t word) { return word; });
          break;
        default:
          this->words(rows.row<std::uint32_t>(y),
            [this](std::uint16_t word) { return word == this->Nothing ? 0xffffffffu : std::uint32_t(word); });
      }
      this->Row.swap(this->Above);
    }
    if (rows.y() + rows.height() == this->Info.height)
    {
      this->checkEnd();
    }
  }

private:
  template <typename T, typename F>
  void words(T* to, const F& valueOf) const
  {
    for (std::size_t i = 8; i < this->Row.size(); i += 2)
    {
      *to++ = valueOf(static_cast<std::uint16_t>(this->Row[i] << 8 | this->Row[i + 1]));
    }
  }

  void readHeader()
  {
    if (this->File.head(8) != std::string("\x89PNG\r\n\x1a\n", 8))
    {
      this->File.fail(0, "is not a PNG file");
    }
    char type[5];
    unsigned char head[13];
    if (this->Data.nextChunk(type) != sizeof head || std::strcmp(type, "IHDR") != 0)
    {
      this->File.fail(8, "the header is missing", "IHDR", quotedType(type));
    }
    this->Data.read(head, sizeof head);
    const std::int64_t width = this->Data.big32(16);
    const std::int64_t height = this->Data.big32(20);
    checkImageSize(this->File, 16, width, height);
    constexpr int channelsOf[] = { 1, 0, 3, 0, 2, 0, 4 };
    const bool known = head[9] < 7 && channelsOf[head[9]] > 0;
    if (!known || (head[8] != 8 && head[8] != 16) || head[10] != 0 || head[11] != 0 || head[12] != 0)
    {
      this->File.fail(24, "unsupported kind of PNG file", "8 or 16 bits, no palette, not interlaced",
        std::to_string(head[8]) + " bits, color type " + std::to_string(head[9]) + ", interlace " +
          std::to_string(head[12]));
    }
    this->Info.format = "png";
    this->Info.type = head[8] == 8 ? PixelType::UInt8 : PixelType::UInt16;
    this->Info.channels = channelsOf[head[9]];
    this->Info.width = static_cast<int>(width);
    this->Info.height = static_cast<int>(height);
    this->PixelBytes = std::size_t(this->Info.channels) * (head[8] / 8);
    this->RowBytes = std::size_t(width) * this->PixelBytes;
    if (this->Info.pixelBytes() / largestRatio > this->File.size())
    {
      this->File.fail(16, "more pixels than a file of this size can hold", {},
        std::to_string(width) + " x " + std::to_string(height));
    }
  }

  static std::string quotedType(const char* type) { return "'" + std::string(type, 4) + "'"; }

  /// A transparent value of 16-bit gray stands for nothing.
  void readTransparent(std::uint64_t at, std::uint32_t length)
  {
    if (this->Info.type != PixelType::UInt16 || this->Info.channels != 1)
    {
      this->Data.skip();
      return;
    }
    unsigned char value[2] = { 0, 0 };
    if (length != sizeof value)
    {
      this->File.fail(at, "the transparent value has a wrong length", "2", std::to_string(length));
    }
    this->Data.read(value, sizeof value);
    this->Nothing = static_cast<std::uint16_t>(value[0] << 8 | value[1]);
    this->Info.type = PixelType::UInt32;
  }

  /// Goes on to the next pixels.
  void findPixels()
  {
    while (this->Data.chunkDone())
    {
      char type[5];
      const std::uint64_t at = this->Data.at();
      const std::uint32_t length = this->Data.nextChunk(type);
      if (std::strcmp(type, "tRNS") == 0 && !this->Started)
      {
        this->readTransparent(at, length);
      }
      else if (std::strcmp(type, "IDAT") != 0)
      {
        if (this->Started || std::strcmp(type, "IEND") == 0)
        {
          this->File.fail(at, "the pixels end too early");
        }
        this->Data.skip();
      }
      else if (length == 0)
      {
        this->Data.skip();
      }
      else
      {
        this->Started = true;
      }
    }
  }

  /// Fills the window with compressed bytes.
  void refill()
  {
    this->findPixels();
    this->Stream.avail_in = static_cast<uInt>(this->Data.read(this->Window.data(), this->Window.size()));
    this->Stream.next_in = this->Window.data();
  }

  void unpack(unsigned char* to, std::size_t bytes)
  {
    this->Stream.next_out = to;
    this->Stream.avail_out = static_cast<uInt>(bytes);
    while (this->Stream.avail_out > 0)
    {
      if (this->Ended)
      {
        this->File.fail(this->Data.at(), "the pixels end too early");
      }
      this->step();
    }
  }

  void step()
  {
    if (this->Stream.avail_in == 0)
    {
      this->refill();
    }
    const int state = inflate(&this->Stream, Z_NO_FLUSH);
    this->Ended = state == Z_STREAM_END;
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
    {
      this->File.fail(this->Data.at(), "damaged compressed data");
    }
  }

  /// Behind the last row the stream ends, with its checksum.
  void checkEnd()
  {
    unsigned char extra = 0;
    this->Stream.next_out = &extra;
    this->Stream.avail_out = 1;
    while (!this->Ended && this->Stream.avail_out > 0)
    {
      this->step();
    }
    if (this->Stream.avail_out == 0)
    {
      this->File.fail(this->Data.at(), "more pixels than the header says");
    }
  }

  void reconstruct(unsigned char filter)
  {
    unsigned char* const row = this->Row.data() + 8;
    const unsigned char* const above = this->Above.data() + 8;
    const unsigned char* const left = row - this->PixelBytes;
    const unsigned char* const corner = above - this->PixelBytes;
    const std::size_t n = this->RowBytes;
    switch (filter)
    {
      case 0:
        break;
      case 1:
        for (std::size_t i = 0; i < n; ++i)
        {
          row[i] = static_cast<unsigned char>(row[i] + left[i]);
        }
        break;
      case 2:
        for (std::size_t i = 0; i < n; ++i)
        {
          row[i] = static_cast<unsigned char>(row[i] + above[i]);
        }
        break;
      case 3:
        for (std::size_t i = 0; i < n; ++i)
        {
          row[i] = static_cast<unsigned char>(row[i] + (left[i] + above[i]) / 2);
        }
        break;
      case 4:
        for (std::size_t i = 0; i < n; ++i)
        {
          row[i] = static_cast<unsigned char>(row[i] + paeth(left[i], above[i], corner[i]));
        }
        break;
      default:
        this->File.fail(this->Data.at(), "unknown filter of a row", "0 to 4", std::to_string(filter));
    }
  }

  InputFile File;
  ImageBytes Data;
  std::vector<unsigned char> Window;
  std::vector<unsigned char> Row;
  std::vector<unsigned char> Above;
  z_stream Stream = {};
  std::size_t PixelBytes = 0;
  std::size_t RowBytes = 0;
  std::uint16_t Nothing = 0; ///< value that is none, of a file read as uint32
  bool Started = false;
  bool Ended = false;
};
} // namespace

std::unique_ptr<RowReader> openPngReader(const std::string& path) { return std::make_unique<PngReader>(path); }

} // namespace dgtk
