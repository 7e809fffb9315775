// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInputFile.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <exception>
#include <vector>

namespace dgtk
{

namespace
{
constexpr std::size_t windowBytes = std::size_t(1) << 18;

/// libpng's.
struct Structures
{
  explicit Structures(png_error_ptr stop)
    : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, stop, stop))
    , head(png ? png_create_info_struct(png) : nullptr)
  {
  }
  ~Structures() { png_destroy_read_struct(&this->png, &this->head, nullptr); }
  Structures(const Structures&) = delete;
  Structures& operator=(const Structures&) = delete;
  png_structp png;
  png_infop head;
};

/// 8 and 16 bits, gray to RGBA, without palette and interlace: what DGTk writes. 16-bit gray with a transparent value
/// is read as uint32, 4294967295 in its place. libpng reads; all that it warns of is an error here, in words of ours.
class PngReader : public RowReader
{
public:
  explicit PngReader(const std::string& path)
    : File(path)
  {
    if (this->File.head(8) != std::string("\x89PNG\r\n\x1a\n", 8))
    {
      this->File.fail(0, "is not a PNG file");
    }
    if (!this->Decoder.head)
    {
      this->File.fail(0, "cannot be decompressed: out of memory");
    }
    this->readHeader();
  }

protected:
  void readRows(Rows& rows) override
  {
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      if (this->Words.empty())
      {
        auto* const row = reinterpret_cast<png_byte*>(rows.data() + std::size_t(y - rows.y()) * rows.rowBytes());
        this->guarded([=] { png_read_row(this->Decoder.png, row, nullptr); });
        continue;
      }
      this->guarded([=] { png_read_row(this->Decoder.png, reinterpret_cast<png_byte*>(this->Words.data()), nullptr); });
      std::transform(this->Words.begin(), this->Words.end(), rows.row<std::uint32_t>(y),
        [this](std::uint16_t word) { return word == this->Nothing ? 0xffffffffu : std::uint32_t(word); });
    }
    if (rows.y() + rows.height() == this->Info.height)
    {
      this->guarded([=] { png_read_end(this->Decoder.png, nullptr); });
    }
  }

private:
  /// libpng's failures come by longjmp(): `body` holds nothing that has a destructor.
  template <typename Body>
  void guarded(const Body& body)
  {
    if (setjmp(png_jmpbuf(this->Decoder.png)) == 0)
    {
      body();
      return;
    }
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
    this->File.fail(this->Position, "is damaged");
  }
  static void stop(png_structp png, png_const_charp) { png_longjmp(png, 1); }
  static void read(png_structp png, png_bytep to, std::size_t bytes)
  {
    if (!static_cast<PngReader*>(png_get_io_ptr(png))->tryRead(to, bytes))
    {
      png_longjmp(png, 1);
    }
  }
  bool tryRead(void* to, std::size_t bytes) noexcept
  {
    try
    {
      this->File.read(this->Position, to, bytes);
      this->Position += bytes;
    }
    catch (...)
    {
      this->Failure = std::current_exception();
    }
    return !this->Failure;
  }

  void readHeader()
  {
    png_set_read_fn(this->Decoder.png, this, &PngReader::read);
    png_set_benign_errors(this->Decoder.png, 0);
    png_set_crc_action(this->Decoder.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_keep_unknown_chunks(this->Decoder.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1); // tRNS is not among them
    png_set_user_limits(this->Decoder.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);            // checked below
    this->guarded(
      [=]
      {
        png_set_compression_buffer_size(this->Decoder.png, windowBytes);
        png_read_info(this->Decoder.png, this->Decoder.head);
      });
    const std::int64_t width = png_get_image_width(this->Decoder.png, this->Decoder.head);
    const std::int64_t height = png_get_image_height(this->Decoder.png, this->Decoder.head);
    checkImageSize(this->File, 16, width, height);
    const int bits = png_get_bit_depth(this->Decoder.png, this->Decoder.head);
    const int color = png_get_color_type(this->Decoder.png, this->Decoder.head);
    const int interlace = png_get_interlace_type(this->Decoder.png, this->Decoder.head);
    if (bits < 8 || color == PNG_COLOR_TYPE_PALETTE || interlace != PNG_INTERLACE_NONE)
    {
      this->File.fail(24, "unsupported kind of PNG file", "8 or 16 bits, no palette, not interlaced",
        std::to_string(bits) + " bits, color type " + std::to_string(color) + ", interlace " +
          std::to_string(interlace));
    }
    this->Info.format = "png";
    this->Info.type = bits == 8 ? PixelType::UInt8 : PixelType::UInt16;
    this->Info.channels = png_get_channels(this->Decoder.png, this->Decoder.head);
    this->Info.width = static_cast<int>(width);
    this->Info.height = static_cast<int>(height);
    if (this->Info.pixelBytes() / deflateRatio > this->File.size())
    {
      this->File.fail(16, "more pixels than a file of this size can hold", {},
        std::to_string(width) + " x " + std::to_string(height));
    }
    if (bits == 16)
    {
      png_set_swap(this->Decoder.png); // the file's are big-endian
    }
    png_color_16p nothing = nullptr;
    if (bits == 16 && this->Info.channels == 1 &&
        png_get_tRNS(this->Decoder.png, this->Decoder.head, nullptr, nullptr, &nothing) != 0)
    {
      this->Nothing = nothing->gray;
      this->Info.type = PixelType::UInt32;
      this->Words.resize(std::size_t(width));
    }
  }

  InputFile File;
  std::uint64_t Position = 0;
  std::exception_ptr Failure;
  Structures Decoder{ &PngReader::stop };
  std::uint16_t Nothing = 0;        ///< value that is none, of a file read as uint32
  std::vector<std::uint16_t> Words; ///< a row of such a file
};
} // namespace

std::unique_ptr<RowReader> openPngReader(const std::string& path) { return std::make_unique<PngReader>(path); }

} // namespace dgtk
