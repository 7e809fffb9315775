// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStage.h"

#include "dgtkError.h"
#include "dgtkInstantSource.h"
#include "dgtkKeptViews.h"
#include "dgtkKeypoints.h"
#include "dgtkMaterialNumbers.h"
#include "dgtkModelClock.h"
#include "dgtkObjectPoses.h"
#include "dgtkSceneTracks.h"
#include "dgtkStageModels.h"
#include "dgtkStageViews.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>

namespace dgtk
{

struct Stage::Impl
{
  static constexpr std::size_t keptStates = 4;

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
    this->Files = models.files();
    std::set<std::shared_ptr<const Model>> known;
    for (const ObjectLook& look : this->Looks)
    {
      if (look.model != nullptr && known.insert(look.model).second)
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
  std::shared_ptr<const SceneState> compute(double frame) const;
  Instance instance(std::size_t object, const Affine3& world_from_object, double frame) const;
  void addCopies(SceneState& state, const std::vector<std::size_t>& objects) const;

  SceneDescription Scene;
  std::vector<ObjectLook> Looks; ///< one an object
  std::unordered_map<std::string, std::uint32_t> ClassIds;
  std::shared_ptr<const EnvironmentState> Environment;
  bool CutsAtWhite = false;
  std::vector<std::shared_ptr<const Model>> Models; ///< in the order of their first use
  std::vector<std::string> Files;
  std::optional<ObjectPoses> Poses;
  std::shared_ptr<GeometryCache> Geometries;
  mutable MaterialNumbers Materials;

  // The latest states: the cameras of a frame, and what looks a frame ahead and back, ask for the same ones.
  std::mutex Mutex;
  std::deque<std::shared_ptr<const SceneState>> Latest;
  KeptViews Views; // without their instants, which keep the stage
};

void Stage::Impl::take(const ModelSource& models)
{
  for (const ClassDescription& one : this->Scene.classes)
  {
    this->ClassIds.try_emplace(one.name, std::uint32_t(one.id));
  }
  for (const ObjectDescription& object : this->Scene.objects)
  {
    this->Looks.push_back(models.lookOf(this->Scene, object));
  }
  this->Environment = models.environment(this->Scene);
  this->CutsAtWhite = models.cutsAtWhite();
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
      checkKeypoints(this->Scene, object, *this->Looks[i].model);
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
  return isEver(this->Scene.objects[object].visible) && model != nullptr && !model->triangles.empty();
}

std::shared_ptr<const SceneState> Stage::Impl::compute(double frame) const
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
  state->background = boundedAt(this->Scene.background, frame);
  state->environment = this->Environment;
  state->cutsAtWhite = this->CutsAtWhite;
  const FogDescription& fog = this->Scene.fog;
  state->fog = { boundedAt(fog.color, frame), boundedAt(fog.density, frame), boundedAt(fog.start, frame) };
  state->lights = lightsAt(this->Scene, frame);
  std::vector<std::size_t> objects;
  for (const SceneItem& item : this->Scene.items())
  {
    if (item.kind != SceneItem::Kind::Object || !this->isPresent(item.index))
    {
      continue;
    }
    objects.push_back(item.index);
    state->instances.push_back(this->instance(item.index, world[item.index], frame));
  }
  this->addCopies(*state, objects);
  return state;
}

/// What objects that are made of copies are made of. `objects`: indices of the instances' descriptions.
void Stage::Impl::addCopies(SceneState& state, const std::vector<std::size_t>& objects) const
{
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    const auto& copies = this->Looks[objects[i]].copies;
    if (copies == nullptr)
    {
      continue;
    }
    const bool visible = std::exchange(state.instances[i].visible, false);
    const Affine3 world_from_object = state.instances[i].world_from_object;
    for (const ModelCopy& copy : *copies)
    {
      Instance instance;
      instance.name = state.instances[i].name;
      instance.model = copy.model;
      instance.geometry = copy.model->rest;
      instance.materials = copy.materials;
      instance.world_from_object = world_from_object * copy.object_from_model;
      instance.visible = visible;
      instance.copyOf = std::uint32_t(i + 1);
      instance.object_from_model = copy.object_from_model;
      instance.firstPart = copy.firstPart;
      instance.firstTriangle = copy.firstTriangle;
      instance.firstInPart = copy.firstInPart;
      state.instances.push_back(std::move(instance));
    }
    state.copies += copies->size();
  }
}

