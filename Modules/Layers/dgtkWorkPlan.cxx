// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkPlan.h"

#include "dgtkError.h"
#include "dgtkLayerWriter.h"
#include "dgtkLayers.h"
#include "dgtkPictureCurve.h"
#include "dgtkPovRenderOptions.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>

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

/// The views of the cameras that are drawn, by camera.
std::map<std::size_t, View> drawnViews(const WorkPlan& plan, const Stage& stage)
{
  const LayerRequest& request = plan.request;
  std::map<std::size_t, View> views;
  for (const Job& job : plan.jobs)
  {
    const std::string& own = stage.description().cameras[job.camera].name;
    if (views.count(job.camera) == 0 && (request.picture.empty() || own == request.picture))
    {
      views.emplace(job.camera, stage.view(job.camera, job.frame, request.width, request.height));
    }
  }
  return views;
}

/// Drawing, and files that hold matrices of OpenGL, are for linear projections. A layer that needs those is of the
/// cameras that have one.
void checkCameras(WorkPlan& plan, const Stage& stage)
{
  const LayerRequest& request = plan.request;
  const std::map<std::size_t, View> views = drawnViews(plan, stage);
  for (const auto& [camera, view] : views)
  {
    if (!view.model->linear() || view.instants)
    {
      plan.curved.insert(camera);
    }
  }
  const bool none = plan.curved.size() == views.size();
  for (const std::size_t camera : plan.curved)
  {
    const View& view = views.at(camera);
    const std::string who = "camera " + quoted(view.name) + " (" + view.model->name() + ") has " +
                            (view.instants ? "a rolling shutter" : "no linear projection");
    for (const PlannedLayer& planned : plan.layers)
    {
      const LayerNeeds needs = planned.layer->needs(request, stage);
      const bool picture = needs.color || needs.sharp;
      const bool drawn = (needs.hits && plan.raster) || (picture && !drawsItself(request)) ||
                         (plan.drawn && (picture || needs.peeled || !needs.mattes.empty()));
      const std::string name = planned.layer->info().layer;
      if (drawn || (none && planned.linear && contains(request.layers, name)))
      {
        throw UsageError("layer " + name + ": " + who + (drawn ? ", and cannot be drawn" : ""));
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

/// The layers of which some pictures of the run have no file, in the order of the plan; one that needs a linear
/// projection and has no file at all is none of the plan's. Throws UsageError for a layer that was asked for by its
/// name and has no file at all.
void findEmptyLayers(WorkPlan& plan, const Stage& stage)
{
  const auto isWithout = [&](const PlannedLayer& planned)
  {
    std::string needs;
    std::size_t without = 0;
    const bool all = planned.layer->requirement().empty() && !(planned.linear && !plan.curved.empty());
    for (const Job& job : all ? std::vector<Job>() : plan.jobs)
    {
      const std::string own = requirementOf(plan, job, planned);
      if (!own.empty() && outputsOf(plan, stage, job, planned).empty())
      {
        needs = needs.empty() ? own : needs;
        ++without;
      }
    }
    const std::string name = planned.layer->info().layer;
    if (without == plan.jobs.size() && contains(plan.request.layers, name))
    {
      throw UsageError("layer " + name + " would have no file in this run: it needs " + needs);
    }
    if (without > 0)
    {
      plan.empty.push_back({ name, without, plan.jobs.size(), needs });
    }
    return planned.linear && without == plan.jobs.size();
  };
  std::vector<PlannedLayer> kept;
  std::copy_if(plan.layers.begin(), plan.layers.end(), std::back_inserter(kept),
    [&](const PlannedLayer& planned) { return !isWithout(planned); });
  plan.layers = std::move(kept);
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
      const LayerNeeds needs = layer->needs(plan.request, stage);
      plan.layers.push_back({ layer, resolveFormats(info, plan.request), needs.linear, nullptr });
      plan.needs.add(needs);
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

} // namespace dgtk
