// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemMotion.h"
#include "dgtkSceneDocument.h"

#include "dgtkSceneTracks.h"
#include "dgtkTestSupport.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using Strings = std::vector<std::string>;
using V = Eigen::Vector3d;

constexpr double tableTolerance = 1e-12;

const SceneItem anObject{ SceneItem::Kind::Object, 0 };
const SceneItem anotherObject{ SceneItem::Kind::Object, 1 };
const SceneItem aLight{ SceneItem::Kind::Light, 0 };
const SceneItem aCamera{ SceneItem::Kind::Camera, 0 };

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}
std::string text(const V& v) { return text(v.x()) + "," + text(v.y()) + "," + text(v.z()); }
std::string text(const Quaternion& q) { return text(q.w) + "," + text(q.x) + "," + text(q.y) + "," + text(q.z); }

const char* letterOf(Interpolation way)
{
  return way == Interpolation::Linear ? "l" : way == Interpolation::Step ? "s" : "c";
}

template <typename T>
std::string text(const Track<T>& track)
{
  std::string all = track.animated() ? letterOf(track.interpolation) : "=" + text(track.value);
  for (const Key<T>& key : track.keys)
  {
    all +=
      " " + std::to_string(key.frame) + (key.interpolation ? letterOf(*key.interpolation) : "") + ":" + text(key.value);
  }
  return all;
}

/// Every track of the scene in the order of its items that is not as in a new item, and key frames of no track.
Strings tracksOf(const SceneDescription& scene)
{
  Strings all;
  for (const SceneItem& item : scene.items())
  {
    int number = 0;
    forEachTrackOf(scene, item,
      [&](const auto& track, bool)
      {
        const std::string now = text(track);
        if (track.animated())
        {
          all.push_back(itemName(scene, item) + "." + std::to_string(number) + " " + now);
        }
        ++number;
      });
  }
  std::string extra = "extra";
  for (const int frame : scene.extraKeyFrames)
  {
    extra += " " + std::to_string(frame);
  }
  all.push_back(extra);
  return all;
}

/// Two objects, a light and a camera; keys of position of the first at 0, 10 and 20, of scale at 10, of its light's
/// target at 10, of the camera's field of view at 0 and 20; 5 and 15 are the scene's own.
SceneDescription keyed()
{
  SceneDescription scene;
  for (const char* name : { "a", "b" })
  {
    scene.objects.emplace_back().name = name;
    scene.objects.back().model = test::sourceFile("Data/Models/crate.ac");
  }
  scene.lights.emplace_back().name = "l";
  scene.lights[0].kind = LightKind::Spot;
  scene.cameras.emplace_back().name = "c";
  scene.objects[0].position.keys = { { 0, V(0, 0, 0) }, { 10, V(1, 2, 3), Interpolation::Step }, { 20, V(5, 6, 7) } };
  scene.objects[0].position.interpolation = Interpolation::Smooth;
  scene.objects[0].scale.keys = { { 10, V(2, 2, 2) } };
  scene.lights[0].target.keys = { { 10, V(0, 8, 0) } };
  scene.cameras[0].fovY.keys = { { 0, 40 }, { 20, 60 } };
  scene.extraKeyFrames = { 5, 15 };
  return scene;
}

