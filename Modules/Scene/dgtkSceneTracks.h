// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneTracks_h
#define dgtkSceneTracks_h

#include "dgtkSceneDescription.h"

namespace dgtk
{

/// Calls function(track, pose) for every track of an item, and there is no other list of them; pose: it is position,
/// orientation or scale of an object, position of a light, or of the pose of a camera that is in use.
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
      break;
    }
    case SceneItem::Kind::Light:
    {
      auto& light = scene.lights[item.index];
      function(light.position, true);
      function(light.target, false);
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

} // namespace dgtk

#endif
