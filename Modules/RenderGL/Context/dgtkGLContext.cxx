// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGLContext.h"

#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk
{
namespace
{

constexpr GLBackend all[] = { GLBackend::Egl, GLBackend::Osmesa, GLBackend::Glx };

constexpr unsigned int childSeconds = 30;

/// What the backend's context says, without GLEW, which would need the process prepared for OSMesa.
std::string tryBackend(GLBackend backend)
{
  switch (backend)
  {
    case GLBackend::Egl:
      return "EGL, " + rendererName(*makeEglContext());
    case GLBackend::Osmesa:
      if (preloadLibrary().empty())
      {
        throw MachineError("the library libdgtkosmesa.so is missing");
      }
      return "OSMesa, " + rendererName(*makeOsmesaContext(false));
    default:
      return chooseGL(backend).description;
  }
}

GLBackendInfo inChild(GLBackend backend)
{
  GLBackendInfo info{ backend, false, "the test could not be started" };
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    return info;
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    ::alarm(childSeconds);
    std::string line;
    try
    {
      line = "+" + tryBackend(backend);
    }
    catch (const std::exception& error)
    {
      line = std::string("-") + error.what();
    }
    const ssize_t written = ::write(ends[1], line.data(), line.size());
    ::_exit(written == ssize_t(line.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string answer;
  char buffer[512];
  for (ssize_t got = 0; child > 0 && (got = ::read(ends[0], buffer, sizeof(buffer))) > 0;)
  {
    answer.append(buffer, std::size_t(got));
  }
  ::close(ends[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child)
  {
    return info;
  }
  info.available = !answer.empty() && answer[0] == '+';
  info.description = answer.empty() ? "the driver ended the process" : answer.substr(1);
  return info;
}

} // namespace

const char* nameOf(GLBackend backend)
{
  switch (backend)
  {
    case GLBackend::Egl:
      return "egl";
    case GLBackend::Osmesa:
      return "osmesa";
    case GLBackend::Glx:
      return "glx";
    case GLBackend::Auto:
      break;
  }
  return "auto";
}

GLBackend glBackendFromName(const std::string& name)
{
  if (name == "auto")
  {
    return GLBackend::Auto;
  }
  for (const GLBackend backend : all)
  {
    if (name == nameOf(backend))
    {
      return backend;
    }
  }
  throw UsageError("unknown OpenGL backend " + quoted(name) + " (expected auto, egl, osmesa or glx)");
}

GLChoice chooseGL(GLBackend backend)
{
  GLChoice choice;
  currentGLWindow(backend, choice);
  return choice;
}

std::vector<GLBackendInfo> glBackends()
{
  std::vector<GLBackendInfo> rows;
  for (const GLBackend backend : all)
  {
    rows.push_back(inChild(backend));
  }
  return rows;
}

} // namespace dgtk