TEST(KeyFrameTables, EveryEditOfKeys)
{
  struct Row
  {
    const char* name;
    std::function<void(SceneDescription&)> edit;
    Strings tracks;
  };
  const std::string a0 = "a.0 c 0:0,0,0 10s:1,2,3 20:5,6,7";
  const std::string a2 = "a.2 l 10:2,2,2";
  const std::string l1 = "l.1 l 10:0,8,0";
  const std::string c5 = "c.5 l 0:40 20:60";
  const std::string extra = "extra 5 15";
  using Scene = SceneDescription;
  const std::vector<Row> rows{
    { "nothing", [](Scene&) {}, { a0, a2, l1, c5, extra } },
    { "remove 10", [](Scene& s) { removeKeyFrame(s, 10); }, { "a.0 c 0:0,0,0 20:5,6,7", c5, extra } },
    { "remove 5", [](Scene& s) { removeKeyFrame(s, 5); }, { a0, a2, l1, c5, "extra 15" } },
    { "remove 7", [](Scene& s) { removeKeyFrame(s, 7); }, { a0, a2, l1, c5, extra } },
    { "remove a's 10", [](Scene& s) { removeItemKeys(s, anObject, 10); }, { "a.0 c 0:0,0,0 20:5,6,7", l1, c5, extra } },
    { "copy 10 to 12", [](Scene& s) { copyKeyFrame(s, 10, 12); },
      { "a.0 c 0:0,0,0 10s:1,2,3 12s:1,2,3 20:5,6,7", "a.2 l 10:2,2,2 12:2,2,2", "l.1 l 10:0,8,0 12:0,8,0", c5,
        extra } },
    { "copy 10 to 20", [](Scene& s) { copyKeyFrame(s, 10, 20); },
      { "a.0 c 0:0,0,0 10s:1,2,3 20s:1,2,3", "a.2 l 10:2,2,2 20:2,2,2", "l.1 l 10:0,8,0 20:0,8,0", c5, extra } },
    { "copy 0 to 10", [](Scene& s) { copyKeyFrame(s, 0, 10); },
      { "a.0 c 0:0,0,0 10:0,0,0 20:5,6,7", a2, l1, "c.5 l 0:40 10:40 20:60", extra } },
    { "copy 5 to 3", [](Scene& s) { copyKeyFrame(s, 5, 3); }, { a0, a2, l1, c5, "extra 3 5 15" } },
    { "copy 5 to 15", [](Scene& s) { copyKeyFrame(s, 5, 15); }, { a0, a2, l1, c5, extra } },
    { "copy 5 to 5", [](Scene& s) { copyKeyFrame(s, 5, 5); }, { a0, a2, l1, c5, extra } },
    { "move 10 to 30", [](Scene& s) { moveKeyFrame(s, 10, 30); },
      { "a.0 c 0:0,0,0 20:5,6,7 30s:1,2,3", "a.2 l 30:2,2,2", "l.1 l 30:0,8,0", c5, extra } },
    { "move 10 to 10", [](Scene& s) { moveKeyFrame(s, 10, 10); }, { a0, a2, l1, c5, extra } },
    { "move 15 to 16", [](Scene& s) { moveKeyFrame(s, 15, 16); }, { a0, a2, l1, c5, "extra 5 16" } },
    { "move 5 to 5", [](Scene& s) { moveKeyFrame(s, 5, 5); }, { a0, a2, l1, c5, extra } },
    { "move 6 to 7", [](Scene& s) { moveKeyFrame(s, 6, 7); }, { a0, a2, l1, c5, extra } },
    { "copy a's 10 to 5", [](Scene& s) { copyItemKeys(s, anObject, 10, 5); },
      { "a.0 c 0:0,0,0 5s:1,2,3 10s:1,2,3 20:5,6,7", "a.2 l 5:2,2,2 10:2,2,2", l1, c5, extra } },
    { "move l's 10 to 0", [](Scene& s) { moveItemKeys(s, aLight, 10, 0); }, { a0, a2, "l.1 l 0:0,8,0", c5, extra } },
    { "a's 10 is linear", [](Scene& s) { setKeyInterpolation(s, anObject, 10, Interpolation::Linear); },
      { "a.0 c 0:0,0,0 10l:1,2,3 20:5,6,7", "a.2 l 10l:2,2,2", l1, c5, extra } },
    { "a's 10 is none", [](Scene& s) { setKeyInterpolation(s, anObject, 10, {}); },
      { "a.0 c 0:0,0,0 10:1,2,3 20:5,6,7", a2, l1, c5, extra } },
    { "c's steps", [](Scene& s) { setInterpolation(s, aCamera, Interpolation::Step); },
      { a0, a2, l1, "c.5 s 0:40 20:60", extra } },
    { "a's steps", [](Scene& s) { setInterpolation(s, anObject, Interpolation::Step); },
      { "a.0 s 0:0,0,0 10:1,2,3 20:5,6,7", "a.2 s 10:2,2,2", l1, c5, extra } },
    // What has no keys gets one at this frame: poses always, the rest where they have some already.
    { "make 10", [](Scene& s) { makeKeyFrame(s, 10); },
      { a0, "a.1 l 10:1,0,0,0", a2, "b.0 l 10:0,0,0", "b.1 l 10:1,0,0,0", "b.2 l 10:1,1,1", "l.0 l 10:0,0,0", l1,
        "c.0 l 10:0,0,10", "c.1 l 10:0,0,0", "c.5 l 0:40 10:50 20:60", extra } },
    { "make 15 of the camera alone",
      [](Scene& s)
      {
        removeItems(s, { anObject, anotherObject, aLight });
        s.cameras[0].posed = true;
        makeKeyFrame(s, 15);
      },
      { "c.2 l 15:0,0,0", "c.3 l 15:1,0,0,0", "c.5 l 0:40 15:55 20:60", extra } },
    { "make 3 of nothing",
      [](Scene& s)
      {
        removeItems(s, s.items());
        makeKeyFrame(s, 3);
        makeKeyFrame(s, 15);
        makeKeyFrame(s, 17);
      },
      { "extra 3 5 15 17" } },
  };
  for (const Row& row : rows)
  {
    SceneDescription scene = keyed();
    row.edit(scene);
    EXPECT_EQ(tracksOf(scene), row.tracks) << row.name;
    SceneDocument document;
    document.edit("scene", [](Scene& s) { s = keyed(); });
    const std::string before = document.json();
    document.edit(row.name, row.edit);
    EXPECT_EQ(document.undoText(), row.name);
    EXPECT_EQ(tracksOf(document.scene()), row.tracks) << row.name;
    document.undo();
    EXPECT_EQ(document.json(), before) << row.name;
    EXPECT_EQ(document.redoText(), row.name);
    document.redo();
    EXPECT_EQ(tracksOf(document.scene()), row.tracks) << row.name;
  }
}

