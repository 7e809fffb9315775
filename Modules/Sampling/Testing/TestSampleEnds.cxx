// SPDX-License-Identifier: BSD-3-Clause
// Single draws: the ends of what may be said, and points that geometry decides.
#include "dgtkDistributions.h"
#include "dgtkPlaceSamples.h"
#include "dgtkSampleGeometry.h"
#include "dgtkSceneRandom.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace dgtk;
using testing::HasSubstr;

namespace
{
JsonNode drawOne(const std::string& json, UpAxis up = UpAxis::Y)
{
  const JsonDocument document = parseJson("test", json);
  const JsonCursor at(document);
  const SampleDraws draw(11, 0);
  return drawnValue(randomWordOf({}, document.root), at, ValueUniforms(draw, "objects/a/b", 0, false), up);
}

std::string refusalOfDraw(const std::string& json)
{
  return test::thrownBy<InputError>([&] { drawOne(json); });
}

Eigen::Vector3d drawnPoint(const JsonNode& node)
{
  return { node.children.at(0).number, node.children.at(1).number, node.children.at(2).number };
}
} // namespace

TEST(SampleEnds, RangesOfOneNumberHaveThatNumber)
{
  EXPECT_EQ(drawOne("{\"uniform\": [2, 2]}").number, 2);
  EXPECT_EQ(drawOne("{\"logUniform\": [3, 3]}").number, 3);
  EXPECT_EQ(drawOne("{\"integer\": [-5, -5]}").number, -5);
  EXPECT_EQ(drawnPoint(drawOne("{\"inBox\": [[1, 2, 3], [1, 2, 3]]}")), Eigen::Vector3d(1, 2, 3));
  for (const char* empty : { "{\"uniform\": [2, 1]}", "{\"logUniform\": [3, 2]}", "{\"integer\": [4, 3]}",
         "{\"inBox\": [[1, 2, 3], [1, 2, 2]]}", "{\"normal\": {\"mean\": 0, \"deviation\": 1, \"min\": 1, \"max\": 1}}",
         "{\"normal\": {\"mean\": 0, \"deviation\": 1, \"min\": 1, \"max\": -1}}" })
  {
    EXPECT_THAT(refusalOfDraw(empty), HasSubstr("is empty")) << empty;
  }
  EXPECT_THAT(refusalOfDraw("{\"normal\": {\"mean\": 0, \"deviation\": 0.5, \"min\": 19}}"), HasSubstr("too far"));
  EXPECT_THAT(refusalOfDraw("{\"normal\": {\"mean\": 0, \"deviation\": 0.5, \"max\": -19}}"), HasSubstr("too far"));
  EXPECT_GE(drawOne("{\"normal\": {\"mean\": 0, \"deviation\": 0.5, \"min\": 18}}").number, 18);
  EXPECT_LE(drawOne("{\"normal\": {\"mean\": 0, \"deviation\": 0.5, \"max\": -18}}").number, -18);
}

TEST(SampleEnds, ShellsAreAroundPointsAndObjects)
{
  // straight up, as the scene says
  const std::string above = "\"radius\": 5, \"elevation\": 90}}";
  EXPECT_LE(
    (drawnPoint(drawOne("{\"shell\": {\"center\": [1, 2, 3], " + above)) - Eigen::Vector3d(1, 7, 3)).norm(), 1e-14);
  EXPECT_LE(
    (drawnPoint(drawOne("{\"shell\": {\"center\": [1, 2, 3], " + above, UpAxis::Z)) - Eigen::Vector3d(1, 2, 8)).norm(),
    1e-14);
  // level, along the axes from which longitudes count
  const auto level = [](const std::string& azimuth, UpAxis up)
  {
    const std::string shell = "{\"shell\": {\"center\": [1, 2, 3], \"radius\": 5, \"elevation\": 0, \"azimuth\": ";
    return drawnPoint(drawOne(shell + azimuth + "}}", up));
  };
  EXPECT_LE((level("0", UpAxis::Y) - Eigen::Vector3d(1, 2, 8)).norm(), 1e-14);
  EXPECT_LE((level("90", UpAxis::Y) - Eigen::Vector3d(6, 2, 3)).norm(), 1e-14);
  EXPECT_LE((level("0", UpAxis::Z) - Eigen::Vector3d(6, 2, 3)).norm(), 1e-14);
  EXPECT_LE((level("90", UpAxis::Z) - Eigen::Vector3d(1, 7, 3)).norm(), 1e-14);
  GeometryPoint point = geometryPointOf(drawOne("{\"shell\": {\"center\": \"ball\", " + above));
  EXPECT_FALSE(point.onSurface);
  EXPECT_EQ(point.object, "ball");
  EXPECT_LE((point.numbers - Eigen::Vector3d(0, 5, 0)).norm(), 1e-14);
  const auto center = [](bool onSurface)
  {
    return std::string("{\"shell\": {\"center\": {\"$geometry\": ") + (onSurface ? "true" : "false") +
           ", \"object\": \"ball\", \"numbers\": [1, 2, 3], \"above\": 0}, ";
  };
  point = geometryPointOf(drawOne(center(false) + above));
  EXPECT_EQ(point.object, "ball");
  EXPECT_LE((point.numbers - Eigen::Vector3d(1, 7, 3)).norm(), 1e-14) << "away from where that was";
  EXPECT_THAT(refusalOfDraw(center(true) + above), HasSubstr("cannot be on a surface"));
}

