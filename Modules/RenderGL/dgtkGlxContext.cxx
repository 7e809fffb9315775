// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <vtkXOpenGLRenderWindow.h>

#include <cstdlib>
#include <dlfcn.h>

namespace dgtk
{
namespace
{

/// VTK aborts the process when the X server cannot be reached, so that is tried before.
void checkDisplay()
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
  void* connection = open(display);
  if (!connection)
  {
    throw MachineError(std::string("no X server at DISPLAY ") + display);
  }
  int numbers[3];
  const bool glx = query(connection, "GLX", &numbers[0], &numbers[1], &numbers[2]) != 0;
  close(connection);
  if (!glx)
  {
    throw MachineError(std::string("the X server ") + display + " has no GLX");
  }
}

} // namespace

vtkSmartPointer<vtkOpenGLRenderWindow> makeGlxWindow()
{
  if (osmesaPreloaded())
  {
    throw MachineError("the process was started for OSMesa");
  }
  checkDisplay();
  auto window = vtkSmartPointer<vtkXOpenGLRenderWindow>::New();
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->SetMultiSamples(0);
  window->SetSize(16, 16);
  window->Initialize();
  return window;
}

} // namespace dgtk
