// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelBuilder.h"

namespace dgtk
{

std::shared_ptr<Model> read3ds(const std::string& path, const ReadOptions&);
std::shared_ptr<Model> read3ds(const std::string& path, const ReadOptions&)
{
  throw InputError(path, 0, "cannot be read");
}

} // namespace dgtk
