// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFourItems_h
#define dgtkFourItems_h

#include "dgtkSceneDocument.h"
#include "dgtkTestSupport.h"

namespace dgtk::test
{

inline const SceneItem creature{ SceneItem::Kind::Object, 0 };
inline const SceneItem crate{ SceneItem::Kind::Object, 1 };
inline const SceneItem lamp{ SceneItem::Kind::Light, 0 };
inline const SceneItem eye{ SceneItem::Kind::Camera, 0 };

/// An animated model, a rigid one, a light with keys at 4 and 8, a camera with one at 20; 12 is the scene's own.
inline void fill(SceneDocument& document)
{
  document.edit("all",
    [](SceneDescription& scene)
    {
      scene.objects.resize(2);
      scene.objects[0].name = "creature";
      scene.objects[0].model = sourceFile("Data/Models/creature.md2");
      scene.objects[0].animation.start = 10;
      scene.objects[0].animation.loop = false;
      scene.objects[0].animation.sequence = "walk";
      scene.objects[1].name = "crate";
      scene.objects[1].model = sourceFile("Data/Models/crate.ac");
      scene.lights.resize(1);
      scene.lights[0].name = "lamp";
      scene.lights[0].position.keys = { { 4, Eigen::Vector3d(0, 0, 0), Interpolation::Step },
        { 8, Eigen::Vector3d(1, 0, 0) } };
      scene.cameras.resize(1);
      scene.cameras[0].name = "eye";
      scene.cameras[0].fovY.keys = { { 20, 50 } };
      scene.extraKeyFrames = { 12 };
    });
}

} // namespace dgtk::test

#endif
