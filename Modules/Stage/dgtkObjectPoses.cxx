// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjectPoses.h"

#include "dgtkSceneDescription.h"

#include <string>
#include <unordered_map>

namespace dgtk
{

Affine3 localPose(const ObjectDescription& object, double frame)
{
  return { object.orientation.at(frame).matrix() * object.scale.at(frame).asDiagonal(), object.position.at(frame) };
}

ObjectPoses::ObjectPoses(const SceneDescription& scene)
  : Scene(scene)
  , Places(scene.objects.size())
{
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    index[scene.objects[i].name] = i;
  }
  std::vector<char> done(this->Places.size(), 0);
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    // Up to an ancestor that is placed already, then back down.
    std::vector<std::size_t> chain;
    for (std::size_t at = i; at != noParent && !done[at]; at = this->Places[at].parent)
    {
      const std::string& parent = scene.objects[at].parent;
      this->Places[at].parent = parent.empty() ? noParent : index.at(parent);
      chain.push_back(at);
      done[at] = 1;
    }
    this->ParentsFirst.insert(this->ParentsFirst.end(), chain.rbegin(), chain.rend());
  }
  for (const std::size_t i : this->ParentsFirst)
  {
    const ObjectDescription& object = scene.objects[i];
    Place& place = this->Places[i];
    const Place* const parent = place.parent == noParent ? nullptr : &this->Places[place.parent];
    place.moves = object.position.animated() || object.orientation.animated() || object.scale.animated() ||
                  (parent != nullptr && parent->moves);
    if (!place.moves)
    {
      const Affine3 local = localPose(object, 0);
      place.world_from_object = parent == nullptr ? local : parent->world_from_object * local;
    }
  }
}

Affine3 ObjectPoses::of(std::size_t object, double frame) const
{
  const Place& place = this->Places[object];
  if (!place.moves)
  {
    return place.world_from_object;
  }
  const Affine3 local = localPose(this->Scene.objects[object], frame);
  return place.parent == noParent ? local : this->of(place.parent, frame) * local;
}

std::vector<Affine3> ObjectPoses::at(double frame) const
{
  std::vector<Affine3> world(this->Places.size());
  for (const std::size_t i : this->ParentsFirst)
  {
    const Place& place = this->Places[i];
    if (!place.moves)
    {
      world[i] = place.world_from_object;
      continue;
    }
    const Affine3 local = localPose(this->Scene.objects[i], frame);
    world[i] = place.parent == noParent ? local : world[place.parent] * local;
  }
  return world;
}

} // namespace dgtk
