// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkPlan.h"

#include "dgtkError.h"
#include "dgtkFrameLayers.h"
#include "dgtkLayerWriter.h"
#include "dgtkNoisySensor.h"
#include "dgtkRasterSource.h"
#include "dgtkRunNotes.h"

#include <algorithm>
#include <cstdio>

namespace dgtk
{

namespace
{
const std::vector<std::string> defaultLayers = { "color", "depth", "objects", "calibration" };

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
  for (const LayerInfo& info : generatorLayers())
  {
    known.push_back(info.layer);
  }
  if (asked.size() == 1 && asked[0] == "all")
  {
    return known;
  }
  const std::vector<std::string>& wanted = asked.empty() ? defaultLayers : asked;
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
  std::vector<LayerInfo> layers{ { "color", { "png", "exr" }, "the picture, by VTK or POV-Ray", true } };
  for (const RepresentationInfo& info : representations())
  {
    layers.push_back({ info.layer, makeRepresentation(info.layer)->formats(), info.description, true });
  }
  for (const auto& layer : frameLayers())
  {
    layers.push_back(layer->info());
  }
  layers.push_back({ "calibration", { "txt" }, "projection and pose of the camera, as the thesis writes them" });
  layers.push_back({ "tiles", { "png" }, "the picture cut into tiles" });
  return layers;
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
  throw UsageError("unknown file format " + quoted(format));
}

LayerSpec WorkPlan::colorSpec(const std::string& format) const
{
  LayerSpec spec;
  spec.name = "color";
  spec.channels = 3;
  spec.frame = "image";
  spec.invalid = "none";
  if (format == "exr")
  {
    spec.type = PixelType::Float32;
    spec.unit = "linear sRGB";
    spec.description = "The picture in linear light, primaries of sRGB; red, green, blue.";
  }
  else
  {
    spec.type = this->request.colorBits == 16 ? PixelType::UInt16 : PixelType::UInt8;
    spec.unit = "sRGB";
    spec.description = "The picture as it is displayed, sRGB-encoded; red, green, blue.";
  }
  return spec;
}

std::string WorkPlan::fileName(
  const std::string& camera, const std::string& layer, int frame, const std::string& extension)
{
  char number[16];
  std::snprintf(number, sizeof number, "%06d", frame);
  return camera + '/' + layer + '/' + number + '.' + extension;
}

std::vector<std::string> WorkPlan::tileNames(const std::string& camera, int frame, const CameraModel& model) const
{
  const int columns = (model.width() + this->request.tileWidth - 1) / this->request.tileWidth;
  const int rows = (model.height() + this->request.tileHeight - 1) / this->request.tileHeight;
  std::vector<std::string> names;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      char name[48];
      std::snprintf(name, sizeof name, "/tiles/%06d_%d_%d.png", frame, row, column);
      names.push_back(camera + name);
    }
  }
  return names;
}

bool WorkPlan::has(const std::string& layer) const { return contains(this->layers, layer); }

namespace
{
std::shared_ptr<const FrameLayer> frameLayerOf(const std::string& name)
{
  const auto& all = frameLayers();
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const auto& layer) { return layer->info().layer == name; });
  return found == all.end() ? nullptr : *found;
}
} // namespace

std::vector<std::string> WorkPlan::formatsOf(const std::string& frameLayer) const
{
  for (const PlannedFrameLayer& planned : this->frameLayers)
  {
    if (planned.layer->info().layer == frameLayer)
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
    throw UsageError("the filter " + request.filter + " needs several samples a pixel (--samples 2 or more) and " +
                     "the built-in renderer");
  }
  for (const Job& job : plan.jobs)
  {
    const CameraDescription& camera = scene.cameras[job.camera];
    if (plan.drawsColor() && request.renderer != "vtk" && (camera.shutter.blurs() || camera.lens.blurs()))
    {
      throw UsageError("camera " + quoted(camera.name) + " has a " + (camera.lens.blurs() ? "lens" : "shutter") +
                       ": only the built-in renderer averages exposures (POV-Ray has --pov-focal-blur)");
    }
  }
}
} // namespace

