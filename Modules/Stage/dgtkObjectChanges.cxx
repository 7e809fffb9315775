// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjectChanges.h"

#include "dgtkModelClock.h"

#include <map>
#include <string>

namespace dgtk
{

ObjectChanges::ObjectChanges(const Stage& stage)
  : Scene(stage.description())
  , First(this->Scene.firstFrame())
  , Last(this->Scene.lastFrame())
  , Poses(this->Scene)
  , Begin(stage.at(this->First))
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < this->Scene.objects.size(); ++i)
  {
    places[this->Scene.objects[i].name] = i;
  }
  for (const Instance& instance : this->Begin->instances)
  {
    this->Objects.push_back(places.at(instance.name));
  }
}

std::vector<PlacedObject> ObjectChanges::placesAt(double frame) const
{
  const std::vector<Affine3> world = this->Poses.at(frame);
  std::vector<PlacedObject> places;
  places.reserve(this->Objects.size());
  for (const std::size_t object : this->Objects)
  {
    places.push_back({ world[object], this->Scene.objects[object].visible.at(frame) });
  }
  return places;
}

std::vector<ObjectChange> ObjectChanges::changes() const
{
  std::vector<ObjectChange> changes;
  changes.reserve(this->Objects.size());
  for (std::size_t i = 0; i < this->Objects.size(); ++i)
  {
    changes.push_back({ this->moves(i), this->deforms(i) });
  }
  return changes;
}

bool ObjectChanges::moves(std::size_t object) const
{
  const std::size_t index = this->Objects[object];
  bool same = true;
  const Affine3 begin = this->Poses.of(index, this->First);
  for (int frame = this->First + 1; same && this->Poses.moves(index) && frame <= this->Last; ++frame)
  {
    same = this->Poses.of(index, frame) == begin;
  }
  return !same;
}

bool ObjectChanges::deforms(std::size_t object) const
{
  const Instance& instance = this->Begin->instances[object];
  const ObjectDescription& description = this->Scene.objects[this->Objects[object]];
  const Model& model = *instance.model;
  const int animation = model.deformation ? findAnimation(this->Scene, description, model) : -1;
  if (animation < 0 || model.deformation->holds(animation))
  {
    return false;
  }
  const auto momentOf = [&](int frame)
  { return momentAt(description.animation, model, animation, frame, this->Scene.fps); };
  const ModelMoment begin = momentOf(this->First);
  GeometryCache cache;
  for (int frame = this->First + 1; frame <= this->Last; ++frame)
  {
    const ModelMoment moment = momentOf(frame);
    const bool sameMoment = moment.frame == begin.frame && moment.wrap == begin.wrap;
    if (!sameMoment && cache.get(model, moment)->positions != instance.geometry->positions)
    {
      return true;
    }
  }
  return false;
}

} // namespace dgtk
