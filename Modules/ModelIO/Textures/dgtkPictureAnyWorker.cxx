// SPDX-License-Identifier: BSD-3-Clause
// dgtk-picture-any: decodes pictures of all kinds with OpenImageIO for the library (dgtkPictureProtocol.h). A program
// of its own, so that an assertion, an endless loop or a flood of memory in a decoder ends here.
#include "dgtkPictureEnd.h"
#include "dgtkPictureServer.h"
#include "dgtkPortableMath.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <sys/mman.h>

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
    { "hdr", 191 },   // a run of 127 bytes takes two; of four bytes a pixel's three floats are made
    { "targa", 256 }, // a run of 128 pixels takes two, each an entry of four bytes of the colour map
    { "pnm", 8 },     // a bit a pixel
    { "png", 35200 }, // deflate: 1032; a bit is an entry of four bytes of the palette
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

const std::string cutShort = "is cut short";

/// What OpenImageIO says, in words for users: a second line says little more.
std::string inWords(const std::string& said)
{
  const auto says = [&said](const char* what) { return said.find(what) != std::string::npos; };
  if (says("could not find a format reader"))
  {
    return "is in a format that is not read";
  }
  for (const char* const end : { "hit end of file", "Hit end of file", "early end of file", "Unexpected end of file",
         "could only read", "Premature end of JPEG file", "premature end of data", "GIF read error at position",
         "bytes, expected", "Read error reading pixels on scanline", "Stream too short",
         "inconsistent with stream length", "IO error during reading of" })
  {
    if (says(end))
    {
      return cutShort;
    }
  }
  if (says("might be corrupted"))
  {
    return "is damaged";
  }
  return said.substr(0, said.find('\n'));
}

/// Of a Radiance file that could not be read: whether its pixels are packed in the old way, in which (1, 1, 1, n)
/// stands for more of the pixel before it.
bool hasOldRuns(const Request& request, int file)
{
  const Mapping memory(file, request.fileBytes, PROT_READ);
  const auto* const bytes = static_cast<const std::uint8_t*>(memory.data());
  const std::string_view text(static_cast<const char*>(memory.data()), memory.size());
  const std::size_t header = text.rfind("#?", 0) == 0 ? text.find("\n\n") : std::string_view::npos;
  const std::size_t end = header == std::string_view::npos ? header : text.find('\n', header + 2);
  if (end == std::string_view::npos || text.substr(end + 1, 2) == "\2\2")
  {
    return false;
  }
  for (std::size_t at = end + 1; at + 4 <= memory.size(); at += 4)
  {
    if (bytes[at] == 1 && bytes[at + 1] == 1 && bytes[at + 2] == 1)
    {
      return true;
    }
  }
  return false;
}

bool lacksItsEnd(const Request& request, int file)
{
  const Mapping memory(file, request.fileBytes, PROT_READ);
  return dgtk::picture::lacksItsEnd(static_cast<const std::uint8_t*>(memory.data()), memory.size());
}

/// Packed rows of a BMP file may end before the picture does, the last one, too: OpenImageIO 2.4 takes what follows
/// that one for a row that is not there. In the file, which is in memory, the picture ends there instead.
void endBmpWithItsLastRow(const Request& request, int file)
{
  const Mapping memory(file, request.fileBytes, PROT_READ | PROT_WRITE);
  auto* const bytes = static_cast<std::uint8_t*>(memory.data());
  const std::size_t size = memory.size();
  constexpr std::size_t header = 54;
  const auto word = [bytes](std::size_t at)
  { return std::uint32_t(bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16) | std::uint32_t(bytes[at + 3]) << 24; };
  if (size < header || bytes[0] != 'B' || bytes[1] != 'M' || word(14) < 40 || word(30) < 1 || word(30) > 2)
  {
    return;
  }
  const bool areHalves = word(30) == 2; // of bytes: 4 bits a pixel
  std::uint32_t rows = 0;
  for (std::size_t at = word(10); at + 1 < size && (bytes[at] != 0 || bytes[at + 1] != 1); at += 2)
  {
    const std::size_t second = bytes[at + 1];
    if (bytes[at] == 0 && second == 0 && ++rows == word(22))
    {
      bytes[at + 1] = 1;
      return;
    }
    if (bytes[at] == 0 && second == 2) // a move: two bytes, the second one in rows
    {
      rows += at + 3 < size ? bytes[at + 3] : 0;
      at += 2;
    }
    else if (bytes[at] == 0 && second > 2) // pixels as they are, an even number of bytes
    {
      at += ((areHalves ? (second + 1) / 2 : second) + 1) / 2 * 2;
    }
  }
}

