// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneSamples_h
#define dgtkSceneSamples_h

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkSceneDescription.h"
#include "dgtkTestSupport.h"

#include <cstdio>
#include <fstream>
#include <string>

namespace dgtk::test
{

/// The example of appendix B.3 of the thesis.
inline const std::string thesisExample = R"(3
glObject_AC: tuxedo.ac
glObject_AC: world.ac
glObject_Camera: ( 60, 0.1, 1000, 1.33 )
[ 2.45 0 -7.24999, -4.5 0 4.09998, 0 1 0 ]
2
0
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 2.45 0 -7.24999 > { 1.0000 , < 0, 0, 0 > }
< -4.5 0 4.09998 > { 1.00000 ,< 0, 0, 0 > }
2
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 2.45 0 -7.24999 > { 1.0000 , < 0, 0, 0 > }
< -4.5 0 4.09998 > { 1.00000 ,< 0, 0, 0 > }
)";

/// Everything that .scene can say, in an order of its own.
inline const std::string richThesisScene = R"(5
glObject_Light: sun ( 1 0.9 0.8, 0.5 0.5 0.5, 0.1 0.1 0.1 )
glObject_Md2: monsters/orc one.md2
glObject_Camera: ( 45.5, 0.25, 100000, 1.7777777777777777 )
[ 1 2 3, 4 5 6, 0 0.1 1 ]
glObject_Light:
glObject_3DS: ../shared/ball.3ds
3
0
< 0.1 0.2 0.30000000000000004 > { 1, < 0, 0, 0 > }
< -1e-07 123456789012345.67 3 > { 0.7071, < 0, 0.7071, 0 > } [ 2, 2, 0.5 ]
< 1 2 3 > { 0.5, < 0.5, -0.5, 0.5 > }
< 4 5 6 > { 1, < 0, 0, 0 > } [ 3 3 3 ]
< -0 7 8 > { 0, < 0, 0, 1 > }
< 5e-324 1.7976931348623157e-308 9 > { -1, < 0, 0, 0 > }
7
< 0.1 0.2 0.3 > { 1, < 0, 0, 0 > }
< -1 20 3 > { 0.71, < 0, 0.71, 0 > } [ 1, -2, 0.5 ]
< 1 2 3.5 > { 1, < 0, 0, 0 > }
< 4 5 6 > { 1, < 0, 0, 0 > } [ 3 3 3 ]
< 0 7 8 > { 0, < 0, 1, 0 > }
< 5 1 9 > { -1, < 0, 0, 0 > }
100
< 0.1 0.2 0.3 > { 1, < 0, 0, 0 > }
< -1 20 3 > { 0.7, < 0, 0.71, 0 > } [ 1, -2, 0.5 ]
< 1 2 3.5 > { 1, < 0, 0, 0 > }
< 4 5 6 > { 1, < 0, 0, 0 > } [ 3 3 3 ]
< 0 7 8 > { 0, < 0, 1, 0 > }
< 5 1 9 > { -1, < 0, 0, 0 > }
)";

/// Everything that .json can say.
inline const std::string richJson = R"({
  // A scene with every key.
  "$schema": "scene.schema.json",
  "version": 1,
  "units": "m",
  "upAxis": "z",
  "fps": 12.5,
  "background": [0.25, 0.5, 1],
  "seed": 9007199254740991,
  "keyFrames": [0, 3, 50],
  "objects": [
    {
      "name": "table",
      "class": "furniture",
      "model": "models/table.obj",
      "parent": "",
      "visible": false,
      "position": [1, 2, 3],
      "orientation": [0.7071067811865476, 0, 0, 0.7071067811865475],
      "scale": 2
    },
    {
      "model": "models/orc.md2",
      "parent": "table",
      "position": { "keys": [[0, [0, 0, 0]], [10, [1, 0, 0]], [30, [1, 5, 0]]], "interpolation": "smooth" },
      "orientation": { "keys": [[3, [1, 0, 0, 0]], [4, [0, 1, 0, 0]]], "interpolation": "step" },
      "scale": { "value": [1, 2, 3], "keys": [[0, 1, "step"], [9, [1, 2, 1]]] },
      "animation": { "sequence": "run", "start": 2.5, "offset": 1, "rate": 0.5, "loop": false },
      "materials": {
        "*": { "ambient": [0, 0, 0], "diffuse": [1, 0, 0], "specular": [0, 1, 0], "emission": [0, 0, 1] },
        "skin": { "shininess": 12, "opacity": 0.5, "texture": "textures/a.png" }
      },
      "skin": "2"
    }
  ],
  "lights": [
    { "name": "sun", "kind": "directional", "position": [1, 1, 1], "target": [0, 0, 0], "intensity": 2 },
    { "kind": "spot", "enabled": false, "position": { "keys": [[0, [0, 0, 9]]] }, "target": [0, 0, 1],
      "ambient": [0.1, 0.1, 0.1], "diffuse": [3, 0, 0], "specular": [0, 0, 0], "attenuation": [1, 0.5, 0.25],
      "coneAngle": 45, "exponent": 2, "unused": { "orientation": [0, 1, 0, 0], "scale": [2, 2, 2] } },
    { "kind": "head" },
    { "kind": "point" }
  ],
  "cameras": [
    { "name": "left", "width": 1280, "height": 960, "K": [[1000, 0.5, 640], [0, 1100, 480.25], [0, 0, 1]],
      "near": 0.5, "far": 50, "position": [0, 0, 5], "orientation": [0, 1, 0, 0] },
    { "name": "right", "fovY": { "keys": [[0, 60], [50, 20]] }, "aspect": 1.5, "eye": [9, 0, 0], "lookAt": [0, 0, 0],
      "up": [0, 1, 0] },
    { "model": "orthographic", "viewHeight": 4, "eye": [0, 9, 0], "lookAt": [0, 0, 0],
      "unusedEye": { "orientation": { "keys": [[0, [0, 0, 1, 0]]] } }, "unusedLookAt": { "scale": [1, 1, 2] } }
  ],
  "order": ["camera", "object", "light", "light", "object", "camera", "light", "light", "camera"]
}
)";

/// Reads a scene from text under a name in a temporary folder.
inline SceneDescription readText(const TemporaryFolder& folder, const std::string& name, const std::string& text)
{
  // Quicker than writeFile() and than overwriting, which both wait for the disk.
  std::remove(folder.path(name).c_str());
  std::ofstream(folder.path(name), std::ios::binary) << text;
  return readScene(folder.path(name));
}

/// The message of the InputError that reading the text raises, with the folder cut off; "" when there is none.
inline std::string refusalIn(const TemporaryFolder& folder, const std::string& name, const std::string& text)
{
  const std::string message = thrownBy<InputError>([&] { readText(folder, name, text); });
  return message.rfind(folder.path() + '/', 0) == 0 ? message.substr(folder.path().size() + 1) : message;
}
inline std::string refusalOf(const std::string& name, const std::string& text) { return refusalIn({}, name, text); }

} // namespace dgtk::test

#endif
