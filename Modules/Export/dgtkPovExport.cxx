// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovExport.h"

#include "dgtkError.h"
#include "dgtkPovLights.h"
#include "dgtkPovMeshes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dgtk
{

namespace
{
constexpr std::size_t MostIds = (1 << 24) - 1;
/// POV-Ray's largest: surfaces that may lie behind one another where texels are missing.
constexpr const char* TraceLevel = "256";

void checkName(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (extension != ".pov")
  {
    throw InputError(path, 0, "is no POV-Ray scene", "a name in .pov", extension.empty() ? "none" : extension);
  }
}

PovBall ballOf(const SceneState& state)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d high = -low;
  for (const Instance& instance : state.instances)
  {
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

/// A ray is location + direction + a right + b up; a from -1/2 at the image's left side to 1/2 at its right, b upwards.
/// Written in axes x left, y up, z forward, which `matrix` turns into the world: a right-handed frame, in which `right`
/// has a negative x, by which readers know that the world is right-handed.
std::string cameraText(const View& view)
{
  const auto linear = view.model->linear();
  if (!linear)
  {
    throw UsageError("camera " + quoted(view.name) + " (" + view.model->name() + ") cannot be written for POV-Ray");
  }
  const double width = view.model->width();
  const double height = view.model->height();
  const auto at = [&](double u, double v) -> Eigen::Vector3d
  {
    const CameraRay ray = view.model->rayThrough({ u, v });
    const Eigen::Vector3d& on = linear->perspective ? ray.direction : ray.origin;
    return { -on.x(), -on.y(), on.z() };
  };
  const Eigen::Vector3d middle = at(width / 2, height / 2);
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  Affine3 world_from_pov{ world_from_camera.rotation, world_from_camera.translation };
  world_from_pov.linear.leftCols<2>() *= -1;
  const Eigen::Vector3d location = linear->perspective ? Eigen::Vector3d(0, 0, 0) : middle;
  const Eigen::Vector3d direction = linear->perspective ? middle : Eigen::Vector3d(0, 0, 1);
  return std::string("camera {\n  ") + (linear->perspective ? "perspective" : "orthographic") + "\n  location " +
         povVector(location) + "\n  direction " + povVector(direction) + "\n  right " +
         povVector(Eigen::Vector3d(at(width, height / 2) - at(0, height / 2))) + "\n  up " +
         povVector(Eigen::Vector3d(at(width / 2, 0) - at(width / 2, height))) + "\n  " + povMatrix(world_from_pov) +
         "\n}\n";
}

std::string header(const SceneState& state, const View& view, const PovOptions& options)
{
  const std::string size = "+W" + std::to_string(view.model->width()) + " +H" + std::to_string(view.model->height());
  std::string text = "// Camera " + quoted(view.name) + ", frame " + povNumber(state.frame) + ".\n// povray " + size +
                     " -A +FN8 File_Gamma=sRGB Dither=off FILE\n\n#version 3.7;\n";
  // Colours are computed with as they are shown: nothing is converted on the way in or out.
  text += "global_settings {\n  assumed_gamma srgb\n  max_trace_level " + std::string(TraceLevel) +
          "\n  ambient_light " + povColor(povAmbient(state)) + "\n}\n";
  const Eigen::Vector3d background = options.flatIds ? Eigen::Vector3d(0, 0, 0) : state.background;
  return text + "background { color " + povColor(background) + " }\n" + cameraText(view);
}
} // namespace

PovResult exportPov(const SceneState& state, const View& view, const std::string& path, const PovOptions& options)
{
  checkName(path);
  if (state.instances.size() > MostIds)
  {
    throw InputError(path, 0, "cannot hold as many objects", "at most " + std::to_string(MostIds),
      std::to_string(state.instances.size()));
  }
  PovResult result;
  PovImages images(path);
  std::string head = header(state, view, options);
  const PovBall ball = ballOf(state);
  for (const LightState& light : state.lights)
  {
    head += options.flatIds ? std::string() : povLight(light, view, ball, result.warnings);
  }
  PovText text(path);
  text << head + '\n';
  PovMeshes meshes(text, images, options);
  std::uint32_t id = 0;
  for (const Instance& instance : state.instances)
  {
    meshes.add(instance, ++id);
  }
  text.commit();
  result.files = images.files();
  result.files.push_back(path);
  return result;
}

PovResult exportPov(const std::shared_ptr<const Model>& model, const std::string& path)
{
  SceneState state;
  state.background = { 1, 1, 1 };
  state.lights.emplace_back();
  state.lights[0].kind = LightState::Kind::Head;
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
  return exportPov(state, view, path);
}

} // namespace dgtk
