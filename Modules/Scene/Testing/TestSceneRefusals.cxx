// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <limits>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

namespace
{
struct Case
{
  std::string text;
  std::string message;
};

const std::string thesisCamera = "glObject_Camera: ( 60, 0.1, 1000, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n";
const std::string key = "< 0 0 0 > { 1, < 0 0 0 > }\n";

/// Text of a .json scene with one object or camera that has these members besides what it needs.
std::string withObject(const std::string& members)
{
  return "{\n\"objects\": [\n{ \"model\": \"a.ac\",\n" + members + "\n}]\n}\n";
}
std::string withCamera(const std::string& members)
{
  return "{\n\"cameras\": [\n{ \"eye\": [0, 0, 5], \"lookAt\": [0, 0, 0],\n" + members + "\n}]\n}\n";
}
std::string withLight(const std::string& members)
{
  return "{\n\"lights\": [\n{ \"name\": \"l\",\n" + members + "\n}]\n}\n";
}
} // namespace

TEST(SceneRefusals, Thesis)
{
  const std::vector<Case> cases{
    { "", "a.scene:1: number of objects (expected a whole number from 0, found the end of the file)" },
    { "three\n", "a.scene:1: number of objects (expected a whole number from 0, found 'three')" },
    { "-1\n", "a.scene:1: number of objects (expected a whole number from 0, found '-1')" },
    { "1000000000\nglObject_AC: a.ac\n1\n0\n" + key,
      "a.scene:3: object 2 of 1000000000 (expected glObject_AC, glObject_3DS, glObject_Md2, glObject_Light or "
      "glObject_Camera, found '1')" },
    { "1\nglObject_AC: a.ac\n1000000000\n0\n" + key,
      "a.scene:6: key frame 2 of 1000000000 (expected a frame number, found the end of the file)" },
    { "99999999999999999999\n", "a.scene:1: number of objects (expected a whole number from 0" },
    { "1\nglObject_XY: a.ac\n0\n", "a.scene:2: object 1 of 1 (expected glObject_AC, glObject_3DS, glObject_Md2, "
                                   "glObject_Light or glObject_Camera, found 'glObject_XY')" },
    { "1\nglObject_AC a.ac\n0\n", "a.scene:2: object 1 of 1 (expected ':', found 'a.ac')" },
    { "1\nglObject_AC:\n0\n", "a.scene:2: object 1 of 1 (expected the name of a model file, found '')" },
    { "1\nglObject_3DS: a.ac\n0\n", "a.scene:2: object 1 of 1 (expected a model that ends in .3ds, found 'a.ac')" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 nan > { 1 <0 0 0> }\n",
      "a.scene:5: model 1 at frame 0: position (expected a finite number, found 'nan')" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 1e999 > { 1 <0 0 0> }\n",
      "a.scene:5: model 1 at frame 0: position (expected a number within the range of double precision" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 1e16 > { 1 <0 0 0> }\n",
      "a.scene:5: model 1 at frame 0: position is out of range (expected a number from -1e15 to 1e15, found '1e16')" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 > { 1 <0 0 0> }\n",
      "a.scene:5: model 1 at frame 0: position (expected a number, found '>')" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 0 > { 0 <0 0 0> }\n",
      "a.scene:5: model 1 at frame 0: orientation is not a rotation (expected a quaternion (w, x, y, z) of length 1, "
      "found length 0)" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 0 > { 1 <0.2 0 0> }\n", "orientation is not a rotation" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 0 > { 1 <0 0 0> } [1 0 1]\n",
      "a.scene:5: model 1 at frame 0: scale is out of range (expected a number other than 0" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 0 >\n{\n1 <0 0 0> } [1\n2\n0]\n",
      "a.scene:9: model 1 at frame 0: scale is out of range (expected a number other than 0" },
    { "1\nglObject_AC: a.ac\n1\n0\n< 0 0 0 >\n{\n1 <0.2 0 0>\n}\n",
      "a.scene:7: model 1 at frame 0: orientation is not a rotation" },
    { "1\nglObject_AC: a.ac\n2\n5\n" + key + "5\n" + key,
      "a.scene:6: key frame 2 of 2 has the frame number of the one before (expected more than 5, found '5')" },
    { "1\nglObject_AC: a.ac\n2\n5\n" + key + "3\n" + key,
      "a.scene:6: key frame 2 of 2 is out of order (expected more than 5, found '3')" },
    { "1\nglObject_AC: a.ac\n1\n-3\n" + key, "a.scene:4: key frame 1 of 1 is out of range" },
    { "1\nglObject_AC: a.ac\n1\n0.5\n" + key, "a.scene:4: key frame 1 of 1 (expected a whole number from 0 to 999999" },
    { "1\nglObject_AC: a.ac\n1\n0\n" + key + key,
      "a.scene:6: text after the last key frame (expected the end of the file, found '<')" },
    { "1\nglObject_Camera: ( 180, 0.1, 1000, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n0\n",
      "a.scene:2: object 1 of 1: field of view is out of range (expected degrees above 0 and below 180, found '180')" },
    { "1\nglObject_Camera: ( 60, 0, 1000, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n0\n",
      "a.scene:2: object 1 of 1: near is out of range (expected a number above 0, up to 1e15, found '0')" },
    { "1\nglObject_Camera: ( 60, 10, 10, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n0\n",
      "a.scene:2: camera 'Camera0': far is not beyond near (expected more than 10, found 10)" },
    { "1\nglObject_Camera: ( 60, 1, 10, 1.33 )\n[ 0 0 5, 0 0 5, 0 1 0 ]\n0\n",
      "a.scene:2: camera 'Camera0': lookAt is the eye itself (expected another point)" },
    { "1\nglObject_Camera: ( 60, 1, 10, 1.33 )\n[ 0 0 5, 0 0 0, 0 0 2 ]\n0\n",
      "a.scene:2: camera 'Camera0': up is zero or along the view" },
    { "1\n" + thesisCamera + "1\n7\n" + key + key, "camera 'Camera0': lookAt is the eye itself at frame 7" },
    { "1\nglObject_Camera: ( 60, 1, 10 )\n[ 0 0 5, 0 0 5, 0 1 0 ]\n0\n",
      "a.scene:2: object 1 of 1: aspect (expected a number, found ')')" },
    { "1\rglObject_AC: a.ac\r1\r\n0\r< nan 0 0 > { 1, < 0, 0, 0 > }\r",
      "a.scene:5: model 1 at frame 0: position (expected a finite number, found 'nan')" },
    { std::string("1\nglObject_AC: a\x01.ac\n0\n"), "a.scene:2: object 1 of 1 (expected the name of a model file" },
    { std::string("\x7f"
                  "ELF\x02\x01\x01\0\0\0",
        10),
      "a.scene:1: number of objects" },
  };
  for (const Case& c : cases)
  {
    EXPECT_THAT(refusalOf("a.scene", c.text), HasSubstr(c.message)) << c.text;
  }
}

