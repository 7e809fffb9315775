// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program: it is started and linked once, and a fork of it runs its main() for each request on
// standard input, which is what a sweep of some thousand short runs spends most of its time on otherwise
// (many_runs.py). What a run leaves in memory the next finds: what ends or kills the fork ends that run, and the next
// has a new one. Request: the size of what follows, and arguments, each with a 0 behind it. Answer: the exit status
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
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
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

/// The fork that runs, and what it writes to.
struct Worker
{
  pid_t process = -1;
  int requests = -1, answers = -1, output = -1, errors = -1;
};

bool receive(int file, std::string& words)
{
  std::uint32_t size = 0;
  if (!transferAll(read, file, reinterpret_cast<char*>(&size), sizeof size))
  {
    return false;
  }
  words.assign(size, '\0');
  return transferAll(read, file, words.data(), words.size());
}

bool send(int file, const std::string& words)
{
  const auto size = static_cast<std::uint32_t>(words.size());
  return transferAll(write, file, reinterpret_cast<const char*>(&size), sizeof size) &&
         transferAll(write, file, words.data(), words.size());
}

int run(char* program, std::string& words, char** environment)
{
  std::vector<char*> arguments{ program };
  for (std::size_t at = 0; at < words.size(); at += std::strlen(&words[at]) + 1)
  {
    arguments.push_back(&words[at]);
  }
  arguments.push_back(nullptr);
  rlimit files = {};
  getrlimit(RLIMIT_NOFILE, &files); // which a run may raise, for itself
  const int status = mainOfProgram(static_cast<int>(arguments.size()) - 1, arguments.data(), environment);
  setrlimit(RLIMIT_NOFILE, &files);
  std::cout.flush();
  std::fflush(nullptr);
  return status;
}

[[noreturn]] void work(char* program, int requests, int answers, const Worker& files, char** environment)
{
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(files.output, STDOUT_FILENO);
  dup2(files.errors, STDERR_FILENO);
  close(input);
  signal(SIGPIPE, SIG_DFL);
  for (std::string words; receive(requests, words);)
  {
    const std::int32_t status = run(program, words, environment) & 0xff;
    transferAll(write, answers, reinterpret_cast<const char*>(&status), sizeof status);
  }
  if (__gcov_dump != nullptr)
  {
    __gcov_dump();
  }
  _exit(0); // destructors of all libraries would copy their pages
}

void start(Worker& worker, char* program, char** environment)
{
  int requests[2] = { -1, -1 }, answers[2] = { -1, -1 };
  if (pipe2(requests, O_CLOEXEC) == 0 && pipe2(answers, O_CLOEXEC) == 0)
  {
    worker.process = fork();
  }
  if (worker.process == 0)
  {
    close(requests[1]);
    close(answers[0]);
    work(program, requests[0], answers[1], worker, environment);
  }
  close(requests[0]);
  close(answers[1]);
  worker.requests = requests[1];
  worker.answers = answers[0];
}

/// The status of a worker that ends now, if it has not: of a signal, its number below 0.
std::int32_t statusOf(Worker& worker)
{
  close(worker.requests);
  close(worker.answers);
  int status = 0;
  pid_t waited = -1;
  while (worker.process > 0 && (waited = waitpid(worker.process, &status, 0)) < 0 && errno == EINTR)
  {
  }
  worker.process = -1;
  return waited < 0 ? -1000 : WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

/// What was written to a file, which is empty afterwards.
std::string taken(int file)
{
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  lseek(file, 0, SEEK_SET);
  transferAll(read, file, text.data(), text.size());
  lseek(file, 0, SEEK_SET);
  static_cast<void>(ftruncate(file, 0));
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
  signal(SIGPIPE, SIG_IGN); // a fork that is gone is found where it does not answer
  Worker worker;
  worker.output = memfd_create("output", MFD_CLOEXEC);
  worker.errors = memfd_create("errors", MFD_CLOEXEC);
  for (std::string words; receive(STDIN_FILENO, words);)
  {
    int late = 0;
    if (worker.process > 0 && waitpid(worker.process, &late, WNOHANG) != 0)
    {
      std::fprintf(stderr, "many runs: the program ended after a run, with status %d\n", late);
      return 1;
    }
    if (worker.process < 0)
    {
      start(worker, arguments[0], environment);
    }
    std::int32_t status = 0;
    if (!send(worker.requests, words) ||
        !transferAll(read, worker.answers, reinterpret_cast<char*>(&status), sizeof status))
    {
      status = statusOf(worker); // waits: a program that replaces itself goes on
    }
    const std::string texts[] = { taken(worker.output), taken(worker.errors) };
    const std::int32_t head[] = { status, static_cast<std::int32_t>(texts[0].size()),
      static_cast<std::int32_t>(texts[1].size()) };
    const std::string answer = std::string(reinterpret_cast<const char*>(head), sizeof head) + texts[0] + texts[1];
    if (!transferAll(write, STDOUT_FILENO, answer.data(), answer.size()))
    {
      return 1;
    }
  }
  return worker.process > 0 && statusOf(worker) != 0;
}
} // namespace

extern "C" int __libc_start_main(
  Main program, int count, char** arguments, void (*before)(), void (*after)(), void (*loader)(), void* stack)
{
  mainOfProgram = program;
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(&serve, count, arguments, before, after, loader, stack);
}
