// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleWorld.h"

#include "dgtkRaySource.h"

#include <algorithm>
#include <utility>

namespace dgtk
{

SampleWorld::SampleWorld(SceneDescription scene, SampleModels& models)
  : Scene(std::move(scene))
  , Models(models)
{
}

SampleWorld::Moment& SampleWorld::momentAt(int frame)
{
  if (!this->TheStage)
  {
    this->TheStage = this->Models.stage(this->Scene);
    const std::vector<bool> moving = this->TheStage->movingObjects();
    this->Moves = std::find(moving.begin(), moving.end(), true) != moving.end() ||
                  std::any_of(this->Scene.objects.begin(), this->Scene.objects.end(),
                    [](const ObjectDescription& object) { return object.visible.animated(); });
  }
  const int place = this->Moves ? frame : this->Scene.firstFrame();
  Moment& moment = this->Moments[place];
  if (!moment.state)
  {
    moment.state = this->TheStage->at(place);
  }
  return moment;
}

std::shared_ptr<const SceneState> SampleWorld::stateAt(int frame) { return this->momentAt(frame).state; }

const SurfaceDistance& SampleWorld::surfacesAt(int frame)
{
  Moment& moment = this->momentAt(frame);
  if (!moment.surfaces)
  {
    moment.surfaces = std::make_unique<SurfaceDistance>(moment.state);
  }
  return *moment.surfaces;
}

const OcclusionQuery& SampleWorld::queryAt(int frame)
{
  Moment& moment = this->momentAt(frame);
  if (!moment.query)
  {
    moment.query = makeOcclusionQuery();
    moment.query->setScene(moment.state);
  }
  return *moment.query;
}

} // namespace dgtk
