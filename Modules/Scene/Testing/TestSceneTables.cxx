// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <numeric>

using namespace dgtk;
using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

// Keys, limits and paths of scenes, one by one.

namespace
{
/// A scene of one object, one light and one camera with a key each, "" for none.
std::string sceneWith(const std::string& where, const std::string& key)
{
  const auto of = [&](const std::string& here) { return where == here && !key.empty() ? ", " + key : std::string(); };
  return "{\"version\": 1" + of("scene") + ", \"objects\": [{\"model\": \"a.ac\"" + of("object") +
         "}], \"lights\": [{\"position\": [0, 0, 9]" + of("light") +
         "}], \"cameras\": [{\"eye\": [0, 0, 9], \"lookAt\": [0, 0, 0]" + of("camera") + "}]}";
}

std::string withoutBlanks(std::string text)
{
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n'; }), text.end());
  return text;
}
} // namespace

TEST(SceneTables, EveryKeyOfPicturesAndImageFormationIsReadAndWritten)
{
  const std::string text = R"({
  "version": 1,
  "environment": { "image": "sky.hdr", "intensity": 2, "rotation": 30, "background": false },
  "fog": { "color": [0.25, 0.5, 0.75], "density": 0.125, "start": 3 },
  "objects": [{ "model": "a.ac", "materials": { "m": {
    "ambient": [0.125, 0, 0], "diffuse": [0.25, 0, 0], "specular": [0.375, 0, 0], "emission": [0.5, 0, 0],
    "shininess": 7, "opacity": 0.625, "texture": "t.png", "metallic": 0.75, "roughness": 0.875, "normalMap": "n.png",
    "bump": "b.png", "bumpScale": 9, "metallicRoughnessMap": "mr.png", "emissionMap": "e.png", "occlusionMap": "o.png"
  } } }],
  "lights": [{ "position": [1, 2, 3], "shadows": true, "shadowSize": 512 }],
  "cameras": [{ "eye": [0, 0, 9], "lookAt": [0, 0, 0], "shutter": { "open": -0.25, "close": 0.5, "exposures": 8 },
    "lens": { "aperture": 0.5, "focus": 6, "exposures": 32 } }]
})";
  const TemporaryFolder folder;
  std::string written = text;
  for (int time = 0; time < 2; ++time) // as read, and as read from what is written
  {
    const SceneDescription scene = readText(folder, "a.json", written);
    EXPECT_EQ(scene.environment.image, "sky.hdr");
    EXPECT_EQ(scene.environment.intensity, 2);
    EXPECT_EQ(scene.environment.rotation, 30);
    EXPECT_FALSE(scene.environment.background);
    EXPECT_EQ(scene.fog.color.value, Vector(0.25, 0.5, 0.75));
    EXPECT_EQ(scene.fog.density.value, 0.125);
    EXPECT_EQ(scene.fog.start.value, 3);
    const MaterialOverride& material = scene.objects.at(0).materials.at(0);
    EXPECT_EQ(material.material, "m");
    EXPECT_EQ(material.ambient->value.x(), 0.125);
    EXPECT_EQ(material.diffuse->value.x(), 0.25);
    EXPECT_EQ(material.specular->value.x(), 0.375);
    EXPECT_EQ(material.emission->value.x(), 0.5);
    EXPECT_EQ(material.shininess->value, 7);
    EXPECT_EQ(material.opacity->value, 0.625);
    EXPECT_EQ(material.texture, "t.png");
    EXPECT_EQ(material.metallic->value, 0.75);
    EXPECT_EQ(material.roughness->value, 0.875);
    EXPECT_EQ(material.normalMap, "n.png");
    EXPECT_EQ(material.bump, "b.png");
    EXPECT_EQ(material.bumpScale->value, 9);
    EXPECT_EQ(material.metallicRoughnessMap, "mr.png");
    EXPECT_EQ(material.emissionMap, "e.png");
    EXPECT_EQ(material.occlusionMap, "o.png");
    EXPECT_TRUE(scene.lights.at(0).shadows);
    EXPECT_EQ(scene.lights[0].shadowSize, 512);
    const CameraDescription& camera = scene.cameras.at(0);
    EXPECT_EQ(camera.shutter.open, -0.25);
    EXPECT_EQ(camera.shutter.close, 0.5);
    EXPECT_EQ(camera.shutter.exposures, 8);
    EXPECT_EQ(camera.lens.aperture, 0.5);
    EXPECT_EQ(camera.lens.focus.at(0), 6);
    EXPECT_EQ(camera.lens.exposures, 32);
    written = toJson(scene, folder.path());
  }
}

