// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovRunner.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkSystem.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr std::chrono::milliseconds lookEvery{ 5 };
/// What POV-Ray says when its own thread has not begun within 3 s, as happens where the machine was halted meanwhile,
/// and may where it misses the word of that thread (vfe/vfesession.cpp, Initialize()). Nothing is drawn then, and it is
/// started again.
constexpr const char* notStarted = "Timed out waiting for worker thread startup";
constexpr int mostStarts = 5;
/// Settings of the user or the machine are not read: this file is empty.
constexpr const char* settingsFile = "povray.ini";
constexpr const char* settingsVariable = "POVINI=";

/// The text between two marks, from `begin` on; `begin` moves behind it. False when there is none.
bool between(const std::string& line, const char* left, const char* right, std::size_t& begin, std::string& text)
{
  const std::size_t from = line.find(left, begin);
  const std::size_t start = from + std::strlen(left);
  const std::size_t end = from == std::string::npos ? from : line.find(right, start);
  if (end == std::string::npos)
  {
    return false;
  }
  text = line.substr(start, end - start);
  begin = end + std::strlen(right);
  return true;
}

PovComplaint parse(const std::string& line)
{
  PovComplaint complaint;
  const std::string mark = "Error: ";
  const std::size_t error = line.find(mark);
  if (error == std::string::npos)
  {
    return complaint;
  }
  complaint.what = line.substr(error + mark.size());
  std::size_t at = 0;
  std::string number;
  if (line.rfind("File '", 0) == 0 && between(line, "File '", "' line ", at, complaint.file) &&
      (number = line.substr(at), true))
  {
    std::from_chars(number.data(), number.data() + number.size(), complaint.line);
  }
  return complaint;
}

/// The last line that POV-Ray printed, but for its own farewell; "" when there is none.
std::string lastWords(const std::string& printed)
{
  std::istringstream lines(printed);
  std::string last;
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t begin = line.find_first_not_of(" \r");
    if (begin != std::string::npos && line.find("POV-Ray finished") == std::string::npos)
    {
      last = line.substr(begin, line.find_last_not_of(" \r") + 1 - begin);
    }
  }
  return last;
}

bool isPicture(const std::string& what)
{
  const char* const ends[] = { ".png", ".ppm", ".pgm" };
  return std::any_of(
    std::begin(ends), std::end(ends), [&](const char* end) { return what.find(end) != std::string::npos; });
}
} // namespace

PovComplaint povComplaint(const std::string& printed)
{
  std::string text = printed;
  for (std::size_t at = text.find("\n "); at != std::string::npos; at = text.find("\n ", at))
  {
    text.erase(at, 1); // long lines are folded
  }
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    PovComplaint complaint = parse(text.substr(begin, end - begin));
    if (!complaint.what.empty())
    {
      return complaint;
    }
    begin = end + 1;
  }
  return {};
}

std::string findPovRay()
{
  std::string program = programOnPath("povray");
  if (program.empty())
  {
    throw MachineError("the renderer povray needs POV-Ray 3.7, which is not on PATH: install the package povray");
  }
  return program;
}

PovRunner::PovRunner(std::string program, std::string folder, const std::atomic<bool>* cancel)
  : Program(std::move(program))
  , Folder(std::move(folder))
  , Cancel(cancel)
{
  writeFile(this->Folder + '/' + settingsFile, "");
}

/// Between fork() and execve() only what is safe after fork in a program of several threads.
int PovRunner::start(const std::vector<std::string>& arguments, const std::string& log) const
{
  std::vector<char*> words{ const_cast<char*>(this->Program.c_str()) };
  for (const std::string& argument : arguments)
  {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  const std::string settings = std::string(settingsVariable) + settingsFile;
  std::vector<char*> variables{ const_cast<char*>(settings.c_str()) };
  for (char** variable = environ; *variable; ++variable)
  {
    if (std::strncmp(*variable, settingsVariable, std::strlen(settingsVariable)) != 0)
    {
      variables.push_back(*variable);
    }
  }
  variables.push_back(nullptr);
  const pid_t process = ::fork();
  if (process != 0)
  {
    return process;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0); // Ctrl-C of the terminal is ours to handle
  const int nothing = ::open("/dev/null", O_RDONLY);
  const int printed = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  ::dup2(nothing, 0);
  ::dup2(printed, 1);
  ::dup2(printed, 2);
  if (::chdir(this->Folder.c_str()) == 0)
  {
    ::execve(this->Program.c_str(), words.data(), variables.data());
  }
  ::_exit(127);
}

int PovRunner::wait(int process) const
{
  int status = 0;
  for (bool killed = false;;)
  {
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process)
    {
      return status;
    }
    if (ended < 0 && errno != EINTR)
    {
      return -1;
    }
    if (this->Cancel && *this->Cancel && !killed)
    {
      killed = true;
      ::kill(process, SIGKILL);
    }
    std::this_thread::sleep_for(lookEvery);
  }
}

void PovRunner::fail(int status, const std::string& printed) const
{
  const PovComplaint complaint = povComplaint(printed);
  if (complaint.what.empty())
  {
    const std::string how = status != -1 && WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                                : "status " + std::to_string(WEXITSTATUS(status));
    const std::string words = lastWords(printed);
    throw MachineError("POV-Ray ended with " + how + (words.empty() ? "" : ": " + printable(words)));
  }
  const std::string file = complaint.file.empty() ? "POV-Ray" : this->Folder + '/' + complaint.file;
  if (isPicture(complaint.what))
  {
    throw InputError(file, complaint.line, "POV-Ray: " + complaint.what);
  }
  throw MachineError(
    file + ':' + (complaint.line > 0 ? std::to_string(complaint.line) + ": POV-Ray: " : " ") + complaint.what);
}

void PovRunner::run(const std::vector<std::string>& arguments, const std::string& name) const
{
  const std::string log = std::filesystem::absolute(this->Folder + '/' + name + ".log").string();
  for (int starts = mostStarts;; --starts)
  {
    if (this->Cancel && *this->Cancel)
    {
      throw MachineError("interrupted");
    }
    const int process = this->start(arguments, log);
    if (process < 0)
    {
      throw MachineError("POV-Ray cannot be started: " + std::string(std::strerror(errno)));
    }
    const int status = this->wait(process);
    std::error_code error;
    const std::string printed = status == 0                           ? std::string()
                                : std::filesystem::exists(log, error) ? readFile(log)
                                                                      : std::string();
    std::filesystem::remove(log, error);
    if (this->Cancel && *this->Cancel)
    {
      throw MachineError("interrupted");
    }
    if (status == 0)
    {
      return;
    }
    if (starts == 1 || printed.find(notStarted) == std::string::npos)
    {
      this->fail(status, printed);
    }
  }
}

} // namespace dgtk
