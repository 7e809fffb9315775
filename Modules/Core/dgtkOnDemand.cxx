// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOnDemand.h"

#include "dgtkError.h"

#include <filesystem>
#include <string>

#include <dlfcn.h>

namespace dgtk
{

const void* callsOnDemand(const char* library)
{
  const std::string own = "dgtkCore"; // libdgtkCore.so.<version>, and so are the others called
  Dl_info self;
  if (::dladdr(reinterpret_cast<const void*>(&callsOnDemand), &self) == 0 || self.dli_fname == nullptr)
  {
    throw MachineError("DGTk's own libraries cannot be found");
  }
  std::filesystem::path path = self.dli_fname;
  std::string file = path.filename().string();
  if (const std::size_t at = file.find(own); at != std::string::npos)
  {
    file.replace(at, own.size(), library);
  }
  path.replace_filename(file);
  void* const handle = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const calls = handle != nullptr ? ::dlsym(handle, (std::string(library) + "Calls").c_str()) : nullptr;
  if (calls == nullptr)
  {
    const char* const reason = ::dlerror();
    throw MachineError("the library " + file + " cannot be loaded: " + (reason != nullptr ? reason : "out of memory"));
  }
  return reinterpret_cast<const void* (*)()>(calls)();
}

} // namespace dgtk