TEST(SceneTables, EveryValueThatMayMoveIsReadAndWrittenWithItsKeys)
{
  const TemporaryFolder folder;
  const char* const keys[] = { "\"background\": { \"keys\": [[1, [0, 0, 0]], [9, [1, 0.5, 0.25], \"step\"]] }",
    "\"color\": { \"keys\": [[1, [0, 0, 1]], [3, [0.5, 0, 1]]] }", "\"density\": { \"keys\": [[2, 0], [3, 4]] }",
    "\"start\": { \"keys\": [[4, 0.5]] }", "\"visible\": { \"keys\": [[0, true], [5, false], [7, true]] }",
    "\"ambient\": { \"keys\": [[6, [0.125, 0, 0]]] }", "\"diffuse\": { \"keys\": [[7, [0.25, 0, 0]]] }",
    "\"specular\": { \"keys\": [[8, [0.375, 0, 0]]] }", "\"emission\": { \"keys\": [[9, [0.5, 0, 0]]] }",
    "\"shininess\": { \"keys\": [[10, 7]] }",
    "\"opacity\": { \"keys\": [[11, 1], [12, 0.5]], \"interpolation\": \"smooth\" }",
    "\"metallic\": { \"keys\": [[13, 1]] }", "\"roughness\": { \"keys\": [[14, 0.25]] }",
    "\"bumpScale\": { \"keys\": [[15, -2]] }", "\"enabled\": { \"keys\": [[16, false]] }",
    "\"ambient\": { \"keys\": [[17, [4, 0, 0]]] }", "\"diffuse\": { \"keys\": [[18, [5, 0, 0]]] }",
    "\"specular\": { \"keys\": [[19, [6, 0, 0]]] }", "\"coneAngle\": { \"keys\": [[20, 10], [21, 90]] }",
    "\"exponent\": { \"keys\": [[22, 0], [23, 128]] }", "\"intensity\": { \"keys\": [[24, 2]] }" };
  const auto list = [&keys](int first, int count)
  {
    std::string text;
    for (int i = first; i < first + count; ++i)
    {
      text += (i == first ? "" : ", ") + std::string(keys[i]);
    }
    return text;
  };
  const std::string text = "{\"version\": 1, " + list(0, 1) + ", \"fog\": {" + list(1, 3) +
                           "}, \"objects\": [{\"model\": \"a.ac\", " + list(4, 1) + ", \"materials\": {\"m\": {" +
                           list(5, 9) + "}}}], \"lights\": [{" + list(14, 7) + "}]}";
  const std::string written = toJson(readText(folder, "a.json", text), folder.path());
  for (const char* const key : keys)
  {
    EXPECT_NE(withoutBlanks(written).find(withoutBlanks(key)), std::string::npos) << key;
  }
  EXPECT_EQ(toJson(readText(folder, "b.json", written), folder.path()), written);
  std::vector<int> frames(25);
  std::iota(frames.begin(), frames.end(), 0);
  EXPECT_EQ(readText(folder, "b.json", written).keyFrames(), frames);
}

TEST(SceneTables, WhatIsTrueOrFalseHasSteps)
{
  const TemporaryFolder folder;
  SceneDescription scene = readText(folder, "a.json",
    sceneWith("object", R"("visible": {"keys": [[2, false], [4, true, "step"]], "interpolation": "step"})"));
  const Track<bool>& visible = scene.objects[0].visible;
  std::string over;
  for (const double frame : { 0.0, 2.0, 3.9, 4.0, 5.0 })
  {
    over += visible.at(frame) ? '1' : '0';
  }
  EXPECT_EQ(over, "00011");
  EXPECT_TRUE(isEver(visible));
  // No other way is kept, nor written.
  scene.objects[0].visible.interpolation = Interpolation::Smooth;
  scene.objects[0].visible.keys[0].interpolation = Interpolation::Linear;
  EXPECT_FALSE(visible.at(3.9));
  EXPECT_THAT(withoutBlanks(toJson(scene, "")), HasSubstr("\"visible\":{\"keys\":[[2,false],[4,true]]}"));
  scene.objects[0].visible.keys[1].value = false;
  EXPECT_FALSE(isEver(visible));
}

