// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStereoScenes.h"

namespace dgtk
{

namespace
{
class Eth3dExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override { return stereoNeeds(options); }
  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    checkStereo(dataset, options, this->Layout);
  }
  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    return planStereo(dataset, options, this->Layout);
  }

private:
  const StereoLayout Layout{ "eth3d", "two_view_training/%", "two_view_training_gt/%", { "disp0GT.pfm" }, "" };
};
} // namespace

std::unique_ptr<Exporter> makeEth3dExporter() { return std::make_unique<Eth3dExporter>(); }

} // namespace dgtk
