// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpDeformation.h"
#include "dgtkAssimpStream.h"
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk::test;
using Json = nlohmann::json;

namespace
{
/// Keys are 32-bit floats.
constexpr double floatTolerance = 1e-6;

Json sampler(int input, int output, const char* interpolation = "LINEAR")
{
  return { { "input", input }, { "output", output }, { "interpolation", interpolation } };
}

Json channel(int index, int node, const char* path)
{
  return { { "sampler", index }, { "target", { { "node", node }, { "path", path } } } };
}

/// Node 0 moves, turns and changes shape; node 1 is bent by joints 2 and 3, of which 3 turns about its own end.
GltfMaker animated()
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const int strip = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 2, 0 });
  const int uvs = maker.floats("VEC2", { 0, 0, 1, 0, 0, 1 });
  const int indices = maker.shorts("SCALAR", { 0, 1, 2 });
  const int target = maker.floats("VEC3", { 0, 0, 1, 0, 0, 2, 0, 0, 3 });
  const int joints = maker.bytes("VEC4", { 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0 });
  const int weights = maker.floats("VEC4", { 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0 });
  const int inverse = maker.floats(
    "MAT4", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1 });
  const int times = maker.floats("SCALAR", { 0, 1, 2 });
  const int moves = maker.floats("VEC3", { 0, 0, 0, 2, 0, 0, 2, 4, 0 });
  const auto half = static_cast<float>(std::sqrt(0.5));
  const int turns = maker.floats("VEC4", { 0, 0, 0, 1, 0, 0, half, half, 0, 0, 1, 0 });
  const int shapes = maker.floats("SCALAR", { 0, 1, 0.5f });
  maker.json["scenes"] = { { { "nodes", { 0, 1, 2 } } } };
  maker.json["nodes"] = { { { "name", "Mover" }, { "mesh", 0 } }, { { "name", "Bent" }, { "mesh", 1 }, { "skin", 0 } },
    { { "name", "Root" }, { "children", { 3 } } }, { { "name", "Tip" }, { "translation", { 0, 1, 0 } } } };
  maker.json["meshes"] = {
    { { "name", "Triangle" }, { "weights", { 0 } },
      { "primitives", { { { "attributes", { { "POSITION", positions }, { "TEXCOORD_0", uvs } } },
                        { "indices", indices }, { "targets", { { { "POSITION", target } } } } } } } },
    { { "name", "Strip" },
      { "primitives", { { { "attributes", { { "POSITION", strip }, { "JOINTS_0", joints }, { "WEIGHTS_0", weights } } },
                        { "indices", indices } } } } }
  };
  maker.json["skins"] = { { { "joints", { 2, 3 } }, { "inverseBindMatrices", inverse } } };
  maker.json["animations"] = { { { "name", "Dance" },
    { "channels", { channel(0, 0, "translation"), channel(1, 0, "weights"), channel(2, 3, "rotation") } },
    { "samplers", { sampler(times, moves), sampler(times, shapes), sampler(times, turns) } } } };
  return maker;
}

std::vector<Eigen::Vector3d> at(const dgtk::Model& model, double frame)
{
  std::vector<Eigen::Vector3d> positions;
  model.deformation->positionsAt(0, frame, positions);
  return positions;
}

void expectFloats(const Eigen::Vector3d& expected, const Eigen::Vector3d& found)
{
  EXPECT_LT((expected - found).norm(), floatTolerance) << expected.transpose() << " against " << found.transpose();
}
} // namespace

