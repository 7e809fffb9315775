// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStageViews.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkStage.h"
#include "dgtkText.h"

#include <cmath>
#include <cstdint>

namespace dgtk
{

namespace
{
constexpr int usualWidth = 640;
constexpr int usualHeight = 480;

LightState lightAt(const LightDescription& light, double frame)
{
  LightState state;
  state.name = light.name;
  state.kind = light.kind;
  state.position = light.position.at(frame);
  state.target = light.target.at(frame);
  state.ambient = boundedAt(light.ambient, frame);
  state.diffuse = boundedAt(light.diffuse, frame);
  state.specular = boundedAt(light.specular, frame);
  state.attenuation = light.attenuation;
  state.coneAngle = boundedAt(light.coneAngle, frame);
  state.exponent = boundedAt(light.exponent, frame);
  state.intensity = boundedAt(light.intensity, frame);
  state.shadows = light.shadows;
  state.shadowSize = light.shadowSize;
  return state;
}
} // namespace

std::vector<LightState> lightsAt(const SceneDescription& scene, double frame)
{
  std::vector<LightState> lights;
  for (const LightDescription& light : scene.lights)
  {
    if (light.enabled.at(frame))
    {
      lights.push_back(lightAt(light, frame));
    }
  }
  if (scene.lights.empty())
  {
    LightState head;
    head.name = "head";
    head.kind = LightKind::Head;
    lights.push_back(head);
  }
  return lights;
}

std::vector<Eigen::Vector2d> lensPoints(int count)
{
  constexpr double goldenAngle = 2.39996322972865332; // pi (3 - sqrt 5)
  std::uint32_t size = 1;
  while (size < std::uint32_t(count))
  {
    size *= 2;
  }
  std::vector<Eigen::Vector2d> points;
  for (std::uint32_t i = 0; i < size; ++i)
  {
    std::uint32_t place = 0;
    for (std::uint32_t low = 1, high = size / 2; high > 0; low *= 2, high /= 2)
    {
      place |= (i & low) != 0 ? high : 0;
    }
    if (place < std::uint32_t(count))
    {
      const double radius = std::sqrt((place + 0.5) / count);
      points.emplace_back(radius * portable::cos(place * goldenAngle), radius * portable::sin(place * goldenAngle));
    }
  }
  return points;
}

View throughLens(const View& view, const Eigen::Vector2d& point, double focus)
{
  Eigen::Matrix3d K = view.model->linear()->K;
  K.topRightCorner<2, 1>() += K.topLeftCorner<2, 2>() * point / focus;
  View moved = view;
  CameraParameters parameters{ view.model->width(), view.model->height(), K };
  parameters.rollingShutter = view.model->parameters().rollingShutter;
  moved.model = makeCamera("pinhole", parameters);
  moved.camera_from_world.translation -= Eigen::Vector3d(point.x(), point.y(), 0);
  return moved;
}

namespace
{
Rigid3 poseAt(const CameraDescription& camera, double frame)
{
  if (!camera.posed)
  {
    return lookAtPose(camera.eye.at(frame), camera.lookAt.at(frame), camera.up.at(frame));
  }
  return Rigid3{ camera.orientation.at(frame).matrix(), camera.position.at(frame) }.inverse();
}
} // namespace

Rigid3 poseIn(const SceneDescription& scene, const CameraDescription& camera, double frame)
{
  try
  {
    return poseAt(camera, frame);
  }
  catch (const UsageError& error)
  {
    throw InputError(scene.title(), camera.line,
      "camera " + quoted(camera.name) + " at frame " + shortest(frame) + ": " + error.what());
  }
}

View cameraView(const CameraDescription& camera, double frame, int width, int height, const std::string& folder)
{
  if (width == 0 && height == 0)
  {
    width = camera.width > 0 ? camera.width : usualWidth;
    height = camera.height > 0 ? camera.height : usualHeight;
  }
  View view;
  view.name = camera.name;
  view.near = camera.near;
  view.far = camera.far;
  view.model = makeCamera(camera.model, cameraParameters(camera, frame, width, height, folder));
  view.camera_from_world = poseAt(camera, frame);
  return view;
}

} // namespace dgtk
