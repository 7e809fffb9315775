// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDocument.h"

#include "dgtkError.h"
#include "dgtkTestSupport.h"
#include "dgtkUniqueNames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <limits>
#include <string>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr SceneItem::Kind ofObject = SceneItem::Kind::Object;

SceneDescription chain()
{
  SceneDescription scene;
  for (const char* name : { "a", "b", "c", "d" })
  {
    ObjectDescription object;
    object.name = name;
    object.model = "m.ac";
    scene.objects.push_back(object);
  }
  scene.objects[1].parent = "a";
  scene.objects[2].parent = "b";
  return scene;
}

TEST(SceneEdits, TracksChangeWhereTheyAreChanged)
{
  Track<double> track(3);
  setTrackAt(track, 7, 4.0);
  EXPECT_FALSE(track.animated());
  EXPECT_EQ(track.value, 4);
  track.keys = { { 0, 1 }, { 10, 2 } };
  setTrackAt(track, 10, 5.0);
  setTrackAt(track, 4, 9.0);
  setTrackAt(track, 20, 8.0);
  const std::vector<Key<double>> expected{ { 0, 1 }, { 4, 9 }, { 10, 5 }, { 20, 8 } };
  EXPECT_EQ(track.keys, expected);
}

TEST(SceneEdits, NamesStayUnique)
{
  EXPECT_EQ(uniqueName({ "tree", "tree-2" }, "tree"), "tree-3");
  EXPECT_EQ(uniqueName({ "tree-2" }, "tree-2"), "tree-3");
  EXPECT_EQ(uniqueName({ "7" }, "7"), "8");
  EXPECT_EQ(uniqueName({ "Light0", "Light1" }, "Light0"), "Light2");
  EXPECT_EQ(uniqueName({ "a12345678901" }, "a12345678901"), "a12345678901-2");
  EXPECT_EQ(uniqueName({ "a123456789" }, "a123456789"), "a123456789-2");
  EXPECT_EQ(uniqueName({ "a12345678" }, "a12345678"), "a12345679");
  EXPECT_EQ(uniqueName({}, "tree"), "tree");
  EXPECT_EQ(uniqueName({ "oak003", "oak004", "oak5" }, "oak003"), "oak005");
  EXPECT_EQ(uniqueName({ "oak099", "oak98" }, "oak099"), "oak100");
  EXPECT_EQ(uniqueName({ "oak99", "oak09" }, "oak99"), "oak100");
  EXPECT_EQ(uniqueName({ "0", "00" }, "00"), "01");
  UniqueNames both;
  for (const char* name : { "oak3", "oak3", "oak003", "oak003" })
  {
    both.add(name);
  }
  EXPECT_EQ(both.rename("oak3"), "oak4");
  EXPECT_EQ(both.rename("oak003"), "oak004") << "oak4 is another name";
}

/// A second array goes on with the numbers of the first one, in its own order.
TEST(SceneEdits, NumbersOfWhatIsAddedAscend)
{
  const auto numbered = [](int count)
  {
    SceneDescription scene;
    for (int i = 1; i <= count; ++i)
    {
      scene.cameras.emplace_back().name = "eye-" + std::to_string(i);
    }
    return scene;
  };
  SceneDescription scene = numbered(5);
  appendItems(scene, numbered(7));
  for (std::size_t i = 0; i < 12; ++i)
  {
    EXPECT_EQ(scene.cameras[i].name, "eye-" + std::to_string(i + 1));
  }
}

TEST(SceneEdits, ManyNamesStayUnique)
{
  UniqueNames names;
  for (const char* name : { "a-9", "a-7", "a-7", "a-7", "a-8", "a-11", "a-007", "a-007", "a", "a", "a-" })
  {
    names.add(name);
  }
  EXPECT_EQ(names.rename("a-9"), "a-9") << "nobody else has it";
  EXPECT_EQ(names.rename("a-9"), "a-9") << "and still nobody";
  EXPECT_EQ(names.rename("a-7"), "a-10");
  EXPECT_EQ(names.rename("a-7"), "a-12");
  EXPECT_EQ(names.rename("a-7"), "a-7");
  EXPECT_EQ(names.rename("a-007"), "a-008") << "a-8 is another name";
  EXPECT_EQ(names.rename("a"), "a-2");
  EXPECT_FALSE(names.holds("a-3"));
  names.add("a-2");
  EXPECT_EQ(names.rename("a-2"), "a-3");
  names.add("a-");
  EXPECT_EQ(names.rename("a-"), "a--2");
  EXPECT_TRUE(names.holds("a-12"));
}

