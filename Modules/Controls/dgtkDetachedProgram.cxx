// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDetachedProgram.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr int niceness = 5; // of 19
constexpr int notStarted = 127;

/// As execve() takes them.
std::vector<char*> pointersTo(QList<QByteArray>& words)
{
  std::vector<char*> pointers;
  for (QByteArray& word : words)
  {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

// From here to execve() only what a copy of a program with threads may do.

[[noreturn]] void giveUp(int report)
{
  const int error = errno;
  [[maybe_unused]] const ssize_t told = ::write(report, &error, sizeof error);
  ::_exit(notStarted);
}

bool writeNumber(int output)
{
  char line[16];
  char* end = std::to_chars(line, line + sizeof line - 1, ::getpid()).ptr;
  *end++ = '\n';
  return ::write(output, line, std::size_t(end - line)) == end - line;
}

[[noreturn]] void become(char* const* words, char* const* environment, int output, int report)
{
  ::setsid();
  for (const int usual : { SIGINT, SIGTERM, SIGPIPE })
  {
    ::signal(usual, SIG_DFL); // scripts start what runs in the background without SIGINT
  }
  ::signal(SIGHUP, SIG_IGN);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  [[maybe_unused]] const int now = ::nice(niceness); // it renders as well without
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
      ::dup2(output, STDERR_FILENO) < 0 || !writeNumber(output))
  {
    giveUp(report);
  }
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC); // of older kernels it keeps what others left open
  ::execve(words[0], words, environment);
  giveUp(report);
}

/// A child of a child that is gone: nobody waits for it, and it is nobody's when this program ends.
[[noreturn]] void parent(char* const* words, char* const* environment, int output, int report)
{
  const pid_t child = ::fork();
  if (child < 0)
  {
    giveUp(report);
  }
  if (child == 0)
  {
    become(words, environment, output, report);
  }
  ::_exit(0);
}

/// The error that was reported before the other end was closed; 0 for none.
int errorFrom(int end)
{
  int error = 0;
  ssize_t got = 0;
  while ((got = ::read(end, &error, sizeof error)) < 0 && errno == EINTR)
  {
  }
  return got == ssize_t(sizeof error) ? error : 0;
}
} // namespace

QString startDetached(QList<QByteArray> words, QList<QByteArray> environment, int output)
{
  const std::vector<char*> arguments = pointersTo(words);
  const std::vector<char*> variables = pointersTo(environment);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    return QString::fromLocal8Bit(std::strerror(errno));
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    parent(arguments.data(), variables.data(), output, ends[1]);
  }
  int error = child < 0 ? errno : 0;
  ::close(ends[1]);
  if (child > 0)
  {
    error = errorFrom(ends[0]);
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR)
    {
    }
  }
  ::close(ends[0]);
  return error == 0 ? QString() : QString::fromLocal8Bit(std::strerror(error));
}

} // namespace dgtk