TEST(SampleEnds, PointsOnSurfacesMayStandAboveThem)
{
  GeometryPoint point = geometryPointOf(drawOne("{\"onSurface\": \"ball\"}"));
  EXPECT_TRUE(point.onSurface);
  EXPECT_EQ(point.object, "ball");
  EXPECT_EQ(point.above, 0);
  point = geometryPointOf(drawOne("{\"onSurface\": {\"object\": \"ball\", \"above\": -2.5}}"));
  EXPECT_EQ(point.object, "ball");
  EXPECT_EQ(point.above, -2.5);
  EXPECT_EQ(geometryPointOf(drawOne("{\"onSurface\": {\"object\": \"ball\"}}")).above, 0);
}

// A square whose front is towards +z, whichever of its sides are swapped within its plane.
TEST(SampleEnds, NormalsOfMirroredObjectsAreOnTheirFront)
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("square.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
  for (const Eigen::Vector3d& scale : { Eigen::Vector3d(1, 1, 1), { -1, 1, 1 }, { 1, -2, 1 }, { -1, -1, 1 } })
  {
    PlaceScene made;
    made.add("square", folder.path("square.obj")).scale = scale;
    const DrawnSurfacePoint point = SampleGeometry(made.scene, PlaceScene::models()).onSurface(0, { 0.1, 0.2, 0.3 });
    EXPECT_LE((point.normal_in_world - Eigen::Vector3d(0, 0, 1)).norm(), 1e-14) << scale.transpose();
  }
}

// A tetrahedron that goes along x by 10 in a second.
TEST(SampleEnds, DeformingModelsHaveTheShapeOfTheFirstFrame)
{
  const test::TemporaryFolder folder;
  const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAA"
                           "AAAAAAAAAAAIA/AAACAAEAAAABAAMAAAADAAIAAQACAAMAAAAA"
                           "AAAAgD8AAAAAAAAAAAAAAAAAACBBAAAAAAAAAAA=";
  writeFile(folder.path("goes.gltf"),
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"n"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":104,"uri":"data:application/octet-stream;base64,)" +
      data + R"("}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24},
{"buffer":0,"byteOffset":72,"byteLength":8},{"buffer":0,"byteOffset":80,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"}],
"animations":[{"samplers":[{"input":2,"output":3}],
"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}]})");
  PlaceScene made;
  made.scene.fps = 25;
  made.scene.extraKeyFrames = { 10, 20 };
  made.add("goes", folder.path("goes.gltf"));
  const SampleGeometry geometry(made.scene, PlaceScene::models());
  EXPECT_LE((geometry.centreOf({ 0 }) - Eigen::Vector3d(4.5, 0.5, 0.5)).norm(), 1e-6);
  EXPECT_GE(geometry.onSurface(0, { 0.5, 0.5, 0.5 }).x_in_world.x(), 4);
}

// Of [0, 1) each choice has a part that begins with its first number.
TEST(SampleEnds, ChoicesBeginWhereTheOneBeforeEnds)
{
  EXPECT_EQ(chosen(0, 2, {}), 0u);
  EXPECT_EQ(chosen(0.5, 2, {}), 1u);
  EXPECT_EQ(chosen(0, 3, { 1, 2, 1 }), 0u);
  EXPECT_EQ(chosen(0.25, 3, { 1, 2, 1 }), 1u);
  EXPECT_EQ(chosen(0.75, 3, { 1, 2, 1 }), 2u);
  EXPECT_EQ(chosen(0, 3, { 0, 2, 0 }), 1u);
  EXPECT_EQ(chosen(1, 3, { 1, 2, 0 }), 1u) << "none that has no weight, whatever is rounded";
  EXPECT_EQ(chosen(1, 3, {}), 2u);
}
