// SPDX-License-Identifier: BSD-3-Clause
// FBX: files, shapes, where things are; layers that turn a node in its order, bones that turn far or mirror.
#include "dgtkFbxMaker.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
constexpr double degree = 3.14159265358979323846 / 180;
using Numbers = FbxMaker::Numbers;

Eigen::Affine3d turn(double x, double y, double z)
{
  return Eigen::Affine3d(Eigen::AngleAxisd(z * degree, Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(y * degree, Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(x * degree, Eigen::Vector3d::UnitX()));
}
Eigen::Affine3d shift(double x, double y, double z) { return Eigen::Affine3d(Eigen::Translation3d(x, y, z)); }
Eigen::Affine3d scale(double x, double y, double z) { return Eigen::Affine3d(Eigen::Scaling(x, y, z)); }

/// The corners of FbxMaker::mesh(), as `transform` places them.
void expectPlaced(const dgtk::Model& model, const Eigen::Affine3d& transform, const std::string& what = {})
{
  ASSERT_EQ(model.triangles.size(), 1u);
  const Eigen::Vector3d corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  for (const Eigen::Vector3d& corner : corners)
  {
    double nearest = 1e9;
    for (const Eigen::Vector3d& p : model.rest->positions)
    {
      nearest = std::min(nearest, (p - transform * corner).norm());
    }
    EXPECT_LT(nearest, 1e-12) << what;
  }
}
} // namespace

TEST(Fbx, TextAndAllKindsOfBinaryFilesAreTheSameModel)
{
  FbxMaker maker;
  maker.mesh(maker.model(0, "quad"), { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.25 }, { 0, 1, 2, -4 });
  const auto text = readChecked(maker);
  EXPECT_EQ(text->triangles.size(), 2u);
  EXPECT_EQ(text->parts[0].name, "quad");
  EXPECT_EQ(text->sourceVertices, 4u);
  for (int i = 0; i < 16; ++i)
  {
    const FbxBinary how{ (i & 1) != 0, (i & 2) != 0, (i & 4) != 0, (i & 8) != 0 };
    const auto model = readBytes("fbx", maker.binary(how));
    EXPECT_EQ(model->rest->positions, text->rest->positions) << i;
    EXPECT_EQ(model->triangles, text->triangles) << i;
    EXPECT_EQ(model->parts[0].name, "quad") << i;
  }
}

TEST(Fbx, WhatIsNoFileOfVersion7IsRefused)
{
  FbxMaker maker;
  maker.mesh(maker.model());
  maker.version = 6100;
  EXPECT_THAT(refusal("fbx", maker.text()), HasSubstr("has version 6100 of FBX: 7000 (FBX 2011) and later are read"));
  maker.version = 0;
  EXPECT_THAT(refusal("fbx", maker.text()), HasSubstr("has nothing of an FBX file"));
  EXPECT_THAT(refusal("fbx", "\n"), HasSubstr("has nothing of an FBX file"));
  EXPECT_THAT(refusal("fbx", "a: 1\nb 2\n"), HasSubstr("expected a colon, on line 2"));
  EXPECT_THAT(refusal("fbx", "a: \"x\n"), HasSubstr("a text does not end, on line 1"));
  EXPECT_THAT(refusal("fbx", "a: {\nb: 1\n"), HasSubstr("an element does not end, on line 3"));
  EXPECT_THAT(refusal("fbx", "a: *2 {\na: 1,2\n"), HasSubstr("a list of numbers does not end"));
  EXPECT_THAT(refusal("fbx", "a: *2 {\nb: 1,2 }\n"), HasSubstr("expected the numbers of a list, on line 2"));
  EXPECT_THAT(refusal("fbx", "}\n"), HasSubstr("expected an element, on line 1"));
  std::string deep;
  for (int i = 0; i < 100; ++i)
  {
    deep += "a: {";
  }
  EXPECT_THAT(refusal("fbx", deep), HasSubstr("elements are nested too deeply"));
  const std::string whole = FbxMaker().binary();
  EXPECT_EQ(refusal("fbx", whole), "");
  EXPECT_THAT(refusal("fbx", whole.substr(0, whole.size() - 1)), HasSubstr("ends before its last element"));
  EXPECT_THAT(
    refusal("fbx", whole.substr(0, 100)), HasSubstr("has an element that does not fit its place, at byte 27"));
}

TEST(Fbx, DamagedBinaryFilesAreRefusedWithThePlace)
{
  FbxMaker maker;
  maker.mesh(maker.model());
  const FbxBinary how{ true, true, false, false };
  const std::string good = maker.binary(how);
  std::string bad = good;
  const std::size_t list = bad.find("Vertices") + 8;
  ASSERT_EQ(bad[list], 'd');
  bad[list] = '?';
  EXPECT_THAT(
    refusal("fbx", bad), HasSubstr("has a value of a type that is not known, at byte " + std::to_string(list)));
  bad = good;
  bad[list + 1] = 100;
  EXPECT_THAT(refusal("fbx", bad), HasSubstr("has a list that cannot be decompressed"));
  bad[list + 5] = 0;
  EXPECT_THAT(refusal("fbx", bad), HasSubstr("has a list of another length than it says"));
  bad = good;
  bad[list + 4] = 0x7f;
  EXPECT_THAT(refusal("fbx", bad), HasSubstr("asks for more memory than a file of its size may"));
  bad = good;
  bad[28] = 0x7f;
  EXPECT_THAT(refusal("fbx", bad), HasSubstr("has an element that does not fit its place, at byte 27"));
}

TEST(Fbx, NodesHavePivotsOffsetsAndTurns)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.mesh(node);
  maker.set(node, "Lcl Translation", { 1, 2, 3 });
  maker.set(node, "Lcl Rotation", { 10, 20, 30 });
  maker.set(node, "Lcl Scaling", { 2, 3, 0.5 });
  maker.set(node, "RotationOffset", { 0.5, 0.25, 0.125 });
  maker.set(node, "RotationPivot", { 1, 0, 2 });
  maker.set(node, "ScalingOffset", { 0.1, 0.2, 0.3 });
  maker.set(node, "ScalingPivot", { 0, 1, 0.5 });
  maker.set(node, "PreRotation", { 40, 0, 50 });
  maker.set(node, "PostRotation", { 0, 60, 70 });
  const Eigen::Affine3d outside = shift(1, 2, 3) * shift(0.5, 0.25, 0.125) * shift(1, 0, 2);
  const Eigen::Affine3d inside =
    shift(-1, 0, -2) * shift(0.1, 0.2, 0.3) * shift(0, 1, 0.5) * scale(2, 3, 0.5) * shift(0, -1, -0.5);
  expectPlaced(*readChecked(maker), outside * turn(10, 20, 30) * inside,
    "turns before and after count only where they are active");
  maker.set(node, "RotationActive", Numbers{ 1 });
  expectPlaced(*readChecked(maker), outside * turn(40, 0, 50) * turn(10, 20, 30) * turn(0, 60, 70).inverse() * inside);
  maker.set(node, "RotationSpaceForLimitOnly", Numbers{ 1 });
  expectPlaced(*readChecked(maker), outside * turn(10, 20, 30) * inside);
}

