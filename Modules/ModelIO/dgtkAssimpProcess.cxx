// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpProcess.h"

#include "dgtkError.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
constexpr std::uint64_t largestModel = std::uint64_t(1) << 32;
constexpr std::uint64_t streamBase = std::uint64_t(64) << 20;
constexpr std::uint64_t streamPerByte = 64;

bool isProgram(const fs::path& path)
{
  std::error_code code;
  return fs::is_regular_file(path, code) && ::access(path.c_str(), X_OK) == 0;
}

/// Folder of the shared library (or program) that holds this function.
fs::path libraryFolder()
{
  Dl_info info{};
  std::error_code code;
  if (::dladdr(reinterpret_cast<const void*>(&importProgram), &info) == 0 || !info.dli_fname)
  {
    return {};
  }
  return fs::weakly_canonical(info.dli_fname, code).parent_path();
}

class Descriptor
{
public:
  explicit Descriptor(int descriptor = -1)
    : Number(descriptor)
  {
  }
  ~Descriptor() { this->close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void close()
  {
    if (this->Number >= 0)
    {
      ::close(this->Number);
      this->Number = -1;
    }
  }
  int get() const { return this->Number; }

private:
  int Number;
};

/// The helper with nothing on its standard input and error and our pipe as its output.
pid_t spawn(const std::string& program, const std::string& path, const std::string& format, int output)
{
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  sigset_t defaults;
  sigset_t none;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : { SIGPIPE, SIGXCPU, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL })
  {
    sigaddset(&defaults, signal);
  }
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, 1);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  const char* arguments[] = { program.c_str(), path.c_str(), format.c_str(), nullptr };
  pid_t child = -1;
  const int problem =
    posix_spawn(&child, program.c_str(), &actions, &attributes, const_cast<char* const*>(arguments), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0)
  {
    throw MachineError(program + ": cannot be started: " + std::strerror(problem));
  }
  return child;
}

int waitFor(pid_t child)
{
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
  {
    if (errno != EINTR)
    {
      return 0; // somebody else collects children: the stream says whether it is whole
    }
  }
  return status;
}

/// All that comes out of the pipe; false when it is more than `limit` bytes.
bool readAll(int from, std::uint64_t limit, std::string& to)
{
  std::size_t size = 0;
  for (;;)
  {
    if (size == to.size())
    {
      if (size > limit)
      {
        return false;
      }
      to.resize(std::max<std::size_t>(65536, size * 2));
    }
    const ssize_t got = ::read(from, to.data() + size, to.size() - size);
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got <= 0)
    {
      break;
    }
    size += static_cast<std::size_t>(got);
  }
  to.resize(size);
  return size <= limit;
}

/// One line, without the path that the error starts with anyway.
std::string oneLine(std::string text, const std::string& path)
{
  for (std::size_t at = text.find(path); !path.empty() && at != std::string::npos; at = text.find(path))
  {
    text.erase(at, path.size());
  }
  for (char& c : text)
  {
    c = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.'))
  {
    text.pop_back();
  }
  return text.substr(0, 300);
}

[[noreturn]] void reportDeath(const std::string& path, int status)
{
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP)
  {
    throw MachineError(path + ": reading was interrupted");
  }
  if (signal == SIGXCPU || signal == SIGKILL)
  {
    throw InputError(path, 0, "is damaged, or too large: reading it took more processor time or memory than allowed");
  }
  throw InputError(path, 0,
    "is damaged: its importer ended abnormally (" +
      (signal ? "signal " + std::to_string(signal) + ", " + ::strsignal(signal) : std::string("incomplete answer")) +
      ')');
}
} // namespace

std::string importProgram()
{
  const char* set = std::getenv("DGTK_IMPORT");
  if (set && *set)
  {
    if (!isProgram(set))
    {
      throw MachineError(std::string(set) + ": is not a program (DGTK_IMPORT names dgtk-import)");
    }
    return set;
  }
  const fs::path library = libraryFolder();
  fs::path folder = library;
  for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path())
  {
    for (const char* below : { "libexec/dgtk", "bin" })
    {
      if (isProgram(folder / below / "dgtk-import"))
      {
        return (folder / below / "dgtk-import").string();
      }
    }
  }
  throw MachineError("dgtk-import, the program that reads models of this format, was not found above " +
                     library.string() + " (DGTK_IMPORT can name it)");
}

import::Scene importModel(const std::string& path, const std::string& format){ std::error_code code;
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
const std::string program = importProgram();
int ends[2] = { -1, -1 };
if (::pipe2(ends, O_CLOEXEC) != 0)
{
  throw MachineError(path + ": no pipe to its importer: " + std::strerror(errno));
}
Descriptor in(ends[0]);
Descriptor out(ends[1]);
const pid_t child = spawn(program, fs::absolute(path, code).string(), format, out.get());
out.close();
std::string stream;
bool whole = false;
try
{
  whole = readAll(in.get(), streamBase + streamPerByte * bytes + (std::uint64_t(1) << 30), stream);
}
catch (...)
{
  in.close();
  waitFor(child);
  throw;
}
in.close();
const int ended = waitFor(child);
import::Scene scene;
try
{
  import::StreamReader reader(stream.data(), whole ? stream.size() : 0);
  io(reader, scene);
}
catch (const std::runtime_error&)
{
  reportDeath(path, ended);
}
if (!scene.error.empty())
{
  throw InputError(path, 0, "cannot be read: " + oneLine(scene.error, fs::absolute(path, code).string()));
}
return scene;
}

} // namespace dgtk
