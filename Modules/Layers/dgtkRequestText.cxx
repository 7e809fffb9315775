// SPDX-License-Identifier: BSD-3-Clause
// What of a request stands in manifests.
#include "dgtkWorkPlan.h"

#include "dgtkLayers.h"
#include "dgtkPovRenderOptions.h"

namespace dgtk
{

namespace
{
using Pairs = std::vector<std::pair<std::string, std::string>>;

void add(Pairs& pairs, const std::vector<const OptionRow*>& rows, const OptionValues& values)
{
  for (const OptionRow* row : rows)
  {
    pairs.emplace_back(row->name, row->text(values));
  }
}

void addGiven(Pairs& pairs, const std::vector<const OptionRow*>& rows, const OptionValues& values)
{
  for (const OptionRow* row : rows)
  {
    if (!row->isDefault(values))
    {
      pairs.emplace_back(row->name, row->text(values));
    }
  }
}

/// A layer without an image of its own: its files are the picture, or are documents.
bool hasImages(const WorkPlan& plan, const PlannedLayer& planned)
{
  return !planned.layer->records(plan, planned.formats.front()).empty();
}

/// A layer's part of the request; the picture's formats stand with how it is drawn.
void addLayer(Pairs& pairs, const WorkPlan& plan, const PlannedLayer& planned, const Stage& stage)
{
  const std::string name = planned.layer->info().layer;
  if (!hasImages(plan, planned) || name == pictureLayer)
  {
    return;
  }
  pairs.emplace_back(formatOption(name), joinedNames(planned.formats));
  if (planned.layer->options() != povOptionRows())
  {
    add(pairs, planned.layer->options(), plan.request.options);
  }
  if (planned.layer->needs(plan.request, stage).samples)
  {
    pairs.emplace_back(name + "_samples", option::samples().text(plan.request.options));
  }
}
} // namespace

Pairs describeRequest(const WorkPlan& plan, const Stage& stage)
{
  const LayerRequest& request = plan.request;
  const OptionValues& options = request.options;
  Pairs pairs;
  std::vector<std::string> names;
  for (const PlannedLayer& planned : plan.layers)
  {
    names.push_back(planned.layer->info().layer);
  }
  pairs.emplace_back("layers", joinedNames(names));
  pairs.emplace_back("cameras", request.cameras.empty() ? "all" : joinedNames(request.cameras));
  pairs.emplace_back("frames", request.frames
                                 ? std::to_string(request.frames->first) + ':' + std::to_string(request.frames->last) +
                                     ':' + std::to_string(request.frames->step)
                                 : "all");
  pairs.emplace_back(
    "size", request.width ? std::to_string(request.width) + 'x' + std::to_string(request.height) : "camera's own");
  for (const PlannedLayer& planned : plan.layers)
  {
    if (!hasImages(plan, planned))
    {
      add(pairs, planned.layer->options(), options);
    }
  }
  if (plan.drawsColor())
  {
    add(pairs, { &option::samples() }, options);
    addGiven(pairs, { &option::filter() }, options);
    add(pairs, { &option::colorBits() }, options);
    addGiven(pairs, { &option::exposure(), &option::tone() }, options);
    pairs.emplace_back(formatOption(pictureLayer), joinedNames(plan.formatsOf(pictureLayer)));
  }
  for (const PlannedLayer& planned : plan.layers)
  {
    addLayer(pairs, plan, planned, stage);
  }
  if (plan.drawsColor() || plan.needs.peeled || !plan.needs.mattes.empty())
  {
    add(pairs, { &option::renderer() }, options);
  }
  addGiven(pairs, povOptionRows(), options);
  pairs.emplace_back(option::visibility().name, plan.raster ? "raster" : "ray");
  add(pairs, { &option::seed() }, options);
  pairs.insert(pairs.end(), plan.noise.begin(), plan.noise.end());
  for (const SwitchOption* row : { &option::pack(), &option::models() })
  {
    if (row->of(options))
    {
      pairs.emplace_back(row->name, "yes");
    }
  }
  return pairs;
}

} // namespace dgtk