TEST(SceneTables, EveryPathMovesWithTheScene)
{
  const TemporaryFolder folder;
  makeFolders(folder.path("deep/er"));
  writeFile(folder.path("classes.json"), R"({"tree": 2})");
  const SceneDescription scene = readText(folder, "a.json", R"({ "classes": "classes.json",
    "environment": { "image": "sky.hdr" }, "objects": [{ "model": "a.ac", "class": "tree", "materials": { "*": {
    "texture": "t.png", "normalMap": "n.png", "bump": "b.png", "metallicRoughnessMap": "mr.png",
    "emissionMap": "e.png", "occlusionMap": "o.png" } } }] })");
  writeScene(scene, folder.path("deep/er/b.json"));
  const SceneDescription moved = readScene(folder.path("deep/er/b.json"));
  const MaterialOverride& material = moved.objects.at(0).materials.at(0);
  EXPECT_THAT((std::vector<std::string>{ moved.classFile, moved.environment.image, moved.objects[0].model,
                *material.texture, *material.normalMap, *material.bump, *material.metallicRoughnessMap,
                *material.emissionMap, *material.occlusionMap }),
    ElementsAre("../../classes.json", "../../sky.hdr", "../../a.ac", "../../t.png", "../../n.png", "../../b.png",
      "../../mr.png", "../../e.png", "../../o.png"));
}

TEST(SceneTables, LimitsAreWithin)
{
  struct Row
  {
    const char* where;
    std::string key; ///< with # for the value
    std::vector<const char*> good, bad;
  };
  const Row table[] = { { "scene", "\"fps\": #", { "1e-9", "1e6" }, { "0", "-1", "1000001" } },
    { "scene", "\"seed\": #", { "0", "9007199254740991" }, { "-1", "9007199254740992", "1.5" } },
    { "scene", "\"keyFrames\": [#]", { "0", "999999" }, { "-1", "1000000", "0.5" } },
    { "scene", "\"background\": [0, #, 0]", { "0", "1" }, { "-0.001", "1.001" } },
    { "scene", "\"environment\": {\"rotation\": #}", { "-36000", "36000" }, { "-36001", "36001" } },
    { "scene", "\"environment\": {\"intensity\": #}", { "0", "1e6" }, { "-1", "1000001" } },
    { "scene", "\"fog\": {\"density\": #}", { "0", "1e15" }, { "-1", "1.1e15" } },
    { "scene", "\"fog\": {\"start\": #}", { "0", "1e15" }, { "-1", "1.1e15" } },
    { "object", "\"position\": [0, #, 0]", { "-1e15", "1e15" }, { "-1.1e15", "1.1e15" } },
    { "object", "\"scale\": [1, #, 1]", { "-1e12", "1e12", "1e-300" }, { "-1.1e12", "1.1e12", "0" } },
    { "object", "\"orientation\": [#, 0, 0, 0]", { "0.9901", "1.0099", "-1" }, { "0.9899", "1.0101", "0" } },
    { "object", "\"animation\": {\"rate\": #}", { "0", "1e6" }, { "-1", "1000001" } },
    { "object", "\"animation\": {\"start\": #}", { "-1e9", "1e9" }, { "-1.1e9", "1.1e9" } },
    { "object", "\"animation\": {\"offset\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "object", "\"materials\": {\"*\": {\"shininess\": #}}", { "0", "128" }, { "-1", "129" } },
    { "object", "\"materials\": {\"*\": {\"opacity\": #}}", { "0", "1" }, { "-0.001", "1.001" } },
    { "object", "\"materials\": {\"*\": {\"metallic\": #}}", { "0", "1" }, { "-0.001", "1.001" } },
    { "object", "\"materials\": {\"*\": {\"roughness\": #}}", { "0", "1" }, { "-0.001", "1.001" } },
    { "object", "\"materials\": {\"*\": {\"diffuse\": [#, 0, 0]}}", { "0", "1" }, { "-0.001", "1.001" } },
    { "light", "\"coneAngle\": #", { "0.001", "90" }, { "0", "90.001" } },
    { "light", "\"exponent\": #", { "0", "128" }, { "-1", "129" } },
    { "light", "\"intensity\": #", { "0", "1e6" }, { "-1", "1000001" } },
    { "light", "\"diffuse\": [#, 0, 0]", { "0", "1e6" }, { "-1", "1000001" } },
    { "scene", "\"background\": {\"keys\": [[0, [0, 0, 0]], [1, [0, #, 0]]]}", { "0", "1" }, { "-0.001", "1.001" } },
    { "scene", "\"fog\": {\"density\": {\"keys\": [[0, #]]}}", { "0", "1e15" }, { "-1", "1.1e15" } },
    { "object", "\"materials\": {\"*\": {\"opacity\": {\"keys\": [[0, #]]}}}", { "0", "1" }, { "-0.001", "1.001" } },
    { "object", "\"materials\": {\"*\": {\"shininess\": {\"keys\": [[0, #]]}}}", { "0", "128" }, { "-1", "129" } },
    { "light", "\"intensity\": {\"keys\": [[0, #]]}", { "0", "1e6" }, { "-1", "1000001" } },
    { "light", "\"coneAngle\": {\"keys\": [[0, #]]}", { "0.001", "90" }, { "0", "90.001" } },
    { "light", "\"diffuse\": {\"keys\": [[0, [#, 0, 0]]]}", { "0", "1e6" }, { "-1", "1000001" } },
    { "light", "\"shadowSize\": #", { "16", "16384" }, { "15", "16385", "16.5" } },
    { "camera", "\"fovY\": #", { "0.001", "179.999" }, { "0", "180" } },
    { "camera", "\"aspect\": #", { "0", "1e6" }, { "-1", "1000001" } },
    { "camera", "\"near\": #, \"far\": 1e15", { "1e-9", "999999999999999" }, { "0", "-1", "1e15" } },
    { "camera", "\"far\": #", { "0.11", "1e15" }, { "0", "0.1", "1.1e15" } },
    { "camera", "\"width\": #, \"height\": 1", { "1", "1048576" }, { "0", "-1", "1048577" } },
    { "camera", "\"model\": \"orthographic\", \"viewHeight\": #", { "1e-9", "1e15" }, { "0", "1.1e15" } },
    { "camera", "\"shutter\": {\"open\": #, \"close\": 1000}", { "-1000", "1000" }, { "-1001", "1001" } },
    { "camera", "\"shutter\": {\"exposures\": #}", { "1", "65536" }, { "0", "65537" } },
    { "camera", "\"lens\": {\"exposures\": #}", { "1", "65536" }, { "0", "65537" } },
    { "camera", "\"lens\": {\"aperture\": #}", { "0", "1e15" }, { "-1", "1.1e15" } },
    { "camera", "\"lens\": {\"focus\": #}", { "1e-9", "1e15" }, { "0", "1.1e15" } } };
  for (const Row& row : table)
  {
    const auto refusalWith = [&row](const char* value)
    {
      std::string key = row.key;
      key.replace(key.find('#'), 1, value);
      return refusalOf("a.json", sceneWith(row.where, key));
    };
    for (const char* value : row.good)
    {
      EXPECT_EQ(refusalWith(value), "") << row.key << ' ' << value;
    }
    for (const char* value : row.bad)
    {
      EXPECT_NE(refusalWith(value), "") << row.key << ' ' << value;
    }
  }
}

