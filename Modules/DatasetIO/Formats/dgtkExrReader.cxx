// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkInputFile.h"

#include <libdeflate.h>

#include <algorithm>
#include <vector>

namespace dgtk
{

namespace
{
constexpr std::uint64_t largestHeader = 1 << 20;

struct Channel
{
  std::string name;
  int fileIndex = 0;
};

/// Scan lines of float32 channels, not compressed or with ZIP (by 16 or by single lines).
class ExrReader : public RowReader
{
public:
  explicit ExrReader(const std::string& path)
    : File(path)
    , Decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor)
  {
    this->Info.format = "exr";
    this->Info.type = PixelType::Float32;
    this->readHeader();
    this->checkSizes();
  }

protected:
  bool anyRow() const override { return true; }
  void readRows(Rows& rows) override
  {
    const std::size_t channels = this->Channels.size();
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      this->load(y / this->ChunkRows);
      const unsigned char* line = &this->Chunk[std::size_t(y % this->ChunkRows) * this->RowBytes];
      float* to = rows.row<float>(y);
      for (std::size_t c = 0; c < channels; ++c)
      {
        const unsigned char* plane =
          line + std::size_t(this->Channels[c].fileIndex) * static_cast<std::size_t>(this->Info.width) * 4;
        for (std::size_t x = 0; x < std::size_t(this->Info.width); ++x)
        {
          std::memcpy(to + x * channels + c, plane + x * 4, 4);
        }
      }
    }
  }

private:
  std::string word(std::uint64_t& at) const
  {
    std::string text;
    for (char c; (c = this->File.value<char>(at++)) != '\0';)
    {
      text += c;
      if (text.size() > 255)
      {
        this->File.fail(at, "a name without an end");
      }
    }
    return text;
  }

  void readHeader()
  {
    if (this->File.value<std::uint32_t>(0) != 20000630)
    {
      this->File.fail(0, "is not an OpenEXR file");
    }
    const auto version = this->File.value<std::uint32_t>(4);
    if ((version & ~std::uint32_t(0x400)) != 2)
    {
      this->File.fail(
        4, "unsupported kind of OpenEXR file", "version 2, one part, scan lines", std::to_string(version));
    }
    bool seen[3] = {};
    std::uint64_t at = 8;
    for (std::string name; !(name = this->word(at)).empty();)
    {
      const std::string type = this->word(at);
      const auto size = this->File.value<std::uint32_t>(at);
      at += 4;
      if (at + size > std::min(this->File.size(), largestHeader))
      {
        this->File.fail(at - 4, "unusable size of the attribute " + quoted(name), {}, std::to_string(size));
      }
      if (name == "channels" && type == "chlist")
      {
        this->readChannels(at, at + size);
        seen[0] = true;
      }
      else if (name == "compression" && size == 1)
      {
        this->readCompression(at);
        seen[1] = true;
      }
      else if (name == "dataWindow" && size == 16)
      {
        this->readWindow(at);
        seen[2] = true;
      }
      at += size;
    }
    if (!seen[0] || !seen[1] || !seen[2])
    {
      this->File.fail(at, "incomplete header", "channels, compression and dataWindow");
    }
    this->TableStart = at;
  }

  void readChannels(std::uint64_t at, std::uint64_t end)
  {
    this->Channels.clear();
    while (at < end && this->File.value<char>(at) != '\0')
    {
      Channel channel;
      channel.name = this->word(at);
      channel.fileIndex = static_cast<int>(this->Channels.size());
      if (this->File.value<std::int32_t>(at) != 2 || this->File.value<std::int32_t>(at + 8) != 1 ||
          this->File.value<std::int32_t>(at + 12) != 1)
      {
        this->File.fail(at, "unsupported channel " + quoted(channel.name), "32-bit float without subsampling");
      }
      at += 16;
      this->Channels.push_back(channel);
    }
    if (this->Channels.empty() || this->Channels.size() > 1024)
    {
      this->File.fail(at, "unusable number of channels", {}, std::to_string(this->Channels.size()));
    }
    // in the file by name; R, G, B, A as such
    const auto rank = [](const Channel& c)
    {
      const std::size_t place = std::string("RGBA").find(c.name);
      return c.name.size() == 1 && place != std::string::npos ? static_cast<int>(place) : 4;
    };
    std::stable_sort(this->Channels.begin(), this->Channels.end(),
      [&](const Channel& a, const Channel& b) { return rank(a) < rank(b); });
    this->Info.channels = static_cast<int>(this->Channels.size());
  }