TEST(SceneRefusals, JsonSyntax)
{
  const std::string invalid = "is not valid JSON (expected ";
  const std::vector<Case> cases{
    { "", "a.json:1: " + invalid + "a value, found the end of the file)" },
    { "[]", "a.json:1: has the wrong type (expected an object, found a list of 0)" },
    { "{\n\n\"fps\": }\n", "a.json:3: " + invalid + "a value, found '}')" },
    { "{\n\"fps\": nan\n}\n", "a.json:2: " + invalid + "a value, found 'na')" },
    { "{\n\"fps\":\n\nx", "a.json:4: " + invalid + "a value, found 'x')" },
    { "{\n\"fps\": 1e999\n}\n",
      "a.json:2: number cannot be used (expected a number within the range of double precision, found '1e999')" },
    { "{\n\"fps\": 25,\n\"fps\": 30\n}\n", "a.json:3: key 'fps' is given twice" },
    { "{\"fps\": 25\n\"units\": 1}", "a.json:2: " + invalid + "',' or '}', found a text)" },
    { "{\"fps\" 25}", "a.json:1: " + invalid + "':', found a number)" },
    { "{\"fps\": 25,}", "a.json:1: " + invalid + "a key in quotes, found '}')" },
    { "{'fps': 25}", "a.json:1: " + invalid + "a key in quotes, found ''')" },
    { "{\"a\": [1 true]}", "a.json:1: " + invalid + "',' or ']', found true)" },
    { "{\"a\": [1", "a.json:1: " + invalid + "',' or ']', found the end of the file)" },
    { "{} {}", "a.json:1: " + invalid + "the end of the file, found '{')" },
    { "{\"a\": -}", "a.json:1: " + invalid + "a digit, found '-}')" },
    { "{\"a\": \"\\q\"}", "a.json:1: " + invalid + "an escape that JSON has: " },
    { "{\"a\": \"b\tc\"}", "a.json:1: " + invalid + "an escape for a control character, found '\"b<U+0009>')" },
    { "{\"a\": \"b", "a.json:1: " + invalid + "a quote at the text's end, found '\"b')" },
    // A terminal is shown no bytes that are no text.
    { "{\n\"units\": \"m\xff\"\n}", "a.json:2: " + invalid + "UTF-8, found '\"m\\xFF')" },
    { "{\"units\": m\x7f}", invalid + "a value, found 'm')" },
    { std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "a.json:1: " + invalid + "a value, found '\\x89')" },
    { "{\"x\": " + std::string(1000, '['), "a.json:1: is nested too deeply (expected at most 32 levels)" },
    { std::string("{}\n\0", 4), "a.json:2: " + invalid }, // as after a machine's failure
    { std::string("{}\0{}", 5), "a.json:1: " + invalid },
    { "{\n/* open", "a.json:2: " + invalid + "a comment as // to the line's end or as /* to */, found " },
    { "{\"version\": 1, \"" + std::string(500, 'a') + "\n", std::string(30, 'a') },
  };
  for (const Case& c : cases)
  {
    EXPECT_THAT(refusalOf("a.json", c.text), HasSubstr(c.message)) << c.text;
  }
}

