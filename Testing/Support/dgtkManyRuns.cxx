// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program: it is started and linked once, and its main() runs in a fork of it for each request on
// standard input, which is what a sweep of some thousand short runs spends most of its time on otherwise
// (many_runs.py). Request: the size of what follows, and arguments, each with a 0 behind it. Answer: the exit status
// (of a signal, its number below 0), the sizes of what was written to standard output and error, and both. Sizes and
// status have 32 bits.
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/// Of programs that count what is covered (gcc): what _exit() would lose.
extern "C" void __gcov_dump() __attribute__((weak));

namespace
{
using Main = int (*)(int, char**, char**);
Main mainOfProgram;

/// Whether all bytes were read or written; false where the other side is gone.
template <typename Transfer, typename Bytes>
bool transferAll(Transfer transfer, int file, Bytes* bytes, std::size_t size)
{
  for (std::size_t done = 0; done < size;)
  {
    const ssize_t some = transfer(file, bytes + done, size - done);
    if (some > 0)
    {
      done += static_cast<std::size_t>(some);
    }
    else if (some == 0 || errno != EINTR)
    {
      return false;
    }
  }
  return true;
}

[[noreturn]] void runOnce(char* program, std::string& words, int output, int errors, char** environment)
{
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  close(input);
  close(output);
  close(errors);
  std::vector<char*> arguments{ program };
  for (std::size_t at = 0; at < words.size(); at += std::strlen(&words[at]) + 1)
  {
    arguments.push_back(&words[at]);
  }
  arguments.push_back(nullptr);
  const int status = mainOfProgram(static_cast<int>(arguments.size()) - 1, arguments.data(), environment);
  std::cout.flush();
  std::fflush(nullptr);
  if (__gcov_dump != nullptr)
  {
    __gcov_dump();
  }
  _exit(status); // destructors of all libraries would copy their pages
}

std::string contents(int file)
{
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  lseek(file, 0, SEEK_SET);
  transferAll(read, file, text.data(), text.size());
  close(file);
  return text;
}

/// What each run would open by name, and find its way through again: what is preloaded, and the ray engine's allocator.
void openOnce()
{
  const char* preloaded = std::getenv("LD_PRELOAD");
  std::istringstream names(std::string(preloaded != nullptr ? preloaded : "") + ":libtbbmalloc.so.2");
  for (std::string name; std::getline(names, name, ':');)
  {
    dlopen(name.c_str(), RTLD_NOW);
  }
}

int serve(int, char** arguments, char** environment)
{
  openOnce();
  unsetenv("LD_PRELOAD"); // programs that a run starts are themselves
  unsetenv("LD_BIND_NOW");
  for (std::uint32_t size = 0; transferAll(read, STDIN_FILENO, reinterpret_cast<char*>(&size), sizeof size);)
  {
    std::string words(size, '\0');
    transferAll(read, STDIN_FILENO, words.data(), words.size());
    const int output = memfd_create("output", MFD_CLOEXEC);
    const int errors = memfd_create("errors", MFD_CLOEXEC);
    const pid_t child = fork();
    if (child == 0)
    {
      runOnce(arguments[0], words, output, errors, environment);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
    {
    }
    const std::string texts[] = { contents(output), contents(errors) };
    const std::int32_t head[] = { child < 0             ? -1000
                                  : WIFSIGNALED(status) ? -WTERMSIG(status)
                                                        : WEXITSTATUS(status),
      static_cast<std::int32_t>(texts[0].size()), static_cast<std::int32_t>(texts[1].size()) };
    const std::string answer = std::string(reinterpret_cast<const char*>(head), sizeof head) + texts[0] + texts[1];
    if (!transferAll(write, STDOUT_FILENO, answer.data(), answer.size()))
    {
      return 1;
    }
  }
  return 0;
}
} // namespace

extern "C" int __libc_start_main(
  Main program, int count, char** arguments, void (*before)(), void (*after)(), void (*loader)(), void* stack)
{
  mainOfProgram = program;
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(&serve, count, arguments, before, after, loader, stack);
}
