// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStereoScenes.h"

namespace dgtk
{

std::unique_ptr<Exporter> makeEth3dExporter()
{
  return makeStereoExporter({ "eth3d", "two_view_training/%", "two_view_training_gt/%", { "disp0GT.pfm" }, "" });
}

} // namespace dgtk
