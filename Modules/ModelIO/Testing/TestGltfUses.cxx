// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace dgtk::test;
using testing::HasSubstr;
using Json = nlohmann::json;

namespace
{
/// Where the corner (0, 0, 0) of each part's first triangle is.
using Places = std::vector<std::array<double, 3>>;

/// A triangle at the origin whose vertices follow the first joint of a skin, if their node has one.
GltfMaker skinnable()
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const int joints = maker.bytes("VEC4", { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 });
  const int weights = maker.floats("VEC4", { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 });
  maker.json["meshes"] = { { { "primitives",
    { { { "attributes", { { "POSITION", positions }, { "JOINTS_0", joints }, { "WEIGHTS_0", weights } } } } } } } };
  return maker;
}

Json& primitiveOf(GltfMaker& maker) { return maker.json["meshes"][0]["primitives"][0]; }
Json& inputsOf(GltfMaker& maker) { return primitiveOf(maker)["attributes"]; }

void setNodes(GltfMaker& maker, const Json& nodes)
{
  maker.json["nodes"] = nodes;
  maker.json["scenes"] = { { { "nodes", Json::array() } } };
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    maker.json["scenes"][0]["nodes"].push_back(i);
  }
}

/// A target that lifts the triangle by 1.
void addTarget(GltfMaker& maker)
{
  primitiveOf(maker)["targets"] = { { { "POSITION", maker.floats("VEC3", { 0, 0, 1, 0, 0, 1, 0, 0, 1 }) } } };
}

Json joint(const Json& where) { return { { "translation", where } }; }

Places placesOf(const std::string& bytes)
{
  const auto model = readBytes(bytes.compare(0, 4, "glTF") == 0 ? "glb" : "gltf", bytes);
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_THAT(model->warnings, testing::IsEmpty());
  Places places;
  for (const dgtk::Part& part : model->parts)
  {
    const Eigen::Vector3d& p = model->rest->positions[model->triangles.at(part.firstTriangle)[0]];
    places.push_back({ p.x(), p.y(), p.z() });
  }
  return places;
}
} // namespace

TEST(GltfUses, AMeshHasTheSkinOfEachOfItsNodes)
{
  GltfMaker maker = skinnable();
  const int moved = maker.floats("MAT4", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.25, 0, 0.5, 1 });
  maker.json["skins"] = { { { "joints", { 3 } } }, { { "joints", { 4 } }, { "inverseBindMatrices", moved } } };
  setNodes(maker, { { { "mesh", 0 }, { "skin", 0 } }, { { "mesh", 0 }, { "skin", 1 } },
                    { { "mesh", 0 }, { "skin", 0 } }, joint({ -0.5, 0, 1 }), joint({ 0.5, 0, 2 }) });
  const Places expected{ { -0.5, 0, 1 }, { 0.75, 0, 2.5 }, { -0.5, 0, 1 } };
  EXPECT_EQ(placesOf(maker.gltf()), expected);
  EXPECT_EQ(placesOf(maker.glb()), expected);
}

TEST(GltfUses, AMeshIsSkinnedWhereItsNodeIs)
{
  GltfMaker maker = skinnable();
  maker.json["skins"] = { { { "joints", { 2 } } } };
  const Json skinned = { { "mesh", 0 }, { "skin", 0 } };
  const Json plain = { { "mesh", 0 }, { "translation", { 0.5, 0, 2 } } };
  setNodes(maker, { skinned, plain, joint({ -0.5, 0, 1 }) });
  EXPECT_EQ(placesOf(maker.gltf()), (Places{ { -0.5, 0, 1 }, { 0.5, 0, 2 } }));
  setNodes(maker, { plain, skinned, joint({ -0.5, 0, 1 }) });
  EXPECT_EQ(placesOf(maker.gltf()), (Places{ { 0.5, 0, 2 }, { -0.5, 0, 1 } }));
}

