// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveScene.h"

#include "dgtkRayPictures.h"
#include "dgtkScenePlaces.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double depthRange = 1e4; // far / near of a view
constexpr double farMargin = 1.01;
} // namespace

CameraDescription liveCamera(const ViewCamera& camera, const WorldBox& box)
{
  CameraDescription eye;
  eye.fovY = ViewCamera::angle();
  eye.eye = camera.eye();
  eye.lookAt = camera.focus();
  eye.up = camera.up();
  const Rigid3 camera_from_world = lookAtPose(camera.eye(), camera.focus(), camera.up());
  eye.far = (camera.focus() - camera.eye()).norm();
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
  {
    const Eigen::Vector3d point(
      (corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(), (corner & 4 ? box.max : box.min).z());
    eye.far = std::max(eye.far, farMargin * (camera_from_world * point).z());
  }
  eye.near = eye.far / depthRange;
  return eye;
}

LiveScene::LiveScene(const SceneDescription& scene, const ModelLibrary& models, const LiveScene* before)
  : Scene(scene)
  , Models(models)
  , First(scene.firstFrame())
  , Last(scene.lastFrame())
{
  if (before != nullptr)
  {
    const std::lock_guard<std::mutex> lock(before->Mutex);
    this->Before = before->Before ? before->Before : before->Queries;
    this->Shader = before->Shader;
  }
}

std::shared_ptr<TracedQueries> LiveScene::queries() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (!this->Queries)
  {
    this->Queries = std::make_shared<TracedQueries>(Stage::make(this->Scene, this->Models));
  }
  return this->Queries;
}

std::shared_ptr<const Stage> LiveScene::stage() const
{
  const std::shared_ptr<TracedQueries> queries = this->queries();
  return { queries, &queries->stage() };
}

LiveScene::Moment LiveScene::at(int frame) const
{
  Moment moment = this->queries()->at(frame);
  std::shared_ptr<TracedQueries> dropped; // destroyed after the lock
  const std::lock_guard<std::mutex> lock(this->Mutex);
  dropped.swap(this->Before);
  return moment;
}

std::shared_ptr<const Stage> LiveScene::stageWith(const CameraDescription& camera, std::size_t& index) const
{
  const std::vector<CameraDescription>& own = this->Scene.cameras;
  const auto called = [&own](const std::string& name)
  { return std::find_if(own.begin(), own.end(), [&](const CameraDescription& one) { return one.name == name; }); };
  const auto found = called(camera.name);
  index = static_cast<std::size_t>(found - own.begin());
  if (found != own.end())
  {
    return this->stage();
  }
  SceneDescription more = this->Scene;
  more.order.clear(); // lists its own
  more.cameras.push_back(camera);
  std::string& name = more.cameras.back().name;
  for (name = "eye"; called(name) != own.end();)
  {
    name += '_';
  }
  return Stage::make(std::move(more), this->Models);
}

void LiveScene::keep(std::shared_ptr<const HitShader> shader) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Shader = std::move(shader);
}

} // namespace dgtk