TEST(Gltf, NodesMorphTargetsAndSkinsMoveExactly)
{
  const GltfMaker maker = animated();
  for (const auto& [extension, bytes] : { std::pair{ "gltf", maker.gltf() }, std::pair{ "glb", maker.glb() } })
  {
    const auto model = readBytes(extension, bytes);
    EXPECT_EQ(brokenPromise(*model), "");
    EXPECT_EQ(model->format, "gltf");
    ASSERT_EQ(model->triangles.size(), 2u);
    ASSERT_EQ(model->animations.size(), 1u);
    EXPECT_EQ(model->animations[0].name, "Dance");
    EXPECT_EQ(model->animations[0].last, 60);
    EXPECT_EQ(model->animations[0].fps, 30);
    EXPECT_EQ(model->frames, 61);
    ASSERT_EQ(model->sourceVertices, 6u);
    for (const double frame : { 0.0, 7.5, 15.0, 30.0, 44.25, 60.0, 1000.0 })
    {
      const double time = std::min(frame / 30, 2.0);
      const std::vector<Eigen::Vector3d> p = at(*model, frame);
      ASSERT_EQ(p.size(), 6u);
      const Eigen::Vector3d move(time < 1 ? 2 * time : 2, time < 1 ? 0 : 4 * (time - 1), 0);
      const double shape = time < 1 ? time : 1 - 0.5 * (time - 1);
      expectFloats(move + Eigen::Vector3d(0, 0, shape), p[0]);
      expectFloats(move + Eigen::Vector3d(1, 0, 2 * shape), p[1]);
      expectFloats(move + Eigen::Vector3d(0, 1, 3 * shape), p[2]);
      // the tip turns about (0, 1, 0), a quarter turn a second
      const double angle = time * 1.57079632679489661923;
      const auto bent = [angle](double x, double y)
      {
        return Eigen::Vector3d(
          x * std::cos(angle) - (y - 1) * std::sin(angle), 1 + x * std::sin(angle) + (y - 1) * std::cos(angle), 0);
      };
      expectFloats({ 0, 0, 0 }, p[3]);
      expectFloats(0.5 * Eigen::Vector3d(1, 0, 0) + 0.5 * bent(1, 0), p[4]);
      expectFloats(bent(0, 2), p[5]);
    }
  }
}

TEST(Gltf, HalfAQuarterTurnIsAnEighth)
{
  const auto model = readBytes("gltf", animated().gltf());
  // slerp, not a normalised blend: a third of the way is 30 degrees
  const std::vector<Eigen::Vector3d> p = at(*model, 10);
  expectFloats({ -0.5, 1 + std::sqrt(3) / 2, 0 }, p[5]);
}

TEST(Gltf, AMeshMovesWithTheNodesAboveIt)
{
  GltfMaker maker = plain({ { "name", "m" } });
  maker.json["nodes"][0].erase("scale");
  const int times = maker.floats("SCALAR", { 0, 1 });
  const int moves = maker.floats("VEC3", { 0, 0, 0, 2, 0, 0 });
  maker.json["animations"] = { { { "channels", { channel(0, 0, "translation") } },
    { "samplers", { sampler(times, moves) } } } };
  const auto model = readBytes("gltf", maker.gltf());
  ASSERT_TRUE(model->deformation);
  expectFloats({ 1, 0, 3 }, at(*model, 15)[0]);
}

TEST(Gltf, StepsBeginAtTheFrameOfTheirKey)
{
  for (const int fps : { 24, 25, 30, 60 })
  {
    std::vector<float> times;
    std::vector<float> places;
    for (int i = 0; i < 200; ++i)
    {
      times.push_back(float(i) / float(fps));
      places.insert(places.end(), { float(i), 0, 0 });
    }
    GltfMaker maker = plain({ { "name", "m" } });
    maker.json["nodes"][0].erase("scale");
    const int input = maker.floats("SCALAR", times);
    const int output = maker.floats("VEC3", places);
    maker.json["animations"] = { { { "channels", { channel(0, 0, "translation") } },
      { "samplers", { sampler(input, output, "STEP") } } } };
    const auto model = readBytes("gltf", maker.gltf());
    for (int i = 0; i < 200; ++i)
    {
      EXPECT_EQ(at(*model, 30.0 * i / fps)[0].x(), i) << fps;
    }
    EXPECT_EQ(at(*model, 30.0 * 7 / fps - 0.001)[0].x(), 6) << fps;
  }
}

TEST(Gltf, AnAnimationLastsAsLongAsItsKeys)
{
  for (const double seconds : { 41.0 / 24, 0.25 / 24, 2.0 })
  {
    GltfMaker maker = plain({ { "name", "m" } });
    maker.json["nodes"][0].erase("scale");
    const int times = maker.floats("SCALAR", { 0, float(seconds) });
    const int moves = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0 });
    maker.json["animations"] = { { { "channels", { channel(0, 0, "translation") } },
      { "samplers", { sampler(times, moves) } } } };
    const auto model = readBytes("gltf", maker.gltf());
    const dgtk::Animation& animation = model->animations.at(0);
    EXPECT_NEAR(animation.length, 30 * seconds, 1e-5);
    EXPECT_EQ(animation.span(), animation.length);
    EXPECT_EQ(animation.last, std::lround(30 * seconds));
    expectFloats({ 1, 0, 3 }, at(*model, animation.length)[0]);
  }
}