TEST(Fbx, NodesTurnInTheirOrder)
{
  const Eigen::Affine3d x = turn(10, 0, 0);
  const Eigen::Affine3d y = turn(0, 20, 0);
  const Eigen::Affine3d z = turn(0, 0, 30);
  const Eigen::Affine3d orders[] = { z * y * x, y * z * x, x * z * y, z * x * y, y * x * z, x * y * z, z * y * x };
  for (int order = 0; order < 7; ++order)
  {
    FbxMaker maker;
    const std::int64_t node = maker.model();
    maker.mesh(node);
    maker.set(node, "Lcl Rotation", { 10, 20, 30 });
    maker.set(node, "RotationActive", Numbers{ 1 });
    maker.set(node, "RotationOrder", { double(order) });
    expectPlaced(*readChecked(maker), orders[order], std::to_string(order));
  }
}

TEST(Fbx, ChildrenTakeOverScalesAsTheySay)
{
  for (int type = 0; type < 3; ++type)
  {
    FbxMaker maker;
    const std::int64_t top = maker.model();
    const std::int64_t middle = maker.model(top);
    const std::int64_t node = maker.model(middle);
    maker.mesh(node);
    maker.set(top, "Lcl Scaling", { 5, 1, 1 });
    maker.set(middle, "Lcl Translation", { 0, 0, 7 });
    maker.set(middle, "Lcl Scaling", { 2, 3, 4 });
    maker.set(node, "Lcl Translation", { 1, 1, 1 });
    maker.set(node, "Lcl Rotation", { 0, 0, 30 });
    maker.set(node, "InheritType", { double(type) });
    const Eigen::Affine3d above = scale(5, 1, 1) * shift(0, 0, 7);
    const Eigen::Affine3d expected[] = { above * shift(2, 3, 4) * turn(0, 0, 30) * scale(2, 3, 4),
      above * scale(2, 3, 4) * shift(1, 1, 1) * turn(0, 0, 30), above * shift(2, 3, 4) * turn(0, 0, 30) };
    expectPlaced(*readChecked(maker), expected[type], std::to_string(type));
  }
}

