// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <vtkXOpenGLRenderWindow.h>

#include <cstdlib>
#include <dlfcn.h>
#include <memory>
#include <string>

namespace dgtk
{
namespace
{

using Connection = std::unique_ptr<void, int (*)(void*)>;

/// VTK aborts the process when the X server cannot be reached, so that is tried before. The connection is to stay open
/// until VTK has its own: a server may start over when its last client leaves.
Connection checkDisplay()
{
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display)
  {
    throw MachineError("DISPLAY is not set");
  }
  void* library = ::dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  using Query = int (*)(void*, const char*, int*, int*, int*);
  const auto open = library ? reinterpret_cast<Open>(::dlsym(library, "XOpenDisplay")) : nullptr;
  const auto close = library ? reinterpret_cast<Close>(::dlsym(library, "XCloseDisplay")) : nullptr;
  const auto query = library ? reinterpret_cast<Query>(::dlsym(library, "XQueryExtension")) : nullptr;
  if (!open || !close || !query)
  {
    throw MachineError("libX11.so.6 cannot be loaded");
  }
  Connection connection(open(display), close);
  if (!connection)
  {
    throw MachineError(std::string("no X server at DISPLAY ") + display);
  }
  int numbers[3];
  const bool glx = query(connection.get(), "GLX", &numbers[0], &numbers[1], &numbers[2]) != 0;
  if (!glx)
  {
    throw MachineError(std::string("the X server ") + display + " has no GLX");
  }
  return connection;
}

} // namespace

vtkSmartPointer<vtkOpenGLRenderWindow> makeGlxWindow()
{
  if (osmesaPreloaded())
  {
    throw MachineError("the process was started for OSMesa");
  }
  const Connection connection = checkDisplay();
  auto window = vtkSmartPointer<vtkXOpenGLRenderWindow>::New();
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->SetMultiSamples(0);
  window->SetSize(16, 16);
  window->Initialize();
  return window;
}

} // namespace dgtk
