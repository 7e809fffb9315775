// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovExport.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPovCamera.h"
#include "dgtkPovLibrary.h"
#include "dgtkPovLights.h"
#include "dgtkPovMeshes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t mostIds = (1 << 24) - 1;
/// POV-Ray's largest: surfaces that may lie behind one another where texels are missing.
constexpr const char* traceLevel = "256";
/// Begins a line that names a file of the library.
const std::string usesLine = "// uses ";

void checkName(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (extension != ".pov")
  {
    throw InputError(path, "is no POV-Ray scene", "a name in .pov", extension.empty() ? "none" : extension);
  }
}

void checkCount(const SceneState& state, const std::string& path)
{
  if (state.objects() > mostIds)
  {
    throw InputError(
      path, "cannot hold as many objects", "at most " + std::to_string(mostIds), std::to_string(state.objects()));
  }
}

PovBall ballOf(const SceneState& state)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d high = -low;
  for (const Instance& instance : state.instances)
  {
    if (!instance.visible)
    {
      continue;
    }
    for (const Eigen::Vector3d& position : instance.geometry->positions)
    {
      const Eigen::Vector3d x_in_world = instance.world_from_object * position;
      low = low.cwiseMin(x_in_world);
      high = high.cwiseMax(x_in_world);
    }
  }
  PovBall ball;
  if ((low.array() <= high.array()).all())
  {
    ball.centre = 0.5 * (low + high);
    ball.radius = std::max(0.5 * (high - low).norm(), 1e-6);
  }
  return ball;
}

std::string settings(const SceneState& state, const PovOptions& options)
{
  // Colours are computed with as they are shown: nothing is converted on the way in or out.
  return "#version 3.7;\nglobal_settings {\n  assumed_gamma srgb\n  max_trace_level " + std::string(traceLevel) +
         "\n  ambient_light " + povColor(options.radiosity ? Eigen::Vector3d(0, 0, 0) : povAmbient(state)) +
         (options.radiosity ? "\n  radiosity { count 150 nearest_count 10 error_bound 0.5 recursion_limit 2 }" : "") +
         "\n}\n";
}

/// Fog whose distance is the built-in renderer's; a note for what it cannot show.
std::string fogText(const SceneState& state, double scale, std::vector<std::string>& warnings)
{
  const FogState& fog = state.fog;
  if (fog.density <= 0)
  {
    return {};
  }
  if (fog.start > 0)
  {
    warnings.push_back("fog that starts away from the camera is not written");
    return {};
  }
  if (fog.color != state.background)
  {
    warnings.push_back("fog hides the background");
  }
  return "fog { distance " + povNumber(scale / fog.density) + " color " + povColor(fog.color) + " }\n";
}

/// Whether the pictures that are written repeat.
bool isTiled(const Model& model, const Material& material)
{
  const int pictures[] = { material.texture, material.bumpMap };
  return std::all_of(std::begin(pictures), std::end(pictures),
    [&model](int index) { return index < 0 || model.textures[static_cast<std::size_t>(index)].repeats(); });
}

void noteMissing(const SceneState& state, std::vector<std::string>& warnings)
{
  bool physical = false;
  bool normals = false;
  bool colors = false;
  bool wraps = false;
  for (const Instance& instance : state.instances)
  {
    colors = colors || !instance.model->colors.empty() || instance.model->colorMap;
    for (const Part& part : instance.model->parts)
    {
      const Material& material = povMaterialsOf(instance)[static_cast<std::size_t>(part.material)];
      wraps = wraps || (!isTiled(*instance.model, material) && instance.model->reachesBeyondPictures(part));
    }
    for (const Material& material : povMaterialsOf(instance))
    {
      physical = physical || (material.physical && material.physical->wanted);
      normals = normals || material.normalMap >= 0;
    }
  }
  const auto note = [&warnings](bool missing, const char* text)
  {
    if (missing)
    {
      warnings.emplace_back(text);
    }
  };
  note(colors, "colours of vertices are not written");
  note(state.environment != nullptr, "the environment is not written");
  note(physical, "metallic and roughness are not written");
  note(normals, "normal maps are not written");
  note(wraps, "textures repeat where the model has a border that goes on, or a mirror");
}

/// All but the objects.
std::string head(
  const SceneState& state, const PovLightContext& context, const PovRows& rows, std::vector<std::string>& warnings)
{
  const PovOptions& options = context.options;
  const bool shines = options.flatIds || options.positionColors;
  const Eigen::Vector3d background = shines ? Eigen::Vector3d(0, 0, 0) : state.background;
  std::string text = settings(state, options) + "background { color " + povColor(background) + " }\n" +
                     povCamera(context.view, rows, options.lens, context.scale);
  for (const LightState& light : state.lights)
  {
    text += shines ? std::string() : povLight(light, context, warnings);
  }
  if (!shines)
  {
    text += fogText(state, context.scale, warnings);
    noteMissing(state, warnings);
  }
  return text + '\n';
}

std::string firstLines(
  const SceneState& state, const PovLightContext& context, const PovRows& rows, const std::string& name)
{
  const CameraModel& model = *context.view.model;
  std::string options =
    "+W" + std::to_string(model.width()) + " +H" + std::to_string(rows.count > 0 ? rows.count : model.height());
  for (const std::string& word : povAntialias(context.options.antialias))
  {
    options += ' ' + word;
  }
  return "// Camera " + quoted(context.view.name) + ", frame " + povNumber(state.frame) + ".\n// povray " + options +
         " +FN8 File_Gamma=sRGB Dither=off " + name + '\n' +
         (context.scale == 1 ? ""
                             : "// Everything is " + povNumber(context.scale) + " times as large as in the scene.\n");
}

