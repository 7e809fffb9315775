// SPDX-License-Identifier: BSD-3-Clause
// dgtk-picture-any: decodes pictures of all kinds with OpenImageIO for the library (dgtkPictureProtocol.h). A program
// of its own, so that an assertion, an endless loop or a flood of memory in a decoder ends here.
#include "dgtkPictureServer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

namespace
{
using namespace dgtk::picture;

/// Bytes of pixels that a byte of the file can stand for, where the format bounds it; 0 where it does not.
std::uint64_t mostExpansion(const std::string& format)
{
  struct Row
  {
    const char* format;
    std::uint64_t expansion;
  };
  constexpr Row rows[] = {
    { "hdr", 64 },    // a run of 127 bytes takes two; four bytes are a pixel
    { "sgi", 64 },    // a run of 127 bytes takes two
    { "targa", 128 }, // a run of 128 pixels of four bytes takes five
    { "pnm", 8 },     // a bit a pixel
    { "png", 1100 },  // deflate: 1032
  };
  for (const Row& row : rows)
  {
    if (format == row.format)
    {
      return row.expansion;
    }
  }
  return 0;
}

/// The decoder of the extension first, then whichever wants the file.
std::unique_ptr<OIIO::ImageInput> open(const Request& request, const std::string& path, std::string& problem)
{
  OIIO::ImageSpec config;
  if (request.values == Values::Bytes)
  {
    config["oiio:UnassociatedAlpha"] = 1;
  }
  OIIO::ImageSpec spec;
  if (request.extension[0] != '\0')
  {
    auto input = OIIO::ImageInput::create(request.extension);
    if (input && input->open(path, spec, config))
    {
      return input;
    }
    problem = input ? input->geterror() : std::string();
  }
  OIIO::geterror(); // of the search for the extension
  auto input = OIIO::ImageInput::open(path, &config);
  const std::string other = OIIO::geterror();
  problem = problem.empty() ? other : problem;
  return input;
}

/// Colours as they are without their alpha, which some files have multiplied them by.
void divideByAlpha(std::uint8_t* pixels, std::size_t count, std::size_t channels)
{
  for (std::uint8_t* const end = pixels + count * channels; pixels != end; pixels += channels)
  {
    const unsigned alpha = pixels[channels - 1];
    for (std::size_t i = 0; i + 1 < channels && alpha > 0; ++i)
    {
      pixels[i] = static_cast<std::uint8_t>(std::min(255U, (pixels[i] * 255U + alpha / 2) / alpha));
    }
  }
}

/// Whether the decoder leaves that to be done.
bool isMultiplied(const OIIO::ImageInput& input, const Request& request, const Answer& answer)
{
  const std::string format = input.format_name();
  return request.values == Values::Bytes && (format == "tiff" || format == "openexr") &&
         (answer.channels == 2 || answer.channels == 4) && input.spec().alpha_channel == answer.channels - 1 &&
         input.spec().get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

void decode(const Request& request, int file, int memory, Answer& answer)
{
  std::string problem;
  const auto input = open(request, descriptorFolder + std::to_string(file), problem);
  if (!input)
  {
    refuse(answer, problem);
    return;
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (!admit(request, spec.width, spec.depth > 1 ? 0 : spec.height, spec.nchannels, spec.pixel_bytes(true),
        mostExpansion(input->format_name()), answer))
  {
    return;
  }
  const std::string extension = request.extension;
  answer.linear = extension == "hdr" || extension == "exr" || spec.format.is_floating_point() ? 1 : 0;
  if (request.step == Step::Decode)
  {
    const PixelMemory pixels(request, answer, memory);
    const auto type = request.values == Values::Floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    if (!input->read_image(0, 0, 0, answer.channels, type, pixels.data()))
    {
      refuse(answer, input->geterror());
      return;
    }
    if (isMultiplied(*input, request, answer))
    {
      divideByAlpha(static_cast<std::uint8_t*>(pixels.data()), std::size_t(answer.width) * std::size_t(answer.height),
        std::size_t(answer.channels));
    }
  }
  answer.status = Status::Done;
}

void start()
{
  // few threads: each takes addresses
  OIIO::attribute("threads", 4);
  OIIO::attribute("exr_threads", 4);
  OIIO::get_string_attribute("format_list"); // whatever it loads for it is loaded
}
} // namespace

int main() { return serve(&decode, &start); }
