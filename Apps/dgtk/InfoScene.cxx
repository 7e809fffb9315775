// SPDX-License-Identifier: BSD-3-Clause
#include "Info.h"

#include "dgtkRepresentation.h"
#include "dgtkStage.h"
#include "dgtkSurfaceResolution.h"

#include <nlohmann/json.hpp>

#include <map>

namespace dgtk::app
{

namespace
{
Json matrix(const Eigen::Matrix3d& m)
{
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i)
  {
    rows.push_back({ m(i, 0), m(i, 1), m(i, 2) });
  }
  return rows;
}

Json infoOfCamera(const Stage& stage, std::size_t index, int width, int height, bool surfaces)
{
  const double frame = stage.description().firstFrame();
  const View view = stage.view(index, frame, width, height);
  Json camera;
  camera["name"] = view.name;
  camera["model"] = view.model->name();
  camera["width"] = view.model->width();
  camera["height"] = view.model->height();
  if (const auto linear = view.model->linear())
  {
    camera["K"] = matrix(linear->K);
    const WorldResolution resolution = worldResolution(view);
    camera["resolution"] = { { "x", resolution.thesis.x() }, { "y", resolution.thesis.y() },
      { "far_plane", { { "x", resolution.farPlane.x() }, { "y", resolution.farPlane.y() } } } };
  }
  else if (view.model->parameters().K)
  {
    camera["K"] = matrix(*view.model->parameters().K);
  }
  for (const auto& [name, numbers] : view.model->parameters().numbers)
  {
    camera[name] = numbers.size() == 1 ? Json(numbers[0]) : Json(numbers);
  }
  if (const RollingShutter& shutter = view.model->parameters().rollingShutter; shutter.duration > 0)
  {
    camera["rollingShutter"] = { { "duration", shutter.duration },
      { "direction", rollingDirections()[std::size_t(shutter.direction)] } };
  }
  camera["R"] = matrix(view.camera_from_world.rotation);
  camera["t"] = vector(view.camera_from_world.translation);
  camera["near"] = view.near;
  camera["far"] = view.far;
  if (surfaces)
  {
    const SurfaceResolution seen = surfaceResolution(stage, index, frame, width, height);
    camera["surfaces"] = { { "pixels", seen.pixels }, { "smallest", seen.smallest }, { "median", seen.median },
      { "largest", seen.largest } };
  }
  return camera;
}
} // namespace

Json vector(const Eigen::Vector3d& v) { return Json::array({ v.x(), v.y(), v.z() }); }

Json infoOfScene(const std::string& path, const Arguments& arguments)
{
  std::vector<std::string> warnings;
  const auto stage = Stage::load(readScene(path), [&](const std::string& line) { warnings.push_back(line); });
  const SceneDescription& scene = stage->description();
  int width = 0;
  int height = 0;
  if (arguments.has("--size"))
  {
    arguments.size("--size", 1 << 20, width, height);
  }
  Json info;
  info["file"] = path;
  info["objects"] = Json::array();
  const auto state = stage->at(scene.firstFrame());
  const std::vector<std::uint32_t> classes = classIds(*state);
  std::map<std::uint32_t, std::string> classNames;
  for (const ClassDescription& one : scene.classes)
  {
    classNames.emplace(one.id, one.name);
  }
  for (std::size_t i = 0; i < state->instances.size(); ++i)
  {
    const Instance& instance = state->instances[i];
    info["objects"].push_back(
      { { "id", i + 1 }, { "name", instance.name }, { "class", instance.className }, { "class_id", classes[i] },
        { "model", instance.model->path }, { "triangles", instance.model->triangles.size() } });
    classNames.emplace(classes[i], instance.className);
  }
  info["classes"] = Json::array();
  for (const auto& [id, name] : classNames)
  {
    info["classes"].push_back({ { "id", id }, { "name", name } });
  }
  info["cameras"] = Json::array();
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
  {
    info["cameras"].push_back(infoOfCamera(*stage, i, width, height, arguments.has("--surfaces")));
  }
  info["lights"] = Json::array();
  for (const LightDescription& light : scene.lights)
  {
    info["lights"].push_back({ { "name", light.name }, { "kind", traitsOf(light.kind).word },
      { "enabled", light.enabled.at(scene.firstFrame()) } });
  }
  info["first_frame"] = scene.firstFrame();
  info["last_frame"] = scene.lastFrame();
  info["key_frames"] = scene.keyFrames();
  info["warnings"] = warnings;
  return info;
}

} // namespace dgtk::app