TEST(Gltf, WhatAnAnimationDoesNotGiveStaysAsAtRest)
{
  auto scene = std::make_shared<dgtk::import::Scene>();
  scene->nodes = { { "root", dgtk::import::noIndex, { 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 7, 0, 0, 0, 1 }, { 0 } } };
  scene->meshes.resize(1);
  scene->meshes[0].positions = { { 1, 0, 0 }, { 0, 1, 0 } };
  scene->animations.resize(1);
  scene->animations[0].duration = 1;
  scene->animations[0].channels.resize(1);
  scene->animations[0].channels[0].node = 0;
  scene->animations[0].channels[0].rotation.times = { 0 };
  scene->animations[0].channels[0].rotation.values = { { std::sqrt(0.5), 0, 0, std::sqrt(0.5) } }; // a quarter turn
  const dgtk::AssimpDeformation deformation(scene, { { 0, 0, { 0, 1 } } });
  std::vector<Eigen::Vector3d> positions;
  deformation.positionsAt(0, 0, positions);
  ASSERT_EQ(positions.size(), 2u);
  expectFloats({ 0, 2, 7 }, positions[0]);
  expectFloats({ -3, 0, 7 }, positions[1]);

  // The animation is over after a second, whatever its keys.
  scene->animations[0].channels[0].translation = { { 0, 2 }, { { 0, 0, 0 }, { 8, 0, 0 } }, {}, {}, {} };
  positions.clear();
  deformation.positionsAt(0, 1000, positions);
  expectFloats({ 4, 2, 0 }, positions[0]);
  positions.clear();
  deformation.positionsAt(0, std::nan(""), positions);
  expectFloats({ 0, 2, 0 }, positions[0]);
}

TEST(Gltf, EachKeyHasAWeightForEachTarget)
{
  auto scene = std::make_shared<dgtk::import::Scene>();
  scene->nodes = { { "root", dgtk::import::noIndex, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, { 0 } } };
  scene->meshes.resize(1);
  scene->meshes[0].positions = { { 0, 0, 0 } };
  scene->meshes[0].targets = { { 0, { { 1, 0, 0 } } }, { 0, { { 0, 1, 0 } } } };
  scene->animations.resize(1);
  scene->animations[0].duration = 2;
  scene->animations[0].morphs.resize(1);
  dgtk::import::MorphChannel& morph = scene->animations[0].morphs[0];
  morph.node = 0;
  morph.times = { 0, 1, 2 };
  morph.targets = 2;
  morph.weights = { 1, 2, 3, 4, 5, 6 };
  const dgtk::AssimpDeformation deformation(scene, { { 0, 0, { 0 } } });
  const std::pair<double, Eigen::Vector3d> expected[] = { { 0, { 1, 2, 0 } }, { 30, { 3, 4, 0 } }, { 45, { 4, 5, 0 } },
    { 60, { 5, 6, 0 } } };
  for (const auto& [frame, place] : expected)
  {
    std::vector<Eigen::Vector3d> positions;
    deformation.positionsAt(0, frame, positions);
    expectFloats(place, positions.at(0));
  }
}

TEST(Gltf, WhatMovesIsSeen)
{
  using dgtk::import::noIndex;
  const dgtk::import::Matrix still = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  const auto moves = [&](int channelNode, int morphNode)
  {
    auto scene = std::make_shared<dgtk::import::Scene>();
    scene->nodes = { { "root", noIndex, still, {} }, { "above", 0, still, {} }, { "drawn", 1, still, { 0 } },
      { "below", 2, still, {} }, { "lamp", 0, still, {} }, { "joint's parent", 0, still, {} },
      { "joint", 5, still, {} } };
    scene->meshes.resize(1);
    scene->meshes[0].positions = { { 0, 0, 0 } };
    scene->meshes[0].bones = { { 6, still, { 0 }, { 1.0f } } };
    scene->animations.resize(2);
    scene->animations[1].channels.resize(1);
    scene->animations[1].channels[0].node = channelNode;
    scene->animations[1].morphs.resize(1);
    scene->animations[1].morphs[0].node = morphNode;
    return dgtk::AssimpDeformation(scene, { { 2, 0, { 0 } } }).moves();
  };
  const std::pair<int, bool> rows[] = { { noIndex, false }, { 0, true }, { 1, true }, { 2, true }, { 3, false },
    { 4, false }, { 5, true }, { 6, true } };
  for (const auto& [node, seen] : rows)
  {
    EXPECT_EQ(moves(node, noIndex), seen) << node;
    EXPECT_EQ(moves(noIndex, node), seen) << node;
    EXPECT_EQ(moves(node, 3), seen) << node;
    EXPECT_EQ(moves(4, node), seen) << node;
  }
}