/// Those of the scene itself, of what is true or false, and of materials.
TEST(KeyFrameTables, TracksOfEveryKindGoAlong)
{
  SceneDescription scene = keyed();
  scene.background.keys = { { 10, V(1, 0, 0) } };
  scene.fog.density.keys = { { 0, 1 }, { 10, 2 } };
  scene.objects[1].visible.keys = { { 0, true }, { 10, false } };
  scene.objects[1].materials.resize(1);
  scene.objects[1].materials[0].material = "*";
  scene.objects[1].materials[0].opacity = Track<double>(1);
  scene.objects[1].materials[0].opacity->keys = { { 10, 0.5 } };
  scene.lights[0].enabled.keys = { { 10, false } };
  const auto texts = [&scene]
  {
    return Strings{ text(scene.background), text(scene.fog.density), text(scene.objects[1].visible),
      text(*scene.objects[1].materials[0].opacity), text(scene.lights[0].enabled) };
  };
  EXPECT_EQ(keyFramesOf(scene, anotherObject), (std::vector<int>{ 0, 10 }));
  EXPECT_EQ(keyInterpolationOf(scene, aLight, 10)->kind, Interpolation::Linear) << "of the target, the first";
  EXPECT_EQ(keyInterpolationOf(scene, anotherObject, 10)->kind, Interpolation::Step);
  moveKeyFrame(scene, 10, 12);
  EXPECT_EQ(texts(), (Strings{ "l 12:1,0,0", "l 0:1 12:2", "l 0:1 12:0", "l 12:0.5", "l 12:0" }));
  copyKeyFrame(scene, 12, 4);
  EXPECT_EQ(
    texts(), (Strings{ "l 4:1,0,0 12:1,0,0", "l 0:1 4:2 12:2", "l 0:1 4:0 12:0", "l 4:0.5 12:0.5", "l 4:0 12:0" }));
  makeKeyFrame(scene, 2);
  EXPECT_EQ(texts(), (Strings{ "l 2:1,0,0 4:1,0,0 12:1,0,0", "l 0:1 2:1.5 4:2 12:2", "l 0:1 2:1 4:0 12:0",
                       "l 2:0.5 4:0.5 12:0.5", "l 2:0 4:0 12:0" }));
  for (const int frame : { 0, 2, 4, 12 })
  {
    removeKeyFrame(scene, frame);
  }
  EXPECT_EQ(texts(), (Strings{ "=1,0,0", "=2", "=0", "=0.5", "=0" })) << "what the last keys said";
  EXPECT_EQ(scene.keyFrames(), (std::vector<int>{ 5, 15, 20 })) << "the rest stays";
}

