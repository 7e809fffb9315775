// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <unistd.h>
#include <vector>

namespace dgtk
{
namespace
{

/// The functions of libEGL, looked up so that a machine without it can still use the other backends.
struct Egl
{
  decltype(&eglGetProcAddress) getProcAddress = nullptr;
  decltype(&eglQueryString) queryString = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglTerminate) terminate = nullptr;
  decltype(&eglBindAPI) bindAPI = nullptr;
  decltype(&eglChooseConfig) chooseConfig = nullptr;
  decltype(&eglCreateContext) createContext = nullptr;
  decltype(&eglDestroyContext) destroyContext = nullptr;
  decltype(&eglMakeCurrent) makeCurrent = nullptr;
  decltype(&eglGetCurrentContext) getCurrentContext = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;
  PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
};

template <typename F>
void resolve(void* library, const char* name, F& function)
{
  function = reinterpret_cast<F>(::dlsym(library, name));
  if (!function)
  {
    throw MachineError(std::string(name) + " is missing in libEGL.so.1");
  }
}

const Egl& egl()
{
  static const Egl functions = []
  {
    void* library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
    {
      throw MachineError("libEGL.so.1 cannot be loaded");
    }
    Egl e;
    resolve(library, "eglGetProcAddress", e.getProcAddress);
    resolve(library, "eglQueryString", e.queryString);
    resolve(library, "eglInitialize", e.initialize);
    resolve(library, "eglTerminate", e.terminate);
    resolve(library, "eglBindAPI", e.bindAPI);
    resolve(library, "eglChooseConfig", e.chooseConfig);
    resolve(library, "eglCreateContext", e.createContext);
    resolve(library, "eglDestroyContext", e.destroyContext);
    resolve(library, "eglMakeCurrent", e.makeCurrent);
    resolve(library, "eglGetCurrentContext", e.getCurrentContext);
    const auto extension = [&e](const char* name) { return e.getProcAddress(name); };
    e.getPlatformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(extension("eglGetPlatformDisplayEXT"));
    e.queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(extension("eglQueryDevicesEXT"));
    e.queryDeviceString = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(extension("eglQueryDeviceStringEXT"));
    return e;
  }();
  return functions;
}

bool contains(const char* list, const char* word)
{
  const std::size_t length = std::strlen(word);
  for (const char* at = list; at && (at = std::strstr(at, word)); at += length)
  {
    if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
    {
      return true;
    }
  }
  return false;
}

class EglContext : public NativeContext
{
public:
  EglContext(EGLDisplay display, EGLContext context)
    : Display(display)
    , Context(context)
  {
  }
  ~EglContext() override
  {
    EglContext::release();
    egl().destroyContext(this->Display, this->Context);
  }
  void makeCurrent() override
  {
    if (!egl().makeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, this->Context))
    {
      throw MachineError("eglMakeCurrent failed");
    }
  }
  void release() override { egl().makeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  bool isCurrent() const override { return egl().getCurrentContext() == this->Context; }
  void* lookUp(const char* function) const override { return reinterpret_cast<void*>(egl().getProcAddress(function)); }

private:
  EGLDisplay Display;
  EGLContext Context;
};

/// A display's renderer waits for threads that a forked process does not have, so each is used by one process only.
void claim(EGLDisplay display)
{
  static std::map<EGLDisplay, pid_t> owners;
  if (owners.emplace(display, ::getpid()).first->second != ::getpid())
  {
    throw MachineError("in use since before the process was forked");
  }
}

/// An OpenGL core context of the highest version that the display has.
std::unique_ptr<NativeContext> contextOn(EGLDisplay display)
{
  claim(display);
  if (display == EGL_NO_DISPLAY || !egl().initialize(display, nullptr, nullptr))
  {
    throw MachineError("eglInitialize failed");
  }
  if (!contains(egl().queryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
  {
    throw MachineError("no EGL_KHR_surfaceless_context");
  }
  const EGLint wanted[] = { EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!egl().bindAPI(EGL_OPENGL_API) || !egl().chooseConfig(display, wanted, &config, 1, &count) || count < 1)
  {
    throw MachineError("no configuration with OpenGL");
  }
  for (const int version : { 46, 45, 43, 41, 33, 32 })
  {
    const EGLint attributes[] = { EGL_CONTEXT_MAJOR_VERSION, version / 10, EGL_CONTEXT_MINOR_VERSION, version % 10,
      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    const EGLContext context = egl().createContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context != EGL_NO_CONTEXT)
    {
      auto made = std::make_unique<EglContext>(display, context);
      made->makeCurrent();
      return made;
    }
  }
  throw MachineError("no OpenGL 3.2 core context");
}

/// A GPU's context, or one of Mesa's software renderer as a device; nothing when there is none.
std::unique_ptr<NativeContext> deviceContext(bool software)
{
  if (!egl().queryDevices || !egl().queryDeviceString)
  {
    return nullptr;
  }
  EGLint count = 0;
  if (!egl().queryDevices(0, nullptr, &count) || count < 1)
  {
    return nullptr;
  }
  std::vector<EGLDeviceEXT> devices(count);
  egl().queryDevices(count, devices.data(), &count);
  devices.resize(count);
  for (EGLDeviceEXT device : devices)
  {
    if (contains(egl().queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software") != software)
    {
      continue;
    }
    try
    {
      auto context = contextOn(egl().getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
      const std::string name = rendererName(*context);
      if (software || (name.find("llvmpipe") == std::string::npos && name.find("softpipe") == std::string::npos))
      {
        return context;
      }
    }
    catch (const MachineError&)
    {
      continue;
    }
  }
  return nullptr;
}

} // namespace

std::unique_ptr<NativeContext> makeEglContext()
{
  ::setenv("EGL_LOG_LEVEL", "fatal", 0); // what fails is told in our own words
  const char* extensions = egl().queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!extensions || !egl().getPlatformDisplay)
  {
    throw MachineError("no EGL_EXT_platform_base");
  }
  const bool devices =
    contains(extensions, "EGL_EXT_platform_device") || contains(extensions, "EGL_EXT_device_enumeration");
  if (devices)
  {
    if (auto context = deviceContext(false))
    {
      return context;
    }
  }
  if (!contains(extensions, "EGL_MESA_platform_surfaceless"))
  {
    throw MachineError("no EGL_MESA_platform_surfaceless");
  }
  try
  {
    return contextOn(egl().getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  }
  catch (const MachineError&)
  {
    // Another display of the same renderer, for a forked process.
    if (auto context = devices ? deviceContext(true) : nullptr)
    {
      return context;
    }
    throw;
  }
}

} // namespace dgtk
