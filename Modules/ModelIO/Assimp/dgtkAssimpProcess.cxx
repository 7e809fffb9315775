// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpProcess.h"

#include "dgtkError.h"
#include "dgtkHelperProcess.h"
#include "dgtkImportProtocol.h"
#include "dgtkModelFiles.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
using helper::Descriptor;
constexpr std::uint64_t largestModel = std::uint64_t(1) << 32;
constexpr std::uint64_t streamBase = std::uint64_t(64) << 20;
constexpr std::uint64_t streamPerByte = 64;
constexpr int mostStarts = 3;

/// Opens a file that the model may have.
Descriptor openFor(ModelFiles& files, const std::string& written, import::FileAnswer& answer)
{
  const std::string path = files.find(written);
  Descriptor file(path.empty() ? -1 : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat status = {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      std::uint64_t(status.st_size) > largestModel)
  {
    return Descriptor();
  }
  helper::put(answer.path, path.c_str());
  return file;
}

/// Appends what the pipe holds; false at its end.
bool readSome(int from, std::string& to, std::size_t& size)
{
  if (size == to.size())
  {
    to.resize(std::max<std::size_t>(65536, size * 2));
  }
  const ssize_t got = ::read(from, to.data() + size, to.size() - size);
  size += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  return got > 0 || (got < 0 && errno == EINTR);
}

/// What the importer of one model has said.
struct Answer
{
  std::string stream;
  bool isWhole = true;   ///< not more than it may be
  bool hasEnded = false; ///< and the program knows how:
  int status = 0;        ///< as of waitpid()
  int server = 0;        ///< the number of the process that was asked
};

/// One question of the importer; false when it has hung up, or ended.
bool serve(int channel, ModelFiles& files, Answer& end)
{
  import::Question question;
  helper::Descriptors none;
  if (!helper::receive(channel, question, none))
  {
    return false;
  }
  if (question.hasEnded != 0)
  {
    end.hasEnded = true;
    end.status = question.status;
    return false;
  }
  question.name[sizeof question.name - 1] = '\0';
  import::FileAnswer answer;
  const Descriptor file = openFor(files, question.name, answer);
  answer.found = file ? 1 : 0;
  helper::send(channel, answer, file.get()); // if nobody is there any more, how that came is what is received next
  return true;
}

/// All that comes out of the pipe, while the importer is given the files that it asks for, to its end or up to more
/// than `limit` bytes.
Answer converse(int channel, int from, ModelFiles& files, std::uint64_t limit)
{
  Answer answer;
  std::size_t size = 0;
  pollfd waits[2] = { { from, POLLIN, 0 }, { channel, POLLIN, 0 } };
  while ((waits[0].fd >= 0 || waits[1].fd >= 0) && size <= limit)
  {
    if (::poll(waits, 2, -1) < 0)
    {
      continue; // interrupted
    }
    if (waits[1].fd >= 0 && waits[1].revents != 0 && !serve(channel, files, answer))
    {
      waits[1].fd = -1;
    }
    if (waits[0].fd >= 0 && waits[0].revents != 0 && !readSome(from, answer.stream, size))
    {
      waits[0].fd = -1;
    }
  }
  answer.stream.resize(size);
  answer.isWhole = size <= limit;
  return answer;
}

/// The running dgtk-import, of which each model has a copy.
class ImportServer
{
public:
  static ImportServer& get()
  {
    static ImportServer one;
    return one;
  }

  /// Asks for a copy; returns the number of the process that was asked. Throws MachineError when there is no such
  /// program.
  int ask(const import::ModelRequest& request, int channel, int out)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const std::string program = helper::findProgram("dgtk-import", "DGTK_IMPORT");
    if (!this->Running || !this->Running->isOurs() || this->Program != program)
    {
      this->start(program);
    }
    if (!helper::send(this->Running->channel(), request, channel, out))
    {
      this->start(program); // it had nothing to do for long, and ended
      helper::send(this->Running->channel(), request, channel, out);
    }
    return this->Number;
  }

  /// A copy ended without a word, and so the process of that number did: how, unless another has asked before.
  int end(int number)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (!this->Running || this->Number != number)
    {
      return 0;
    }
    const int status = this->Running->wait();
    this->Running.reset();
    return status;
  }

private:
  void start(const std::string& program)
  {
    this->Running = std::make_unique<helper::Process>(std::vector<std::string>{ program }, -1);
    this->Program = program;
    ++this->Number;
  }

  std::mutex Mutex;
  std::unique_ptr<helper::Process> Running;
  std::string Program;
  int Number = 0; ///< of processes that were started
};

