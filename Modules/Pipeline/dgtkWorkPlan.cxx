// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkPlan.h"

#include "dgtkError.h"
#include "dgtkLayerWriter.h"
#include "dgtkLayers.h"
#include "dgtkRasterSource.h"
#include "dgtkRunNotes.h"

#include <algorithm>
#include <cstdio>

namespace dgtk
{

namespace
{
std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ",") + word;
  }
  return text;
}

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
      throw UsageError("unknown layer " + quoted(layer) + " (expected some of " + joined(known) + ", or all)");
    }
  }
  std::vector<std::string> layers;
  std::copy_if(known.begin(), known.end(), std::back_inserter(layers),
    [&](const std::string& layer) { return contains(wanted, layer); });
  return layers;
}

std::vector<std::string> resolveFormats(const LayerInfo& layer, const GeneratorRequest& request)
{
  const auto asked = request.formats.find(layer.layer);
  if (asked == request.formats.end() || asked->second.empty())
  {
    return { layer.formats.front() };
  }
  for (const std::string& format : asked->second)
  {
    if (!contains(layer.formats, format))
    {
      throw UsageError("layer " + layer.layer + " cannot be written as " + quoted(format) + " (expected some of " +
                       joined(layer.formats) + ')');
    }
  }
  std::vector<std::string> formats;
  std::copy_if(layer.formats.begin(), layer.formats.end(), std::back_inserter(formats),
    [&](const std::string& format) { return contains(asked->second, format); });
  return formats;
}

std::vector<std::size_t> resolveCameras(const std::vector<std::string>& asked, const SceneDescription& scene)
{
  if (scene.cameras.empty())
  {
    throw InputError(scene.file, 0, "the scene has no camera");
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
      throw UsageError("the scene has no camera " + quoted(name) + " (it has " + joined(names) + ')');
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
} // namespace

std::vector<LayerInfo> generatorLayers()
{
  std::vector<LayerInfo> infos;
  for (const auto& layer : layers())
  {
    infos.push_back(layer->info());
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

void LayerNeeds::add(const LayerNeeds& more)
{
  this->hits = this->hits || more.hits;
  this->color = this->color || more.color;
  this->sharp = this->sharp || more.sharp;
  this->peeled = this->peeled || more.peeled;
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

namespace
{
constexpr int mostSamples = 16;

void checkEngines(const GeneratorRequest& request)
{
  if (!contains({ "auto", "raster", "ray" }, request.visibility))
  {
    throw UsageError("unknown visibility engine " + quoted(request.visibility) + " (expected auto, raster or ray)");
  }
  glBackendFromName(request.gl);
  if (request.samples < 1 || request.samples > mostSamples)
  {
    throw UsageError("samples must be between 1 and " + std::to_string(mostSamples) + " (found " +
                     std::to_string(request.samples) + ')');
  }
}

/// What the renderer cannot do.
void checkPictures(const WorkPlan& plan, const SceneDescription& scene)
{
  const GeneratorRequest& request = plan.request;
  pixelFilterFromName(request.filter);
  if (request.filter != "box" && (request.samples == 1 || request.renderer != "vtk"))
  {
    throw UsageError(
      "the filter " + request.filter + " needs several samples a pixel (2 or more) and " + "the built-in renderer");
  }
  for (const Job& job : plan.jobs)
  {
    const CameraDescription& camera = scene.cameras[job.camera];
    if (plan.drawsColor() && request.renderer != "vtk" && (camera.shutter.blurs() || camera.lens.blurs()))
    {
      throw UsageError("camera " + quoted(camera.name) + " has a " + (camera.lens.blurs() ? "lens" : "shutter") +
                       ": only the built-in renderer averages exposures (POV-Ray has a focal blur of its own)");
    }
  }
}
} // namespace

WorkPlan makeWorkPlan(const GeneratorRequest& request, const Stage& stage)
{
  const SceneDescription& scene = stage.description();
  checkEngines(request);
  WorkPlan plan;
  plan.request = request;
  const std::vector<std::string> wanted = resolveLayers(request.layers);
  for (const auto& layer : layers())
  {
    const LayerInfo info = layer->info();
    if (contains(wanted, info.layer))
    {
      plan.layers.push_back({ layer, resolveFormats(info, request), nullptr });
      plan.needs.add(layer->needs(request, stage));
    }
  }
  plan.raster = request.visibility == "raster";
  for (const int frame : resolveFrames(request.frames, scene))
  {
    for (const std::size_t camera : resolveCameras(request.cameras, scene))
    {
      plan.jobs.push_back({ camera, frame });
    }
  }
  checkPictures(plan, scene);
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
  plan.empty = emptyLayers(plan, stage);
  return plan;
}

std::vector<std::pair<std::string, std::string>> describeRequest(const WorkPlan& plan)
{
  const GeneratorRequest& request = plan.request;
  std::vector<std::pair<std::string, std::string>> pairs;
  std::vector<std::string> names;
  for (const PlannedLayer& planned : plan.layers)
  {
    names.push_back(planned.layer->info().layer);
  }
  pairs.emplace_back("layers", joined(names));
  pairs.emplace_back("cameras", request.cameras.empty() ? "all" : joined(request.cameras));
  pairs.emplace_back("frames", request.frames
                                 ? std::to_string(request.frames->first) + ':' + std::to_string(request.frames->last) +
                                     ':' + std::to_string(request.frames->step)
                                 : "all");
  pairs.emplace_back(
    "size", request.width ? std::to_string(request.width) + 'x' + std::to_string(request.height) : "camera's own");
  const auto add = [&pairs](const std::vector<std::pair<std::string, std::string>>& more)
  { pairs.insert(pairs.end(), more.begin(), more.end()); };
  for (const PlannedLayer& planned : plan.layers)
  {
    add(planned.layer->pictureOptions(request));
  }
  if (plan.drawsColor())
  {
    pairs.emplace_back("samples", std::to_string(request.samples));
    if (request.filter != "box")
    {
      pairs.emplace_back("filter", request.filter);
    }
    pairs.emplace_back("color_bits", std::to_string(request.colorBits));
    pairs.emplace_back("color_format", joined(plan.formatsOf(pictureLayer)));
  }
  for (const PlannedLayer& planned : plan.layers)
  {
    add(planned.layer->options(request, planned));
  }
  if (request.renderer != "vtk")
  {
    pairs.emplace_back("renderer", request.renderer);
  }
  add(request.pov.describe());
  pairs.emplace_back("visibility", plan.raster ? "raster" : "ray");
  pairs.emplace_back("seed", std::to_string(request.seed));
  add(plan.noise);
  if (request.pack)
  {
    pairs.emplace_back("pack", "yes");
  }
  return pairs;
}

} // namespace dgtk
