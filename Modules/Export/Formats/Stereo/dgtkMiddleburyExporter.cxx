// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStereoScenes.h"

namespace dgtk
{

std::unique_ptr<Exporter> makeMiddleburyExporter()
{
  return makeStereoExporter({ "middlebury", "%", "%", { "disp0.pfm", "disp0GT.pfm" }, "disp1.pfm" });
}

} // namespace dgtk
