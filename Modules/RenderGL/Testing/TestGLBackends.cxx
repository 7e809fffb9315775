// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"

#include "dgtkError.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace dgtk;
using namespace dgtk::test;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace
{

struct Answer
{
  int status = -1;
  std::string first;  ///< description of OpenGL or error
  std::string second; ///< checksum
  std::string rest;   ///< must be empty: nothing else is printed, nor by libraries
};

/// Runs RasterChecksum with `environment` (NAME=value words; "-u NAME" unsets).
Answer run(const std::string& arguments, const std::string& environment = {})
{
  const std::string command = "env -u DISPLAY " + environment + " '" DGTK_RASTER_CHECKSUM "' " + arguments + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), int(buffer.size()), pipe))
  {
    text += buffer.data();
  }
  const int status = ::pclose(pipe);
  Answer answer;
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::istringstream lines(text);
  std::getline(lines, answer.first);
  std::getline(lines, answer.second);
  std::getline(lines, answer.rest, '\0');
  return answer;
}

bool available(GLBackend backend)
{
  static const std::vector<GLBackendInfo> rows = glBackends();
  for (const GLBackendInfo& row : rows)
  {
    if (row.backend == backend)
    {
      return row.available;
    }
  }
  return false;
}

constexpr const char* noEgl = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";

/// An X server of our own on a display number that it chooses.
class XServer
{
public:
  XServer()
  {
    int ends[2];
    if (::pipe(ends) != 0)
    {
      return;
    }
    this->Child = ::fork();
    if (this->Child == 0)
    {
      const int null = ::open("/dev/null", O_RDWR);
      ::dup2(ends[1], 3);
      ::dup2(null, 1);
      ::dup2(null, 2);
      ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "64x64x24", "-nolisten", "tcp", nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    char digit = 0;
    while (::read(ends[0], &digit, 1) == 1 && digit != '\n')
    {
      this->Number += digit;
    }
    ::close(ends[0]);
  }
  ~XServer()
  {
    if (this->Child > 0)
    {
      ::kill(this->Child, SIGTERM);
      ::waitpid(this->Child, nullptr, 0);
    }
  }
  const std::string& number() const { return this->Number; }

private:
  pid_t Child = -1;
  std::string Number;
};

} // namespace

TEST(GLBackends, NamesAndTheirRefusal)
{
  for (const GLBackend backend : { GLBackend::Auto, GLBackend::Egl, GLBackend::Osmesa, GLBackend::Glx })
  {
    EXPECT_EQ(glBackendFromName(nameOf(backend)), backend);
  }
  EXPECT_THAT(
    thrownBy<UsageError>([&] { glBackendFromName("vulkan"); }), HasSubstr("expected auto, egl, osmesa or glx"));
}

TEST(GLBackends, EveryOneIsListedWithAReason)
{
  const std::vector<GLBackendInfo> rows = glBackends();
  ASSERT_EQ(rows.size(), 3u);
  for (const GLBackendInfo& row : rows)
  {
    EXPECT_FALSE(row.description.empty());
    EXPECT_EQ(row.description.find('\n'), std::string::npos);
  }
}

TEST(GLBackends, EglAndOsmesaDrawTheSamePixels)
{
  ASSERT_TRUE(available(GLBackend::Egl) && available(GLBackend::Osmesa)) << "see Utilities/Setup/packages.txt";
  const Answer egl = run("egl");
  const Answer again = run("egl");
  const Answer osmesa = run("osmesa");
  EXPECT_EQ(egl.status, 0);
  EXPECT_EQ(egl.second, again.second);
  EXPECT_THAT(egl.first, StartsWith("EGL, "));
  EXPECT_THAT(osmesa.first, StartsWith("OSMesa, "));
  EXPECT_EQ(egl.second.size(), 64u) << egl.second;
  if (egl.first.find("llvmpipe") != std::string::npos)
  {
    EXPECT_EQ(egl.second, osmesa.second);
  }
  EXPECT_EQ(egl.rest + osmesa.rest, "");
}