TEST(Fbx, DefaultsOfItsClassCountWhereAnObjectIsSilent)
{
  FbxMaker maker;
  maker.definitions = { { "ObjectType", { std::string("Model") },
    { { "PropertyTemplate", { std::string("FbxNode") },
      { { "Properties70", {},
        { { "P", { std::string("Lcl Translation"), std::string(), std::string(), std::string(), std::int64_t(4), 0.5,
                   6. } } } } } } } } };
  const std::int64_t node = maker.model();
  maker.mesh(node);
  expectPlaced(*readChecked(maker), shift(4, 0.5, 6));
  maker.set(node, "Lcl Translation", { 1, 0, 0 });
  expectPlaced(*readChecked(maker), shift(1, 0, 0));
}

TEST(Fbx, GeometricTransformsAreNotPassedOn)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.set(node, "GeometricTranslation", { 1, 2, 3 });
  maker.set(node, "GeometricRotation", { 10, 20, 30 });
  maker.set(node, "GeometricScaling", { 2, 2, 3 });
  const std::int64_t child = maker.model(node);
  const std::int64_t mesh = maker.mesh(child);
  expectPlaced(*readChecked(maker), Eigen::Affine3d::Identity());
  maker.connect(mesh, node); // the same geometry twice
  const auto model = readChecked(maker);
  ASSERT_EQ(model->triangles.size(), 2u);
  const Eigen::Vector3d moved = shift(1, 2, 3) * turn(10, 20, 30) * scale(2, 2, 3) * Eigen::Vector3d(0, 1, 0);
  double nearest = 1e9;
  for (const Eigen::Vector3d& p : model->rest->positions)
  {
    nearest = std::min(nearest, (p - moved).norm());
  }
  EXPECT_LT(nearest, 1e-12);
}

TEST(Fbx, PartsHaveTheOrderOfTheirModels)
{
  FbxMaker maker;
  const std::int64_t first = maker.model(0, "first");
  maker.mesh(first);
  maker.set(first, "GeometricTranslation", { 0.001, 0, 0 });
  maker.mesh(maker.model(first, "child"));
  maker.mesh(maker.model(0, "second"));
  const auto model = readChecked(maker);
  std::vector<std::string> names;
  for (const dgtk::Part& part : model->parts)
  {
    names.push_back(part.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{ "first", "child", "second" }));
}

