// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelReader.h"

#include <filesystem>

namespace dgtk
{

std::shared_ptr<Model> readBlend(const std::string& path, const ReadOptions&);
std::shared_ptr<Model> readBlend(const std::string& path, const ReadOptions&)
{
  std::error_code code;
  if (!std::filesystem::exists(path, code))
  {
    throw InputError(path, 0, "no such file");
  }
  throw InputError(path, 0,
    "Blender's own files are not read: open it in Blender, choose File > Export > glTF 2.0 and use the .glb file");
}

} // namespace dgtk
