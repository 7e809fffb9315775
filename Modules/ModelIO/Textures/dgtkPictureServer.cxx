// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureServer.h"

#include "dgtkHelperChannel.h"
#include "dgtkHelperWall.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <stdexcept>

#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace dgtk::picture
{

using helper::Descriptors;

const std::string descriptorFolder = "/proc/self/fd/";

namespace
{
constexpr int channel = 0;
constexpr int idleMilliseconds = 10'000;
constexpr std::uint64_t slackBytes = std::uint64_t(512) << 20;
constexpr std::uint64_t slackSeconds = 20;
constexpr std::uint64_t pixelsPerSecond = 2'000'000;

std::uint64_t addressLimit = RLIM_INFINITY; ///< the machine's, when the program started

/// False when the machine's limit is below that. The limit is never raised above the machine's.
bool limitAddresses(std::uint64_t room)
{
  const std::uint64_t wanted = helper::addressSpace() + room;
  const bool fits = addressLimit == RLIM_INFINITY || wanted <= addressLimit;
  if (!helper::isSanitized)
  {
    helper::limitTo(RLIMIT_AS, std::min(wanted, addressLimit));
  }
  return fits;
}

void limitSeconds(std::uint64_t pixels)
{
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  helper::limitTo(RLIMIT_CPU, spent + slackSeconds + pixels / pixelsPerSecond);
}

Answer answerTo(Decoder decoder, const Request& request, const Descriptors& files)
{
  Answer answer;
  limitSeconds(0);
  const bool fits = limitAddresses(slackBytes + 4 * request.fileBytes);
  try
  {
    decoder(request, files[0].get(), files[1].get(), answer);
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
} // namespace

Mapping::Mapping(int file, std::uint64_t bytes, int protection)
  : Bytes(static_cast<std::size_t>(bytes))
  , Data(::mmap(nullptr, std::max<std::size_t>(this->Bytes, 1), protection, MAP_SHARED, file, 0))
{
  if (this->Data == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
}

Mapping::~Mapping() { ::munmap(this->Data, std::max<std::size_t>(this->Bytes, 1)); }

void refuse(Answer& answer, std::string problem)
{
  // the name that the decoders see says nothing
  for (std::size_t at = 0; (at = problem.find(descriptorFolder)) != std::string::npos;)
  {
    std::size_t end = std::min(problem.find_first_not_of("0123456789", at + descriptorFolder.size()), problem.size());
    const bool isQuoted = at > 0 && end < problem.size() && problem[at - 1] == problem[end];
    at -= isQuoted ? 1 : 0;
    end += isQuoted ? 1 : 0;
    problem.replace(at, end - at, "the file");
  }
  answer.status = Status::Refused;
  helper::put(answer.problem, problem.empty() ? "is not a picture" : problem.c_str());
}

bool admit(const Request& request, std::int64_t width, std::int64_t height, int channels, std::uint64_t nativeBytes,
  std::uint64_t expansion, Answer& answer)
{
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width < 1 || height < 1 || width > largestSide || height > largestSide || channels < 1)
  {
    refuse(answer, "is " + size + ", at most " + std::to_string(largestSide) + " a side");
    return false;
  }
  const std::uint64_t native = std::uint64_t(width) * std::uint64_t(height) * nativeBytes;
  if (expansion != 0 && native / expansion > request.fileBytes)
  {
    refuse(answer, "is cut short: " + std::to_string(request.fileBytes) + " bytes cannot hold " + size);
    return false;
  }
  answer.width = static_cast<std::int32_t>(width);
  answer.height = static_cast<std::int32_t>(height);
  answer.channels = std::min(channels, request.values == Values::Floats ? 3 : 4);
  const std::uint64_t room = pixelBytes(answer, request.values) + 2 * native + 4 * request.fileBytes + slackBytes;
  answer.cramped = limitAddresses(room) ? 0 : 1;
  if (request.step == Step::Decode)
  {
    limitSeconds(std::uint64_t(width) * std::uint64_t(height));
  }
  return true;
}

namespace
{
std::uint64_t checkedSize(const Request& request, const Answer& answer, int memory)
{
  struct stat status = {};
  const std::uint64_t wanted = pixelBytes(answer, request.values);
  if (::fstat(memory, &status) != 0 || std::uint64_t(status.st_size) < wanted)
  {
    throw std::runtime_error("changed while it was read");
  }
  return wanted;
}
} // namespace

PixelMemory::PixelMemory(const Request& request, const Answer& answer, int memory)
  : Mapping(memory, checkedSize(request, answer, memory), PROT_READ | PROT_WRITE)
{
}

int serve(Decoder decoder, void (*start)())
{
  struct stat status = {};
  if (::fstat(channel, &status) != 0 || !S_ISSOCK(status.st_mode))
  {
    std::fputs("this program is a part of DGTk: it decodes pictures for the library\n", stderr);
    return 2;
  }
  rlimit now{};
  addressLimit = ::getrlimit(RLIMIT_AS, &now) == 0 ? now.rlim_cur : RLIM_INFINITY;
  helper::limitTo(RLIMIT_CORE, 0);
  helper::addressSpace();
  ::mallopt(M_ARENA_MAX, 2); // each takes addresses
  if (start != nullptr)
  {
    start();
  }
  helper::lockDown(helper::Opening::Memory);
  for (;;)
  {
    pollfd wait = { channel, POLLIN, 0 };
    const int ready = ::poll(&wait, 1, idleMilliseconds);
    if (ready == 0)
    {
      Answer bye;
      bye.status = Status::Bye;
      helper::send(channel, bye);
      return 0;
    }
    Request request;
    Descriptors files;
    if (ready > 0 &&
        (!helper::receive(channel, request, files) || !helper::send(channel, answerTo(decoder, request, files))))
    {
      return 0;
    }
  }
}

} // namespace dgtk::picture
