// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStage.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkModelClock.h"
#include "dgtkObjectPoses.h"
#include "dgtkStageModels.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int usualWidth = 640;
constexpr int usualHeight = 480;
constexpr std::size_t keptStates = 4;

LightState lightAt(const LightDescription& light, double frame)
{
  LightState state;
  state.name = light.name;
  state.kind = light.kind;
  state.position = light.position.at(frame);
  state.target = light.target.at(frame);
  state.ambient = light.ambient;
  state.diffuse = light.diffuse;
  state.specular = light.specular;
  state.attenuation = light.attenuation;
  state.coneAngle = light.coneAngle;
  state.exponent = light.exponent;
  state.intensity = light.intensity;
  state.shadows = light.shadows;
  state.shadowSize = light.shadowSize;
  return state;
}

std::vector<LightState> lightsAt(const SceneDescription& scene, double frame)
{
  std::vector<LightState> lights;
  for (const LightDescription& light : scene.lights)
  {
    if (light.enabled)
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

/// Points on the unit disc: Vogel's spiral, in bit-reversed order.
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
      points.emplace_back(radius * std::cos(place * goldenAngle), radius * std::sin(place * goldenAngle));
    }
  }
  return points;
}

/// The view through a point of the lens (camera axes, scene units from its centre): points at depth `focus` keep their
/// place in the image.
View throughLens(const View& view, const Eigen::Vector2d& point, double focus)
{
  Eigen::Matrix3d K = view.model->linear()->K;
  K.topRightCorner<2, 1>() += K.topLeftCorner<2, 2>() * point / focus;
  View moved = view;
  moved.model = makePinhole(view.model->width(), view.model->height(), K);
  moved.camera_from_world.translation -= Eigen::Vector3d(point.x(), point.y(), 0);
  return moved;
}

Rigid3 poseAt(const CameraDescription& camera, double frame)
{
  if (!camera.posed)
  {
    return lookAtPose(camera.eye.at(frame), camera.lookAt.at(frame), camera.up.at(frame));
  }
  return Rigid3{ camera.orientation.at(frame).matrix(), camera.position.at(frame) }.inverse();
}
} // namespace

View cameraView(
  const CameraDescription& camera, double frame, int width, int height, const std::string& folder)
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

struct Stage::Impl
{
  Impl(SceneDescription scene, const WarningSink& warning)
    : Scene(std::move(scene))
  {
    const StageModels read(this->Scene, warning);
    this->Models = read.models();
    this->Files = read.files();
    this->take(read);
  }
  Impl(SceneDescription scene, const ModelSource& models)
    : Scene(std::move(scene))
  {
    this->take(models);
    for (const ObjectLook& look : this->Looks)
    {
      if (look.model != nullptr &&
          std::find(this->Models.begin(), this->Models.end(), look.model) == this->Models.end())
      {
        this->Models.push_back(look.model);
      }
    }
  }

  void take(const ModelSource& models);
  void checkObjects() const;
  void checkScale(const ObjectDescription& object, double frame) const;
  /// It has an id.
  bool isPresent(std::size_t object) const;
  std::shared_ptr<const SceneState> compute(double frame);

  SceneDescription Scene;
  std::vector<ObjectLook> Looks; ///< one an object
  std::shared_ptr<const EnvironmentState> Environment;
  std::vector<std::shared_ptr<const Model>> Models; ///< in the order of their first use
  std::vector<std::string> Files;
  std::optional<ObjectPoses> Poses;
  std::shared_ptr<GeometryCache> Geometries;

  // The latest states: the cameras of a frame, and what looks a frame ahead and back, ask for the same ones.
  std::mutex Mutex;
  std::deque<std::shared_ptr<const SceneState>> Latest;
};

void Stage::Impl::take(const ModelSource& models)
{
  for (const ObjectDescription& object : this->Scene.objects)
  {
    this->Looks.push_back(models.lookOf(this->Scene, object));
  }
  this->Environment = models.environment(this->Scene);
  this->Geometries = models.geometries();
  this->checkObjects();
  this->Poses.emplace(this->Scene);
}

void Stage::Impl::checkObjects() const
{
  for (std::size_t i = 0; i < this->Looks.size(); ++i)
  {
    const ObjectDescription& object = this->Scene.objects[i];
    if (this->Looks[i].model != nullptr && !this->Looks[i].standsIn)
    {
      findAnimation(this->Scene, object, *this->Looks[i].model);
    }
    if (!object.scale.animated())
    {
      this->checkScale(object, 0);
    }
  }
}

void Stage::Impl::checkScale(const ObjectDescription& object, double frame) const
{
  if ((object.scale.at(frame).array() == 0).any())
  {
    failObject(this->Scene, object, "scale passes through 0", "another interpolation", "frame " + shortest(frame));
  }
}

bool Stage::Impl::isPresent(std::size_t object) const
{
  const Model* const model = this->Looks[object].model.get();
  return this->Scene.objects[object].visible && model != nullptr && !model->triangles.empty();
}

