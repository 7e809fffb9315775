// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGLWindow.h"

#include <cstdlib>
#include <dlfcn.h>
#include <unistd.h>

namespace dgtk
{
namespace
{

constexpr const char* originalPreload = "DGTK_ORIGINAL_LD_PRELOAD"; // its presence tells that we started ourselves anew
constexpr const char* reasonVariable = "DGTK_GL_REASON";

std::string& reason()
{
  static std::string text;
  return text;
}

/// The started program gives its own children the environment that it was given itself.
bool restoreEnvironment()
{
  const char* original = std::getenv(originalPreload);
  if (!original)
  {
    return false;
  }
  if (*original)
  {
    ::setenv("LD_PRELOAD", original, 1);
  }
  else
  {
    ::unsetenv("LD_PRELOAD");
  }
  const char* passed = std::getenv(reasonVariable);
  reason() = passed ? passed : "";
  ::unsetenv(originalPreload);
  ::unsetenv(reasonVariable);
  return true;
}

void startAnew(char** argv, const std::string& why)
{
  const std::string library = preloadLibrary();
  if (library.empty() || !::dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL))
  {
    return;
  }
  const char* present = std::getenv("LD_PRELOAD");
  const std::string before = present ? present : "";
  ::setenv(originalPreload, before.c_str(), 1);
  ::setenv(reasonVariable, why.c_str(), 1);
  ::setenv("LD_PRELOAD", (library + ":libOSMesa.so.8" + (before.empty() ? "" : ":" + before)).c_str(), 1);
  ::execv("/proc/self/exe", argv);
  restoreEnvironment(); // execv failed: go on without
}

} // namespace

std::string preloadLibrary()
{
  Dl_info info;
  if (!::dladdr(reinterpret_cast<const void*>(&nameOf), &info) || !info.dli_fname)
  {
    return {};
  }
  std::string path = info.dli_fname;
  const std::size_t slash = path.rfind('/');
  path = (slash == std::string::npos ? std::string() : path.substr(0, slash + 1)) + "libdgtkosmesa.so";
  char* whole = ::realpath(path.c_str(), nullptr);
  std::string result = whole ? whole : "";
  std::free(whole);
  return result;
}

bool osmesaPreloaded() { return ::dlsym(RTLD_DEFAULT, "dgtkOsmesaPreloaded") != nullptr; }

std::string inheritedReason() { return reason(); }

void prepareProcess(GLBackend backend, char** argv, int threads)
{
  if (threads > 0)
  {
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
  }
  if (restoreEnvironment() || osmesaPreloaded())
  {
    return;
  }
  if (backend == GLBackend::Osmesa)
  {
    startAnew(argv, "");
  }
  if (backend == GLBackend::Auto)
  {
    try
    {
      chooseGL(GLBackend::Egl);
    }
    catch (const Error& error)
    {
      std::string why = error.what();
      const std::string prefix = "no OpenGL: ";
      startAnew(argv, why.compare(0, prefix.size(), prefix) == 0 ? why.substr(prefix.size()) : why);
    }
  }
}

} // namespace dgtk