TEST(SceneRefusals, JsonValues)
{
  const std::vector<Case> cases{
    { "{\n\"backgroud\": [0, 0, 0]\n}", "a.json:2: backgroud is an unknown key (expected perhaps 'background', found "
                                        "'backgroud')" },
    { "{\n\"zzz\": 1\n}",
      "a.json:2: zzz is an unknown key (expected one of $schema, version, dataset, units, metresPerUnit, upAxis, fps" },
    { "{\n\"version\": 2\n}", "a.json:2: version is out of range (expected 1, found 2)" },
    { "{\n\"fps\": \"25\"\n}", "a.json:2: fps has the wrong type (expected a number above 0, up to 1e6, found '25')" },
    { "{\n\"fps\": 0\n}", "a.json:2: fps is out of range" },
    { "{\n\"seed\": 9007199254740993\n}", "a.json:2: seed is out of range" },
    { "{\n\"seed\": 1.5\n}", "a.json:2: seed is not a whole number" },
    { "{\n\"upAxis\": \"x\"\n}", "a.json:2: upAxis is not known (expected one of y, z, found 'x')" },
    { "{\n\"background\": [0, 0]\n}",
      "a.json:2: background has the wrong type (expected a list of 3, found a list of 2)" },
    { "{\n\"background\": [0,\n 0,\n 2]\n}",
      "a.json:4: background[2] is out of range (expected a number from 0 to 1, found 2)" },
    { "{\n\"keyFrames\": [5, 5]\n}", "a.json:2: keyFrames[1] is out of order (expected more than 5, found 5)" },
    { "{\n\"keyFrames\": [1000000000]\n}", "a.json:2: keyFrames[0] is out of range" },
    { "{\n\"objects\": [\n{ \"model\": \"a.ac\" },\n{\n}\n]\n}",
      "a.json:4: objects[1] has no model (expected \"model\": a file)" },
    { "{\n\"objects\": { }\n}", "a.json:2: objects has the wrong type (expected a list, found an object)" },
    { "{\n\"order\": [\"object\"]\n}", "a.json:2: order does not list every object (expected 0, found 1)" },
    { withObject("\"scael\": 2"),
      "a.json:4: objects[0].scael is an unknown key (expected perhaps 'scale', found 'scael')" },
    { withObject("\"scale\": [1,\n0, 1]"),
      "a.json:5: objects[0].scale[1] is out of range (expected a number other than 0" },
    { withObject("\"scale\": 0"), "a.json:4: objects[0].scale is out of range" },
    { withObject("\"orientation\": [0, 0, 0, 0]"),
      "a.json:4: objects[0].orientation is not a rotation (expected a quaternion "
      "(w, x, y, z) of length 1, found length 0)" },
    { withObject("\"orientation\": [2, 0, 0, 0]"), "found length 2)" },
    { withObject("\"position\": {\"keys\": []}"), "a.json:4: objects[0].position has no key frames" },
    { withObject("\"position\": {\"keys\": [[0, [0, 0, 0]],\n[0, [1, 0, 0]]]}"),
      "a.json:5: objects[0].position.keys[1][0] is a key frame twice (expected more than 0, found 0)" },
    { withObject("\"position\": {\"keys\": [[4, [0, 0, 0]],\n[3, [1, 0, 0]]]}"),
      "a.json:5: objects[0].position.keys[1][0] is out of order (expected more than 4, found 3)" },
    { withObject("\"position\": {\"keys\": [[0.5, [0, 0, 0]]]}"),
      "objects[0].position.keys[0][0] is not a whole number" },
    { withObject("\"position\": {\"keys\": [[0]]}"),
      "objects[0].position.keys[0] has the wrong type (expected [frame, value] or [frame, value, interpolation]" },
    { withObject("\"position\": {\"keys\": [[0, [0, 0, 0],\n\"stop\"]]}"),
      "a.json:5: objects[0].position.keys[0][2] is not known (expected one of" },
    { withObject("\"position\": {\"keys\": [[0, [0, 0, 0], \"step\", 1]]}"),
      "objects[0].position.keys[0] has the wrong type" },
    { withObject("\"scale\": {\"keys\": [[0, -1], [4, 1]]}"), "scale passes through 0 at frame 2" },
    { withObject("\"scale\": {\"interpolation\": \"step\", \"keys\": [[0, -1, \"linear\"], [4, 1]]}"),
      "scale passes through 0 at frame 2" },
    { withObject("\"rotation\": [1, 0, 0, 0]"), "expected perhaps 'orientation', found 'rotation'" },
    { withCamera("\"target\": [0, 0, 0]"), "expected perhaps 'lookAt', found 'target'" },
    { withObject("\"position\": {\"interplation\": \"step\"}"), "perhaps 'interpolation'" },
    { withObject("\"parent\": \"nobody\""),
      "a.json:4: objects[0].parent is no object of the scene (expected the name of an "
      "object, found 'nobody')" },
    { withObject("\"name\": \"me\", \"parent\": \"me\""),
      "a.json:4: objects[0].parent leads back to the object itself" },
    { "{\"objects\": [\n{\"model\": \"a.ac\", \"name\": \"a\", \"parent\": \"b\"},\n{\"model\": \"a.ac\", \"name\": "
      "\"b\", "
      "\"parent\": \"c\"},\n{\"model\": \"a.ac\", \"name\": \"c\", \"parent\": \"a\"}]}",
      "a.json:4: objects[2].parent leads back to the object itself" },
    { "{\"objects\": [\n{\"model\": \"a.ac\", \"name\": \"a\"},\n{\"model\": \"a.ac\", \"name\": \"a\"}]}",
      "a.json:3: objects[1].name is taken (expected a name that no other has, found 'a')" },
    { "{\"lights\": [\n{\"name\": \"a\"},\n{\"name\": \"a\"}]}",
      "a.json:3: lights[1].name is taken (expected a name that no other has, found 'a')" },
    { R"({"cameras": [{"name": "a", "eye": [0, 0, 5], "lookAt": [0, 0, 0]},
      {"name": "a", "eye": [0, 0, 6], "lookAt": [0, 0, 0]}]})",
      "a.json:2: cameras[1].name is taken (expected a name that no other has, found 'a')" },
    { R"({"cameras": [{"name": "abc ", "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]})",
      "a dot, dash or space, not ending with a space, found 'abc ')" },
    { R"({"cameras": [{"name": "contact.png", "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]})",
      "(expected a name that is not that of a file of datasets, found 'contact.png')" },
    { withObject("\"visible\": 1"), "objects[0].visible has the wrong type (expected true or false, found 1)" },
    { withObject("\"visible\": {\"keys\": [[0, 1]]}"),
      "objects[0].visible.keys[0][1] has the wrong type (expected true or false, found 1)" },
    { withObject("\"visible\": {\"keys\": [[0, true, \"linear\"]]}"),
      "objects[0].visible.keys[0][2] is not known (expected one of step, found 'linear')" },
    { withObject("\"visible\": {\"keys\": [[0, true]], \"interpolation\": \"smooth\"}"),
      "objects[0].visible.interpolation is not known (expected one of step, found 'smooth')" },
    { withObject("\"visible\": {\"keys\": []}"), "objects[0].visible has no key frames" },
    { withObject("\"materials\": {\"*\": {\"texture\": {\"keys\": [[0, \"a.png\"]]}}}"),
      "objects[0].materials.*.texture has the wrong type" },
    { withObject("\"animation\": {\"rate\": -1}"), "objects[0].animation.rate is out of range" },
    { withObject("\"materials\": {\"*\": {\"opacity\": 1.5}}"),
      "a.json:4: objects[0].materials.*.opacity is out of range" },
    { withObject("\"name\": \"a\\u0000b\""), "objects[0].name cannot be used" },
    { withObject("\"materials\": {\"\": {\"opacity\": 1}}"), "a.json:4: objects[0].materials. cannot be used" },
    { withObject("\"keypoints\": {\"\": [0, 0, 0]}"),
      "a.json:4: objects[0].keypoints. has a name that cannot be used" },
    { withLight("\"kind\": \"area\""),
      "lights[0].kind is not known (expected one of point, head, directional, spot, found "
      "'area')" },
    { withLight("\"kind\": \"spot\""), "lights[0].target is the light's own position at frame 0" },
    { withLight("\"kind\": \"spot\", \"target\": {\"keys\": [[0, [1, 0, 0]], [5, [0, 0, 0]]]}"),
      "a.json:4: lights[0].target is the light's own position at frame 5" },
    { withLight("\"kind\": \"spot\", \"target\": {\"keys\": [[0, [1, 0, 0]], [4, [-1, 0, 0]]]}"),
      "a.json:4: lights[0].target is the light's own position at frame 2" },
    { withLight("\"kind\": \"spot\", \"target\": {\"keys\": [[90000, [1, 0, 0]], [90004, [-1, 0, 0]]]}"),
      "a.json:4: lights[0].target is the light's own position at frame 90002" },
    { withLight("\"attenuation\": [0, 0, 0]"), "a.json:4: lights[0].attenuation is zero" },
    { withLight("\"coneAngle\": 91"),
      "lights[0].coneAngle is out of range (expected degrees above 0, up to 90, found 91)" },
    { withCamera("\"near\": 2, \"far\": 1"),
      "a.json:4: cameras[0].far is not beyond near (expected more than 2, found 1)" },
    { withCamera("\"near\": 0"), "a.json:4: cameras[0].near is out of range" },
    { withCamera("\"fovY\": 180"),
      "a.json:4: cameras[0].fovY is out of range (expected degrees above 0 and below 180, found "
      "180)" },
    { withCamera("\"fovY\": {\"keys\": [[0, 60],\n[1, -5]]}"), "a.json:5: cameras[0].fovY.keys[1][1] is out of range" },
    { withCamera("\"width\": 640"),
      "a.json:3: cameras[0].height is missing or 0 (expected both width and height, or neither)" },
    { withCamera("\"K\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"), "cameras[0].K has no image size" },
    { withCamera("\"K\": [[1, 0, 0], [0, -1, 0], [0, 0, 1]]"),
      "cameras[0].K is not a camera matrix (expected [[fx, s, cx], "
      "[0, fy, cy], [0, 0, 1]] with fx and fy above 0)" },
    { withCamera("\"fovY\": 60, \"K\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
      "cameras[0].fovY does not go together with K" },
    { withCamera("\"position\": [0, 0, 0]"), "a.json:4: cameras[0].position does not go together with eye" },
    { withCamera("\"model\": \"orthographic\", \"fovY\": 3"),
      "a.json:4: cameras[0].fovY is not for a camera of the model 'orthographic' (expected viewHeight, aspect, found "
      "3)" },
    { withCamera("\"viewHeight\": 3"), "a.json:4: cameras[0].viewHeight is not for a camera of the model 'pinhole' "
                                       "(expected fovY, aspect, K, distortion, found 3)" },
    { withCamera("\"up\": [0, 0, 1]"), "a.json:4: cameras[0].up is zero or along the view" },
    { withCamera("\"up\": {\"keys\": [[0, [0, 1, 0]], [3, [0, 0, 1]]]}"),
      "a.json:4: cameras[0].up is zero or along the view at frame 3" },
    { withCamera("\"name\": \"a/b\""), "a.json:4: cameras[0].name cannot be used" },
    { withCamera("\"name\": \"manifest.json\""), "cameras[0].name cannot be used" },
    { "{\"cameras\": [\n{\"eye\": [0, 0, 0]}]}",
      "a.json:2: cameras[0] has no pose (expected eye and lookAt, or position and "
      "orientation)" },
    { "{\"cameras\": [{\"eye\": [0, 0, 0],\n\"lookAt\": [0, 0, 0]}]}",
      "a.json:2: cameras[0].lookAt is the eye itself" },
    { "{\"cameras\": [{\n\"eye\": {\"keys\": [[0, [0, 0, 5]], [2, [0, 0, -5]]]},\n\"lookAt\": [0, 0, 0]}]}",
      "a.json:3: cameras[0].lookAt is the eye itself at frame 1" },
    { withObject("\"scale\": {\"keys\": [[0, [1, -1, 1]], [4, [1, 1, 1]]]}"),
      "a.json:4: objects[0].scale passes through 0 at frame 2" },
    { withCamera("\"shutter\": {\"open\": 1, \"close\": 0}"), "a.json:4: cameras[0].shutter closes before it opens" },
    { withCamera("\"model\": \"orthographic\", \"lens\": {\"aperture\": 1}"),
      "cameras[0].lens is not for this camera" },
    { withCamera("\"lens\": {\"focus\": 0}"), "cameras[0].lens.focus" },
    { "{\"fog\": {\"density\": -1}}", "fog.density" },
    { "{\"environment\": {\"picture\": \"a.hdr\"}}", "environment" },
    { withLight("\"shadowSize\": 15"), "lights[0].shadowSize" },
  };
  for (const Case& c : cases)
  {
    EXPECT_THAT(refusalOf("a.json", c.text), HasSubstr(c.message)) << c.text;
  }
}

