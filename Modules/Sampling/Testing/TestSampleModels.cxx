// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceBody.h"
#include "dgtkRandomScene.h"
#include "dgtkSampleModels.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

using namespace dgtk;

/// Each sample may give a model a colour or a picture that none had before.
TEST(SampleModels, KeepsFewLooks)
{
  const test::TemporaryFolder folder;
  SampleModels models;
  SceneDescription scene;
  scene.folder = folder.path();
  scene.objects.resize(50);
  std::size_t most = 0;
  for (int number = 0; number < 24; ++number)
  {
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
    {
      ObjectDescription& object = scene.objects[i];
      object.name = "ball" + std::to_string(i);
      object.model = test::sourceFile("Data/Models/ball.ac");
      object.materials.resize(1);
      object.materials[0].material = "*";
      object.materials[0].texture = "look" + std::to_string(number * 50 + int(i)) + ".ppm";
      std::ofstream(folder.path(*object.materials[0].texture)) << "P6 1 1 255\nabc";
    }
    EXPECT_EQ(models.stage(scene)->at(0)->instances.size(), 50U);
    most = std::max(most, models.looks());
  }
  EXPECT_GT(most, 500U) << "each look is one";
  EXPECT_LE(most, SampleModels::mostLooks + 50);
}

TEST(TriangleTree, ThePointOfATriangleThatIsNearest)
{
  constexpr double rounding = 1e-15; // of a few products about 1
  const SolidMesh mesh = solidMesh({ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } });
  const TriangleTree tree(mesh, 0, 1);
  const Eigen::Vector3d cases[][2] = { // where, and what is nearest: corners, sides, the face
    { { -1, -1, 3 }, { 0, 0, 0 } }, { { 3, -0.5, 1 }, { 2, 0, 0 } }, { { -0.2, 2, -1 }, { 0, 1, 0 } },
    { { 0.25, -1, 2 }, { 0.25, 0, 0 } }, { { -1, 0.25, 1 }, { 0, 0.25, 0 } }, { { 1.3, 1.1, 2 }, { 1, 0.5, 0 } },
    { { 0.5, 0.25, -3 }, { 0.5, 0.25, 0 } }
  };
  for (const auto& [where, expected] : cases)
  {
    EXPECT_LT((tree.nearest(where) - expected).norm(), rounding) << where.transpose();
  }
}

TEST(RandomScene, SaysWhereItIsRandom)
{
  const auto scene = RandomScene::ofText(R"({ "parameters": { "size": { "uniform": [1, 2] } },
    "objects": [ { "name": "a", "scale": "$size", "position": [0, { "normal": [0, 1] }, 0] },
      { "name": "b", "count": 3, "place": { "on": "a", "clearance": { "uniform": [0, 1] } } } ],
    "lights": [ { "name": "l", "intensity": 2 } ] })",
    ".");
  std::vector<std::string> found;
  for (const RandomScene::Place& place : scene->places())
  {
    found.push_back(place.path + ' ' + place.word);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found,
    (std::vector<std::string>{ "objects[0].position[1] normal", "objects[0].scale $size", "objects[1].count count",
      "objects[1].place place", "objects[1].place.clearance uniform", "parameters.size uniform" }));
}
