// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayers.h"

#include <algorithm>

namespace dgtk
{

std::vector<std::string> LayerOutput::files() const
{
  std::vector<std::string> names;
  for (const std::string& format : this->formats)
  {
    names.push_back(this->path + '.' + formatExtension(format));
  }
  return names;
}

std::string formatOption(const std::string& layer) { return layer + "_format"; }

std::vector<LayerOutput> PlannedPass::outputs() const
{
  std::vector<LayerOutput> all;
  for (const PassLayer& layer : this->layers)
  {
    all.insert(all.end(), layer.outputs.begin(), layer.outputs.end());
  }
  return all;
}

namespace
{
bool isCurved(const WorkPlan& plan, const Job& job, const PlannedLayer& planned)
{
  return planned.linear && plan.curved.count(job.camera) > 0;
}
} // namespace

std::vector<LayerOutput> outputsOf(
  const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned)
{
  return isCurved(plan, job, planned) ? std::vector<LayerOutput>() : planned.layer->outputs(plan, stage, job, planned);
}

std::string requirementOf(const WorkPlan& plan, const Job& job, const PlannedLayer& planned)
{
  return isCurved(plan, job, planned) ? "a camera with a linear projection and no rolling shutter"
                                      : planned.layer->requirement();
}

std::vector<PlannedPass> passesOf(const WorkPlan& plan, const Stage& stage, const Job& job)
{
  std::vector<PlannedPass> passes;
  for (const PlannedLayer& planned : plan.layers)
  {
    const Layer& layer = *planned.layer;
    std::vector<LayerOutput> outputs = outputsOf(plan, stage, job, planned);
    if (outputs.empty())
    {
      continue;
    }
    auto pass = std::find_if(passes.begin(), passes.end(),
      [key = layer.passKey()](const PlannedPass& other) { return other.layers.front().layer.passKey() == key; });
    if (pass == passes.end())
    {
      pass = passes.insert(passes.end(), PlannedPass());
    }
    pass->layers.push_back({ layer, planned, std::move(outputs) });
    const LayerNeeds needs = layer.needs(plan.request, stage);
    pass->readsColor = pass->readsColor || needs.color || needs.sharp;
  }
  return passes;
}

std::vector<LayerOutput> outputsOf(const WorkPlan& plan, const Stage& stage, const Job& job)
{
  std::vector<LayerOutput> all;
  for (const PlannedLayer& planned : plan.layers)
  {
    std::vector<LayerOutput> outputs = outputsOf(plan, stage, job, planned);
    all.insert(all.end(), std::make_move_iterator(outputs.begin()), std::make_move_iterator(outputs.end()));
  }
  return all;
}

LayerOutput imageOutput(const WorkPlan& plan, const Stage& stage, const Job& job, const LayerSpec& spec,
  const std::vector<std::string>& formats)
{
  LayerOutput output = documentOutput(stage, job, spec, {});
  output.formats = formats;
  const View view = stage.view(job.camera, job.frame, plan.request.width, plan.request.height);
  output.width = view.model->width();
  output.height = view.model->height();
  return output;
}

LayerOutput documentOutput(const Stage& stage, const Job& job, const LayerSpec& spec, const std::string& format)
{
  LayerOutput output;
  output.layer = spec.name;
  output.name = spec.name;
  output.path = WorkPlan::stem(stage.description().cameras[job.camera].name, spec.name, job.frame);
  output.formats = { format };
  output.spec = spec;
  return output;
}

} // namespace dgtk
