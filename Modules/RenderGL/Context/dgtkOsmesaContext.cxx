// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <GL/osmesa.h>

#include <array>
#include <dlfcn.h>

namespace dgtk
{
namespace
{

struct Osmesa
{
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetCurrentContext) current = nullptr;
  decltype(&OSMesaGetProcAddress) getProcAddress = nullptr;
};

const Osmesa& osmesa()
{
  static const Osmesa functions = []
  {
    void* library = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!library)
    {
      throw MachineError("libOSMesa.so.8 cannot be loaded");
    }
    Osmesa o;
    const auto find = [library](const char* name, auto& function)
    {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(library, name));
      if (!function)
      {
        throw MachineError(std::string(name) + " is missing in libOSMesa.so.8");
      }
    };
    find("OSMesaCreateContextAttribs", o.create);
    find("OSMesaDestroyContext", o.destroy);
    find("OSMesaMakeCurrent", o.makeCurrent);
    find("OSMesaGetCurrentContext", o.current);
    find("OSMesaGetProcAddress", o.getProcAddress);
    return o;
  }();
  return functions;
}

class OsmesaOwner : public NativeContext
{
public:
  explicit OsmesaOwner(OSMesaContext context)
    : Context(context)
  {
  }
  ~OsmesaOwner() override { osmesa().destroy(this->Context); }
  void makeCurrent() override
  {
    if (!osmesa().makeCurrent(this->Context, this->Pixel.data(), GL_UNSIGNED_BYTE, 4, 4))
    {
      throw MachineError("OSMesaMakeCurrent failed");
    }
  }
  void release() override { osmesa().makeCurrent(nullptr, nullptr, 0, 0, 0); }
  bool isCurrent() const override { return osmesa().current() == this->Context; }
  void* lookUp(const char* function) const override
  {
    return reinterpret_cast<void*>(osmesa().getProcAddress(function));
  }

private:
  OSMesaContext Context;
  std::array<unsigned char, 64> Pixel{}; // the default framebuffer, which nothing is drawn to
};

} // namespace

std::unique_ptr<NativeContext> makeOsmesaContext(bool preloadNeeded)
{
  osmesa();
  if (preloadNeeded && !osmesaPreloaded())
  {
    const std::string library = preloadLibrary();
    throw MachineError(library.empty()
                         ? std::string("the library libdgtkosmesa.so is missing")
                         : "must be loaded before the program starts: set LD_PRELOAD=" + library + ":libOSMesa.so.8");
  }
  for (const int version : { 45, 43, 41, 33, 32 })
  {
    const int attributes[] = { OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
      OSMESA_CONTEXT_MAJOR_VERSION, version / 10, OSMESA_CONTEXT_MINOR_VERSION, version % 10, 0 };
    if (OSMesaContext context = osmesa().create(attributes, nullptr))
    {
      auto made = std::make_unique<OsmesaOwner>(context);
      made->makeCurrent();
      return made;
    }
  }
  throw MachineError("no OpenGL 3.2 core context");
}

} // namespace dgtk
