// SPDX-License-Identifier: BSD-3-Clause
// The picture itself.
#include "dgtkColorRows.h"

namespace dgtk
{

const char* const pictureLayer = "color";

namespace
{
class ColorLayer final : public Layer
{
public:
  LayerInfo info() const override { return { pictureLayer, { "png", "exr" }, "the picture", true }; }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofColor(); }
  std::vector<LayerRecord> records(const WorkPlan& plan, const std::string& format) const override
  {
    return { { colorSpec(plan.request, format), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return colorOutputs(plan, stage, job, planned, &colorSpec);
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    return makeColorPass(context, layers, &Band::rgb);
  }
};
} // namespace

LayerList colorLayers() { return { std::make_shared<ColorLayer>() }; }

} // namespace dgtk