TEST(SceneTables, EveryKindOfLightIsReadAndWritten)
{
  const TemporaryFolder folder;
  for (const LightTraits& kind : lightKinds())
  {
    const std::string key = "\"kind\": \"" + std::string(kind.word) + '"';
    const SceneDescription scene = readText(folder, "a.json", sceneWith("light", key));
    EXPECT_EQ(scene.lights.at(0).kind, kind.kind);
    EXPECT_EQ(&traitsOf(kind.kind), &kind);
    EXPECT_EQ(toJson(scene, folder.path()).find(key) == std::string::npos, kind.kind == LightKind::Point);
    const std::string aimed = R"("target": [0, 0, 9], )" + key;
    EXPECT_EQ(refusalOf("a.json", sceneWith("light", aimed)).empty(), !kind.aimed) << "a target at its position";
  }
  EXPECT_THAT(refusalOf("a.json", sceneWith("light", "\"kind\": \"sun\"")),
    HasSubstr("lights[0].kind is not known (expected one of point, head, "));
}

TEST(SceneTables, CamerasHaveOneWholePose)
{
  const std::pair<const char*, const char*> keys[] = { { "eye", "[0, 0, 9]" }, { "lookAt", "[0, 0, 0]" },
    { "up", "[0, 1, 0]" }, { "position", "[1, 2, 3]" }, { "orientation", "[1, 0, 0, 0]" } };
  for (unsigned subset = 0; subset < 32; ++subset)
  {
    std::string camera;
    for (unsigned i = 0; i < 5; ++i)
    {
      camera += (subset >> i & 1u) != 0 ? std::string(", \"") + keys[i].first + "\": " + keys[i].second : "";
    }
    const bool good = subset == 0b00011 || subset == 0b00111 || subset == 0b11000;
    EXPECT_EQ(refusalOf("a.json", "{\"cameras\": [{\"name\": \"c\"" + camera + "}]}").empty(), good) << camera;
  }
}