/// One attempt to have a model imported.
Answer askOnce(const std::string& path, const std::string& absolute, const std::string& format, std::uint64_t bytes,
  ModelFiles& files)
{
  int pipe[2] = { -1, -1 };
  int socket[2] = { -1, -1 };
  const bool isPiped = ::pipe2(pipe, O_CLOEXEC) == 0;
  const Descriptor in(pipe[0]);
  Descriptor out(pipe[1]);
  if (!isPiped || ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, socket) != 0)
  {
    throw MachineError(path + ": no pipe to its importer: " + std::strerror(errno));
  }
  const Descriptor channel(socket[0]);
  Descriptor theirs(socket[1]);
  import::ModelRequest request;
  helper::put(request.path, absolute.c_str());
  helper::put(request.format, format.c_str());
  const int server = ImportServer::get().ask(request, theirs.get(), out.get());
  theirs.reset();
  out.reset();
  Answer answer =
    converse(channel.get(), in.get(), files, streamBase + streamPerByte * bytes + (std::uint64_t(1) << 30));
  answer.server = server;
  return answer;
}

/// A program that ends before it knows of the model is started again, some times.
Answer askUntilAnswered(const std::string& path, const std::string& absolute, const std::string& format,
  std::uint64_t bytes, ModelFiles& files)
{
  for (int starts = 1;; ++starts)
  {
    Answer answer = askOnce(path, absolute, format, bytes, files);
    if (answer.hasEnded || !answer.isWhole)
    {
      return answer;
    }
    answer.status = ImportServer::get().end(answer.server);
    const bool isInterrupted = WIFSIGNALED(answer.status) && helper::isInterruption(WTERMSIG(answer.status));
    if (!answer.stream.empty() || isInterrupted || starts == mostStarts)
    {
      return answer;
    }
  }
}

[[noreturn]] void reportDeath(const std::string& path, int status)
{
  const int signal = helper::signalOf(status, path);
  if (signal == SIGXCPU || signal == SIGKILL)
  {
    throw InputError(path, "is damaged, or too large: reading it took more processor time or memory than allowed");
  }
  if (helper::addressesAreFew())
  {
    throw MachineError(path + ": cannot be read: not enough memory");
  }
  throw InputError(path, "is damaged: its importer ended abnormally (" +
                           (signal ? helper::signalText(signal) : std::string("incomplete answer")) + ')');
}

/// Bytes of the model. Throws InputError when it is no file that can be read.
std::uint64_t sizeOfModel(const std::string& path)
{
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status))
  {
    throw InputError(path, "no such file");
  }
  if (!fs::is_regular_file(status))
  {
    throw InputError(path, "is not a regular file");
  }
  const std::uint64_t bytes = fs::file_size(path, code);
  if (code || bytes > largestModel)
  {
    throw InputError(path, "is too large", "at most " + std::to_string(largestModel) + " bytes");
  }
  return bytes;
}

[[noreturn]] void reportError(const std::string& path, const std::string& absolute, const import::Scene& scene)
{
  const std::string file = scene.errorFile.empty() || scene.errorFile == absolute ? path : scene.errorFile;
  throw InputError(file, static_cast<long>(std::min<std::uint64_t>(scene.errorLine, 1u << 31)),
    "cannot be read: " + oneLine(scene.error, absolute));
}
} // namespace

auto importModel(const std::string& path, const std::string& format) -> ImportedScene
{
  const std::uint64_t bytes = sizeOfModel(path);
  std::error_code code;
  const std::string absolute = fs::absolute(path, code).string();
  ModelFiles files(absolute);
  const Answer answer = askUntilAnswered(path, absolute, format, bytes, files);
  files.refuseOutside(path);
  ImportedScene scene;
  try
  {
    MemoryReader reader({ answer.stream.data() }, answer.isWhole ? answer.stream.size() : 0);
    import::io(reader, scene);
  }
  catch (const std::runtime_error&)
  {
    reportDeath(path, answer.status);
  }
  if (!scene.error.empty())
  {
    reportError(path, absolute, scene);
  }
  scene.files = files.companions(path);
  scene.dependencies = files.dependencies();
  scene.dependencies.push_back({ ModelDependency::Kind::Program, "dgtk-import", "DGTK_IMPORT" });
  scene.dependencies.push_back({ ModelDependency::Kind::Program, DGTK_ASSIMP_LIBRARY, {} });
  return scene;
}

} // namespace dgtk