TEST(GltfUses, JointsOfSeveralTypes)
{
  GltfMaker maker = skinnable();
  const int bytes = maker.bytes("VEC4", { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 });
  const int shorts = maker.shorts("VEC4", { 2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0 });
  const int quarters = maker.floats("VEC4", { 0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.25, 0, 0, 0 });
  const int rests = maker.floats("VEC4", { 0.75, 0, 0, 0, 0.75, 0, 0, 0, 0.75, 0, 0, 0 });
  maker.json["skins"] = { { { "joints", { 1, 2, 3 } } } };
  setNodes(maker, { { { "mesh", 0 }, { "skin", 0 } }, joint({ 0, 0, 64 }), joint({ 0, 0, 16 }), joint({ 0, 0, 4 }) });
  inputsOf(maker)["WEIGHTS_0"] = quarters;
  inputsOf(maker)["WEIGHTS_1"] = rests;
  inputsOf(maker)["JOINTS_0"] = bytes;
  inputsOf(maker)["JOINTS_1"] = shorts;
  EXPECT_EQ(placesOf(maker.gltf()), (Places{ { 0, 0, 7 } }));
  inputsOf(maker)["JOINTS_0"] = shorts;
  inputsOf(maker)["JOINTS_1"] = bytes;
  std::string text = maker.gltf();
  text.replace(text.find("\"skin\":"), 7, "\"skin\"\n :");
  EXPECT_EQ(placesOf(text), (Places{ { 0, 0, 13 } }));
}

TEST(GltfUses, NodesHaveTheirOwnWeights)
{
  GltfMaker maker = skinnable();
  addTarget(maker);
  maker.json["meshes"][0]["weights"] = { 0.25 };
  const Json own = { { "mesh", 0 }, { "weights", { 0.75 } } };
  setNodes(maker, { own, { { "mesh", 0 } }, own, { { "mesh", 0 }, { "weights", { -1 } } } });
  EXPECT_EQ(placesOf(maker.gltf()), (Places{ { 0, 0, 0.75 }, { 0, 0, 0.25 }, { 0, 0, 0.75 }, { 0, 0, -1 } }));

  // what moves one of two nodes leaves the other
  const int times = maker.floats("SCALAR", { 0, 1 });
  const int values = maker.floats("SCALAR", { 0, 1 });
  maker.json["animations"] = {
    { { "channels", { { { "sampler", 0 }, { "target", { { "node", 2 }, { "path", "weights" } } } } } },
      { "samplers", { { { "input", times }, { "output", values } } } } }
  };
  const auto model = readBytes("gltf", maker.gltf());
  ASSERT_TRUE(model->deformation);
  std::vector<Eigen::Vector3d> positions;
  model->deformation->positionsAt(0, 15, positions);
  ASSERT_EQ(positions.size(), 12u);
  EXPECT_EQ(positions[0].z(), 0.75);
  EXPECT_EQ(positions[3].z(), 0.25);
  EXPECT_EQ(positions[6].z(), 0.5);
  EXPECT_EQ(positions[9].z(), -1);
}

TEST(GltfUses, NormalsOfTargetsCountAtRest)
{
  GltfMaker maker = skinnable();
  addTarget(maker);
  inputsOf(maker)["NORMAL"] = maker.floats("VEC3", { 0, 0, 1, 0, 0, 1, 0, 0, 1 });
  const int tilts = maker.floats("VEC3", { 1.5, 0, 0, 0, 1.5, 0, 0, 0, 1 });
  Json& targets = primitiveOf(maker)["targets"];
  targets[0]["NORMAL"] = tilts;
  targets.push_back({ { "NORMAL", tilts } });
  maker.json["meshes"][0]["weights"] = { 0.25, 0.25 };
  setNodes(maker, { { { "mesh", 0 } }, { { "mesh", 0 }, { "weights", { 0.5, 0 } } }, { { "name", "lamp" } } });
  // a lamp that moves moves no triangle
  const int times = maker.floats("SCALAR", { 0, 1 });
  const int values = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0 });
  maker.json["animations"] = {
    { { "channels", { { { "sampler", 0 }, { "target", { { "node", 2 }, { "path", "translation" } } } } } },
      { "samplers", { { { "input", times }, { "output", values } } } } }
  };
  const auto model = readBytes("gltf", maker.gltf());
  ASSERT_FALSE(model->deformation);
  ASSERT_EQ(model->triangles.size(), 2u);
  for (const auto& corners : model->triangles) // (0.75, 0, 1) of unit length, and so on
  {
    EXPECT_LT((model->rest->normals[corners[0]] - Eigen::Vector3f(0.6F, 0, 0.8F)).norm(), 1e-6);
    EXPECT_LT((model->rest->normals[corners[1]] - Eigen::Vector3f(0, 0.6F, 0.8F)).norm(), 1e-6);
    EXPECT_LT((model->rest->normals[corners[2]] - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6);
  }
}

