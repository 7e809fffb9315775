// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

#include <libdeflate.h>

#include <algorithm>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr int compressionLevel = 1; // libdeflate
constexpr int chunkRows = 16;       // of ZIP compression

std::vector<std::string> exrChannelNames(const LayerSpec& spec)
{
  switch (spec.channels)
  {
    case 1:
      return { spec.meaning == Meaning::Depth ? "Z" : "Y" };
    case 2:
      return spec.meaning == Meaning::TextureCoordinates ? std::vector<std::string>{ "U", "V" }
                                                         : std::vector<std::string>{ "X", "Y" };
    case 3:
      return spec.meaning == Meaning::Picture ? std::vector<std::string>{ "R", "G", "B" }
                                              : std::vector<std::string>{ "X", "Y", "Z" };
    default:
      return { "R", "G", "B", "A" };
  }
}

/// As OpenEXR's ZIP: even bytes, then odd bytes (`split`), as differences (`delta`).
void predict(const unsigned char* __restrict raw, std::size_t bytes, unsigned char* __restrict split,
  unsigned char* __restrict delta)
{
  unsigned char* const odd = split + (bytes + 1) / 2;
  for (std::size_t i = 0; i < bytes / 2; ++i)
  {
    split[i] = raw[2 * i];
    odd[i] = raw[2 * i + 1];
  }
  delta[0] = split[0];
  for (std::size_t i = 1; i < bytes; ++i)
  {
    delta[i] = static_cast<unsigned char>(split[i] - split[i - 1] + 128);
  }
}

/// OpenEXR 2 scan lines with ZIP compression and nothing in the header but what the format requires and
/// LayerWriterContext::attributes.
class ExrWriter : public LayerFileWriter
{
public:
  ExrWriter(const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
    : LayerFileWriter(path, spec, width, height)
    , Compressor(libdeflate_alloc_compressor(compressionLevel), &libdeflate_free_compressor)
    , Order(std::size_t(spec.channels))
    , ChunkBytes(std::size_t(chunkRows) * static_cast<std::size_t>(width) * spec.channels * 4)
  {
    if (!this->Compressor)
    {
      throw MachineError(path.path() + ": out of memory");
    }
    this->hashAtEnd();
    const std::vector<std::string> names = context.channels.empty() ? exrChannelNames(spec) : context.channels;
    if (names.size() != this->Order.size())
    {
      throw UsageError(path.path() + ": " + std::to_string(names.size()) + " channel names for " +
                       std::to_string(this->Order.size()) + " channels");
    }
    std::iota(this->Order.begin(), this->Order.end(), 0);
    std::sort(this->Order.begin(), this->Order.end(),
      [&](int a, int b) { return names[std::size_t(a)] < names[std::size_t(b)]; });
    this->writeHeader(names, context.attributes);
    this->Chunk.reserve(this->ChunkBytes);
  }

protected:
  void writeRows(const Rows& rows) override
  {
    narrow(rows, this->Values);
    const std::size_t channels = this->Order.size();
    const std::size_t width = std::size_t(this->Width);
    for (int i = 0; i < rows.height(); ++i)
    {
      const float* row = &this->Values[std::size_t(i) * width * channels];
      const std::size_t start = this->Chunk.size();
      this->Chunk.resize(start + width * channels * 4);
      unsigned char* to = &this->Chunk[start];
      for (const int channel : this->Order)
      {
        const float* from = row + channel;
        for (std::size_t x = 0; x < width; ++x)
        {
          std::memcpy(to + x * 4, from + x * channels, 4);
        }
        to += width * 4;
      }
      if (this->Chunk.size() == this->ChunkBytes)
      {
        this->writeChunk();
      }
    }
  }

  void complete() override
  {
    if (!this->Chunk.empty())
    {
      this->writeChunk();
    }
    this->writeAt(this->TableStart, this->Table.data(), this->Table.size());
  }

private:
  static void attribute(std::string& header, const char* name, const char* type, const std::string& value)
  {
    header.append(name).push_back('\0');
    header.append(type).push_back('\0');
    putLittle(header, static_cast<std::int32_t>(value.size()));
    header += value;
  }

  void writeHeader(const std::vector<std::string>& names, const std::vector<std::pair<std::string, std::string>>& texts)
  {
    std::string channels;
    for (const int channel : this->Order)
    {
      channels.append(names[std::size_t(channel)]).push_back('\0');
      for (const std::int32_t value : { 2 /* float */, 0 /* not perceptual */, 1, 1 /* sampling */ })
      {
        putLittle(channels, value);
      }
    }
    channels.push_back('\0');
    std::string window;
    for (const std::int32_t value : { 0, 0, this->Width - 1, this->Height - 1 })
    {
      putLittle(window, value);
    }
    std::string one;
    putLittle(one, 1.0f);
    std::string header("\x76\x2f\x31\x01\x02\x00\x00\x00", 8);
    attribute(header, "channels", "chlist", channels);
    attribute(header, "compression", "compression", std::string(1, '\3'));
    attribute(header, "dataWindow", "box2i", window);
    attribute(header, "displayWindow", "box2i", window);
    attribute(header, "lineOrder", "lineOrder", std::string(1, '\0'));
    attribute(header, "pixelAspectRatio", "float", one);
    attribute(header, "screenWindowCenter", "v2f", std::string(8, '\0'));
    attribute(header, "screenWindowWidth", "float", one);
    for (const auto& [name, value] : texts)
    {
      attribute(header, name.c_str(), "string", value);
    }
    header.push_back('\0');
    this->TableStart = header.size();
    // the offsets of the chunks are known at the end
    header.append(std::size_t((this->Height - 1) / chunkRows + 1) * 8, '\0');
    this->Offset = header.size();
    this->append(header);
  }

  void writeChunk()
  {
    const std::size_t raw = this->Chunk.size();
    this->Split.resize(raw);
    this->Delta.resize(raw);
    predict(this->Chunk.data(), raw, this->Split.data(), this->Delta.data());
    this->Packed.resize(raw);
    // a chunk that does not shrink is stored as it is
    const std::size_t packed =
      libdeflate_zlib_compress(this->Compressor.get(), this->Delta.data(), raw, this->Packed.data(), raw - 1);
    const std::size_t size = packed > 0 ? packed : raw;
    std::string head;
    putLittle(head, static_cast<std::int32_t>(this->NextChunk * chunkRows));
    putLittle(head, static_cast<std::int32_t>(size));
    this->append(head);
    this->append(packed > 0 ? this->Packed.data() : this->Chunk.data(), size);
    putLittle(this->Table, this->Offset);
    this->Offset += head.size() + size;
    ++this->NextChunk;
    this->Chunk.clear();
  }

  std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> Compressor;
  std::vector<int> Order; ///< of the layer's channels in the file: by name
  std::size_t ChunkBytes;
  std::vector<float> Values;
  std::vector<unsigned char> Chunk;
  std::vector<unsigned char> Split;
  std::vector<unsigned char> Delta;
  std::vector<unsigned char> Packed;
  std::string Table;
  std::uint64_t TableStart = 0;
  std::uint64_t Offset = 0;
  int NextChunk = 0;
};

bool canWriteExr(const LayerSpec& spec)
{
  return (spec.type == PixelType::Float32 || spec.type == PixelType::Float64) &&
         (spec.channels <= 4 || spec.meaning == Meaning::Coverage);
}

std::unique_ptr<LayerWriter> openExr(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
{
  return std::make_unique<ExrWriter>(path, spec, width, height, context);
}
} // namespace

extern const WriterEntry writerExr;
const WriterEntry writerExr = { &canWriteExr, &openExr, true };

} // namespace dgtk
