// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDepthPicture.h"
#include "dgtkLayerFile.h"
#include "dgtkPngEncoder.h"
#include "dgtkWriterEntry.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace dgtk
{

namespace
{
bool isFloat(PixelType type) { return type == PixelType::Float32 || type == PixelType::Float64; }

constexpr std::uint32_t largestWord = 0xffff;

/// The layer's value for nothing, where it does not fit 16 bits.
std::optional<std::uint32_t> nothingOf(const LayerSpec& spec)
{
  const unsigned long value = std::strtoul(spec.invalid.c_str(), nullptr, 10);
  return spec.type == PixelType::UInt32 && value > largestWord ? std::optional<std::uint32_t>(value) : std::nullopt;
}

PngEncoder::Header headerOf(const LayerSpec& spec, int width, int height)
{
  PngEncoder::Header header;
  header.width = width;
  header.height = height;
  header.bitDepth = spec.type == PixelType::UInt16 || spec.type == PixelType::UInt32 ? 16 : 8;
  header.channels = spec.channels;
  header.nothing = nothingOf(spec).has_value();
  header.srgb = spec.meaning == Meaning::Picture;
  // numbers that name things have no smooth areas
  header.prediction = spec.type == PixelType::UInt32 || spec.unit == "id" || spec.unit == "class"
                        ? PngPrediction::Labels
                        : PngPrediction::Smooth;
  return header;
}

/// 8 and 16 bits as they are; uint32 as 16-bit gray when every value fits, 65535 for a larger value for nothing; depth
/// as an 8-bit picture.
class PngWriter : public LayerFileWriter
{
public:
  PngWriter(const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
    : LayerFileWriter(path, spec, width, height)
    , Encoder(headerOf(spec, width, height), [this](const void* data, std::size_t n) { this->append(data, n); })
    , Row(Encoder.rowBytes())
    , Nothing(nothingOf(spec))
  {
    if (isFloat(spec.type))
    {
      this->Picture.emplace(context.near, context.far, path.path());
    }
  }

protected:
  void writeRows(const Rows& rows) override
  {
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      switch (rows.type())
      {
        case PixelType::UInt8:
          this->Encoder.row(rows.row<unsigned char>(y));
          continue;
        case PixelType::UInt16:
          this->packWords(rows.row<std::uint16_t>(y));
          break;
        case PixelType::UInt32:
          this->packIds(rows.row<std::uint32_t>(y));
          break;
        case PixelType::Float32:
          std::transform(rows.row<float>(y), rows.row<float>(y) + this->Width, this->Row.begin(), *this->Picture);
          break;
        case PixelType::Float64:
          std::transform(rows.row<double>(y), rows.row<double>(y) + this->Width, this->Row.begin(), *this->Picture);
          break;
      }
      this->Encoder.row(this->Row.data());
    }
  }

  void complete() override { this->Encoder.finish(); }

private:
  void packWords(const std::uint16_t* from)
  {
    for (std::size_t i = 0; i < this->Row.size() / 2; ++i)
    {
      putBig16(&this->Row[i * 2], from[i]);
    }
  }

  void packIds(const std::uint32_t* from)
  {
    const std::uint32_t largest = this->Nothing ? largestWord - 1 : largestWord;
    this->Ids.assign(from, from + this->Width);
    bool fits = true;
    for (std::size_t i = 0; i < this->Ids.size(); ++i)
    {
      const bool nothing = this->Nothing && from[i] == *this->Nothing;
      this->Ids[i] = nothing ? 0 : from[i];
      fits = fits && this->Ids[i] <= largest;
      putBig16(&this->Row[i * 2], nothing ? largestWord : from[i]);
    }
    if (!fits)
    {
      refuseIds(this->Ids.data(), this->Ids.size(), largest, "a 16-bit .png", this->Spec.name);
    }
  }

  PngEncoder Encoder;
  std::vector<unsigned char> Row;
  std::optional<std::uint32_t> Nothing;
  std::vector<std::uint32_t> Ids; // of a row, 0 for nothing
  std::optional<DepthPicture> Picture;
};

bool canWritePng(const LayerSpec& spec)
{
  if (isFloat(spec.type))
  {
    return spec.channels == 1 && (spec.meaning == Meaning::Depth || spec.meaning == Meaning::Distance);
  }
  return spec.type == PixelType::UInt32 ? spec.channels == 1 : spec.channels <= 4;
}

std::unique_ptr<LayerWriter> openPng(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
{
  return std::make_unique<PngWriter>(path, spec, width, height, context);
}
} // namespace

extern const WriterEntry writerPng;
const WriterEntry writerPng = { &canWritePng, &openPng, false, largestWord, true };

} // namespace dgtk