TEST(Fbx, NormalsAndTextureCoordinatesByCornerPointAndPolygon)
{
  const auto modelOf = [](const FbxItem& normals, const FbxItem& uvs)
  {
    FbxMaker maker;
    const std::int64_t mesh = maker.mesh(maker.model(), { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, { 0, 1, -3, 0, 2, -4 });
    maker.item(mesh).children.push_back(normals);
    maker.item(mesh).children.push_back(uvs);
    return readChecked(maker);
  };
  const Numbers ofCorners{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1 };
  const Numbers uvs{ 0, 0, 0.5, 0, 1, 1 };
  const auto uvsBy = [&uvs](const std::string& mapping, const FbxMaker::Integers& indices) {
    return fbxLayer("LayerElementUV", mapping, "IndexToDirect", { { "UV", { uvs } }, { "UVIndex", { indices } } });
  };
  const auto cornerOf = [](const dgtk::Model& model, std::size_t triangle, std::size_t corner)
  { return model.triangles[triangle][corner]; };

  auto model = modelOf(fbxLayer("LayerElementNormal", "ByPolygonVertex", "Direct", { { "Normals", { ofCorners } } }),
    uvsBy("ByPolygonVertex", { 0, 1, 2, 2, 1, 0 }));
  EXPECT_EQ(model->rest->normals[cornerOf(*model, 0, 1)], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(model->rest->normals[cornerOf(*model, 1, 1)], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(model->uvs[cornerOf(*model, 0, 1)], Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(model->uvs[cornerOf(*model, 1, 0)], Eigen::Vector2d(1, 1));

  model = modelOf(fbxLayer("LayerElementNormal", "ByVertice", "Direct", { { "Normals", { ofCorners } } }),
    uvsBy("ByVertice", { 0, 1, 2, 1 }));
  EXPECT_EQ(model->rest->normals[cornerOf(*model, 0, 2)], Eigen::Vector3f(0, 0, 1)) << "the third point's";
  EXPECT_EQ(model->rest->normals[cornerOf(*model, 1, 1)], Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(model->uvs[cornerOf(*model, 1, 2)], Eigen::Vector2d(0.5, 0));

  model = modelOf(
    fbxLayer("LayerElementNormal", "ByPolygon", "Direct", { { "Normals", { ofCorners } } }), uvsBy("AllSame", { 2 }));
  EXPECT_EQ(model->rest->normals[cornerOf(*model, 1, 2)], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(model->uvs[cornerOf(*model, 1, 2)], Eigen::Vector2d(1, 1));

  model = modelOf(fbxLayer("LayerElementNormal", "ByEdge", "Direct", { { "Normals", { ofCorners } } }),
    uvsBy("ByPolygonVertex", { 0, 1, 7, -1 }));
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, 1)) << "the triangle's own";
  EXPECT_EQ(model->uvs[cornerOf(*model, 0, 2)], Eigen::Vector2d(0, 0)) << "an index that is none";
  EXPECT_THAT(model->unplaced, ElementsAre(0, 1)) << "no corner of the second has one";
}

TEST(Fbx, SurfacesThatNameMissingPointsAreLeftOut)
{
  FbxMaker maker;
  maker.mesh(maker.model(), { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, -3, 0, 1, -4, 0, -2, 0, 1, 2 });
  const auto model = readChecked(maker);
  EXPECT_EQ(model->triangles.size(), 2u) << "the last polygon has no end";
  EXPECT_EQ(model->lines, 1u);
  EXPECT_THAT(model->warnings, ElementsAre("1 surface left out: a vertex that does not exist"));
}

TEST(Fbx, NodesMayBeNestedDeeplyAndInRings)
{
  FbxMaker maker;
  std::int64_t node = maker.model();
  const std::int64_t first = node;
  for (int i = 0; i < 5000; ++i)
  {
    node = maker.model(node);
    maker.set(node, "Lcl Translation", { 1, 0, 0 });
  }
  maker.mesh(node);
  maker.connect(first, node);
  expectPlaced(*readChecked(maker), shift(5000, 0, 0));
}

TEST(Fbx, Fuzz)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  const std::int64_t mesh = maker.mesh(node, { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, { 0, 1, 2, -4 });
  maker.item(mesh).children.push_back(fbxLayer("LayerElementUV", "ByPolygonVertex", "IndexToDirect",
    { { "UV", { Numbers{ 0, 0, 1, 1 } } }, { "UVIndex", { FbxMaker::Integers{ 0, 1, 0, 1 } } } }));
  const std::int64_t bone = maker.model(0, "bone");
  const std::int64_t skin = maker.add("Deformer", "Skin",
    { { "SkinningType", { std::string("Blend") } }, { "Indexes", { FbxMaker::Integers{ 0, 1 } } },
      { "BlendWeights", { Numbers{ 0.5, 1 } } } });
  maker.connect(skin, mesh);
  const std::int64_t cluster = maker.add("Deformer", "Cluster",
    { { "Indexes", { FbxMaker::Integers{ 0, 1, 2 } } }, { "Weights", { Numbers{ 1, 0.5, 0.25 } } },
      { "Transform", { Numbers{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } } } });
  maker.connect(cluster, skin);
  maker.connect(bone, cluster);
  const std::int64_t shapes = maker.add("Deformer", "BlendShape");
  maker.connect(shapes, mesh);
  const std::int64_t channel = maker.add("Deformer", "BlendShapeChannel", { { "FullWeights", { Numbers{ 100 } } } });
  maker.connect(channel, shapes);
  const std::int64_t shape = maker.add(
    "Geometry", "Shape", { { "Indexes", { FbxMaker::Integers{ 1 } } }, { "Vertices", { Numbers{ 0, 0, 1 } } } });
  maker.connect(shape, channel);
  const std::int64_t layer = maker.stack(1);
  maker.animate(layer, bone, "Lcl Rotation", "d|Z", { { 0, 0, 8 | 0x3000400, { 1, 2 } }, { 0.5, 90 }, { 1, 45 } });
  maker.animate(layer, channel, "DeformPercent", "d|DeformPercent", { { 0, 0 }, { 1, 100 } });
  const std::string text = maker.text();
  fuzzReader("fbx", { text, maker.binary(), maker.binary({ false, false, false, false }) }, 1200, false);
}

namespace
{
/// About the axes of `order`, the first of them first.
Eigen::Matrix3d turnInOrder(const std::string& order, const Eigen::Vector3d& degrees)
{
  Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
  for (const char letter : order)
  {
    const int axis = letter - 'x';
    all = Eigen::AngleAxisd(degrees[axis] * 3.14159265358979323846 / 180, Eigen::Vector3d::Unit(axis)).matrix() * all;
  }
  return all;
}

FbxMaker::Numbers numbersOf(const Eigen::Vector3d& v) { return { v[0], v[1], v[2] }; }

/// A bone at the origin: degrees about z, and scales.
struct HoldingBone
{
  double turn = 0;
  Eigen::Vector3d scale{ 1, 1, 1 };
};

const Eigen::Vector3d heldPoint(2, 0, 3);

/// Where `heldPoint` is when these bones hold it in equal shares.
Eigen::Vector3d whereHeldBy(const std::vector<HoldingBone>& bones)
{
  FbxMaker maker;
  const std::int64_t mesh = maker.mesh(maker.model(), { heldPoint[0], heldPoint[1], heldPoint[2], 0, 0, 0, 0, 1, 0 });
  const std::int64_t skin = maker.add("Deformer", "Skin", { { "SkinningType", { std::string("DualQuaternion") } } });
  maker.connect(skin, mesh);
  for (const HoldingBone& bone : bones)
  {
    const std::int64_t node = maker.model(0, "bone");
    maker.set(node, "Lcl Rotation", { 0, 0, bone.turn });
    maker.set(node, "Lcl Scaling", numbersOf(bone.scale));
    const std::int64_t cluster = maker.add("Deformer", "Cluster",
      { { "Indexes", { FbxMaker::Integers{ 0 } } }, { "Weights", { FbxMaker::Numbers{ 1 / double(bones.size()) } } },
        { "Transform", { FbxMaker::Numbers{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } } } });
    maker.connect(cluster, skin);
    maker.connect(node, cluster);
  }
  return readBytes("fbx", maker.text())->rest->positions.at(0);
}

void expectThere(const Eigen::Vector3d& point, const Eigen::Vector3d& expected)
{
  EXPECT_LT((point - expected).norm(), 1e-6) << point.transpose() << " for " << expected.transpose();
}
} // namespace

TEST(FbxTurns, LayersTurnInTheOrderOfTheirNode)
{
  const Eigen::Vector3d degrees[] = { { 20, -30, 50 }, { 40, 25, -15 } };
  const std::string orders[] = { "xyz", "xzy", "yzx", "yxz", "zxy", "zyx" };
  for (std::size_t order = 0; order < 6; ++order)
  {
    FbxMaker maker;
    const std::int64_t node = maker.model();
    maker.mesh(node, { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
    maker.set(node, "RotationActive", { 1. });
    maker.set(node, "RotationOrder", { double(order) });
    const std::int64_t base = maker.stack(1);
    const std::int64_t layers[] = { base, maker.layer(100, 0) };
    const char* const components[] = { "d|X", "d|Y", "d|Z" };
    for (int i = 0; i < 2; ++i)
    {
      const std::int64_t curves = maker.add("AnimationCurveNode", "");
      maker.connect(curves, layers[i]);
      maker.connect(curves, node, "Lcl Rotation");
      for (int axis = 0; axis < 3; ++axis)
      {
        maker.set(curves, components[axis], { degrees[i][axis] });
      }
    }
    const auto model = readBytes("fbx", maker.text());
    std::vector<Eigen::Vector3d> points;
    model->deformation->positionsAt(0, 0.5 * model->animations.at(0).fps, points);
    const Eigen::Matrix3d both = turnInOrder(orders[order], degrees[0]) * turnInOrder(orders[order], degrees[1]);
    for (int axis = 0; axis < 3; ++axis)
    {
      SCOPED_TRACE(orders[order]);
      expectThere(points.at(std::size_t(axis)), both.col(axis));
    }
  }
}

// 160 degrees lie between them, half of these behind either.
TEST(FbxTurns, BonesMeetOnTheShorterWay)
{
  expectThere(whereHeldBy({ { 100 }, { -100 } }), { -2, 0, 3 });
  expectThere(whereHeldBy({ { -100 }, { 100 } }), { -2, 0, 3 });
  expectThere(whereHeldBy({ { 170 }, { -170 } }), { -2, 0, 3 });
  expectThere(whereHeldBy({ { 80 }, { -80 } }), { 2, 0, 3 });
}

TEST(FbxTurns, BonesMayMirror)
{
  for (const Eigen::Vector3d& scale : { Eigen::Vector3d(1, 1, -1), { -1, 1, 1 }, { 1, -3, 2 }, { -1, -1, -1 } })
  {
    expectThere(whereHeldBy({ { 90, scale } }), turnInOrder("z", { 0, 0, 90 }) * heldPoint.cwiseProduct(scale));
  }
}
