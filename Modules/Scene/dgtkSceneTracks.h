// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneTracks_h
#define dgtkSceneTracks_h

#include "dgtkSceneDescription.h"

namespace dgtk
{

// The lists of tracks: there are no others. Each calls function(track, pose); pose: it is position, orientation or
// scale of an object, position of a light, or of the pose of a camera that is in use.

/// The tracks that belong to no item.
template <typename Scene, typename Function>
void forEachTrackOfScene(Scene& scene, Function&& function)
{
  function(scene.background, false);
  function(scene.fog.color, false);
  function(scene.fog.density, false);
  function(scene.fog.start, false);
}

/// The tracks that an override has: function(track).
template <typename Override, typename Function>
void forEachTrackOf(Override& material, Function&& function)
{
  const auto offer = [&function](auto& track)
  {
    if (track)
    {
      function(*track);
    }
  };
  offer(material.ambient);
  offer(material.diffuse);
  offer(material.specular);
  offer(material.emission);
  offer(material.shininess);
  offer(material.opacity);
  offer(material.metallic);
  offer(material.roughness);
  offer(material.bumpScale);
}

/// Every track of an item.
template <typename Scene, typename Function>
void forEachTrackOf(Scene& scene, const SceneItem& item, Function&& function)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
    {
      auto& object = scene.objects[item.index];
      function(object.position, true);
      function(object.orientation, true);
      function(object.scale, true);
      function(object.visible, false);
      for (auto& material : object.materials)
      {
        forEachTrackOf(material, [&function](auto& track) { function(track, false); });
      }
      break;
    }
    case SceneItem::Kind::Light:
    {
      auto& light = scene.lights[item.index];
      function(light.position, true);
      function(light.target, false);
      function(light.ambient, false);
      function(light.diffuse, false);
      function(light.specular, false);
      function(light.coneAngle, false);
      function(light.exponent, false);
      function(light.intensity, false);
      function(light.enabled, false);
      function(light.unused.orientation, false);
      function(light.unused.scale, false);
      break;
    }
    case SceneItem::Kind::Camera:
    {
      auto& camera = scene.cameras[item.index];
      function(camera.eye, !camera.posed);
      function(camera.lookAt, !camera.posed);
      function(camera.position, camera.posed);
      function(camera.orientation, camera.posed);
      function(camera.up, false);
      function(camera.fovY, false);
      function(camera.viewHeight, false);
      for (auto& [name, value] : camera.parameters)
      {
        for (auto& number : value.numbers)
        {
          function(number, false);
        }
      }
      function(camera.lens.focus, false);
      for (auto* unused : { &camera.unusedEye, &camera.unusedLookAt })
      {
        function(unused->orientation, false);
        function(unused->scale, false);
      }
      break;
    }
  }
}

/// Every track of a scene.
template <typename Scene, typename Function>
void forEachTrack(Scene& scene, Function&& function)
{
  forEachTrackOfScene(scene, function);
  for (const SceneItem& item : scene.items())
  {
    forEachTrackOf(scene, item, function);
  }
}

} // namespace dgtk

#endif