TEST(KeyFrameTables, WhatTheLastKeySaidStays)
{
  SceneDescription scene = keyed();
  removeKeyFrame(scene, 10);
  EXPECT_EQ(scene.objects[0].scale.value, V(2, 2, 2));
  EXPECT_EQ(scene.lights[0].target.value, V(0, 8, 0));
  EXPECT_EQ(scene.objects[0].position.value, V(0, 0, 0)) << "it has further keys";
  removeKeyFrame(scene, 0);
  EXPECT_EQ(scene.cameras[0].fovY.value, 60) << "the usual one";
  removeKeyFrame(scene, 20);
  EXPECT_EQ(scene.objects[0].position.value, V(5, 6, 7));
}

TEST(KeyFrameTables, Questions)
{
  const SceneDescription scene = keyed();
  EXPECT_EQ(keyFramesOf(scene, anObject), (std::vector<int>{ 0, 10, 20 }));
  EXPECT_EQ(keyFramesOf(scene, anotherObject), std::vector<int>{});
  EXPECT_EQ(keyFramesOf(scene, aCamera), (std::vector<int>{ 0, 20 }));
  EXPECT_EQ(interpolationOf(scene, anObject), Interpolation::Smooth) << "that of the first track";
  EXPECT_EQ(interpolationOf(scene, anotherObject), Interpolation::Linear);
  const auto keyAt = [&scene](const SceneItem& item, int frame)
  {
    const auto found = keyInterpolationOf(scene, item, frame);
    return found ? letterOf(found->kind) + std::string(found->own ? " own" : "") : "none";
  };
  EXPECT_EQ(keyAt(anObject, 10), "s own");
  EXPECT_EQ(keyAt(anObject, 0), "c");
  EXPECT_EQ(keyAt(anotherObject, 0), "none");
}

/// Objects, lights and cameras in an order of their own, with all that names or places of others depend on.
SceneDescription listed()
{
  SceneDescription scene = keyed();
  scene.folder = "/scenes/one";
  scene.objects.emplace_back().name = "d-4";
  scene.objects[2].parent = "a";
  scene.lights.emplace_back().name = "Light1";
  for (ObjectDescription& object : scene.objects)
  {
    object.model = "models/m.ac";
    object.line = 7;
  }
  scene.objects[2].materials.resize(1);
  scene.objects[2].materials[0].texture = "t.png";
  scene.objects[2].materials[0].normalMap = "/n.png";
  scene.objects[2].materials[0].bump = "";
  scene.objects[2].materials[0].metallicRoughnessMap = "../m.png";
  scene.objects[2].materials[0].emissionMap = "e.png";
  scene.objects[2].materials[0].occlusionMap = "o.png";
  scene.order = { aCamera, { SceneItem::Kind::Object, 0 }, { SceneItem::Kind::Light, 0 },
    { SceneItem::Kind::Object, 1 }, { SceneItem::Kind::Light, 1 }, { SceneItem::Kind::Object, 2 } };
  return scene;
}

std::string namesOf(const SceneDescription& scene)
{
  std::string all;
  for (const SceneItem& item : scene.items())
  {
    const std::string parent = item.kind == SceneItem::Kind::Object ? scene.objects[item.index].parent : "";
    all += (all.empty() ? "" : " ") + itemName(scene, item) + (parent.empty() ? "" : "<" + parent);
  }
  return all + (scene.order.empty() ? "" : " listed");
}