TEST(SceneTables, NamesOfCamerasAreFitForFolders)
{
  for (const std::string& name : { std::string("a b"), std::string("a.b-c"), std::string(128, 'x'), std::string("Ä") })
  {
    EXPECT_EQ(refusalOf("a.json", sceneWith("camera", "\"name\": \"" + name + '"')), "") << name;
  }
  for (const std::string& name : { std::string(), std::string("a/b"), std::string("a\\\\b"), std::string("a,b"),
         std::string("a@b"), std::string("a:b"), std::string(".a"), std::string(" a"), std::string("-a"),
         std::string("a "), std::string("manifest.json"), std::string("cameras.json"), std::string("objects.json"),
         std::string("poses.json"), std::string("scene.json"), std::string("contact.png"), std::string(129, 'x'),
         std::string("a\\u0001b"), std::string("a\\u007fb") })
  {
    EXPECT_THAT(refusalOf("a.json", sceneWith("camera", "\"name\": \"" + name + '"')), HasSubstr("name")) << name;
  }
}

TEST(SceneTables, MatricesOfCamerasAreThoseOfPinholes)
{
  const auto refusal = [](const std::string& rows)
  { return refusalOf("a.json", sceneWith("camera", "\"width\": 64, \"height\": 48, \"K\": [" + rows + ']')); };
  EXPECT_EQ(refusal("[50, 0, 32], [0, 50, 24], [0, 0, 1]"), "");
  EXPECT_EQ(refusal("[50, -3, -32], [0, 0.5, 0], [0, 0, 1]"), "");
  for (const char* rows : { "[0, 0, 32], [0, 50, 24], [0, 0, 1]", "[-50, 0, 32], [0, 50, 24], [0, 0, 1]",
         "[50, 0, 32], [0, 0, 24], [0, 0, 1]", "[50, 0, 32], [0, -50, 24], [0, 0, 1]",
         "[50, 0, 32], [1, 50, 24], [0, 0, 1]", "[50, 0, 32], [0, 50, 24], [1, 0, 1]",
         "[50, 0, 32], [0, 50, 24], [0, 1, 1]", "[50, 0, 32], [0, 50, 24], [0, 0, 2]" })
  {
    EXPECT_THAT(refusal(rows), HasSubstr("is not a camera matrix")) << rows;
  }
}

TEST(SceneTables, OnlyKeyFramesThatNoTrackHasAreExtra)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.json",
    R"({"keyFrames": [1, 2, 4, 5, 9],
      "objects": [{"model": "a.ac", "position": {"keys": [[2, [0, 0, 0]], [5, [1, 0, 0]]]}}]})");
  EXPECT_THAT(scene.extraKeyFrames, ElementsAre(1, 4, 9));
  EXPECT_THAT(scene.keyFrames(), ElementsAre(1, 2, 4, 5, 9));
}