namespace
{
/// Ids that do not fit a format are refused before anything is written.
void checkIds(const WorkPlan& plan, const Stage& stage)
{
  const std::shared_ptr<const SceneState> state = stage.at(plan.jobs.front().frame);
  for (const PlannedLayer& layer : plan.representations)
  {
    const std::uint32_t largest = layer.representation->largest(*state);
    for (const std::string& format : layer.formats)
    {
      const std::uint32_t fits = largestStored(format, layer.spec);
      if (largest > fits)
      {
        throw UsageError("layer " + layer.spec.name + ": ids up to " + std::to_string(largest) + " do not fit ." +
                         formatExtension(format) + " (largest " + std::to_string(fits) + "); .npy holds them");
      }
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
  plan.layers = resolveLayers(request.layers);
  for (const LayerInfo& info : generatorLayers())
  {
    if (!contains(plan.layers, info.layer))
    {
      continue;
    }
    if (info.layer == "color")
    {
      plan.colorFormats = resolveFormats(info, request);
    }
    else if (info.layer == "tiles" || info.layer == "calibration")
    {
      (info.layer == "tiles" ? plan.tiles : plan.calibration) = true;
    }
    else if (const auto frameLayer = frameLayerOf(info.layer))
    {
      plan.frameLayers.push_back({ frameLayer, resolveFormats(info, request) });
    }
    else
    {
      std::shared_ptr<const Representation> representation = makeRepresentation(info.layer);
      plan.representations.push_back({ representation, representation->spec(), resolveFormats(info, request) });
    }
  }
  plan.layersReadColor = std::any_of(plan.frameLayers.begin(), plan.frameLayers.end(),
    [](const PlannedFrameLayer& planned) { return planned.layer->needsColor(); });
  plan.raster = request.visibility == "raster";
  for (const int frame : resolveFrames(request.frames, scene))
  {
    for (const std::size_t camera : resolveCameras(request.cameras, scene))
    {
      plan.jobs.push_back({ camera, frame });
    }
  }
  checkPictures(plan, scene);
  checkIds(plan, stage);
  plan.noise = describeNoise(plan, stage);
  for (const PlannedFrameLayer& planned : plan.frameLayers)
  {
    planned.layer->check(plan, stage);
  }
  plan.empty = emptyLayers(plan, stage);
  return plan;
}

std::vector<std::pair<std::string, std::string>> describeRequest(const WorkPlan& plan)
{
  const GeneratorRequest& request = plan.request;
  std::vector<std::pair<std::string, std::string>> pairs;
  pairs.emplace_back("layers", joined(plan.layers));
  pairs.emplace_back("cameras", request.cameras.empty() ? "all" : joined(request.cameras));
  pairs.emplace_back("frames", request.frames
                                 ? std::to_string(request.frames->first) + ':' + std::to_string(request.frames->last) +
                                     ':' + std::to_string(request.frames->step)
                                 : "all");
  pairs.emplace_back(
    "size", request.width ? std::to_string(request.width) + 'x' + std::to_string(request.height) : "camera's own");
  if (plan.tiles)
  {
    pairs.emplace_back("tile", std::to_string(request.tileWidth) + 'x' + std::to_string(request.tileHeight));
  }
  if (plan.drawsColor())
  {
    pairs.emplace_back("samples", std::to_string(request.samples));
    if (request.filter != "box")
    {
      pairs.emplace_back("filter", request.filter);
    }
    pairs.emplace_back("color_bits", std::to_string(request.colorBits));
    pairs.emplace_back("color_format", joined(plan.colorFormats));
  }
  for (const PlannedLayer& layer : plan.representations)
  {
    pairs.emplace_back(layer.spec.name + "_format", joined(layer.formats));
  }
  for (const PlannedFrameLayer& planned : plan.frameLayers)
  {
    pairs.emplace_back(planned.layer->info().layer + "_format", joined(planned.formats));
    const auto options = planned.layer->options(request);
    pairs.insert(pairs.end(), options.begin(), options.end());
  }
  if (request.renderer != "vtk")
  {
    pairs.emplace_back("renderer", request.renderer);
  }
  const auto povray = request.pov.describe();
  pairs.insert(pairs.end(), povray.begin(), povray.end());
  pairs.emplace_back("visibility", plan.raster ? "raster" : "ray");
  pairs.emplace_back("seed", std::to_string(request.seed));
  pairs.insert(pairs.end(), plan.noise.begin(), plan.noise.end());
  if (request.pack)
  {
    pairs.emplace_back("pack", "yes");
  }
  return pairs;
}

} // namespace dgtk