TEST(Gltf, AnAnimationOfOneValueHolds)
{
  using dgtk::import::Scene;
  const auto holds = [](const auto& change)
  {
    auto scene = std::make_shared<Scene>();
    scene->animations.resize(1);
    dgtk::import::Animation& animation = scene->animations[0];
    animation.channels.resize(1);
    animation.channels[0].rotation.times = { 0, 1, 2 };
    animation.channels[0].rotation.values = { { 1, 0, 0, 0 }, { 1, 0, 0, 0 }, { 1, 0, 0, 0 } };
    animation.channels[0].scale = { { 0 }, { { 2, 2, 2 } }, dgtk::import::Interpolation::Cubic, { {} }, { {} } };
    animation.morphs.resize(1);
    animation.morphs[0] = { 0, { 0, 1, 2 }, 2, { 0.25, 0.5, 0.25, 0.5, 0.25, 0.5 }, {}, {}, {} };
    change(animation);
    return dgtk::AssimpDeformation(scene, {}).holds(0);
  };
  using Animation = dgtk::import::Animation;
  EXPECT_TRUE(holds([](Animation&) {}));
  EXPECT_FALSE(holds([](Animation& a) { a.channels[0].rotation.values[2][3] = 0.1; }));
  EXPECT_FALSE(holds([](Animation& a) { a.channels[0].scale.in[0][1] = 1; }));
  EXPECT_FALSE(holds([](Animation& a) { a.channels[0].scale.out[0][2] = 1; }));
  EXPECT_FALSE(holds([](Animation& a) { a.channels[0].translation.values = { { 0, 0, 0 }, { 0, 0, 1 } }; }));
  EXPECT_FALSE(holds([](Animation& a) { a.morphs[0].weights[5] = 0.25; }));
  EXPECT_FALSE(holds([](Animation& a) { a.morphs[0].in = { 0, 0, 0, 0, 0, 1 }; }));
  EXPECT_FALSE(holds([](Animation& a) { a.morphs[0].out = { 1, 0, 0, 0, 0, 0 }; }));
  EXPECT_FALSE(holds([](Animation& a) { a.joints.resize(1); })) << "curves of FBX are not looked at";
  EXPECT_FALSE(holds([](Animation& a) { a.blends.resize(1); }));
  EXPECT_FALSE(dgtk::AssimpDeformation(std::make_shared<Scene>(), {}).holds(0)) << "there is none";
}

TEST(Gltf, WhatHoldsIsNotRounded)
{
  using namespace dgtk::import;
  for (const Interpolation interpolation : { Interpolation::Linear, Interpolation::Cubic })
  {
    auto scene = std::make_shared<Scene>();
    scene->nodes = { { "root", noIndex, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, { 0 } } };
    scene->meshes.resize(1);
    scene->meshes[0].positions = { { 0.3F, 0.7F, 1.1F } };
    scene->meshes[0].targets.resize(1);
    scene->meshes[0].targets[0].positions = { { 52.2F, -90.9F, 171.7F } };
    scene->animations.resize(1);
    Animation& animation = scene->animations[0];
    animation.duration = 1;
    animation.channels.resize(1);
    animation.channels[0].node = 0;
    const bool isCubic = interpolation == Interpolation::Cubic;
    const auto fill = [&](auto& keys, auto value)
    {
      keys.times = { 0, 1 };
      keys.values = { value, value };
      keys.interpolation = interpolation;
      keys.in.resize(isCubic ? 2 : 0);
      keys.out.resize(isCubic ? 2 : 0);
    };
    fill(animation.channels[0].rotation, std::array<double, 4>{ 0.927, 0.1, 0.2, 0.3 });
    fill(animation.channels[0].translation, std::array<double, 3>{ 0.1, 0.7, 0.123 });
    fill(animation.channels[0].scale, std::array<double, 3>{ 1.1, 0.7, 1.3 });
    animation.morphs.resize(1);
    animation.morphs[0] = { 0, { 0, 1 }, 1, { 0.3, 0.3 }, interpolation, std::vector<double>(isCubic ? 2 : 0),
      std::vector<double>(isCubic ? 2 : 0) };
    const dgtk::AssimpDeformation deformation(scene, { { 0, 0, { 0 } } });
    EXPECT_TRUE(deformation.holds(0));
    std::vector<Eigen::Vector3d> first;
    std::vector<Eigen::Vector3d> later;
    deformation.positionsAt(0, 0, first);
    for (double frame = 0.5; frame < 30; frame += 0.7)
    {
      deformation.positionsAt(0, frame, later);
      EXPECT_EQ(later, first) << frame;
    }
  }
}