  void readCompression(std::uint64_t at)
  {
    const int kind = this->File.value<std::uint8_t>(at);
    if (kind != 0 && kind != 2 && kind != 3)
    {
      this->File.fail(at, "unsupported compression", "none (0) or ZIP (2, 3)", std::to_string(kind));
    }
    this->ChunkRows = kind == 3 ? 16 : 1;
    this->Compressed = kind != 0;
  }

  void readWindow(std::uint64_t at)
  {
    std::int32_t box[4];
    this->File.read(at, box, sizeof box);
    const std::int64_t width = std::int64_t(box[2]) - box[0] + 1;
    const std::int64_t height = std::int64_t(box[3]) - box[1] + 1;
    checkImageSize(this->File, at, width, height);
    this->FirstLine = box[1];
    this->Info.width = static_cast<int>(width);
    this->Info.height = static_cast<int>(height);
  }

  void checkSizes()
  {
    this->RowBytes = std::size_t(this->Info.width) * static_cast<std::size_t>(this->Info.channels) * 4;
    const std::uint64_t chunks = std::uint64_t((this->Info.height - 1) / this->ChunkRows) + 1;
    const std::uint64_t ratio = this->Compressed ? deflateRatio : 1;
    if (this->TableStart + chunks * 16 > this->File.size() || this->Info.pixelBytes() / ratio > this->File.size())
    {
      this->File.fail(this->TableStart, "more pixels than a file of this size can hold", {},
        std::to_string(this->Info.width) + " x " + std::to_string(this->Info.height));
    }
  }

  void load(int chunk)
  {
    if (chunk == this->Loaded)
    {
      return;
    }
    const auto offset = this->File.value<std::uint64_t>(this->TableStart + std::uint64_t(chunk) * 8);
    if (offset > this->File.size() || this->File.size() - offset < 8)
    {
      this->File.fail(this->TableStart + std::uint64_t(chunk) * 8, "an offset beyond the end of the file", {},
        std::to_string(offset));
    }
    const auto line = this->File.value<std::int32_t>(offset);
    const auto size = this->File.value<std::uint32_t>(offset + 4);
    const int first = chunk * this->ChunkRows;
    const std::size_t raw =
      this->RowBytes * static_cast<std::size_t>(std::min(this->ChunkRows, this->Info.height - first));
    if (line - std::int64_t(this->FirstLine) != first)
    {
      this->File.fail(offset, "another line than expected", std::to_string(std::int64_t(this->FirstLine) + first),
        std::to_string(line));
    }
    if (size > raw || (size < raw && !this->Compressed))
    {
      this->File.fail(offset + 4, "unusable size of a chunk", std::to_string(raw) + " at most", std::to_string(size));
    }
    this->Chunk.resize(raw);
    if (size == raw)
    {
      this->File.read(offset + 8, this->Chunk.data(), raw);
    }
    else
    {
      this->Packed.resize(size);
      this->File.read(offset + 8, this->Packed.data(), size);
      this->unpack(offset + 8, raw);
    }
    this->Loaded = chunk;
  }

  void unpack(std::uint64_t offset, std::size_t raw)
  {
    this->Delta.resize(raw);
    if (!this->Decompressor || libdeflate_zlib_decompress(this->Decompressor.get(), this->Packed.data(),
                                 this->Packed.size(), this->Delta.data(), raw, nullptr) != LIBDEFLATE_SUCCESS)
    {
      this->File.fail(offset, "damaged compressed data");
    }
    for (std::size_t i = 1; i < raw; ++i)
    {
      this->Delta[i] = static_cast<unsigned char>(this->Delta[i] + this->Delta[i - 1] - 128);
    }
    const unsigned char* even = this->Delta.data();
    const unsigned char* odd = even + (raw + 1) / 2;
    for (std::size_t i = 0; i < raw; ++i)
    {
      this->Chunk[i] = i % 2 ? odd[i / 2] : even[i / 2];
    }
  }

  InputFile File;
  std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> Decompressor;
  std::vector<Channel> Channels; ///< in the order of the image
  bool Compressed = false;
  int ChunkRows = 1;
  std::int32_t FirstLine = 0;
  std::size_t RowBytes = 0;
  std::uint64_t TableStart = 0;
  int Loaded = -1;
  std::vector<unsigned char> Chunk;
  std::vector<unsigned char> Packed;
  std::vector<unsigned char> Delta;
};
} // namespace

std::unique_ptr<RowReader> openExrReader(const std::string& path) { return std::make_unique<ExrReader>(path); }

} // namespace dgtk