TEST(SceneTables, ScalesThatPassThroughZeroAtAnyFrameBetween)
{
  // from -a to b within some frames, 0 at the frame behind the first, or before the last
  EXPECT_THAT(refusalOf("a.json", sceneWith("object", "\"scale\": {\"keys\": [[3, -1], [7, 3]]}")),
    HasSubstr("scale passes through 0 at frame 4"));
  EXPECT_THAT(refusalOf("a.json", sceneWith("object", "\"scale\": {\"keys\": [[3, -3], [7, 1]]}")),
    HasSubstr("scale passes through 0 at frame 6"));
  // between two keys of 1, between keys of 9: (1 + 1) / 2 + 2 / 8 (-2 - 2)
  EXPECT_THAT(
    refusalOf("a.json",
      sceneWith("object", "\"scale\": {\"interpolation\": \"smooth\", \"keys\": [[0, 9], [2, 1], [4, 1], [6, 9]]}")),
    HasSubstr("scale passes through 0 at frame 3"));
  // between whole frames, and to and fro between them, where both keys have one sign
  for (const char* keys : { "[[0, 1], [10, 0.1], [20, 0.1], [30, 4]]", "[[0, 4], [10, 0.1], [20, 0.1], [30, 1]]",
         "[[0, -1], [10, -0.1], [20, -0.1], [30, -4]]",
         "[[0, 9], [10, [1, 1, 0.1]], [11, [1, 1, 0.1]], [12, [1, 1, 9]]]" })
  {
    EXPECT_THAT(
      refusalOf("a.json",
        sceneWith("object", std::string("\"scale\": {\"interpolation\": \"smooth\", \"keys\": ") + keys + "}")),
      HasSubstr("scale passes through 0 between frames 10 and "));
  }
  for (const char* keys : { "[[0, 1], [10, 0.2], [20, 0.2], [30, 1]]", "[[0, 1], [10, 0.5], [20, 4]]",
         "[[0, 2], [9, 2]]", "[[0, -1], [10, 2], [20, 5]]", "[[0, 1], [3, 2], [6, 3]]" })
  {
    EXPECT_EQ(refusalOf("a.json",
                sceneWith("object", std::string("\"scale\": {\"interpolation\": \"smooth\", \"keys\": ") + keys + "}")),
      "")
      << keys;
  }
  EXPECT_EQ(refusalOf("a.json", sceneWith("object", "\"scale\": {\"keys\": [[3, -1], [7, 2]]}")), "");
  EXPECT_EQ(refusalOf("a.json", sceneWith("object", "\"scale\": {\"keys\": [[3, -1], [4, 1]]}")), "");
}