/// Processor time of copying, removing and undoing all of a scene, the least of three.
double timeOfCopies(std::size_t count)
{
  SceneDescription scene;
  for (std::size_t i = 0; i < count; ++i)
  {
    ObjectDescription object;
    object.name = "tree-" + std::to_string(i + 1);
    object.model = "tree.ac";
    object.parent =
      i % 2 == 1 && i + 1 < count ? "tree-" + std::to_string(i + 2) : std::string(); // a child of the next
    scene.objects.push_back(object);
  }
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i)
  {
    SceneDescription copy = scene;
    const std::clock_t began = std::clock();
    const SceneItems added = appendItems(copy, extractItems(copy, withChildren(copy, copy.items())));
    EXPECT_EQ(copy.objects.back().name, "tree-" + std::to_string(2 * count));
    removeItems(copy, added);
    EXPECT_EQ(copy.objects.size(), count);
    least = std::min(least, double(std::clock() - began) / CLOCKS_PER_SEC);
  }
  return least;
}

TEST(SceneEdits, CopiesTakeTimeByTheirNumber)
{
  // Eight times as many take eight times as long, with what caches and busy machines add; squares would take 64.
  constexpr double mostGrowth = 30;
  const double few = timeOfCopies(1000);
  EXPECT_LT(timeOfCopies(8000), mostGrowth * few);
}

TEST(SceneEdits, FamiliesAreWhole)
{
  SceneDescription scene = chain();
  std::reverse(scene.objects.begin(), scene.objects.end()); // d, c of b, b of a, a
  const SceneItem light{ SceneItem::Kind::Light, 0 };
  EXPECT_EQ(withChildren(scene, { light, { ofObject, 3 }, { ofObject, 1 } }),
    (SceneItems{ light, { ofObject, 3 }, { ofObject, 1 }, { ofObject, 2 } }));
  EXPECT_EQ(withChildren(scene, { { ofObject, 0 } }), (SceneItems{ { ofObject, 0 } }));
  EXPECT_TRUE(withChildren(scene, {}).empty());
}

TEST(SceneEdits, RemovingTakesChildrenAlong)
{
  SceneDescription scene = chain();
  scene.lights.resize(2);
  scene.lights[0].name = "l";
  scene.lights[1].name = "m";
  removeItems(scene, { { ofObject, 1 }, { SceneItem::Kind::Light, 0 } });
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(scene.objects[1].name, "d");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].name, "m");
  validate(scene);
}

TEST(SceneEdits, CopiesOfAFamilyBelongTogether)
{
  SceneDescription scene = chain();
  const SceneItems added =
    appendItems(scene, extractItems(scene, { { ofObject, 0 }, { ofObject, 1 }, { ofObject, 2 } }));
  ASSERT_EQ(added.size(), 3u);
  EXPECT_EQ(scene.objects[4].name, "a-2");
  EXPECT_EQ(scene.objects[5].parent, "a-2");
  EXPECT_EQ(scene.objects[6].parent, "b-2");
  EXPECT_EQ(scene.objects[1].parent, "a");
  appendItems(scene, extractItems(scene, { { ofObject, 2 } }));
  EXPECT_EQ(scene.objects[7].parent, "b") << "a child alone stays with its parent";
  validate(scene);
}

TEST(SceneEdits, RenamingIsSeenByChildren)
{
  SceneDescription scene = chain();
  renameItem(scene, { ofObject, 1 }, "other");
  EXPECT_EQ(scene.objects[2].parent, "other");
  validate(scene);
}