TEST(GLBackends, OneThreadAndTwoDrawTheSamePixels)
{
  const Answer one = run("auto", "LP_NUM_THREADS=1");
  const Answer two = run("auto", "LP_NUM_THREADS=2");
  EXPECT_EQ(one.status, 0);
  EXPECT_EQ(one.second, two.second);
}

TEST(GLBackends, AutoFallsBackToOsmesaAndSaysWhy)
{
  ASSERT_TRUE(available(GLBackend::Osmesa)); // packages.txt installs it
  const Answer answer = run("auto", noEgl);
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.first, StartsWith("OSMesa, "));
  EXPECT_THAT(answer.first, HasSubstr("EGL: "));
  EXPECT_EQ(answer.rest, "");
}

TEST(GLBackends, OsmesaIsPreloadedBesideOtherLibraries)
{
  const Answer beside = run("osmesa", "LD_PRELOAD=libm.so.6");
  EXPECT_EQ(beside.status, 0);
  EXPECT_THAT(beside.first, StartsWith("OSMesa, "));
  EXPECT_EQ(beside.rest, "");
}

TEST(GLBackends, OsmesaWithoutPreparationSaysHow)
{
  const Answer answer = run("osmesa unprepared");
  EXPECT_EQ(answer.status, int(ExitCode::Machine));
  EXPECT_THAT(answer.first, HasSubstr("LD_PRELOAD="));
  EXPECT_EQ(answer.second, "");
}

TEST(GLBackends, NothingWorks)
{
  const Answer answer = run("auto unprepared", noEgl);
  EXPECT_EQ(answer.status, int(ExitCode::Machine));
  EXPECT_THAT(answer.first, StartsWith("no OpenGL: EGL: "));
  EXPECT_THAT(answer.first, HasSubstr("; OSMesa: "));
  EXPECT_THAT(answer.first, HasSubstr("; GLX: DISPLAY is not set"));
  EXPECT_EQ(answer.second + answer.rest, "");
}

TEST(GLBackends, GlxWithoutAServer)
{
  const Answer answer = run("glx", "DISPLAY=:47811");
  EXPECT_EQ(answer.status, int(ExitCode::Machine));
  EXPECT_THAT(answer.first, HasSubstr("GLX: no X server at DISPLAY :47811"));
  EXPECT_EQ(answer.second + answer.rest, "");
}

TEST(GLBackends, GlxDrawsUnderXvfb)
{
  const XServer server;
  ASSERT_FALSE(server.number().empty()) << "Xvfb does not start";
  const std::string display = "DISPLAY=:" + server.number();
  const Answer glx = run("glx", display);
  EXPECT_EQ(glx.status, 0);
  EXPECT_THAT(glx.first, StartsWith("GLX, "));
  EXPECT_EQ(glx.second.size(), 64u);
  EXPECT_EQ(glx.rest, "");
  const Answer egl = run("egl");
  const auto isSoftware = [](const Answer& answer) { return answer.first.find("llvmpipe") != std::string::npos; };
  if (isSoftware(egl) && isSoftware(glx))
  {
    EXPECT_EQ(glx.second, egl.second); // the first picture of the process, too
  }
  const Answer fallback = run("auto unprepared", noEgl + (" " + display));
  EXPECT_THAT(fallback.first, StartsWith("GLX, "));
  EXPECT_THAT(fallback.first, HasSubstr("OSMesa: "));
  EXPECT_EQ(fallback.second, glx.second);
}

TEST(GLBackends, TheProcessKeepsItsOpenGL)
{
  const GLChoice choice = source().choice();
  EXPECT_EQ(chooseGL(GLBackend::Auto).description, choice.description);
  const GLBackend other = choice.backend == GLBackend::Glx ? GLBackend::Egl : GLBackend::Glx;
  EXPECT_THROW(chooseGL(other), UsageError);
}