std::shared_ptr<const SceneState> Stage::Impl::compute(double frame)
{
  for (const ObjectDescription& object : this->Scene.objects)
  {
    if (object.scale.animated())
    {
      this->checkScale(object, frame);
    }
  }
  const std::vector<Affine3> world = this->Poses->at(frame);
  auto state = std::make_shared<SceneState>();
  state->frame = frame;
  state->background = this->Scene.background;
  state->environment = this->Environment;
  state->fog = { this->Scene.fog.color, this->Scene.fog.density, this->Scene.fog.start };
  state->lights = lightsAt(this->Scene, frame);
  for (const SceneItem& item : this->Scene.items())
  {
    if (item.kind != SceneItem::Kind::Object || !this->isPresent(item.index))
    {
      continue;
    }
    const ObjectDescription& object = this->Scene.objects[item.index];
    Instance instance;
    instance.name = object.name;
    instance.className = object.className;
    instance.classId = std::uint32_t(this->Scene.classIdOf(object.className));
    const ObjectLook& look = this->Looks[item.index];
    instance.model = look.model;
    instance.geometry = geometryAt(this->Scene, object, *look.model, frame, *this->Geometries);
    instance.materials = look.materials;
    instance.world_from_object = world[item.index];
    state->instances.push_back(std::move(instance));
  }
  return state;
}

Stage::Stage(std::unique_ptr<Impl> impl)
  : Self(std::move(impl))
{
}

Stage::~Stage() = default;

std::shared_ptr<const Stage> Stage::load(SceneDescription scene, const WarningSink& warning)
{
  check(scene);
  return std::shared_ptr<const Stage>(new Stage(std::make_unique<Impl>(std::move(scene), warning)));
}

std::shared_ptr<const Stage> Stage::make(SceneDescription scene, const ModelSource& models)
{
  check(scene);
  return std::shared_ptr<const Stage>(new Stage(std::make_unique<Impl>(std::move(scene), models)));
}

void Stage::check(SceneDescription& scene)
{
  nameAll(scene);
  validate(scene);
}

const SceneDescription& Stage::description() const { return this->Self->Scene; }

std::shared_ptr<const SceneState> Stage::at(double frame) const
{
  if (!std::isfinite(frame))
  {
    throw UsageError("frame is not a finite number");
  }
  {
    const std::lock_guard<std::mutex> lock(this->Self->Mutex);
    for (const std::shared_ptr<const SceneState>& state : this->Self->Latest)
    {
      if (state->frame == frame)
      {
        return state;
      }
    }
  }
  std::shared_ptr<const SceneState> state = this->Self->compute(frame);
  const std::lock_guard<std::mutex> lock(this->Self->Mutex);
  this->Self->Latest.push_back(state);
  if (this->Self->Latest.size() > keptStates)
  {
    this->Self->Latest.pop_front();
  }
  return state;
}

View Stage::view(std::size_t index, double frame, int width, int height) const
{
  const SceneDescription& scene = this->Self->Scene;
  if (index >= scene.cameras.size())
  {
    throw UsageError("camera " + std::to_string(index) + " does not exist (the scene has " +
                     std::to_string(scene.cameras.size()) + ')');
  }
  if (!std::isfinite(frame))
  {
    throw UsageError("frame is not a finite number");
  }
  const CameraDescription& camera = scene.cameras[index];
  try
  {
    poseAt(camera, frame);
  }
  catch (const UsageError& error)
  {
    throw InputError(scene.title(), camera.line,
      "camera " + quoted(camera.name) + " at frame " + shortest(frame) + ": " + error.what());
  }
  return cameraView(camera, frame, width, height, scene.folder);
}

std::vector<Exposure> Stage::exposures(std::size_t index, int frame, int width, int height) const
{
  std::vector<Exposure> all{ { double(frame), this->view(index, frame, width, height) } };
  const CameraDescription& camera = this->Self->Scene.cameras[index];
  const bool moves = camera.shutter.blurs();
  const bool blurs = camera.lens.blurs();
  if (!moves && !blurs)
  {
    return all;
  }
  const int count = std::max(moves ? camera.shutter.exposures : 1, blurs ? camera.lens.exposures : 1);
  const std::vector<Eigen::Vector2d> points = blurs ? lensPoints(count) : std::vector<Eigen::Vector2d>();
  all.clear();
  for (int i = 0; i < count; ++i)
  {
    Exposure one;
    one.frame =
      frame + (moves ? camera.shutter.open + (i + 0.5) / count * (camera.shutter.close - camera.shutter.open) : 0.0);
    one.view = this->view(index, one.frame, width, height);
    if (blurs)
    {
      one.view =
        throughLens(one.view, points[std::size_t(i)] * (camera.lens.aperture / 2), camera.lens.focus.at(one.frame));
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<std::string> Stage::cameraNames() const
{
  std::vector<std::string> names;
  for (const CameraDescription& camera : this->Self->Scene.cameras)
  {
    names.push_back(camera.name);
  }
  return names;
}

std::vector<std::string> Stage::objectNames() const
{
  std::vector<std::string> names;
  for (const SceneItem& item : this->Self->Scene.items())
  {
    if (item.kind == SceneItem::Kind::Object && this->Self->isPresent(item.index))
    {
      names.push_back(this->Self->Scene.objects[item.index].name);
    }
  }
  return names;
}

std::vector<std::shared_ptr<const Model>> Stage::models() const { return this->Self->Models; }

std::vector<std::string> Stage::inputFiles() const { return this->Self->Files; }

} // namespace dgtk