TEST(SceneEditTables, ItemsComeAndGoInTheirOrder)
{
  EXPECT_EQ(namesOf(listed()), "c a l b Light1 d-4<a listed");
  SceneDescription scene = listed();
  removeItems(scene, { { SceneItem::Kind::Light, 0 }, anotherObject });
  EXPECT_EQ(namesOf(scene), "c a Light1 d-4<a listed");
  removeItems(scene, { anObject, aCamera });
  EXPECT_EQ(namesOf(scene), "Light1 listed") << "children go along";
  scene = listed();
  scene.order.clear();
  removeItems(scene, { anotherObject });
  EXPECT_EQ(namesOf(scene), "a d-4<a l Light1 c") << "what had no order has none";

  const SceneDescription part = extractItems(listed(), { { SceneItem::Kind::Object, 2 }, anObject, aCamera, aLight });
  EXPECT_EQ(namesOf(part), "a d-4<a l c");
  EXPECT_EQ(part.folder, "/scenes/one");
  scene = listed();
  const SceneItems added = appendItems(scene, part);
  EXPECT_EQ(namesOf(scene), "c a l b Light1 d-4<a a-2 d-5<a-2 l-2 c-2 listed");
  EXPECT_EQ(added, (SceneItems{ { SceneItem::Kind::Object, 3 }, { SceneItem::Kind::Object, 4 },
                     { SceneItem::Kind::Light, 2 }, { SceneItem::Kind::Camera, 1 } }));
  EXPECT_EQ(scene.objects[3].line, 0);
  EXPECT_EQ(scene.objects[0].line, 7);
  EXPECT_EQ(tracksOf(scene).size(), 2 * (tracksOf(listed()).size() - 1) + 1) << "with all their keys";
  scene = SceneDescription();
  appendItems(scene, extractItems(listed(), { { SceneItem::Kind::Object, 2 } }));
  EXPECT_EQ(namesOf(scene), "d-4") << "a parent that is nowhere is none";
}

TEST(SceneEditTables, PathsMoveBetweenFolders)
{
  const SceneDescription part = extractItems(listed(), { { SceneItem::Kind::Object, 2 } });
  const auto pathsIn = [&](const std::string& folder)
  {
    SceneDescription scene;
    scene.folder = folder;
    appendItems(scene, part);
    const ObjectDescription& object = scene.objects[0];
    const MaterialOverride& material = object.materials[0];
    return Strings{ object.model, *material.texture, *material.normalMap, *material.bump,
      *material.metallicRoughnessMap, *material.emissionMap, *material.occlusionMap };
  };
  EXPECT_EQ(pathsIn("/scenes/one"), (Strings{ "models/m.ac", "t.png", "/n.png", "", "../m.png", "e.png", "o.png" }));
  EXPECT_EQ(pathsIn("/scenes/two"),
    (Strings{ "../one/models/m.ac", "../one/t.png", "/n.png", "", "../m.png", "../one/e.png", "../one/o.png" }));
}

TEST(SceneEditTables, NamesAndPlacesOfEveryKind)
{
  SceneDescription scene = listed();
  scene.cameras.emplace_back().name = "posed";
  scene.cameras[1].posed = true;
  scene.order.clear();
  const std::vector<SceneItem> items = scene.items();
  const Strings names{ "a", "b", "d-4", "l", "Light1", "c", "posed" };
  ASSERT_EQ(items.size(), names.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    EXPECT_EQ(itemName(scene, items[i]), names[i]);
    SceneDescription renamed = scene;
    renameItem(renamed, items[i], "new");
    for (std::size_t k = 0; k < items.size(); ++k)
    {
      EXPECT_EQ(itemName(renamed, items[k]), k == i ? "new" : names[k]);
    }
    EXPECT_EQ(renamed.objects[2].parent, i == 0 ? "new" : "a");
    SceneDescription moved = scene;
    setItemPosition(moved, items[i], 12, { 1, 20, 300 });
    for (std::size_t k = 0; k < items.size(); ++k)
    {
      EXPECT_EQ(itemPosition(moved, items[k], 12), k == i ? V(1, 20, 300) : itemPosition(scene, items[k], 12));
    }
    EXPECT_EQ(moved.objects[0].position.keys.size(), i == 0 ? 4u : 3u);
    EXPECT_EQ(moved.lights[0].target.at(12), i == 3 ? V(1, 28, 300) : V(0, 8, 0));
    EXPECT_EQ(moved.lights[0].target.keys.size(), i == 3 ? 2u : 1u);
    EXPECT_EQ(moved.lights[1].target.value, V(0, 0, 0)) << "a point light aims at nothing";
    EXPECT_EQ(moved.cameras[0].lookAt.value, i == 5 ? V(1, 20, 290) : V(0, 0, 0));
    EXPECT_EQ(moved.cameras[1].lookAt.value, V(0, 0, 0));
    EXPECT_EQ(moved.cameras[1].eye.value, V(0, 0, 10));
  }
}

