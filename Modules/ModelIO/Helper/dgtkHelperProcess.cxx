// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHelperProcess.h"

#include "dgtkError.h"
#include "dgtkSystem.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk::helper
{

namespace
{
namespace fs = std::filesystem;

/// Folder of the shared library (or program) that holds this function.
fs::path libraryFolder()
{
  Dl_info info{};
  std::error_code code;
  if (::dladdr(reinterpret_cast<const void*>(&findProgram), &info) == 0 || !info.dli_fname)
  {
    return {};
  }
  return fs::weakly_canonical(info.dli_fname, code).parent_path();
}

/// With default signals and nothing on its standard error.
pid_t spawn(const std::vector<std::string>& command, int input, int output)
{
  constexpr const char* outlet = "/dev/null";
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  sigset_t defaults;
  sigset_t none;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : { SIGPIPE, SIGXCPU, SIGXFSZ, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL })
  {
    sigaddset(&defaults, signal);
  }
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, 0);
  if (output >= 0)
  {
    posix_spawn_file_actions_adddup2(&actions, output, 1);
  }
  else
  {
    posix_spawn_file_actions_addopen(&actions, 1, outlet, O_WRONLY, 0);
  }
  posix_spawn_file_actions_addopen(&actions, 2, outlet, O_WRONLY, 0);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command)
  {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int problem = ::posix_spawn(&child, command.front().c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0)
  {
    const bool noOutlet = ::access(outlet, W_OK) != 0;
    throw MachineError((noOutlet ? outlet : command.front()) + ": cannot be " + (noOutlet ? "opened: " : "started: ") +
                       std::strerror(problem));
  }
  return child;
}
} // namespace

std::string findProgram(const char* name, const char* variable)
{
  const char* set = std::getenv(variable);
  if (set && *set)
  {
    if (!isProgram(set))
    {
      throw MachineError(std::string(set) + ": is not a program (" + variable + " names " + name + ')');
    }
    return set;
  }
  const fs::path library = libraryFolder();
  fs::path folder = library;
  for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path())
  {
    for (const char* below : { "libexec/dgtk", "bin" })
    {
      std::string program = (folder / below / name).string();
      if (isProgram(program))
      {
        return program;
      }
    }
  }
  throw MachineError(std::string(name) + ", a program that belongs to the library, was not found above " +
                     library.string() + " (" + variable + " can name it)");
}

std::string installedProgram(const std::string& name, const std::string& variable)
{
  const char* const set = std::getenv(variable.c_str());
  if (set && *set)
  {
    return isProgram(set) ? fs::absolute(set).string() : std::string();
  }
  return programOnPath(name);
}

Process::Process(const std::vector<std::string>& command, int output)
  : Owner(::getpid())
{
  int ends[2] = { -1, -1 };
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
  {
    throw MachineError(command.front() + ": no socket to it: " + std::strerror(errno));
  }
  this->Channel.reset(ends[0]);
  const Descriptor theirs(ends[1]);
  this->Child = spawn(command, theirs.get(), output);
}

Process::~Process()
{
  if (this->Child > 0 && this->isOurs())
  {
    ::kill(this->Child, SIGKILL); // nobody waits for what it does
  }
  this->wait();
}

bool Process::isOurs() const { return this->Owner == ::getpid(); }

int Process::wait()
{
  this->Channel.reset();
  int status = 0;
  while (this->Child > 0 && this->isOurs() && ::waitpid(this->Child, &status, 0) < 0)
  {
    if (errno != EINTR)
    {
      status = 0; // somebody else collects children: what it sent says whether it came to its end
      break;
    }
  }
  this->Child = -1;
  return status;
}

bool isInterruption(int signal) { return signal == SIGINT || signal == SIGTERM || signal == SIGHUP; }

int signalOf(int status, const std::string& path)
{
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (isInterruption(signal))
  {
    throw MachineError(path + ": reading was interrupted");
  }
  return signal;
}

bool addressesAreFew()
{
  constexpr rlim_t least = rlim_t(3) << 29; // libraries, stacks of their threads, and 512 MiB for the work
  rlimit now{};
  return ::getrlimit(RLIMIT_AS, &now) == 0 && now.rlim_cur != RLIM_INFINITY && now.rlim_cur < least;
}

std::string signalText(int signal) { return "signal " + std::to_string(signal) + ", " + ::strsignal(signal); }

} // namespace dgtk::helper