TEST(Gltf, WeightsOfJointsAreSharesOfTheirSum)
{
  const dgtk::import::Matrix still = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  const dgtk::import::Matrix moved = { 1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  auto scene = std::make_shared<dgtk::import::Scene>();
  scene->nodes = { { "root", dgtk::import::noIndex, still, { 0 } }, { "joint", 0, moved, {} } };
  scene->meshes.resize(1);
  scene->meshes[0].positions = { { 1, 2, 3 } };
  scene->meshes[0].bones = { { 0, still, { 0 }, { 0.125f } }, { 1, still, { 0 }, { 0.375f } } };
  const dgtk::AssimpDeformation deformation(scene, { { 0, 0, { 0 } } });
  std::vector<Eigen::Vector3d> positions;
  deformation.positionsAt(-1, 0, positions);
  ASSERT_EQ(positions.size(), 1u);
  expectFloats({ 4, 2, 3 }, positions[0]);
}

TEST(Gltf, StepsSplinesAndNegativeWeights)
{
  GltfMaker maker = animated();
  maker.json["nodes"][2].erase("name"); // joints without a name, and two nodes of one name
  maker.json["nodes"][3].erase("name");
  maker.json["nodes"][1]["name"] = "Mover";
  const int times = maker.floats("SCALAR", { 0, 2 });
  const int moves = maker.floats("VEC3", { 0, 0, 0, 0, 0, 0, 1, 2, 3, /**/ -1, 0, 0, 4, 0, 0, 0, 0, 0 });
  const int weights = maker.floats("SCALAR", { -1, 1 });
  const auto half = static_cast<float>(std::sqrt(0.5));
  const int turns = maker.floats("VEC4", { 0, 0, 0, 1, 0, 0, half, half });
  maker.json["animations"][0]["samplers"] = { sampler(times, moves, "CUBICSPLINE"), sampler(times, weights),
    sampler(times, turns, "STEP") };
  const auto model = readBytes("gltf", maker.gltf());
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  // p(s) of the Hermite spline at s = 1/4, over 2 seconds
  const double s = 0.25;
  const double h00 = 2 * s * s * s - 3 * s * s + 1;
  const Eigen::Vector3d out(1, 2, 3);
  const Eigen::Vector3d in(-1, 0, 0);
  const Eigen::Vector3d move =
    (1 - h00) * Eigen::Vector3d(4, 0, 0) + 2 * (s * s * s - 2 * s * s + s) * out + 2 * (s * s * s - s * s) * in;
  std::vector<Eigen::Vector3d> p = at(*model, 15);
  expectFloats(move + Eigen::Vector3d(0, 0, -0.5), p[0]);
  expectFloats({ 0, 2, 0 }, p[5]);
  p = at(*model, 59.9);
  expectFloats({ 0, 2, 0 }, p[5]); // still the first key's rotation
  p = at(*model, 60);
  expectFloats({ 4, 0, 1 }, p[0]);
  expectFloats({ -1, 1, 0 }, p[5]);
}

TEST(Gltf, NodeTransformsAndMirrorsTurnTheWinding)
{
  const auto model = readBytes("gltf", plain({ { "name", "m" } }).gltf());
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_FALSE(model->deformation);
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(0, 0, -6));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(2, 2, -6));
  EXPECT_EQ(model->parts[0].name, "Child");
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, -1));
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& p = model->rest->positions[i];
    EXPECT_EQ(model->uvs[i], Eigen::Vector2d(p.x() / 2, 1 - p.y() / 2)); // glTF's v runs down, the model's up
  }
}

TEST(Gltf, NormalsOfMirroredNodesStayOutside)
{
  GltfMaker maker = plain({ { "name", "m" } });
  const float n[] = { 0.6f, 0, 0.8f };
  maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
    maker.floats("VEC3", { n[0], n[1], n[2], n[0], n[1], n[2], n[0], n[1], n[2] });
  const auto model = readBytes("gltf", maker.gltf());
  EXPECT_EQ(brokenPromise(*model), "");
  const Eigen::Vector3f& normal = model->rest->normals[0];
  EXPECT_NEAR(normal.x(), 0.6, 1e-6);
  EXPECT_NEAR(normal.z(), -0.8, 1e-6) << "mirrored in z, as the surface is";
}