TEST(MotionTables, TurnsAndProducts)
{
  const Quaternion a{ 1, 2, 3, 4 };
  const Quaternion b{ 5, 6, 7, 8 };
  EXPECT_TRUE(product(a, b) == (Quaternion{ -60, 12, 30, 24 }));
  EXPECT_TRUE(product(b, a) == (Quaternion{ -60, 20, 14, 32 }));
  const Quaternion third = turn(V(0, 1, 0), 60);
  EXPECT_NEAR(third.w, std::sqrt(0.75), tableTolerance);
  EXPECT_NEAR(third.y, 0.5, tableTolerance);
  EXPECT_EQ(third.x, 0);
  EXPECT_EQ(third.z, 0);
}

/// An aimed light, one that is not, both kinds of cameras, two objects: what each mode does to each.
SceneDescription crowd()
{
  SceneDescription scene = keyed();
  scene.objects[0].position.keys.clear();
  scene.objects[0].scale = V(2, 2, 2);
  scene.objects[0].position.value = V(4, 0, 0);
  scene.objects[0].scale.keys.clear();
  scene.lights[0].target.keys.clear();
  scene.lights[0].position.value = V(0, 2, 0);
  scene.lights[0].target.value = V(3, 2, 0);
  scene.lights.emplace_back().name = "point";
  scene.lights[1].position.value = V(0, 0, 6);
  scene.cameras[0].fovY.keys.clear();
  scene.cameras.emplace_back().name = "posed";
  scene.cameras[1].posed = true;
  scene.cameras[1].position.value = V(2, 0, 2);
  return scene;
}

