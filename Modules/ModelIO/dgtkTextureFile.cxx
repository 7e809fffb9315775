// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTextureFile.h"

namespace dgtk
{

} // namespace dgtk
