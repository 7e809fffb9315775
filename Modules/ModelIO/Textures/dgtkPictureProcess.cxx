// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureProcess.h"

#include "dgtkError.h"
#include "dgtkHelperProcess.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <memory>
#include <mutex>
#include <new>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>

namespace dgtk::picture
{

using helper::Descriptor;
using helper::Descriptors;

namespace
{
constexpr std::uint64_t largestFile = std::uint64_t(1) << 31;

[[noreturn]] void failMachine(const std::string& path, const std::string& what)
{
  throw MachineError(path + ": cannot be decoded: " + what);
}

/// Shared memory of a size that never changes again once it is sealed.
Descriptor sharedMemory(const std::string& path, std::uint64_t bytes)
{
  Descriptor memory(::memfd_create("dgtk-picture", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!memory || ::ftruncate(memory.get(), static_cast<off_t>(bytes)) != 0)
  {
    const std::string room = std::to_string(bytes) + " bytes";
    failMachine(path, errno == EFBIG ? "files may not have " + room + " here (see ulimit -f)"
                                     : "no shared memory of " + room + ": " + std::strerror(errno));
  }
  ::fcntl(memory.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL);
  return memory;
}

void writeAll(int to, const std::string& path, const void* data, std::size_t bytes)
{
  const char* at = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t written = ::write(to, at, bytes);
    if (written < 0 && errno != EINTR)
    {
      failMachine(path, std::string("no shared memory: ") + std::strerror(errno));
    }
    at += std::max<ssize_t>(written, 0);
    bytes -= static_cast<std::size_t>(std::max<ssize_t>(written, 0));
  }
}

/// The encoded picture in shared memory.
struct Encoded
{
  Descriptor memory;
  std::uint64_t bytes = 0;
};

bool readFileInto(const std::string& path, Encoded& encoded, std::string& problem)
{
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat status = {};
  if (!file || ::fstat(file.get(), &status) != 0)
  {
    problem = std::string("cannot be opened: ") + std::strerror(errno);
    return false;
  }
  if (!S_ISREG(status.st_mode) || std::uint64_t(status.st_size) > largestFile)
  {
    problem = S_ISREG(status.st_mode) ? "is larger than 2 GiB" : "is not a regular file";
    return false;
  }
  encoded.bytes = std::uint64_t(status.st_size);
  encoded.memory = sharedMemory(path, encoded.bytes);
  std::vector<char> buffer(std::size_t(1) << 18);
  for (std::uint64_t left = encoded.bytes; left > 0;)
  {
    const ssize_t got = ::read(file.get(), buffer.data(), std::min<std::uint64_t>(buffer.size(), left));
    if (got == 0 || (got < 0 && errno != EINTR))
    {
      problem = got == 0 ? "changed while it was read" : std::string("cannot be read: ") + std::strerror(errno);
      return false;
    }
    writeAll(encoded.memory.get(), path, buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    left -= static_cast<std::uint64_t>(std::max<ssize_t>(got, 0));
  }
  return true;
}

bool encodedOf(const Source& source, Encoded& encoded, std::string& problem)
{
  if (!source.bytes)
  {
    return readFileInto(source.path, encoded, problem);
  }
  encoded.bytes = source.bytes->size();
  encoded.memory = sharedMemory(source.path, encoded.bytes);
  writeAll(encoded.memory.get(), source.path, source.bytes->data(), source.bytes->size());
  return true;
}

bool isSane(const Answer& answer)
{
  return answer.width >= 1 && answer.height >= 1 && answer.width <= largestSide && answer.height <= largestSide &&
         answer.channels >= 1 && answer.channels <= 4;
}

/// One of the two programs that decode for this process.
class Helper
{
public:
  Helper(const char* program, const char* variable)
    : Program(program)
    , Variable(variable)
  {
  }

  void prepare()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->start();
  }

  /// False, and `problem` set, when the picture is to blame.
  bool ask(const std::string& path, const Request& request, int file, int memory, bool cramped, Answer& answer,
    std::string& problem)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (;;)
    {
      this->start();
      if (!helper::send(this->Running->channel(), request, file, memory))
      {
        this->Running.reset(); // it ended before it knew of this picture
        if (++this->Starts > mostStarts)
        {
          failMachine(path, std::string(this->Program) + " ends at its start");
        }
        continue;
      }
      Descriptors none;
      if (!helper::receive(this->Running->channel(), answer, none))
      {
        problem = this->end(path, cramped);
        return false;
      }
      this->Starts = 0;
      if (answer.status != Status::Bye)
      {
        break;
      }
      this->Running.reset();
    }
    return this->judge(path, answer, problem);
  }

private:
  static constexpr int mostStarts = 3;

