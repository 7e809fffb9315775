// SPDX-License-Identifier: BSD-3-Clause
// dgtk-picture: decodes what most textures are, sound PNG, JPEG and PCX files, and hands on all else
// (Status::Elsewhere) to dgtk-picture-any. It starts forty times as fast.
#include "dgtkPcx.h"
#include "dgtkPictureServer.h"

#include <jerror.h>
#include <jpeglib.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include <sys/mman.h>

namespace
{
using namespace dgtk::picture;

constexpr std::uint64_t mostDeflated = 1100; // 1032

/// A picture in memory whose decoder fails by longjmp(). Whatever it fails or warns of is left to others, so that there
/// is one judge of what is damaged.
class Sound
{
public:
  explicit Sound(const Mapping& file)
    : File(file)
  {
  }
  virtual ~Sound() = default;
  Sound(const Sound&) = delete;
  Sound& operator=(const Sound&) = delete;

  /// False when others are to judge.
  virtual bool readHeader() = 0;
  virtual bool decode(std::uint8_t* pixels) = 0;

  std::int64_t width = 0;
  std::int64_t height = 0;
  int channels = 0;
  std::uint64_t expansion = 0;

protected:
  const std::uint8_t* bytes() const { return static_cast<const std::uint8_t*>(this->File.data()); }
  std::size_t size() const { return this->File.size(); }
  std::jmp_buf Stop; // NOLINT(readability-identifier-naming)

private:
  const Mapping& File;
};

/// Of 8 bits a channel or fewer: palettes become colours, transparent colours an alpha channel.
class Png final : public Sound
{
public:
  explicit Png(const Mapping& file)
    : Sound(file)
    , Read(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &Png::stop, &Png::stop))
    , Head(this->Read ? png_create_info_struct(this->Read) : nullptr)
  {
  }
  ~Png() override { png_destroy_read_struct(&this->Read, &this->Head, nullptr); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;

  bool readHeader() override
  {
    if (!this->Head)
    {
      return false;
    }
    if (setjmp(this->Stop) != 0)
    {
      return false;
    }
    png_set_user_limits(this->Read, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_read_fn(this->Read, this, &Png::read);
    png_read_info(this->Read, this->Head);
    const int bits = png_get_bit_depth(this->Read, this->Head) * png_get_channels(this->Read, this->Head);
    png_set_expand(this->Read);
    this->Passes = png_set_interlace_handling(this->Read);
    png_read_update_info(this->Read, this->Head);
    this->width = png_get_image_width(this->Read, this->Head);
    this->height = png_get_image_height(this->Read, this->Head);
    this->channels = png_get_channels(this->Read, this->Head);
    this->expansion = mostDeflated * 8 * std::uint64_t(this->channels) / std::uint64_t(bits);
    return png_get_bit_depth(this->Read, this->Head) == 8;
  }

  bool decode(std::uint8_t* pixels) override
  {
    if (setjmp(this->Stop) != 0)
    {
      return false;
    }
    const std::size_t row = std::size_t(this->width) * std::size_t(this->channels);
    for (int pass = 0; pass < this->Passes; ++pass)
    {
      for (std::int64_t y = 0; y < this->height; ++y)
      {
        png_read_row(this->Read, pixels + std::size_t(y) * row, nullptr);
      }
    }
    png_read_end(this->Read, nullptr);
    return true;
  }

private:
  static void stop(png_structp read, png_const_charp)
  {
    std::longjmp(static_cast<Png*>(png_get_error_ptr(read))->Stop, 1);
  }
  static void read(png_structp read, png_bytep to, std::size_t count)
  {
    auto* const self = static_cast<Png*>(png_get_io_ptr(read));
    if (count > self->size() - self->At)
    {
      std::longjmp(self->Stop, 1);
    }
    std::memcpy(to, self->bytes() + self->At, count);
    self->At += count;
  }

  png_structp Read;
  png_infop Head;
  std::size_t At = 0;
  int Passes = 1;
};

/// Gray or colour of 8 bits; four inks become colours as in OpenImageIO: as Adobe stores them, 255 for none.
class Jpeg final : public Sound
{
public:
  explicit Jpeg(const Mapping& file)
    : Sound(file)
  {
    this->Read.err = jpeg_std_error(&this->Errors);
    this->Errors.error_exit = &Jpeg::stop;
    this->Errors.emit_message = &Jpeg::message;
    this->Read.client_data = this;
  }
  ~Jpeg() override { jpeg_destroy_decompress(&this->Read); }
  Jpeg(const Jpeg&) = delete;
  Jpeg& operator=(const Jpeg&) = delete;

  bool readHeader() override
  {
    if (setjmp(this->Stop) != 0)
    {
      return false;
    }
    jpeg_create_decompress(&this->Read);
    this->Read.client_data = this;
    jpeg_mem_src(&this->Read, this->bytes(), static_cast<unsigned long>(this->size()));
    jpeg_read_header(&this->Read, TRUE);
    this->width = this->Read.image_width;
    this->height = this->Read.image_height;
    this->channels = this->Read.jpeg_color_space == JCS_GRAYSCALE ? 1 : 3;
    this->Ink.resize(this->Read.out_color_space == JCS_CMYK ? std::size_t(this->width) * 4 : 0);
    return this->Read.jpeg_color_space != JCS_UNKNOWN;
  }

  bool decode(std::uint8_t* pixels) override
  {
    if (setjmp(this->Stop) != 0)
    {
      return false;
    }
    jpeg_start_decompress(&this->Read);
    const bool isInk = !this->Ink.empty();
    if (this->Read.output_components != (isInk ? 4 : this->channels))
    {
      return false;
    }
    const std::size_t row = std::size_t(this->width) * std::size_t(this->channels);
    while (this->Read.output_scanline < this->Read.output_height)
    {
      std::uint8_t* const to = pixels + this->Read.output_scanline * row;
      JSAMPROW line = isInk ? this->Ink.data() : to;
      jpeg_read_scanlines(&this->Read, &line, 1);
      for (std::size_t i = 0; isInk && i < row; ++i)
      {
        const std::uint8_t* const inks = line + i / 3 * 4;
        to[i] = std::uint8_t((inks[i % 3] * inks[3] + 127) / 255);
      }
    }
    // of several scans the last ones may lack, and arithmetic coding warns of no bit that does
    const bool needsEnd = jpeg_has_multiple_scans(&this->Read) || this->Read.arith_code;
    jpeg_finish_decompress(&this->Read);
    return !(this->LacksEnd && needsEnd);
  }

private:
  static void stop(j_common_ptr read) { std::longjmp(static_cast<Jpeg*>(read->client_data)->Stop, 1); }
  static void message(j_common_ptr read, int level)
  {
    if (level < 0 && read->err->msg_code == JWRN_JPEG_EOF) // what lacks may be the mark of the end alone
    {
      static_cast<Jpeg*>(read->client_data)->LacksEnd = true;
    }
    else if (level < 0) // a warning of damage
    {
      stop(read);
    }
  }

  jpeg_decompress_struct Read{};
  jpeg_error_mgr Errors{};
  std::vector<std::uint8_t> Ink; ///< a row of pixels of four inks, where the file has them
  bool LacksEnd = false;
};

void decodeSound(Sound& picture, const Request& request, int memory, Answer& answer)
{
  if (!picture.readHeader())
  {
    answer.status = Status::Elsewhere;
    return;
  }
  if (!admit(request, picture.width, picture.height, picture.channels, std::uint64_t(picture.channels),
        picture.expansion, answer))
  {
    return;
  }
  answer.status = Status::Done;
  if (request.step == Step::Decode)
  {
    const PixelMemory pixels(request, answer, memory);
    answer.status = picture.decode(static_cast<std::uint8_t*>(pixels.data())) ? Status::Done : Status::Elsewhere;
  }
}

void decodePcx(const Mapping& file, const Request& request, int memory, Answer& answer)
{
  const dgtk::PcxPicture picture(static_cast<const std::uint8_t*>(file.data()), file.size(), largestSide);
  answer.width = static_cast<std::int32_t>(picture.width());
  answer.height = static_cast<std::int32_t>(picture.height());
  answer.channels = 3;
  if (!picture.problem().empty())
  {
    refuse(answer, picture.problem());
    return;
  }
  if (request.step == Step::Decode)
  {
    const PixelMemory pixels(request, answer, memory);
    if (!picture.decode(static_cast<std::uint8_t*>(pixels.data())))
    {
      refuse(answer, dgtk::pcxCutShort);
      return;
    }
  }
  answer.status = Status::Done;
}

void decode(const Request& request, int file, int memory, Answer& answer)
{
  answer.status = Status::Elsewhere;
  if (request.values == Values::Floats)
  {
    return;
  }
  const Mapping bytes(file, request.fileBytes, PROT_READ);
  const auto begins = [&](const char* with, std::size_t count)
  { return bytes.size() > count && std::memcmp(bytes.data(), with, count) == 0; };
  if (std::string(request.extension) == "pcx")
  {
    decodePcx(bytes, request, memory, answer);
  }
  else if (begins("\x89PNG\r\n\x1a\n", 8))
  {
    Png png(bytes);
    decodeSound(png, request, memory, answer);
  }
  else if (begins("\xff\xd8\xff", 3))
  {
    Jpeg jpeg(bytes);
    decodeSound(jpeg, request, memory, answer);
  }
}
} // namespace

int main() { return serve(&decode, nullptr); }