TEST(MotionTables, EveryModeOfEveryKind)
{
  const SceneDescription before = crowd();
  const ScenePlaces places = placeScene(before, ModelLibrary(), 0);
  const SceneItem kinds[] = { anObject, aLight, { SceneItem::Kind::Light, 1 }, aCamera,
    { SceneItem::Kind::Camera, 1 } };
  const bool rotates[] = { true, true, false, true, true };
  WorldMotion motion;
  motion.translation = V(1, 2, 3);
  motion.axis = V(0, 1, 0);
  motion.degrees = 90; // (x, y, z) -> (z, y, -x)
  motion.factors = V(2, 3, 4);
  for (std::size_t i = 0; i < 5; ++i)
  {
    const ItemMotion items(before, places, { kinds[i] }, 0);
    EXPECT_TRUE(items.can(HandleMode::Move));
    EXPECT_EQ(items.can(HandleMode::Rotate), rotates[i]) << i;
    EXPECT_EQ(items.can(HandleMode::Scale), i == 0) << i;
    EXPECT_FALSE(items.can(HandleMode::None));
    EXPECT_EQ(items.frame(), 0);
    EXPECT_EQ(items.axes(HandleMode::Rotate), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  }
  const ItemMotion all(before, places, SceneItems(std::begin(kinds), std::end(kinds)), 0);
  EXPECT_TRUE(all.can(HandleMode::Scale));
  EXPECT_FALSE(all.can(HandleMode::None));
  EXPECT_FALSE(ItemMotion(before, places, {}, 0).can(HandleMode::Move));
  // (4, 0, 0), (0, 2, 0), (0, 0, 6), (0, 0, 10), (2, 0, 2)
  EXPECT_EQ(all.pivot(), V(2, 1, 5)) << "of the common box";
  EXPECT_LT((all.pivot(HandlePivot::Origin) - V(6, 2, 18) / 5).norm(), tableTolerance) << "the mean";
  const auto expectScene = [&](HandleMode mode, const std::vector<V>& expected)
  {
    SceneDescription scene = before;
    motion.mode = mode;
    motion.pivot = V(0, 0, 0);
    all.apply(scene, motion);
    const std::vector<V> found{ scene.objects[0].position.value, scene.objects[0].scale.value,
      scene.lights[0].position.value, scene.lights[0].target.value, scene.lights[1].position.value,
      scene.lights[1].target.value, scene.cameras[0].eye.value, scene.cameras[0].lookAt.value,
      scene.cameras[0].up.value, scene.cameras[1].position.value, scene.cameras[1].eye.value,
      scene.cameras[1].lookAt.value };
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_LT((found[i] - expected[i]).norm(), tableTolerance)
        << int(mode) << ' ' << i << ": " << found[i].transpose();
    }
    EXPECT_EQ(scene.objects[1].position.value, before.objects[1].position.value);
    return scene;
  };
  SceneDescription scene =
    expectScene(HandleMode::Move, { V(5, 2, 3), V(2, 2, 2), V(1, 4, 3), V(4, 4, 3), V(1, 2, 9), V(0, 0, 0), V(1, 2, 13),
                                    V(1, 2, 3), V(0, 1, 0), V(3, 2, 5), V(0, 0, 10), V(0, 0, 0) });
  EXPECT_TRUE(scene.objects[0].orientation.value == Quaternion()) << "what moves does not turn";
  EXPECT_TRUE(scene.cameras[1].orientation.value == Quaternion());
  scene =
    expectScene(HandleMode::Rotate, { V(0, 0, -4), V(2, 2, 2), V(0, 2, 0), V(0, 2, -3), V(6, 0, 0), V(0, 0, 0),
                                      V(10, 0, 0), V(0, 0, 0), V(0, 1, 0), V(2, 0, -2), V(0, 0, 10), V(0, 0, 0) });
  const Quaternion quarter{ std::sqrt(0.5), 0, std::sqrt(0.5), 0 };
  for (const Quaternion& q : { scene.objects[0].orientation.value, scene.cameras[1].orientation.value })
  {
    EXPECT_LT((q - quarter).norm(), tableTolerance);
  }
  EXPECT_TRUE(scene.objects[1].orientation.value == Quaternion());
  scene = expectScene(HandleMode::Scale, { V(8, 0, 0), V(4, 6, 8), V(0, 6, 0), V(6, 6, 0), V(0, 0, 24), V(0, 0, 0),
                                           V(0, 0, 40), V(0, 0, 0), V(0, 1, 0), V(4, 0, 8), V(0, 0, 10), V(0, 0, 0) });
  EXPECT_TRUE(scene.objects[0].orientation.value == Quaternion());
  EXPECT_TRUE(scene.cameras[1].orientation.value == Quaternion());
  scene = before;
  motion.mode = HandleMode::None;
  all.apply(scene, motion);
  EXPECT_EQ(toJson(scene, ""), toJson(before, ""));
}

/// Several objects grow in the world's directions, each along its own axes by as much as they stretch.
TEST(MotionTables, SeveralGrowAsFarAsTheirAxesStretch)
{
  SceneDescription scene = crowd();
  scene.objects[0].orientation.value = turn(V(0, 0, 1), 90); // its x axis is the world's y
  scene.objects[1].parent = "";
  scene.objects[1].position.value = V(0, 0, 2);
  scene.objects[1].orientation.value = turn(V(0, 0, 1), 45);
  const ItemMotion items(scene, placeScene(scene, ModelLibrary(), 0), { anObject, anotherObject }, 0);
  WorldMotion motion;
  motion.mode = HandleMode::Scale;
  motion.factors = V(3, 4, 5);
  items.apply(scene, motion);
  EXPECT_LT((scene.objects[0].scale.value - V(8, 6, 10)).norm(), tableTolerance);
  const double slanted = std::sqrt((9 + 16) / 2.0);
  EXPECT_LT((scene.objects[1].scale.value - V(slanted, slanted, 5)).norm(), tableTolerance);
  EXPECT_LT((scene.objects[1].position.value - V(0, 0, 10)).norm(), tableTolerance);
}
} // namespace