TEST(GltfUses, SkinsThatCannotBeRead)
{
  const std::string refused = "model.gltf: cannot be read: its skins or weights of morph targets: ";
  GltfMaker maker = skinnable();
  maker.json["skins"] = { { { "joints", { 1 } } } };
  setNodes(maker, { { { "mesh", 0 }, { "skin", 0 } }, joint({ 0, 0, 1 }) });
  EXPECT_EQ(placesOf(maker.gltf()), (Places{ { 0, 0, 1 } }));
  inputsOf(maker)["JOINTS_0"] = maker.bytes("VEC4", { 0, 9, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0 });
  EXPECT_EQ(refusal("gltf", maker.gltf()), refused + "a vertex follows a joint that does not exist");
  inputsOf(maker)["JOINTS_0"] = maker.bytes("VEC4", { 0, 0, 0, 0, 0, 0, 0, 0 });
  EXPECT_EQ(refusal("gltf", maker.gltf()), refused + "attributes and vertices do not match");
  maker.json["skins"][0]["inverseBindMatrices"] =
    maker.floats("MAT4", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  maker.json["skins"][0]["joints"] = { 1, 0 };
  EXPECT_EQ(refusal("gltf", maker.gltf()), refused + "a joint has no matrix");
}

TEST(GltfUses, KeysThatDoNotAscendHaveAWarning)
{
  const auto read = [](const std::vector<float>& times)
  {
    GltfMaker maker = skinnable();
    setNodes(maker, { { { "mesh", 0 } } });
    const int input = maker.floats("SCALAR", times);
    const int output = maker.floats("VEC3", std::vector<float>(3 * times.size(), 1));
    maker.json["animations"] = {
      { { "channels", { { { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "translation" } } } } } },
        { "samplers", { { { "input", input }, { "output", output } } } } }
    };
    return readBytes("gltf", maker.gltf());
  };
  const auto warnings = [&read](const std::vector<float>& times) { return read(times)->warnings; };
  EXPECT_THAT(warnings({ 0, 1, 2 }), testing::IsEmpty());
  EXPECT_THAT(
    warnings({ 0, 2, 1 }), testing::ElementsAre("1 key of an animation is left out: their times do not ascend"));
  EXPECT_THAT(warnings({ -0.5, 0, 1, 1, NAN }),
    testing::ElementsAre("2 keys of animations are left out: their times do not ascend"));
  EXPECT_EQ(read({ -2, 1, NAN })->animations.at(0).last, 30);
}

TEST(GltfUses, FilesOfOtherVersionsAreRefused)
{
  const auto said = [](const Json& asset)
  {
    GltfMaker maker = skinnable();
    setNodes(maker, { { { "mesh", 0 } } });
    maker.json["asset"] = asset;
    return refusal("gltf", maker.gltf());
  };
  for (const char* version : { "2.0", "2.1", "2" })
  {
    EXPECT_EQ(said({ { "version", version } }), "") << version;
  }
  EXPECT_EQ(said({ { "version", "2.1" }, { "minVersion", "2.0" } }), "");
  EXPECT_THAT(
    said({ { "version", "2.1" }, { "minVersion", "2.1" } }), HasSubstr("needs a reader of glTF 2.1; 2.0 is read"));
  EXPECT_THAT(said({ { "version", "1.0" } }), HasSubstr("needs a reader of glTF 1.0; 2.0 is read"));
  EXPECT_THAT(said({ { "generator", "me" } }), HasSubstr("has no asset.version (a text), without which it is no glTF"));
  EXPECT_THAT(said(nullptr), HasSubstr("has no asset.version"));
}

TEST(GltfUses, FilesThatOnlyTheImporterReads)
{
  GltfMaker maker = skinnable();
  const int inverse = maker.floats("MAT4", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  maker.json["skins"] = { { { "joints", { 1 } }, { "inverseBindMatrices", inverse } } };
  setNodes(maker, { { { "mesh", 0 }, { "skin", 0 } }, { { "name", "bone" }, { "translation", { 0, 0, 1 } } } });
  std::string text = maker.gltf();
  text.replace(text.find("bone"), 4, "b\xf6ne"); // not UTF-8
  EXPECT_EQ(placesOf(text), (Places{ { 0, 0, 1 } }));
}

TEST(GltfUses, BytesThatAreZeroBehindTheText)
{
  GltfMaker maker = skinnable();
  addTarget(maker);
  setNodes(maker, { { { "mesh", 0 }, { "weights", { 0.5 } } } });
  std::string bytes = maker.glb();
  for (std::size_t at = bytes.find("BIN") - 5; bytes[at] == ' '; --at)
  {
    bytes[at] = '\0';
  }
  EXPECT_EQ(placesOf(bytes), (Places{ { 0, 0, 0.5 } }));
}
