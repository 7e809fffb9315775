// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveScene.h"

#include "dgtkRaySource.h"
#include "dgtkScenePlaces.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t mostKept = 4; // a frame, its neighbours, and another one
constexpr double depthRange = 1e4;  // far / near of a view
constexpr double farMargin = 1.01;

std::shared_ptr<const SceneState> stateOf(const SceneDescription& scene, const ModelStore& models, int frame)
{
  ScenePlaces places = placeScene(scene, models, frame);
  auto state = std::make_shared<SceneState>(*places.surroundings);
  for (const SceneItem& item : scene.items())
  {
    if (item.kind != SceneItem::Kind::Object)
    {
      continue;
    }
    ObjectPlace& place = places.objects[item.index];
    if (place.visible && place.instance.model != nullptr)
    {
      place.instance.className = scene.objects[item.index].className;
      place.instance.classId = std::uint32_t(scene.classIdOf(place.instance.className));
      state->instances.push_back(std::move(place.instance));
    }
  }
  return state;
}
} // namespace

LiveView liveView(const ViewCamera& camera, const WorldBox& box, int width, int height)
{
  View view;
  view.model = makePinholeFromFov(width, height, ViewCamera::angle(), 0);
  view.camera_from_world = lookAtPose(camera.eye(), camera.focus(), camera.up());
  view.far = (camera.focus() - camera.eye()).norm();
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
  {
    const Eigen::Vector3d point(
      (corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(), (corner & 4 ? box.max : box.min).z());
    view.far = std::max(view.far, farMargin * (view.camera_from_world * point).z());
  }
  view.near = view.far / depthRange;
  return { view, view, view };
}

LiveScene::LiveScene(const SceneDescription& scene, const ModelStore& models, const LiveScene* before)
  : Scene(scene)
  , Models(models)
  , First(scene.firstFrame())
  , Last(scene.lastFrame())
{
  if (before != nullptr)
  {
    const std::lock_guard<std::mutex> lock(before->Mutex);
    this->Old = before->Kept.empty() ? before->Old : before->Kept;
  }
}

std::optional<LiveScene::Moment> LiveScene::find(int frame) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found =
    std::find_if(this->Kept.begin(), this->Kept.end(), [&](const Moment& moment) { return moment.frame == frame; });
  if (found == this->Kept.end())
  {
    return std::nullopt;
  }
  this->Kept.splice(this->Kept.begin(), this->Kept, found);
  return this->Kept.front();
}

LiveScene::Moment LiveScene::at(int frame) const
{
  if (const std::optional<Moment> known = this->find(frame))
  {
    return *known;
  }
  const std::lock_guard<std::mutex> building(this->Building);
  if (const std::optional<Moment> known = this->find(frame))
  {
    return *known;
  }
  Moment moment{ frame, stateOf(this->Scene, this->Models, frame), nullptr };
  std::shared_ptr<OcclusionQuery> occlusion = makeOcclusionQuery();
  occlusion->setScene(moment.state);
  moment.occlusion = std::move(occlusion);
  std::list<Moment> dropped; // destroyed after the lock
  const std::lock_guard<std::mutex> lock(this->Mutex);
  dropped.swap(this->Old);
  this->Kept.push_front(moment);
  if (this->Kept.size() > mostKept)
  {
    dropped.splice(dropped.begin(), this->Kept, std::prev(this->Kept.end()));
  }
  return moment;
}

LiveView LiveScene::view(const CameraDescription& camera, int frame, int width, int height) const
{
  SceneDescription alone;
  alone.file = this->Scene.file;
  alone.cameras.push_back(camera);
  const std::shared_ptr<const Stage> stage = Stage::load(std::move(alone));
  const auto at = [&](int when) { return stage->view(0, when, width, height); };
  return { at(frame), at(std::max(frame - 1, this->First)), at(std::min(frame + 1, this->Last)) };
}

std::shared_ptr<const EnvironmentLight> LiveScene::environmentLight() const
{
  return this->Models.environment(this->Scene).light;
}

std::vector<std::string> LiveScene::objectNames() const
{
  std::vector<std::string> names;
  for (const SceneItem& item : this->Scene.items())
  {
    if (item.kind == SceneItem::Kind::Object)
    {
      const ObjectDescription& object = this->Scene.objects[item.index];
      if (object.visible && this->Models.at(this->Scene, object, this->First).model != nullptr)
      {
        names.push_back(object.name);
      }
    }
  }
  return names;
}

} // namespace dgtk
