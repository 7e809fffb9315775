// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkInputFile.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::uint64_t largestRatio = 1032; // of deflate

std::uint32_t big32(const InputFile& file, std::uint64_t offset)
{
  unsigned char bytes[4];
  file.read(offset, bytes, 4);
  return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 | bytes[3];
}

/// Checks the header against the file's size before a library allocates on its word.
void checkHeader(const InputFile& file)
{
  if (file.head(8) != std::string("\x89PNG\r\n\x1a\n", 8))
  {
    file.fail(0, "is not a PNG file");
  }
  if (big32(file, 8) != 13 || big32(file, 12) != 0x49484452)
  {
    file.fail(8, "the header is missing", "IHDR");
  }
  const std::int64_t width = big32(file, 16);
  const std::int64_t height = big32(file, 20);
  checkImageSize(file, 16, width, height);
  const auto depth = file.value<std::uint8_t>(24);
  const auto type = file.value<std::uint8_t>(25);
  const std::uint64_t samples = type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1;
  const std::uint64_t raw = (std::uint64_t(width) * samples * depth + 7) / 8 * std::uint64_t(height);
  if (raw / largestRatio > file.size())
  {
    file.fail(
      16, "more pixels than a file of this size can hold", {}, std::to_string(width) + " x " + std::to_string(height));
  }
}

class PngReader : public RowReader
{
public:
  explicit PngReader(const std::string& path)
    : Path(path)
  {
    checkHeader(InputFile(path));
    this->Input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    if (!this->Input || !this->Input->open(path, spec, config))
    {
      this->fail(this->Input ? this->Input->geterror() : OIIO::geterror());
    }
    this->Info.format = "png";
    this->Info.type = spec.format == OIIO::TypeDesc::UINT16 ? PixelType::UInt16 : PixelType::UInt8;
    this->Info.channels = spec.nchannels;
    this->Info.width = spec.width;
    this->Info.height = spec.height;
  }

protected:
  void readRows(Rows& rows) override
  {
    const auto type = rows.type() == PixelType::UInt16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    if (!this->Input->read_scanlines(
          0, 0, rows.y(), rows.y() + rows.height(), 0, 0, rows.channels(), type, rows.data()))
    {
      this->fail(this->Input->geterror());
    }
  }

private:
  [[noreturn]] void fail(std::string message) const
  {
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw InputError(this->Path, 0, "is damaged: " + (message.empty() ? std::string("no reason given") : message));
  }

  std::string Path;
  std::unique_ptr<OIIO::ImageInput> Input;
};
} // namespace

std::unique_ptr<RowReader> openPngReader(const std::string& path) { return std::make_unique<PngReader>(path); }

} // namespace dgtk