TEST(SceneTables, WhatSceneFilesHaveNoWordsFor)
{
  const std::pair<std::function<void(SceneDescription&)>, const char*> table[] = {
    { [](auto& s) { s.environment.image = "sky.hdr"; }, "environment" }, { [](auto& s) { s.fog.density = 1; }, "fog" },
    { [](auto& s) { s.fps = 30; }, "fps" }, { [](auto& s) { s.background.value[1] = 0.5; }, "background" },
    { [](auto& s) { s.units = "m"; }, "units" }, { [](auto& s) { s.upAxis = UpAxis::Z; }, "upAxis" },
    { [](auto& s) { s.seed = 7; }, "seed" },
    { [](auto& s)
      {
        s.classes = { { "a", 1 } };
        s.objects[0].className = "a";
      },
      "classes" },
    { [](auto& s) { s.objects[0].animation.start = 1; }, "object 'a-1': animation.start" },
    { [](auto& s) { s.objects[0].animation.offset = 1; }, "object 'a-1': animation.offset" },
    { [](auto& s) { s.objects[0].animation.loop = !s.objects[0].animation.loop; }, "object 'a-1': animation.loop" },
    { [](auto& s) {
       s.objects[0].orientation.keys = { { 0, {}, Interpolation::Step }, { 1, {} } };
     },
      "object 'a-1': orientation" },
    { [](auto& s) {
       s.objects[0].scale.keys = { { 0, { 1, 1, 1 }, Interpolation::Step }, { 1, { 1, 1, 1 } } };
     },
      "object 'a-1': scale" },
    { [](auto& s) {
       s.background.keys = { { 0, Vector(0, 0, 0) } };
     },
      "background" },
    { [](auto& s) {
       s.fog.density.keys = { { 0, 0 } };
     },
      "fog" },
    { [](auto& s) {
       s.fog.color.keys = { { 0, Vector(0, 0, 0) } };
     },
      "fog" },
    { [](auto& s) {
       s.fog.start.keys = { { 0, 0 } };
     },
      "fog" },
    { [](auto& s) {
       s.objects[0].visible.keys = { { 0, true } };
     },
      "object 'a-1': visible" },
    { [](auto& s) {
       s.lights[0].enabled.keys = { { 0, true } };
     },
      "light 'Light0': enabled" },
    { [](auto& s) {
       s.lights[0].ambient.keys = { { 0, Vector(0, 0, 0) } };
     },
      "light 'Light0': ambient" },
    { [](auto& s) {
       s.lights[0].diffuse.keys = { { 0, Vector(1, 1, 1) } };
     },
      "light 'Light0': diffuse" },
    { [](auto& s) {
       s.lights[0].specular.keys = { { 0, Vector(1, 1, 1) } };
     },
      "light 'Light0': specular" },
    { [](auto& s) {
       s.lights[0].coneAngle.keys = { { 0, 30 } };
     },
      "light 'Light0': coneAngle" },
    { [](auto& s) {
       s.lights[0].exponent.keys = { { 0, 1 } };
     },
      "light 'Light0': exponent" },
    { [](auto& s) {
       s.lights[0].intensity.keys = { { 0, 1 } };
     },
      "light 'Light0': intensity" },
    { [](auto& s) { s.lights[0].target.value = Vector(1, 0, 0); }, "light 'Light0': target" },
    { [](auto& s) { s.lights[0].coneAngle = 31; }, "light 'Light0': coneAngle" },
    { [](auto& s) { s.lights[0].exponent = 2; }, "light 'Light0': exponent" },
    { [](auto& s) { s.lights[0].shadows = true; }, "light 'Light0': shadows" },
    { [](auto& s) { s.lights[0].name = "a (b"; }, "light 'a (b': name" },
    { [](auto& s) { s.cameras[0].shutter.close = 1; }, "camera 'Camera0': shutter" },
    { [](auto& s) { s.cameras[0].lens.aperture = 1; }, "camera 'Camera0': lens" },
    { [](auto& s) { s.cameras[0].sensor.emplace(); }, "camera 'Camera0': sensor" },
    { [](auto& s) { s.cameras[0].parameters["distortion"].numbers.assign(4, -0.2); }, "camera 'Camera0': distortion" },
    { [](auto& s) {
       s.cameras[0].up.keys = { { 0, { 0, 1, 0 } }, { 1, { 0, 1, 0.5 } } };
     },
      "camera 'Camera0': up" },
    { [](auto& s) {
       s.cameras[0].eye.keys = { { 0, { 0, 0, 9 }, Interpolation::Smooth }, { 1, { 0, 0, 8 } } };
     },
      "camera 'Camera0': eye" },
    { [](auto& s)
      {
        s.cameras[0].K = Eigen::Matrix3d::Identity();
        s.cameras[0].width = s.cameras[0].height = 9;
      },
      "camera 'Camera0': K" }
  };
  for (const auto& [change, what] : table)
  {
    SceneDescription scene;
    scene.objects.resize(1);
    scene.objects[0].model = "a.ac";
    scene.lights.resize(1);
    scene.cameras.resize(1);
    nameAll(scene);
    EXPECT_NO_THROW(toThesisScene(scene, ""));
    change(scene);
    for (const std::vector<int>& frames : { std::vector<int>(), std::vector<int>{ 3, 7 } })
    {
      scene.extraKeyFrames = frames;
      EXPECT_THAT(thrownBy<InputError>([&] { toThesisScene(scene, ""); }),
        HasSubstr(std::string("scene: ") + what + " cannot be said in .scene"))
        << what;
    }
  }
}

TEST(SceneTables, ModelsOfSceneFilesHaveTheExtensionOfTheirWord)
{
  for (const auto& [word, own] : { std::pair("glObject_3DS", "3ds"), std::pair("glObject_Md2", "md2"),
         std::pair("glObject_AC", ""), std::pair("GLOBJECT_md2", "md2") })
  {
    for (const std::string extension : { "3ds", "3DS", "md2", "MD2", "ac", "pov", "md3" })
    {
      std::string small = extension;
      std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
      const std::string refusal = refusalOf("a.scene", std::string("1\n") + word + ": a." + extension + "\n0\n");
      EXPECT_EQ(refusal.empty(), *own == '\0' || small == own) << word << ' ' << extension << ' ' << refusal;
    }
  }
}

TEST(SceneTables, WithoutAnOrderObjectsComeFirstThenLightsThenCameras)
{
  using Kind = SceneItem::Kind;
  SceneDescription scene;
  scene.objects.resize(2);
  scene.objects[0].model = scene.objects[1].model = "a.ac";
  scene.lights.resize(1);
  scene.cameras.resize(1);
  const std::vector<SceneItem> expected = { { Kind::Object, 0 }, { Kind::Object, 1 }, { Kind::Light, 0 },
    { Kind::Camera, 0 } };
  EXPECT_EQ(scene.items(), expected);
  scene.order = { { Kind::Camera, 0 }, { Kind::Object, 1 }, { Kind::Light, 0 }, { Kind::Object, 0 } };
  EXPECT_EQ(scene.items(), scene.order);
}