TEST(SceneRefusals, Files)
{
  const TemporaryFolder folder;
  makeFolders(folder.path("a.scene"));
  const auto message = [](const std::string& path) -> std::string
  { return thrownBy<InputError>([&] { readScene(path); }); };
  EXPECT_THAT(message(folder.path("a.scene")), HasSubstr("cannot be read (expected a file, found a directory)"));
  EXPECT_THAT(message(folder.path("none.json")), HasSubstr("cannot be read: No such file or directory"));
  writeFile(folder.path("a.txt"), "{}");
  EXPECT_THAT(message(folder.path("a.txt")), HasSubstr("is no scene (expected a name in .scene or .json, found .txt)"));
}

TEST(SceneRefusals, ClaimedCountsCostNothing)
{
  const std::clock_t start = std::clock(); // of this process: others on the machine do not count
  EXPECT_NE(refusalOf("a.scene", "1000000000\n"), "");
  EXPECT_NE(refusalOf("a.scene", "0\n1000000000\n0\n"), "");
  EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC);
}

TEST(SceneRefusals, WhatThesisScenesCannotSay)
{
  struct Change
  {
    std::function<void(SceneDescription&)> make;
    std::string message;
  };
  const Track<Vector> eased = []
  {
    Track<Vector> track;
    track.keys = { { 0, Vector(0, 0, 0) }, { 1, Vector(1, 1, 1) } };
    track.interpolation = Interpolation::Smooth;
    return track;
  }();
  Track<Vector> once = Vector(1, 1, 1);
  once.keys = { { 0, Vector(1, 1, 1) } };
  once.interpolation = Interpolation::Step;
  const std::vector<Change> changes{
    { [](auto& s) { s.fps = 30; }, "scene: fps cannot be said in .scene" },
    { [](auto& s) { s.background = Vector(1, 0, 0); }, "scene: background cannot be said" },
    { [](auto& s) { s.units = "m"; }, "scene: units cannot be said" },
    { [](auto& s) { s.metresPerUnit = 2; }, "scene: metresPerUnit cannot be said" },
    { [](auto& s) { s.dataset["name"] = "x"; }, "scene: dataset cannot be said" },
    { [](auto& s)
      {
        s.objects[0].keypoints.resize(1);
        s.objects[0].keypoints[0].name = "a";
      },
      "object 'a-1': keypoints cannot be said" },
    { [](auto& s) { s.upAxis = UpAxis::Z; }, "scene: upAxis cannot be said" },
    { [](auto& s) { s.seed = 1; }, "scene: seed cannot be said" },
    { [](auto& s) {
       s.classes = { { "", 1 } };
     },
      "scene: classes cannot be said" },
    { [](auto& s) { s.objects[0].name = "fred"; }, "object 'fred': name cannot be said in .scene (expected 'a-1')" },
    { [](auto& s) { s.objects[0].className = "x"; }, "object 'a-1': class cannot be said" },
    { [](auto& s) { s.objects[1].parent = "a-1"; }, "object 'a-2': parent cannot be said" },
    { [](auto& s) { s.objects[0].visible = false; }, "object 'a-1': visible cannot be said" },
    { [](auto& s)
      {
        s.objects[0].model = "x.obj";
        s.objects[0].name = "x-1";
        s.objects[1].name = "a-1";
      },
      "object 'x-1': model 'x.obj' cannot be said in .scene (expected a file in .ac, .acc, .pov, .3ds or .md2)" },
    { [](auto& s) { s.objects[0].animation.rate = 2; }, "object 'a-1': animation.rate cannot be said" },
    { [](auto& s) { s.objects[0].animation.sequence = "run"; }, "object 'a-1': animation.sequence cannot be said" },
    { [](auto& s)
      {
        s.objects[0].materials.resize(1);
        s.objects[0].materials[0].material = "*";
      },
      "object 'a-1': materials cannot be said" },
    { [](auto& s) { s.objects[0].skin = "1"; }, "object 'a-1': skin cannot be said" },
    { [&](auto& s) { s.objects[0].position = eased; },
      "object 'a-1': position cannot be said in .scene (expected linear" },
    { [](auto& s) {
       s.lights[0].position.keys = { { 0, Vector(0, 0, 0), Interpolation::Step }, { 1, Vector(1, 1, 1) } };
     },
      "light 'Light0': position cannot be said in .scene (expected linear" },
    { [](auto& s) {
       s.cameras[0].lookAt.keys = { { 0, Vector(0, 0, 1), Interpolation::Smooth } };
     },
      "camera 'Camera0': lookAt cannot be said in .scene (expected linear" },
    { [](auto& s) { s.lights[0].kind = LightKind::Head; }, "light 'Light0': kind cannot be said" },
    { [](auto& s) { s.lights[0].enabled = false; }, "light 'Light0': enabled cannot be said" },
    { [](auto& s) { s.lights[0].intensity = 2; }, "light 'Light0': intensity cannot be said" },
    { [](auto& s) {
       s.lights[0].attenuation = { 1, 1, 0 };
     },
      "light 'Light0': attenuation cannot be said" },
    { [](auto& s) { s.cameras[0].model = "orthographic"; }, "camera 'Camera0': model cannot be said" },
    { [](auto& s) { s.cameras[0].width = s.cameras[0].height = 9; }, "camera 'Camera0': width cannot be said" },
    { [](auto& s) { s.cameras[0].posed = true; }, "camera 'Camera0': orientation cannot be said" },
    { [](auto& s) {
       s.cameras[0].lens.focus.keys = { { 0, 5 } };
     },
      "camera 'Camera0': lens cannot be said" },
    { [](auto& s) { s.cameras[0].name = "eye"; }, "camera 'eye': name cannot be said" },
    { [](auto& s) {
       s.cameras[0].fovY.keys = { { 0, 60 }, { 1, 50 } };
     },
      "camera 'Camera0': fovY cannot be said" },
    // Also what has no effect.
    { [](auto& s) { s.environment.intensity = 3; }, "scene: environment cannot" },
    { [](auto& s) { s.environment.rotation = 9; }, "scene: environment cannot" },
    { [](auto& s) { s.environment.background = false; }, "scene: environment cannot" },
    { [](auto& s) { s.fog.color = Vector(1, 0, 0); }, "scene: fog cannot" },
    { [](auto& s) { s.fog.start = 4; }, "scene: fog cannot" },
    { [](auto& s) { s.lights[0].shadowSize = 64; }, "light 'Light0': shadowSize cannot" },
    { [&](auto& s) { s.lights[0].unused.scale = once; }, "light 'Light0': unused.scale cannot" },
    { [](auto& s)
      {
        s.lights[0].unused.orientation.keys = { { 0, {} } };
        s.lights[0].unused.orientation.interpolation = Interpolation::Step;
      },
      "light 'Light0': unused.orientation cannot" },
    { [&](auto& s) { s.cameras[0].unusedEye.scale = once; }, "camera 'Camera0': unusedEye.scale cannot" },
    { [&](auto& s) { s.cameras[0].unusedLookAt.scale = once; }, "camera 'Camera0': unusedLookAt.scale cannot" },
    { [&](auto& s) { s.objects[0].position = once; }, "object 'a-1': position cannot" },
    { [](auto& s) { s.cameras[0].shutter.open = -1; }, "camera 'Camera0': shutter cannot" },
    { [](auto& s) { s.cameras[0].shutter.open = s.cameras[0].shutter.close = 1; }, "camera 'Camera0': shutter cannot" },
    { [](auto& s) { s.cameras[0].shutter.exposures = 3; }, "camera 'Camera0': shutter cannot" },
    { [](auto& s) { s.cameras[0].rollingShutter.duration = 0.5; }, "camera 'Camera0': rollingShutter cannot" },
    { [](auto& s) { s.cameras[0].rollingShutter.direction = RollingShutter::Direction::Up; },
      "camera 'Camera0': rollingShutter cannot" },
    { [](auto& s) { s.cameras[0].lens.focus = 3; }, "camera 'Camera0': lens cannot" },
    { [](auto& s) { s.cameras[0].lens.exposures = 3; }, "camera 'Camera0': lens cannot" },
  };
  for (const Change& change : changes)
  {
    SceneDescription scene;
    scene.objects.resize(2);
    scene.objects[0].model = "a.ac";
    scene.objects[1].model = "a.ac";
    scene.lights.resize(1);
    scene.cameras.resize(1);
    nameAll(scene);
    EXPECT_NO_THROW(toThesisScene(scene, ""));
    change.make(scene);
    EXPECT_THAT(thrownBy<InputError>([&] { toThesisScene(scene, ""); }), HasSubstr(change.message)) << change.message;
  }
}