Instance Stage::Impl::instance(std::size_t index, const Affine3& world_from_object, double frame) const
{
  const ObjectDescription& object = this->Scene.objects[index];
  const ObjectLook& look = this->Looks[index];
  Instance instance;
  instance.name = object.name;
  instance.className = object.className;
  instance.classId = this->ClassIds.count(object.className) != 0 ? this->ClassIds.at(object.className) : 0;
  instance.model = look.model;
  instance.geometry = geometryAt(this->Scene, object, *look.model, frame, *this->Geometries);
  instance.materials = this->Materials.at(object, look.materials, frame);
  instance.world_from_object = world_from_object;
  instance.visible = object.visible.at(frame);
  instance.keypoints = keypointsAt(object, *look.model, *instance.geometry);
  return instance;
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
  if (this->Self->Latest.size() > Impl::keptStates)
  {
    this->Self->Latest.pop_front();
  }
  return state;
}

namespace
{
/// Whether tracks of an item have keys: those of its pose, the others.
std::pair<bool, bool> animatedTracks(const SceneDescription& scene, const SceneItem& item)
{
  std::pair<bool, bool> animated{ false, false };
  forEachTrackOf(scene, item,
    [&animated](const auto& track, bool pose)
    {
      bool& which = pose ? animated.first : animated.second;
      which = which || track.animated();
    });
  return animated;
}
} // namespace

class Stage::Instants final : public InstantSource
{
public:
  /// Through a point of the lens: camera axes, scene units from its centre.
  Instants(
    std::shared_ptr<const Stage> stage, std::size_t camera, double frame, const Eigen::Vector2d& point = { 0, 0 })
    : Owner(std::move(stage))
    , Camera(Owner->description().cameras[camera])
    , Frame(frame)
    , LensPoint(point.x(), point.y(), 0)
  {
    const Impl& impl = *this->Owner->Self;
    std::size_t weight = 1;
    bool still = true;
    forEachTrackOfScene(impl.Scene, [&still](const auto& track, bool) { still = still && !track.animated(); });
    for (const SceneItem& item : impl.Scene.items())
    {
      const std::pair<bool, bool> animated = animatedTracks(impl.Scene, item);
      if (item.kind == SceneItem::Kind::Object && impl.isPresent(item.index))
      {
        this->Objects.push_back(item.index);
        const Model& model = *impl.Looks[item.index].model;
        weight += 1 + (model.deformation ? model.sourceVertex.size() / verticesAnObject : 0);
        const bool changes = model.deformation || animated.second;
        this->Motions.push_back(changes ? Motion::Any : impl.Poses->moves(item.index) ? Motion::Rigid : Motion::None);
        still = still && this->Motions.back() == Motion::None;
      }
      still = still && (item.kind == SceneItem::Kind::Camera || !(animated.first || animated.second));
    }
    this->MostKept = std::max(leastKept, objectsKept / weight);
    this->Still = still ? this->Owner->at(frame) : nullptr;
  }

  double frame() const override { return this->Frame; }

