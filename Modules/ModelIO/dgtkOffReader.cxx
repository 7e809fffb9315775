// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpModel.h"

namespace dgtk
{

std::shared_ptr<Model> readOff(const std::string& path, const ReadOptions& options);
std::shared_ptr<Model> readOff(const std::string& path, const ReadOptions& options)
{
  return readThroughAssimp(path, "off", options);
}

} // namespace dgtk