TEST(SceneEdits, KeyFramesHoldWhatIsThere)
{
  // The thesis's walk-through A.3: a key frame, another frame, a move, another key frame.
  SceneDescription scene = chain();
  scene.cameras.resize(1);
  scene.cameras[0].name = "Camera0";
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    scene.objects[i].name = "m-" + std::to_string(i + 1);
    scene.objects[i].parent.clear();
  }
  makeKeyFrame(scene, 0);
  setItemPosition(scene, { ofObject, 3 }, 10, { 4, 0, 0 });
  makeKeyFrame(scene, 10);
  EXPECT_EQ(scene.firstFrame(), 0);
  EXPECT_EQ(scene.lastFrame(), 10);
  EXPECT_EQ(scene.objects[3].position.at(5), Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(scene.objects[0].position.at(5), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(scene.cameras[0].eye.keys.size(), 2u);
  EXPECT_TRUE(scene.cameras[0].position.keys.empty()) << "the pose that is not in use";
  EXPECT_EQ(keyFramesOf(scene, { ofObject, 0 }), (std::vector<int>{ 0, 10 }));
  validate(scene);
  EXPECT_NO_THROW(toThesisScene(scene, ""));
  removeKeyFrame(scene, 0);
  removeKeyFrame(scene, 10);
  EXPECT_TRUE(scene.keyFrames().empty());
  EXPECT_EQ(scene.objects[3].position.value, Eigen::Vector3d(4, 0, 0));
}

TEST(SceneEdits, KeyFramesAreCopiedAndInterpolated)
{
  SceneDescription scene = chain();
  makeKeyFrame(scene, 0);
  setItemPosition(scene, { ofObject, 0 }, 10, { 10, 0, 0 });
  setInterpolation(scene, { ofObject, 0 }, Interpolation::Step);
  EXPECT_EQ(interpolationOf(scene, { ofObject, 0 }), Interpolation::Step);
  EXPECT_EQ(interpolationOf(scene, { ofObject, 1 }), Interpolation::Linear);
  EXPECT_EQ(scene.objects[0].position.at(9), Eigen::Vector3d(0, 0, 0));
  copyKeyFrame(scene, 10, 4);
  EXPECT_EQ(scene.objects[0].position.at(4), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(scene.objects[1].position.keys.size(), 1u) << "it has no key to copy";
  copyKeyFrame(scene, 0, 20);
  removeKeyFrame(scene, 0);
  EXPECT_EQ(scene.keyFrames(), (std::vector<int>{ 4, 10, 20 }));
  EXPECT_EQ(scene.objects[0].position.at(25), Eigen::Vector3d(0, 0, 0));
}

TEST(SceneEdits, KeysMoveWithTheirInterpolation)
{
  SceneDescription scene = chain();
  makeKeyFrame(scene, 0);
  setItemPosition(scene, { ofObject, 0 }, 10, { 10, 0, 0 });
  setItemPosition(scene, { ofObject, 1 }, 10, { 20, 0, 0 });
  setKeyInterpolation(scene, { ofObject, 0 }, 0, Interpolation::Step);
  EXPECT_EQ(scene.objects[0].position.at(9), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(scene.objects[1].position.at(5), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(keyInterpolationOf(scene, { ofObject, 0 }, 0)->kind, Interpolation::Step);
  EXPECT_TRUE(keyInterpolationOf(scene, { ofObject, 0 }, 0)->own);
  EXPECT_FALSE(keyInterpolationOf(scene, { ofObject, 1 }, 0)->own);
  EXPECT_FALSE(keyInterpolationOf(scene, { ofObject, 0 }, 3));

  copyItemKeys(scene, { ofObject, 0 }, 0, 20);
  EXPECT_EQ(keyFramesOf(scene, { ofObject, 0 }), (std::vector<int>{ 0, 10, 20 }));
  EXPECT_EQ(keyFramesOf(scene, { ofObject, 1 }), (std::vector<int>{ 0, 10 }));
  EXPECT_EQ(keyInterpolationOf(scene, { ofObject, 0 }, 20)->kind, Interpolation::Step);
  moveItemKeys(scene, { ofObject, 0 }, 10, 4);
  EXPECT_EQ(scene.objects[0].position.at(4), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(scene.objects[0].position.keys.size(), 3u);
  moveItemKeys(scene, { ofObject, 0 }, 4, 20);
  EXPECT_EQ(scene.objects[0].position.at(20), Eigen::Vector3d(10, 0, 0)) << "in place of the key that was there";
  EXPECT_FALSE(
    keyInterpolationOf(scene, { ofObject, 0 }, 20)->own && scene.objects[0].position.keys.back().interpolation);
  moveItemKeys(scene, { ofObject, 0 }, 7, 8);
  moveItemKeys(scene, { ofObject, 0 }, 0, 0);
  EXPECT_EQ(scene.objects[0].position.keys.size(), 2u) << "no key, or no way";

  scene.extraKeyFrames = { 10 };
  moveKeyFrame(scene, 10, 12);
  EXPECT_EQ(keyFramesOf(scene, { ofObject, 1 }), (std::vector<int>{ 0, 12 }));
  EXPECT_EQ(scene.extraKeyFrames, std::vector<int>{ 12 });
  removeItemKeys(scene, { ofObject, 1 }, 12);
  EXPECT_EQ(keyFramesOf(scene, { ofObject, 1 }), std::vector<int>{ 0 });

  // A key that is put between two goes on as the one before it.
  setItemPosition(scene, { ofObject, 0 }, 5, { 1, 0, 0 });
  EXPECT_EQ(scene.objects[0].position.at(19), Eigen::Vector3d(1, 0, 0));
  setInterpolation(scene, { ofObject, 0 }, Interpolation::Linear);
  EXPECT_FALSE(keyInterpolationOf(scene, { ofObject, 0 }, 0)->own);
}

TEST(SceneEdits, MovingTakesLookAtPointsAndTargetsAlong)
{
  SceneDescription scene;
  scene.cameras.resize(2);
  scene.cameras[1].posed = true;
  scene.lights.resize(1);
  scene.lights[0].kind = LightKind::Spot;
  setItemPosition(scene, { SceneItem::Kind::Camera, 0 }, 0, { 1, 2, 13 });
  EXPECT_EQ(scene.cameras[0].lookAt.value, Eigen::Vector3d(1, 2, 3));
  setItemPosition(scene, { SceneItem::Kind::Camera, 1 }, 0, { 1, 2, 3 });
  EXPECT_EQ(scene.cameras[1].position.value, Eigen::Vector3d(1, 2, 3));
  setItemPosition(scene, { SceneItem::Kind::Light, 0 }, 0, { 0, 5, 0 });
  EXPECT_EQ(scene.lights[0].target.value, Eigen::Vector3d(0, 5, 0));
}

TEST(SceneEdits, PastedElsewhereModelsAreStillFound)
{
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  const SceneDescription house = extractItems(document.scene(), { { ofObject, 1 } });
  document.clear();
  document.paste("Paste", house);
  const std::string file = document.scene().resolve(document.scene().objects.front().model);
  EXPECT_TRUE(std::filesystem::equivalent(file, sourceFile("Data/Models/house.ac"))) << file;
  const std::filesystem::path model = document.scene().objects.front().model;
  EXPECT_EQ(model, model.lexically_normal()) << "nothing leads into a folder and out again";
}

/// A smooth curve with keys of 1, 0 and 0 is at -1/16 between the last two; what has a range stays at 0.
TEST(SceneEdits, AKeyFrameHasWhatIsSeenThere)
{
  using V = Eigen::Vector3d;
  Track<double> number;
  number.keys = { { 0, 1 }, { 4, 0 }, { 8, 0 } };
  number.interpolation = Interpolation::Smooth;
  Track<V> vector;
  vector.keys = { { 0, V(1, 1, 1) }, { 4, V(0, 0, 0) }, { 8, V(0, 0, 0) } };
  vector.interpolation = Interpolation::Smooth;
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].materials.resize(1);
  scene.lights.resize(1);
  scene.cameras.resize(2);
  scene.cameras[1].posed = true;
  ObjectDescription& object = scene.objects[0];
  LightDescription& light = scene.lights[0];
  CameraDescription& camera = scene.cameras[0];
  object.materials[0].opacity = number;
  object.materials[0].diffuse = vector;
  camera.parameters["xi"].numbers = { number };
  const std::vector<Track<double>*> numbers{ &scene.fog.density, &scene.fog.start, &*object.materials[0].opacity,
    &light.intensity, &light.coneAngle, &light.exponent, &camera.fovY, &camera.viewHeight, &camera.lens.focus,
    &camera.parameters["xi"].numbers[0] };
  const std::vector<Track<V>*> colors{ &scene.background, &scene.fog.color, &*object.materials[0].diffuse,
    &light.ambient, &light.diffuse, &light.specular };
  const std::vector<Track<V>*> places{ &object.position, &object.scale, &light.position, &light.target, &camera.eye,
    &camera.lookAt, &camera.up, &scene.cameras[1].position };
  for (Track<double>* track : numbers)
  {
    *track = number;
  }
  for (const auto* list : { &colors, &places })
  {
    for (Track<V>* track : *list)
    {
      *track = vector;
    }
  }
  makeKeyFrame(scene, 6);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    EXPECT_EQ(numbers[i]->keys.at(2), (Key<double>{ 6, 0 })) << i;
  }
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    EXPECT_EQ(colors[i]->keys.at(2), (Key<V>{ 6, V(0, 0, 0) })) << i;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_EQ(places[i]->keys.at(2), (Key<V>{ 6, V(-1, -1, -1) / 16 })) << i;
  }
}
} // namespace
