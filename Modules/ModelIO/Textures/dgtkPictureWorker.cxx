// SPDX-License-Identifier: BSD-3-Clause
// dgtk-picture: decodes pictures with OpenImageIO for the library (dgtkPictureProtocol.h). A program of its own, so
// that an assertion, an endless loop or a flood of memory in a decoder ends here.
#include "dgtkHelperChannel.h"
#include "dgtkHelperWall.h"
#include "dgtkPcx.h"
#include "dgtkPictureProtocol.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <string>

#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace
{
using namespace dgtk::picture;
using dgtk::helper::Descriptors;

constexpr int channel = 0;
const std::string descriptors = "/proc/self/fd/";
constexpr int idleMilliseconds = 10'000;
constexpr std::uint64_t slackBytes = std::uint64_t(512) << 20;
constexpr std::uint64_t slackSeconds = 20;
constexpr std::uint64_t pixelsPerSecond = 2'000'000;

std::uint64_t addressLimit = RLIM_INFINITY; ///< the machine's, when the program started

/// Shared memory, mapped.
class Mapping
{
public:
  Mapping(int file, std::uint64_t bytes, int protection)
    : Bytes(static_cast<std::size_t>(bytes))
    , Data(::mmap(nullptr, std::max<std::size_t>(this->Bytes, 1), protection, MAP_SHARED, file, 0))
  {
    if (this->Data == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
  }
  ~Mapping() { ::munmap(this->Data, std::max<std::size_t>(this->Bytes, 1)); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  void* data() const { return this->Data; }
  std::size_t size() const { return this->Bytes; }

private:
  std::size_t Bytes;
  void* Data;
};

void refuse(Answer& answer, std::string problem)
{
  // the name that the decoders see says nothing
  for (std::size_t at = 0; (at = problem.find(descriptors)) != std::string::npos;)
  {
    std::size_t end = std::min(problem.find_first_not_of("0123456789", at + descriptors.size()), problem.size());
    const bool isQuoted = at > 0 && end < problem.size() && problem[at - 1] == problem[end];
    at -= isQuoted ? 1 : 0;
    end += isQuoted ? 1 : 0;
    problem.replace(at, end - at, "the file");
  }
  answer.status = Status::Refused;
  dgtk::helper::put(answer.problem, problem.empty() ? "is not a picture" : problem.c_str());
}

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

std::uint64_t roomFor(const Request& request, const OIIO::ImageSpec& spec, const Answer& answer)
{
  const std::uint64_t native = std::uint64_t(spec.width) * std::uint64_t(spec.height) * spec.pixel_bytes(true);
  return pixelBytes(answer, request.values) + 2 * native + 4 * request.fileBytes + slackBytes;
}

/// False when the machine's limit is below that. The limit is never raised above the machine's.
bool limitAddresses(std::uint64_t room)
{
  const std::uint64_t wanted = dgtk::helper::addressSpace() + room;
  const bool fits = addressLimit == RLIM_INFINITY || wanted <= addressLimit;
  if (!dgtk::helper::isSanitized)
  {
    dgtk::helper::limitTo(RLIMIT_AS, std::min(wanted, addressLimit));
  }
  return fits;
}

void limitSeconds(std::uint64_t pixels)
{
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  dgtk::helper::limitTo(RLIMIT_CPU, spent + slackSeconds + pixels / pixelsPerSecond);
}

/// What the header says. False, with `answer` refused, when it cannot be.
bool measure(const Request& request, const OIIO::ImageInput& input, Answer& answer)
{
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > largestSide || spec.height > largestSide || spec.depth > 1 ||
      spec.nchannels < 1)
  {
    refuse(answer, "is " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels, at most " +
                     std::to_string(largestSide) + " a side");
    return false;
  }
  const std::uint64_t expansion = mostExpansion(input.format_name());
  const std::uint64_t native = std::uint64_t(spec.width) * std::uint64_t(spec.height) * spec.pixel_bytes(true);
  if (expansion != 0 && native / expansion > request.fileBytes)
  {
    refuse(answer, "is cut short: " + std::to_string(request.fileBytes) + " bytes cannot hold " +
                     std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels");
    return false;
  }
  const bool floats = request.values == Values::Floats;
  answer.width = spec.width;
  answer.height = spec.height;
  answer.channels = std::min(spec.nchannels, floats ? 3 : 4);
  const std::string extension = request.extension;
  answer.linear = extension == "hdr" || extension == "exr" || spec.format.is_floating_point() ? 1 : 0;
  return true;
}

void decodeLibrary(const Request& request, int file, int memory, Answer& answer)
{
  const std::string path = descriptors + std::to_string(file);
  std::string problem;
  const auto input = open(request, path, problem);
  if (!input)
  {
    refuse(answer, problem);
    return;
  }
  if (!measure(request, *input, answer))
  {
    return;
  }
  const bool fits = limitAddresses(roomFor(request, input->spec(), answer));
  answer.cramped = fits ? 0 : 1;
  if (request.step == Step::Decode)
  {
    limitSeconds(std::uint64_t(answer.width) * std::uint64_t(answer.height));
    struct stat status = {};
    if (::fstat(memory, &status) != 0 || std::uint64_t(status.st_size) < pixelBytes(answer, request.values))
    {
      refuse(answer, "changed while it was read");
      return;
    }
    const Mapping pixels(memory, pixelBytes(answer, request.values), PROT_READ | PROT_WRITE);
    const auto type = request.values == Values::Floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    if (!input->read_image(0, 0, 0, answer.channels, type, pixels.data()))
    {
      refuse(answer, input->geterror());
      return;
    }
  }
  answer.status = Status::Done;
}

void decodePcxPicture(const Request& request, int file, int memory, Answer& answer)
{
  const Mapping bytes(file, request.fileBytes, PROT_READ);
  const dgtk::PcxPicture picture(static_cast<const std::uint8_t*>(bytes.data()), bytes.size(), largestSide);
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
    const Mapping pixels(memory, pixelBytes(answer, Values::Bytes), PROT_WRITE);
    picture.decode(static_cast<std::uint8_t*>(pixels.data()));
  }
  answer.status = Status::Done;
}

Answer answerTo(const Request& request, const Descriptors& files)
{
  Answer answer;
  limitSeconds(0);
  const bool fits = limitAddresses(slackBytes + 4 * request.fileBytes);
  try
  {
    const bool isPcx = std::string(request.extension) == "pcx" && request.values == Values::Bytes;
    (isPcx ? decodePcxPicture : decodeLibrary)(request, files[0].get(), files[1].get(), answer);
  }
  catch (const std::bad_alloc&)
  {
    refuse(answer, "needs more memory than a picture of its size may");
  }
  catch (const std::exception& error)
  {
    refuse(answer, error.what());
  }
  answer.cramped = fits ? answer.cramped : 1;
  if (answer.status == Status::Refused && answer.cramped != 0)
  {
    answer.status = Status::NoRoom;
  }
  return answer;
}

void rememberLimit()
{
  rlimit now{};
  addressLimit = ::getrlimit(RLIMIT_AS, &now) == 0 ? now.rlim_cur : RLIM_INFINITY;
}
} // namespace

int main()
{
  struct stat status = {};
  if (::fstat(channel, &status) != 0 || !S_ISSOCK(status.st_mode))
  {
    std::fputs("dgtk-picture is a part of DGTk: it decodes pictures for the library\n", stderr);
    return 2;
  }
  rememberLimit();
  dgtk::helper::limitTo(RLIMIT_CORE, 0);
  dgtk::helper::addressSpace();
  // few threads: each takes addresses
  ::mallopt(M_ARENA_MAX, 2);
  OIIO::attribute("threads", 4);
  OIIO::attribute("exr_threads", 4);
  OIIO::get_string_attribute("format_list"); // whatever it loads for it is loaded
  dgtk::helper::lockDown(dgtk::helper::Opening::Memory);
  for (;;)
  {
    pollfd wait = { channel, POLLIN, 0 };
    const int ready = ::poll(&wait, 1, idleMilliseconds);
    if (ready == 0)
    {
      Answer bye;
      bye.status = Status::Bye;
      dgtk::helper::send(channel, bye);
      return 0;
    }
    Request request;
    Descriptors files;
    if (ready > 0)
    {
      if (!dgtk::helper::receive(channel, request, files))
      {
        return 0;
      }
      if (!dgtk::helper::send(channel, answerTo(request, files)))
      {
        return 0;
      }
    }
  }
}