/// The decoder of the extension first, then whichever wants the file.
std::unique_ptr<OIIO::ImageInput> open(const Request& request, const std::string& path, std::string& problem)
{
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
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

/// Light as codes of 8 bits; alpha, the last of an even number of channels, stays as it is.
void encode(
  const float* light, std::size_t count, std::size_t channels, bool multiplied, float factor, std::uint8_t* to)
{
  const auto code = [](float value) { return static_cast<std::uint8_t>(value * 255 + 0.5F); };
  const auto within = [](float value) { return value > 0 ? std::min(value, 1.0F) : 0.0F; }; // not a number: 0
  const bool hasAlpha = channels % 2 == 0;
  for (const std::uint8_t* const end = to + count * channels; to != end; to += channels, light += channels)
  {
    const float alpha = hasAlpha ? within(light[channels - 1]) : 1;
    const float scale = multiplied && alpha > 0 ? factor / alpha : factor;
    for (std::size_t i = 0; i + (hasAlpha ? 1 : 0) < channels; ++i)
    {
      to[i] = code(dgtk::portable::encodedFromLinear(within(light[i] * scale)));
    }
    to[channels - 1] = hasAlpha ? code(alpha) : to[channels - 1];
  }
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
  return request.values != Values::Floats && (format == "tiff" || format == "openexr") &&
         (answer.channels == 2 || answer.channels == 4) && input.spec().alpha_channel == answer.channels - 1 &&
         input.spec().get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

/// Where pixel i of row j of a file stands in its picture: at start + i along + j across. What is beyond the picture is
/// cut, where nothing stands it is black.
struct Placing
{
  using Step = std::array<std::int64_t, 2>; ///< columns, rows
  int width = 0;
  int height = 0;
  Step start = { 0, 0 };
  Step along = { 1, 0 };
  Step across = { 0, 1 };
  float factor = 1; ///< of light

  bool moves(const OIIO::ImageSpec& file) const
  {
    return this->width != file.width || this->height != file.height || this->start != Step{ 0, 0 } ||
           this->along != Step{ 1, 0 };
  }
  void place(const std::uint8_t* from, const OIIO::ImageSpec& file, std::size_t bytes, std::uint8_t* to) const
  {
    for (int j = 0; j < file.height; ++j)
    {
      for (int i = 0; i < file.width; ++i, from += bytes)
      {
        const std::int64_t x = this->start[0] + i * this->along[0] + j * this->across[0];
        const std::int64_t y = this->start[1] + i * this->along[1] + j * this->across[1];
        if (x >= 0 && x < this->width && y >= 0 && y < this->height)
        {
          std::memcpy(to + (std::size_t(y) * std::size_t(this->width) + std::size_t(x)) * bytes, from, bytes);
        }
      }
    }
  }
};

/// The header of a Radiance file has the way of its rows and of their pixels, "-Y 2 +X 3": down, and to the right; and
/// what its light was multiplied by.
void readRadianceHeader(const std::string& path, Placing& placing)
{
  std::ifstream file(path);
  std::string line;
  double exposure = 1;
  while (std::getline(file, line) && !line.empty())
  {
    double value = 1;
    exposure *= std::sscanf(line.c_str(), "EXPOSURE=%lf", &value) == 1 ? value : 1;
  }
  placing.factor = float(1 / exposure);
  if (!(exposure > 0) || !(placing.factor > 0) || std::isinf(placing.factor))
  {
    throw std::runtime_error("has an EXPOSURE that is no number above 0");
  }
  std::getline(file, line);
  char sign[2] = { '-', '+' };
  char axis = 'Y';
  std::sscanf(line.c_str(), "%c%c %*d %c", &sign[0], &axis, &sign[1]);
  const int x = axis == 'X' ? 0 : 1; // which of the two is across
  if (x == 0)
  {
    std::swap(placing.width, placing.height);
  }
  const int right = sign[x] == '+' ? 1 : -1;
  const int down = sign[1 - x] == '-' ? 1 : -1;
  placing.start = { right > 0 ? 0 : placing.width - 1, down > 0 ? 0 : placing.height - 1 };
  (x == 0 ? placing.across : placing.along) = { right, 0 };
  (x == 0 ? placing.along : placing.across) = { 0, down };
}

/// Colours of a picture whose colour map lacks its first entries come from others in OpenImageIO.
void requireWholeMap(const std::string& path)
{
  std::array<char, 5> head{}; // ..., kind of the picture, the map's first entry
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const bool mapped = head[2] == 1 || head[2] == 9;
  if (mapped && (head[3] != 0 || head[4] != 0))
  {
    throw std::runtime_error("has a colour map that does not begin with entry 0");
  }
}

Placing placingOf(const OIIO::ImageInput& input, const std::string& path)
{
  const OIIO::ImageSpec& spec = input.spec();
  const std::string format = input.format_name();
  Placing placing{ spec.width, spec.height };
  if (format == "openexr")
  {
    placing = { spec.full_width, spec.full_height,
      { std::int64_t(spec.x) - spec.full_x, std::int64_t(spec.y) - spec.full_y } };
  }
  else if (format == "hdr")
  {
    readRadianceHeader(path, placing);
  }
  else if (format == "targa")
  {
    requireWholeMap(path);
  }
  else if (const int colors = spec.get_int_attribute("tiff:PhotometricInterpretation");
           colors == 32844 || colors == 32845)
  {
    throw std::runtime_error("has logarithmic colours (LogL, LogLuv), which are not read: save it as .hdr or .exr");
  }
  return placing;
}

void decode(const Request& request, int file, int memory, Answer& answer)
{
  std::string problem;
  const std::string path = descriptorFolder + std::to_string(file);
  if (lacksItsEnd(request, file))
  {
    refuse(answer, cutShort);
    return;
  }
  endBmpWithItsLastRow(request, file);
  const auto input = open(request, path, problem);
  if (!input)
  {
    refuse(answer, inWords(problem));
    return;
  }
  const OIIO::ImageSpec& spec = input->spec();
  answer.linear = spec.format.is_floating_point() ? 1 : 0;
  const bool encodes = request.values == Values::Codes && answer.linear != 0; // from floats
  const std::uint64_t fileBytes = std::max<std::uint64_t>(spec.pixel_bytes(true), encodes ? 4 * spec.nchannels : 0);
  if (!admit(request, spec.width, spec.depth > 1 ? 0 : spec.height, spec.nchannels, fileBytes,
        mostExpansion(input->format_name()), answer))
  {
    return;
  }
  const Placing placing = placingOf(*input, path);
  const bool moves = placing.moves(spec);
  const std::size_t pixelBytes = std::size_t(answer.channels) * (request.values == Values::Floats ? sizeof(float) : 1);
  const std::uint64_t area = std::uint64_t(spec.width) * std::uint64_t(spec.height);
  const std::int64_t shown = std::max<std::int64_t>(1, std::int64_t(placing.width) * placing.height);
  const std::uint64_t nativeBytes = (fileBytes + pixelBytes) * (1 + area / std::uint64_t(shown));
  if (moves && !admit(request, placing.width, placing.height, spec.nchannels, nativeBytes, 0, answer))
  {
    return;
  }
  if (request.step == Step::Decode)
  {
    const PixelMemory pixels(request, answer, memory);
    std::vector<std::uint8_t> asInFile(moves ? area * pixelBytes : 0);
    void* const placed = moves ? static_cast<void*>(asInFile.data()) : pixels.data();
    std::vector<float> light(encodes ? area * std::size_t(answer.channels) : 0);
    const auto type = encodes || request.values == Values::Floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    const bool isRead =
      input->read_image(0, 0, 0, answer.channels, type, encodes ? static_cast<void*>(light.data()) : placed);
    const std::string said = input->geterror();
    if (const std::string words = inWords(said); !isRead || words == cutShort) // of some formats it fills the rest
    {
      const bool isCut = said.empty() || words == cutShort; // the decoder of PNM has no word for it
      refuse(answer, isCut && hasOldRuns(request, file) ? "is packed as Radiance files once were, which is not read"
                     : isCut                            ? cutShort
                                                        : words);
      return;
    }
    const bool multiplied = isMultiplied(*input, request, answer);
    if (encodes)
    {
      encode(light.data(), area, std::size_t(answer.channels), multiplied, placing.factor,
        static_cast<std::uint8_t*>(placed));
    }
    if (moves)
    {
      std::memset(pixels.data(), 0, pixels.size());
      placing.place(asInFile.data(), spec, pixelBytes, static_cast<std::uint8_t*>(pixels.data()));
    }
    if (request.values == Values::Floats && placing.factor != 1)
    {
      auto* const light = static_cast<float*>(pixels.data());
      std::transform(light, light + pixels.size() / sizeof(float), light, [&](float v) { return v * placing.factor; });
    }
    if (multiplied && !encodes)
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
