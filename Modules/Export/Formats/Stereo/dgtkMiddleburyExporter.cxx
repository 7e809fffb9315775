// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStereoScenes.h"

namespace dgtk
{

namespace
{
class MiddleburyExporter : public Exporter
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
  const StereoLayout Layout{ "middlebury", "%", "%", { "disp0.pfm", "disp0GT.pfm" }, "disp1.pfm" };
};
} // namespace

std::unique_ptr<Exporter> makeMiddleburyExporter() { return std::make_unique<MiddleburyExporter>(); }

} // namespace dgtk
