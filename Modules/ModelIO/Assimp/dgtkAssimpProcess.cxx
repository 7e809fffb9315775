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

#include <fcntl.h>
#include <poll.h>
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

/// One question of the importer; false when it has hung up.
bool serve(int channel, ModelFiles& files)
{
  import::FileRequest request;
  helper::Descriptors none;
  if (!helper::receive(channel, request, none))
  {
    return false;
  }
  request.name[sizeof request.name - 1] = '\0';
  import::FileAnswer answer;
  const Descriptor file = openFor(files, request.name, answer);
  answer.found = file ? 1 : 0;
  return helper::send(channel, answer, file.get());
}

/// All that comes out of the pipe, while the importer is given the files that it asks for; false when it is more than
/// `limit` bytes.
bool converse(int channel, int from, ModelFiles& files, std::uint64_t limit, std::string& to)
{
  std::size_t size = 0;
  pollfd waits[2] = { { from, POLLIN, 0 }, { channel, POLLIN, 0 } };
  for (bool open = true; open && size <= limit;)
  {
    if (::poll(waits, 2, -1) < 0)
    {
      continue; // interrupted
    }
    if (waits[1].revents != 0 && !serve(channel, files))
    {
      waits[1].fd = -1;
    }
    open = waits[0].revents == 0 || readSome(from, to, size);
  }
  to.resize(size);
  return size <= limit;
}

[[noreturn]] void reportDeath(const std::string& path, int status)
{
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (helper::isInterruption(signal))
  {
    throw MachineError(path + ": reading was interrupted");
  }
  if (signal == SIGXCPU || signal == SIGKILL)
  {
    throw InputError(path, 0, "is damaged, or too large: reading it took more processor time or memory than allowed");
  }
  throw InputError(path, 0,
    "is damaged: its importer ended abnormally (" +
      (signal ? helper::signalText(signal) : std::string("incomplete answer")) + ')');
}

/// Bytes of the model. Throws InputError when it is no file that can be read.
std::uint64_t sizeOfModel(const std::string& path)
{
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status))
  {
    throw InputError(path, 0, "no such file");
  }
  if (!fs::is_regular_file(status))
  {
    throw InputError(path, 0, "is not a regular file");
  }
  const std::uint64_t bytes = fs::file_size(path, code);
  if (code || bytes > largestModel)
  {
    throw InputError(path, 0, "is too large", "at most " + std::to_string(largestModel) + " bytes");
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
  const std::string program = helper::findProgram("dgtk-import", "DGTK_IMPORT");
  int ends[2] = { -1, -1 };
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    throw MachineError(path + ": no pipe to its importer: " + std::strerror(errno));
  }
  const Descriptor in(ends[0]);
  Descriptor out(ends[1]);
  helper::Process process({ program, absolute, format }, out.get());
  out.reset();
  ModelFiles files(absolute);
  std::string stream;
  const std::uint64_t limit = streamBase + streamPerByte * bytes + (std::uint64_t(1) << 30);
  const bool whole = converse(process.channel(), in.get(), files, limit, stream);
  const int ended = whole ? process.wait() : 0;
  files.refuseOutside(path);
  ImportedScene scene;
  try
  {
    MemoryReader reader({ stream.data() }, whole ? stream.size() : 0);
    import::io(reader, scene);
  }
  catch (const std::runtime_error&)
  {
    reportDeath(path, ended);
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
