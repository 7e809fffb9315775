// SPDX-License-Identifier: BSD-3-Clause
// FBX: layers that turn a node in its order, and bones of dual quaternions that turn far or mirror.
#include "dgtkFbxMaker.h"
#include "dgtkModelChecks.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <string>

using namespace dgtk::test;

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
