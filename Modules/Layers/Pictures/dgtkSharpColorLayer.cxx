// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorRows.h"

#include <algorithm>
#include <functional>

namespace dgtk
{

namespace
{
constexpr const char* sharpName = "color_sharp";

LayerSpec sharpSpec(const LayerRequest& request, const std::string& format)
{
  LayerSpec spec = colorSpec(request, format);
  spec.name = sharpName;
  spec.description = "The picture at the frame's own instant and through the centre of the lens; red, green, blue.";
  return spec;
}

bool hasBlur(const SceneDescription& scene)
{
  return std::any_of(scene.cameras.begin(), scene.cameras.end(), std::mem_fn(&CameraDescription::blurs));
}

class SharpColorLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { sharpName, { "png", "exr" },
      "the picture without motion blur and depth of field, of cameras that have them", false, {}, &hasBlur };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override
  {
    LayerNeeds needs = LayerNeeds::ofColor();
    needs.sharp = true;
    return needs;
  }
  std::string requirement() const override
  {
    return "a camera with a shutter or a lens, drawn by the built-in renderer";
  }
  std::vector<LayerRecord> records(const WorkPlan& plan, const std::string& format) const override
  {
    return { { sharpSpec(plan.request, format), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    const CameraDescription& camera = stage.description().cameras[job.camera];
    if (!drawsItself(plan.request) || !camera.blurs())
    {
      return {};
    }
    return colorOutputs(plan, stage, job, planned, &sharpSpec);
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    return makeColorPass(context, layers, &Band::sharp);
  }
};
} // namespace

LayerList sharpColorLayers() { return { std::make_shared<SharpColorLayer>() }; }

} // namespace dgtk