  Instant at(double frame) const override
  {
    Instant now{ this->Still, this->poseAt(frame) };
    if (now.state)
    {
      return now;
    }
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto found = this->Kept.find(frame);
      if (found != this->Kept.end())
      {
        now.state = found->second;
        return now;
      }
    }
    now.state = this->Owner->Self->compute(frame);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Kept.size() >= this->MostKept)
    {
      this->Kept.clear();
    }
    this->Kept[frame] = now.state;
    return now;
  }

  Instance instanceAt(double frame, std::uint32_t object) const override
  {
    return this->Owner->Self->instance(this->Objects[object - 1], this->placeAt(frame, object), frame);
  }

  const std::vector<Motion>& motions() const override { return this->Motions; }
  Rigid3 poseAt(double frame) const override
  {
    Rigid3 pose = poseIn(this->Owner->description(), this->Camera, frame);
    pose.translation -= this->LensPoint;
    return pose;
  }
  bool isVisibleAt(double frame, std::uint32_t object) const override
  {
    return this->Owner->description().objects[this->Objects[object - 1]].visible.at(frame);
  }
  Affine3 placeAt(double frame, std::uint32_t object) const override
  {
    return this->Owner->Self->Poses->of(this->Objects[object - 1], frame);
  }

  Point pointAt(
    double frame, std::uint32_t object, std::uint32_t triangle, const Eigen::Vector2d& barycentrics) const override
  {
    const Impl& impl = *this->Owner->Self;
    const std::size_t index = this->Objects[object - 1];
    const Model& model = *impl.Looks[index].model;
    const auto p = cornersAt(impl.Scene, impl.Scene.objects[index], model, frame, triangle);
    return { this->placeAt(frame, object) *
               (p[0] + barycentrics.x() * (p[1] - p[0]) + barycentrics.y() * (p[2] - p[0])),
      this->poseAt(frame) };
  }

private:
  static constexpr std::size_t objectsKept = 200000; ///< of all states together
  static constexpr std::size_t verticesAnObject = 8; ///< of memory
  static constexpr std::size_t leastKept = 16;

  std::shared_ptr<const Stage> Owner;
  const CameraDescription& Camera;
  double Frame;
  Eigen::Vector3d LensPoint;
  std::vector<std::size_t> Objects; ///< by id - 1
  std::vector<Motion> Motions;
  std::size_t MostKept = leastKept;
  std::shared_ptr<const SceneState> Still; ///< at all times; null where it changes
  mutable std::mutex Mutex;
  mutable std::map<double, std::shared_ptr<const SceneState>> Kept;
};

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
  const auto make = [&]
  {
    poseIn(scene, camera, frame);
    return cameraView(camera, frame, width, height, scene.folder);
  };
  View view = this->Self->Views.at(scene.cameras, index, { frame, width, height }, make);
  if (view.model->rolls())
  {
    view.instants = std::make_shared<Instants>(this->shared_from_this(), index, frame);
  }
  return view;
}

std::vector<Exposure> Stage::exposures(std::size_t index, int frame, int width, int height) const
{
  const CameraDescription& camera = this->Self->Scene.cameras[index];
  if (!camera.blurs())
  {
    return {};
  }
  const ShutterDescription& shutter = camera.shutter;
  const bool blurs = camera.lens.blurs();
  const int count = std::max(shutter.close > shutter.open ? shutter.exposures : 1, blurs ? camera.lens.exposures : 1);
  const std::vector<Eigen::Vector2d> points = blurs ? lensPoints(count) : std::vector<Eigen::Vector2d>();
  std::vector<Exposure> all;
  for (int i = 0; i < count; ++i)
  {
    Exposure one;
    one.frame = frame + (shutter.open + (i + 0.5) / count * (shutter.close - shutter.open));
    one.view = this->view(index, one.frame, width, height);
    if (blurs)
    {
      const Eigen::Vector2d point = points[std::size_t(i)] * (camera.lens.aperture / 2);
      one.view = throughLens(one.view, point, boundedAt(camera.lens.focus, one.frame));
      if (one.view.instants)
      {
        one.view.instants = std::make_shared<Instants>(this->shared_from_this(), index, one.frame, point);
      }
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

std::vector<bool> Stage::movingObjects() const
{
  const Impl& impl = *this->Self;
  std::vector<bool> moving;
  for (const SceneItem& item : impl.Scene.items())
  {
    if (item.kind == SceneItem::Kind::Object && impl.isPresent(item.index))
    {
      const Model& model = *impl.Looks[item.index].model;
      const bool deforms = model.deformation && findAnimation(impl.Scene, impl.Scene.objects[item.index], model) >= 0;
      moving.push_back(deforms || impl.Poses->moves(item.index));
    }
  }
  return moving;
}

std::vector<std::shared_ptr<const Model>> Stage::models() const { return this->Self->Models; }

std::vector<std::string> Stage::inputFiles() const { return this->Self->Files; }

} // namespace dgtk