TEST(SceneRefusals, ScenesMadeByProgramObeyTheSameRules)
{
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].model = "a.ac";
  scene.objects[0].name = "ball";
  scene.objects[0].position.value[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(thrownBy<InputError>([&] { validate(scene); }), HasSubstr("object 'ball': position[1] is out of range"));
  scene.objects[0].position.value[1] = 0;
  EXPECT_NO_THROW(validate(scene));
  scene.order = { { SceneItem::Kind::Object, 0 }, { SceneItem::Kind::Object, 0 } };
  EXPECT_THROW(validate(scene), InputError);
  scene.order.clear();
  scene.extraKeyFrames = { 3, 2 };
  EXPECT_THROW(validate(scene), InputError);
}

TEST(SceneRefusals, PropertiesOfAProgramsSceneObeyTheSameRules)
{
  const std::pair<std::function<void(SceneDescription&)>, const char*> table[] = { { [](auto& s) { s.units = "m\n"; },
                                                                                     "units" },
    { [](auto& s) { s.fps = 0; }, "fps" }, { [](auto& s) { s.background.value[2] = 2; }, "background[2]" },
    { [](auto& s) { s.environment.intensity = -1; }, "environment.intensity" },
    { [](auto& s) { s.fog.density = -1; }, "fog.density" }, { [](auto& s) { s.fog.start = -1; }, "fog.start" },
    { [](auto& s) { s.fog.color.value[1] = 2; }, "fog.color[1]" },
    { [](auto& s) { s.seed = std::uint64_t(1) << 60; }, "seed" },
    { [](auto& s) { s.dataset["nme"] = "x"; }, "dataset.nme" },
    { [](auto& s) {
       s.classes = { { "a", 0 } };
     },
      "classes.a" },
    { [](auto& s) { s.extraKeyFrames = { -1 }; }, "keyFrames[0]" } };
  for (const auto& [change, what] : table)
  {
    SceneDescription scene;
    EXPECT_NO_THROW(validate(scene));
    change(scene);
    EXPECT_THAT(thrownBy<InputError>([&] { validate(scene); }), HasSubstr(std::string("scene: ") + what + ' ')) << what;
  }
}

TEST(SceneRefusals, ScenesWithoutAFileAreCalledScene)
{
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].model = "a.ac";
  scene.objects[0].parent = "b";
  EXPECT_EQ(thrownBy<InputError>([&] { toJson(scene, ""); }),
    "scene: object 'a-1': parent is no object of the scene (expected the name of an object, found 'b')");
}