PovLightContext contextOf(const SceneState& state, const View& view, const PovOptions& options)
{
  PovLightContext context{ view, options, ballOf(state), 1, povShadows(state, options) };
  context.scale = options.ownScale ? *options.ownScale : povSceneScale(view, context.ball);
  return context;
}

void addObjects(const SceneState& state, PovObjects&& objects)
{
  std::map<std::pair<const Geometry*, const std::vector<Material>*>, int> users;
  for (const Instance& instance : state.instances)
  {
    ++users[{ instance.geometry.get(), &povMaterialsOf(instance) }];
  }
  std::uint32_t number = 0;
  for (const Instance& instance : state.instances)
  {
    ++number;
    if (instance.visible)
    {
      objects.add(instance, state.objectOf(number), users[{ instance.geometry.get(), &povMaterialsOf(instance) }] > 1);
    }
  }
}
} // namespace

std::vector<std::string> povNotes(const SceneState& state, const View& view, const PovOptions& options)
{
  std::vector<std::string> notes;
  head(state, contextOf(state, view, options), {}, notes);
  return notes;
}

std::vector<std::string> povAntialias(int points)
{
  return points > 1 ? std::vector<std::string>{ "+A0.0", "+AM1", "+R" + std::to_string(points), "-J" }
                    : std::vector<std::string>{ "-A" };
}

namespace
{
std::vector<std::string> inputsOf(const SceneState& state, const PovOptions& options)
{
  std::vector<std::string> inputs = options.inputs;
  std::set<const Model*> known;
  for (const Instance& instance : state.instances)
  {
    const Model& model = *instance.model;
    if (known.insert(&model).second)
    {
      inputs.push_back(model.path);
      inputs.insert(inputs.end(), model.companions.begin(), model.companions.end());
      for (const Texture& texture : model.textures)
      {
        inputs.push_back(texture.path);
      }
    }
  }
  return inputs;
}

PovResult writeScene(
  const SceneState& state, const View& view, const std::string& path, const PovSurfaceOptions& options)
{
  checkName(path);
  checkCount(state, path);
  const std::vector<std::string> inputs = inputsOf(state, options);
  refuseInPlaceOf(inputs, path);
  PovResult result;
  PovImagesBeside images(path, inputs);
  const PovLightContext context = contextOf(state, view, options);
  const std::string begin = firstLines(state, context, {}, "FILE") + '\n' + head(state, context, {}, result.warnings);
  PovText text(path);
  text << begin;
  PovMeshesInside meshes(text, images, options);
  addObjects(state, { text, meshes, view, options, context.scale });
  text.commit();
  result.files = images.files();
  result.files.push_back(path);
  result.scale = context.scale;
  return result;
}
} // namespace

PovResult exportPov(const SceneState& state, const View& view, const std::string& path, const PovOptions& options)
{
  return writeScene(state, view, path, povSurfaceOptions(state, options));
}

PovResult exportPov(const std::shared_ptr<const Model>& model, const std::string& path)
{
  SceneState state;
  state.background = { 1, 1, 1 };
  state.lights.emplace_back();
  state.lights[0].kind = LightKind::Head;
  Instance instance;
  instance.name = std::filesystem::path(model->path).filename().string();
  instance.model = model;
  instance.geometry = model->rest;
  state.instances.push_back(instance);
  const PovBall ball = ballOf(state);
  View view;
  view.name = "front";
  view.model = makePinholeFromFov(640, 480, 45, 0);
  view.camera_from_world =
    lookAtPose(ball.centre + Eigen::Vector3d(0, 0, 2.8 * ball.radius), ball.centre, Eigen::Vector3d(0, 1, 0));
  view.near = ball.radius;
  view.far = 5 * ball.radius;
  PovSurfaceOptions options = povSurfaceOptions(state, {});
  options.ownScale = 1;
  options.asSeen = false;
  return writeScene(state, view, path, options);
}

PovScene makePovScene(const SceneState& state, const View& view, const PovOptions& options, PovLibrary& library,
  const PovRows& rows, const std::string& name)
{
  checkCount(state, view.name);
  PovScene scene;
  const PovLightContext context = contextOf(state, view, options);
  scene.scale = context.scale;
  PovText objects;
  const PovSurfaceOptions surface = povSurfaceOptions(state, options);
  PovMeshesIncluded meshes(library.impl(), surface);
  addObjects(state, { objects, meshes, view, surface, context.scale });
  scene.uses = meshes.uses();
  scene.text = firstLines(state, context, rows, name);
  for (const PovFile& file : scene.uses)
  {
    scene.text += usesLine + library.impl().reference + file.name + '\n';
  }
  const std::string begin = head(state, context, rows, scene.warnings);
  for (const std::string& warning : scene.warnings)
  {
    scene.text += "// Note: " + warning + '\n';
  }
  scene.text += '\n' + begin;
  for (const std::string& file : meshes.includes())
  {
    scene.text += "#include \"" + library.impl().reference + file + "\"\n";
  }
  scene.text += '\n' + meshes.declared() + objects.text();
  return scene;
}

std::vector<std::string> povSceneUses(const std::string& path)
{
  std::vector<std::string> names;
  const std::string text = readFile(path);
  for (std::size_t begin = 0; text.compare(begin, 2, "//") == 0;)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (text.compare(begin, usesLine.size(), usesLine) == 0)
    {
      const std::string name = text.substr(begin + usesLine.size(), end - begin - usesLine.size());
      names.push_back(name.substr(name.rfind('/') + 1));
    }
    begin = std::min(end + 1, text.size());
  }
  return names;
}

} // namespace dgtk