  void start()
  {
    if (!this->Running || !this->Running->isOurs())
    {
      const std::string program = helper::findProgram(this->Program, this->Variable);
      this->Running = std::make_unique<helper::Process>(std::vector<std::string>{ program }, -1);
    }
  }

  /// Why it ended without an answer.
  std::string end(const std::string& path, bool cramped)
  {
    const int status = this->Running->wait();
    this->Running.reset();
    const int signal = helper::signalOf(status, path);
    if (signal == SIGKILL)
    {
      failMachine(path, std::string(this->Program) + " was killed: not enough memory?");
    }
    if (cramped || (signal != SIGXCPU && helper::addressesAreFew()))
    {
      failMachine(path, "not enough memory");
    }
    if (signal == SIGXCPU)
    {
      return "is damaged, or too large: decoding took more processor time than allowed";
    }
    return "is damaged: its decoder ended abnormally (" +
           (signal ? helper::signalText(signal) : std::string("no answer")) + ')';
  }

  bool judge(const std::string& path, Answer& answer, std::string& problem) const
  {
    if (answer.status == Status::NoRoom)
    {
      failMachine(path, "not enough memory");
    }
    if (answer.status == Status::Elsewhere || (answer.status == Status::Done && isSane(answer)))
    {
      return true;
    }
    answer.problem[sizeof answer.problem - 1] = '\0';
    problem = answer.status == Status::Done ? "is damaged: its decoder gave no picture" : answer.problem;
    return false;
  }

  const char* Program;
  const char* Variable;
  std::mutex Mutex;
  std::unique_ptr<helper::Process> Running;
  int Starts = 0;
};

Request requestFor(const Source& source, Values values, const Encoded& encoded)
{
  Request request;
  request.values = values;
  request.fileBytes = encoded.bytes;
  helper::put(request.extension, source.extension.size() < sizeof request.extension ? source.extension.c_str() : "");
  return request;
}

/// The quick one, for what most pictures are, and the one for all kinds, which loads some 250 libraries.
std::array<Helper, 2>& helpers()
{
  static std::array<Helper, 2> both{ { { "dgtk-picture", "DGTK_PICTURE" },
    { "dgtk-picture-any", "DGTK_PICTURE_ANY" } } };
  return both;
}

/// What one of them makes of a picture: its size, and its pixels unless `pixels` is null. False with a problem; with
/// Status::Elsewhere in `size`, it is the other's.
bool askOne(Helper& helper, const Source& source, Request request, const Encoded& encoded, Answer& size, Pixels* pixels,
  std::string& problem)
{
  request.step = Step::Measure;
  if (!helper.ask(source.path, request, encoded.memory.get(), -1, false, size, problem))
  {
    return false;
  }
  if (pixels == nullptr || size.status == Status::Elsewhere)
  {
    return true;
  }
  const std::uint64_t bytes = pixelBytes(size, request.values);
  const Descriptor memory = sharedMemory(source.path, bytes);
  Answer answer;
  request.step = Step::Decode;
  const bool cramped = size.cramped != 0;
  if (!helper.ask(source.path, request, encoded.memory.get(), memory.get(), cramped, answer, problem))
  {
    return false;
  }
  if (answer.status == Status::Elsewhere)
  {
    size.status = answer.status;
    return true;
  }
  if (pixelBytes(answer, request.values) != bytes || answer.width != size.width || answer.channels != size.channels)
  {
    problem = "is damaged: its decoder gave no picture";
    return false;
  }
  pixels->map(memory.get(), static_cast<std::size_t>(bytes));
  return true;
}

bool ask(const Source& source, Values values, Answer& size, Pixels* pixels, std::string& problem)
{
  Encoded encoded;
  if (!encodedOf(source, encoded, problem))
  {
    return false;
  }
  const Request request = requestFor(source, values, encoded);
  for (Helper& helper : helpers())
  {
    if (!askOne(helper, source, request, encoded, size, pixels, problem))
    {
      return false;
    }
    if (size.status != Status::Elsewhere)
    {
      return true;
    }
  }
  problem = "is damaged: its decoder gave no picture";
  return false;
}
} // namespace

Pixels::~Pixels()
{
  if (this->Data)
  {
    ::munmap(this->Data, this->Bytes);
  }
}

void Pixels::map(int file, std::size_t bytes)
{
  void* data = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
  if (data == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  this->Data = data;
  this->Bytes = bytes;
}

void prepare() { helpers().front().prepare(); }

bool measure(const Source& source, Values values, Answer& size, std::string& problem)
{
  return ask(source, values, size, nullptr, problem);
}

bool decode(const Source& source, Values values, Answer& size, Pixels& pixels, std::string& problem)
{
  return ask(source, values, size, &pixels, problem);
}

} // namespace dgtk::picture
