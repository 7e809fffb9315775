// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkPlan.h"

#include "dgtkError.h"
#include "dgtkLayerWriter.h"
#include "dgtkLayers.h"
#include "dgtkPictureCurve.h"
#include "dgtkPovRenderOptions.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace dgtk
{

namespace
{
bool contains(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The requested names in the order of the registry, without repetition.
std::vector<std::string> resolveLayers(const std::vector<std::string>& asked)
{
  std::vector<std::string> known;
  std::vector<std::string> usual;
  for (const LayerInfo& info : generatorLayers())
  {
    known.push_back(info.layer);
    if (info.usual)
    {
      usual.push_back(info.layer);
    }
  }
  if (asked.size() == 1 && asked[0] == "all")
  {
    return known;
  }
  const std::vector<std::string>& wanted = asked.empty() ? usual : asked;
  for (const std::string& layer : wanted)
  {
    if (!contains(known, layer))
    {
      throw UsageError("unknown layer " + quoted(layer) + " (expected some of " + joinedNames(known) + ", or all)");
    }
  }
  std::vector<std::string> layers;
  std::copy_if(known.begin(), known.end(), std::back_inserter(layers),
    [&](const std::string& layer) { return contains(wanted, layer); });
  return layers;
}

std::vector<std::string> resolveFormats(const LayerInfo& layer, const LayerRequest& request)
{
  if (layer.formats.size() == 1)
  {
    return layer.formats;
  }
  const OptionRow& row = requestOption(formatOption(layer.layer));
  const std::vector<std::string> asked = splitNames(row.text(request.options), row.name);
  std::vector<std::string> formats;
  std::copy_if(layer.formats.begin(), layer.formats.end(), std::back_inserter(formats),
    [&](const std::string& format) { return contains(asked, format); });
  return formats.empty() ? std::vector<std::string>{ layer.formats.front() } : formats;
}

std::vector<std::size_t> resolveCameras(const std::vector<std::string>& asked, const SceneDescription& scene)
{
  if (scene.cameras.empty())
  {
    throw InputError(scene.file, "the scene has no camera");
  }
  std::vector<std::string> names;
  for (const CameraDescription& camera : scene.cameras)
  {
    names.push_back(camera.name);
  }
  for (const std::string& name : asked)
  {
    if (!contains(names, name))
    {
      throw UsageError("the scene has no camera " + quoted(name) + " (it has " + joinedNames(names) + ')');
    }
  }
  std::vector<std::size_t> cameras;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (asked.empty() || contains(asked, names[i]))
    {
      cameras.push_back(i);
    }
  }
  return cameras;
}

std::vector<int> resolveFrames(const std::optional<FrameRange>& asked, const SceneDescription& scene)
{
  const FrameRange range = asked.value_or(FrameRange{ scene.firstFrame(), scene.lastFrame(), 1 });
  if (range.first < scene.firstFrame() || range.last > scene.lastFrame())
  {
    throw UsageError("the scene has frames " + std::to_string(scene.firstFrame()) + " to " +
                     std::to_string(scene.lastFrame()) + ", found " +
                     std::to_string(range.first < scene.firstFrame() ? range.first : range.last));
  }
  if (range.last < range.first || range.step < 1)
  {
    throw UsageError("frames: expected first <= last and a step of at least 1, found " + std::to_string(range.first) +
                     " to " + std::to_string(range.last) + " by " + std::to_string(range.step));
  }
  std::vector<int> frames;
  for (long frame = range.first; frame <= range.last; frame += range.step)
  {
    frames.push_back(static_cast<int>(frame));
  }
  return frames;
}

/// Whether its options are POV-Ray's, which are not of layers only.
bool isForPov(const Layer& layer) { return layer.options() == povOptionRows(); }
} // namespace

std::vector<LayerInfo> generatorLayers()
{
  std::vector<LayerInfo> infos;
  for (const auto& layer : layers())
  {
    infos.push_back(layer->info());
    LayerInfo& info = infos.back();
    info.options = isForPov(*layer) ? std::vector<const OptionRow*>() : layer->options();
    if (info.formats.size() > 1)
    {
      info.options.push_back(&requestOption(formatOption(info.layer)));
    }
    for (const std::string& format : info.formats)
    {
      const std::vector<LayerRecord> records = layer->records({}, format);
      info.records.insert(info.records.end(), records.begin(), records.end());
    }
  }
  return infos;
}

std::string formatExtension(const std::string& format)
{
  for (const WriterInfo& info : layerWriters())
  {
    if (info.format == format)
    {
      return info.extension;
    }
  }
  return format;
}

LayerNeeds LayerNeeds::ofHits()
{
  LayerNeeds needs;
  needs.hits = true;
  return needs;
}

LayerNeeds LayerNeeds::ofColor()
{
  LayerNeeds needs;
  needs.color = true;
  return needs;
}

LayerNeeds LayerNeeds::ofLinear()
{
  LayerNeeds needs;
  needs.linear = true;
  return needs;
}

void LayerNeeds::add(const LayerNeeds& more)
{
  this->hits = this->hits || more.hits;
  this->color = this->color || more.color;
  this->sharp = this->sharp || more.sharp;
  this->peeled = this->peeled || more.peeled;
  this->samples = this->samples || more.samples;
  this->whole = this->whole || more.whole;
  this->linear = this->linear || more.linear;
  this->mattes.insert(this->mattes.end(), more.mattes.begin(), more.mattes.end());
}

std::string WorkPlan::stem(const std::string& camera, const std::string& layer, int frame)
{
  char number[16];
  std::snprintf(number, sizeof number, "%06d", frame);
  return camera + '/' + layer + '/' + number;
}

std::vector<std::string> WorkPlan::formatsOf(const std::string& layer) const
{
  for (const PlannedLayer& planned : this->layers)
  {
    if (planned.layer->info().layer == layer)
    {
      return planned.formats;
    }
  }
  return {};
}

bool drawsItself(const LayerRequest& request) { return option::renderer().of(request.options) != "povray"; }

bool mayUseOpenGL(const LayerRequest& request)
{
  return option::renderer().of(request.options) == "vtk" || option::visibility().of(request.options) == "raster";
}

namespace
{
/// The request with its options as they stand in manifests. Throws UsageError for one that is none.
LayerRequest normalised(LayerRequest request)
{
  for (auto& [name, text] : request.options)
  {
    text = requestOption(name).normal(text);
  }
  return request;
}

/// What the renderer cannot do.
void checkPictures(const WorkPlan& plan, const SceneDescription& scene)
{
  const LayerRequest& request = plan.request;
  const bool single = option::samples().of(request.options) == 1;
  if (!option::filter().isDefault(request.options) && (single || !drawsItself(request)))
  {
    throw UsageError("the filter " + option::filter().of(request.options) +
                     " needs several samples a pixel (2 or more) and the built-in renderer");
  }
  if (PictureCurve(request).changes() && !plan.drawsColor())
  {
    throw UsageError("exposure, tone: are for pictures, and this run makes none");
  }
  for (const Job& job : plan.jobs)
  {
    const CameraDescription& camera = scene.cameras[job.camera];
    if (plan.drawsColor() && !drawsItself(request) && camera.blurs())
    {
      throw UsageError("camera " + quoted(camera.name) + " has a " + (camera.lens.blurs() ? "lens" : "shutter") +
                       ": only the built-in renderer averages exposures (POV-Ray has a focal blur of its own)");
    }
  }
}

/// Drawing, and files that hold matrices of OpenGL, are for linear projections. A layer that needs those and was not
/// asked for by its name is left out of the plan where a camera has another.
void checkCameras(WorkPlan& plan, const Stage& stage)
{
  std::set<std::size_t> seen;
  std::set<std::string> leftOut;
  for (const Job& job : plan.jobs)
  {
    const LayerRequest& request = plan.request;
    const std::string& own = stage.description().cameras[job.camera].name;
    if (!seen.insert(job.camera).second || (!request.picture.empty() && own != request.picture))
    {
      continue;
    }
    const View view = stage.view(job.camera, job.frame, request.width, request.height);
    const bool linear = view.model->linear() && !view.instants;
    const std::string who = "camera " + quoted(view.name) + " (" + view.model->name() + ") has " +
                            (view.instants ? "a rolling shutter" : "no linear projection");
    for (const PlannedLayer& planned : linear ? std::vector<PlannedLayer>() : plan.layers)
    {
      const LayerNeeds needs = planned.layer->needs(request, stage);
      const bool picture = needs.color || needs.sharp;
      const bool drawn = (needs.hits && plan.raster) || (picture && !drawsItself(request)) ||
                         (plan.drawn && (picture || needs.peeled || !needs.mattes.empty()));
      const std::string name = planned.layer->info().layer;
      if (drawn || (needs.linear && contains(request.layers, name)))
      {
        throw UsageError("layer " + name + ": " + who + (drawn ? ", and cannot be drawn" : ""));
      }
      if (needs.linear && leftOut.insert(name).second)
      {
        plan.empty.push_back({ name, plan.jobs.size(), plan.jobs.size(), "cameras with linear projections alone" });
      }
      for (const std::string& format : planned.formats)
      {
        if (holdsMatrices(format))
        {
          throw UsageError("layer " + name + " as " + format + ": " + who);
        }
      }
    }
  }
  const auto gone = [&](const PlannedLayer& planned) { return leftOut.count(planned.layer->info().layer) > 0; };
  plan.layers.erase(std::remove_if(plan.layers.begin(), plan.layers.end(), gone), plan.layers.end());
}

/// Options of POV-Ray mean nothing where it does not draw and no layer is for it.
void checkPovOptions(const WorkPlan& plan)
{
  const std::vector<const OptionRow*>& rows = povOptionRows();
  povOptionsOf(plan.request.options);
  const auto given =
    std::find_if(rows.begin(), rows.end(), [&](const OptionRow* row) { return !row->isDefault(plan.request.options); });
  const bool used = std::any_of(
    plan.layers.begin(), plan.layers.end(), [](const PlannedLayer& planned) { return isForPov(*planned.layer); });
  if (given != rows.end() && drawsItself(plan.request) && !used)
  {
    throw UsageError((*given)->name + ": is for pictures and scenes of POV-Ray, and this run makes none");
  }
}

/// The layers of which some pictures of the run have no file, in the order of the plan. Throws UsageError for a layer
/// that was asked for by its name and has no file at all.
void findEmptyLayers(WorkPlan& plan, const Stage& stage)
{
  for (const PlannedLayer& planned : plan.layers)
  {
    const std::string needs = planned.layer->requirement();
    if (needs.empty())
    {
      continue;
    }
    const auto without = std::count_if(plan.jobs.begin(), plan.jobs.end(),
      [&](const Job& job) { return planned.layer->outputs(plan, stage, job, planned).empty(); });
    if (without == 0)
    {
      continue;
    }
    const std::string name = planned.layer->info().layer;
    if (std::size_t(without) == plan.jobs.size() && contains(plan.request.layers, name))
    {
      throw UsageError("layer " + name + " would have no file in this run: it needs " + needs);
    }
    plan.empty.push_back({ name, std::size_t(without), plan.jobs.size(), needs });
  }
}
} // namespace

WorkPlan makeWorkPlan(const LayerRequest& request, const Stage& stage)
{
  const SceneDescription& scene = stage.description();
  WorkPlan plan;
  plan.request = normalised(request);
  const std::vector<std::string> wanted = resolveLayers(request.layers);
  for (const auto& layer : layers())
  {
    const LayerInfo info = layer->info();
    if (contains(wanted, info.layer))
    {
      plan.layers.push_back({ layer, resolveFormats(info, plan.request), nullptr });
      plan.needs.add(layer->needs(plan.request, stage));
    }
  }
  plan.raster = option::visibility().of(plan.request.options) == "raster";
  plan.drawn = option::renderer().of(plan.request.options) == "vtk";
  for (const int frame : resolveFrames(request.frames, scene))
  {
    for (const std::size_t camera : resolveCameras(request.cameras, scene))
    {
      plan.jobs.push_back({ camera, frame });
    }
  }
  checkPictures(plan, scene);
  checkPovOptions(plan);
  checkCameras(plan, stage);
  for (const PlannedLayer& planned : plan.layers)
  {
    planned.layer->check(plan, stage, planned);
    for (const auto& pair : planned.layer->noise(plan, stage))
    {
      if (std::find(plan.noise.begin(), plan.noise.end(), pair) == plan.noise.end())
      {
        plan.noise.push_back(pair);
      }
    }
  }
  findEmptyLayers(plan, stage);
  return plan;
}

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
  if (!isForPov(*planned.layer))
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
