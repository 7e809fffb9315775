// SPDX-License-Identifier: BSD-3-Clause
// FBX: curves, layers, blend shapes and skins, against closed forms.
#include "dgtkAssimpDeformation.h"
#include "dgtkFbxMaker.h"
#include "dgtkModelChecks.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr double fbxDegree = 3.14159265358979323846 / 180;
constexpr std::int64_t step = 2;
constexpr std::int64_t stepToNext = 2 | 0x100;
constexpr std::int64_t linear = 4;
constexpr std::int64_t automatic = 8 | 0x100;
constexpr std::int64_t timeIndependent = 0x2000;
using Key = FbxMaker::Key;
using Keys = std::vector<Key>;
using Numbers = FbxMaker::Numbers;

/// Source vertices of a model after so many seconds.
std::vector<Eigen::Vector3d> pointsAt(const dgtk::Model& model, double seconds)
{
  std::vector<Eigen::Vector3d> points;
  EXPECT_TRUE(model.deformation);
  if (model.deformation)
  {
    model.deformation->positionsAt(0, seconds * model.animations.at(0).fps, points);
  }
  return points;
}

/// A triangle that a curve moves along x.
class Moving
{
public:
  explicit Moving(const Keys& keys, double seconds = 10)
  {
    const std::int64_t node = this->Maker.model();
    this->Maker.mesh(node);
    this->Curve = this->Maker.animate(this->Maker.stack(seconds), node, "Lcl Translation", "d|X", keys);
  }
  double at(double seconds)
  {
    this->Model = this->Model ? this->Model : readBytes("fbx", this->Maker.text());
    return pointsAt(*this->Model, seconds).at(0).x();
  }

  FbxMaker Maker;
  std::int64_t Curve;

private:
  std::shared_ptr<const dgtk::Model> Model;
};

/// From 0 to 1 with slopes at both ends.
double hermite(double begin, double beginSlope, double end, double endSlope, double s)
{
  return (2 * s * s * s - 3 * s * s + 1) * begin + (s * s * s - 2 * s * s + s) * beginSlope +
         (3 * s * s - 2 * s * s * s) * end + (s * s * s - s * s) * endSlope;
}

void expectAt(const std::vector<Eigen::Vector3d>& points, std::size_t index, const Eigen::Vector3d& expected)
{
  EXPECT_LT((points.at(index) - expected).norm(), 1e-6) << points.at(index).transpose();
}
} // namespace

TEST(FbxMotion, CurvesStepGoStraightOrBend)
{
  Moving m(
    { { 0, 1, step }, { 1, 2, stepToNext }, { 2, 3, linear }, { 3, 7, 8 | 0x400, { 2, -1 } }, { 4, 9, linear } });
  // what is meant to be at a key is
  EXPECT_THAT((std::array{ m.at(0.9), m.at(1 - 1e-5), m.at(1 - 1e-8), m.at(1), m.at(1 + 1e-8), m.at(1 + 1e-5) }),
    testing::ElementsAre(1, 1, 2, 2, 2, 3));
  EXPECT_NEAR(m.at(2.25), 4, 1e-12);
  for (const double s : { 0.125, 0.5, 0.75 })
  {
    EXPECT_NEAR(m.at(3 + s), hermite(7, 2, 9, -1, s), 1e-9);
  }
  EXPECT_EQ(m.at(9), 9);
}

TEST(FbxMotion, TangentsHaveLengths)
{
  Moving m({ { 0, 0, 8 | 0x400 | 0x3000000, { 2, -1 }, { 0.6, 0.25 } }, { 2, 3, linear } });
  for (const double t : { 0.1, 0.3, 0.5, 0.9 })
  {
    const double u = 1 - t;
    const double time = 3 * u * u * t * 1.2 + 3 * u * t * t * (2 - 0.5) + 2 * t * t * t;
    const double value = 3 * u * u * t * (1.2 * 2) + 3 * u * t * t * (3 + 0.5) + 3 * t * t * t;
    EXPECT_NEAR(m.at(time), value, 1e-9);
  }
  // lengths of 1 make the curve stand where both meet: found all the same
  Moving steep({ { 0, 0, 8 | 0x400 | 0x3000000, { 0, 0 }, { 1, 1 } }, { 2, 1, linear } });
  EXPECT_NEAR(steep.at(1), 0.5, 1e-6);
}

TEST(FbxMotion, AutomaticTangents)
{
  const auto between = [](std::int64_t flags, const Keys& keys, double slope, double firstSlope)
  {
    Keys own = keys;
    for (Key& key : own)
    {
      key.flags = automatic | flags;
    }
    Moving m(own);
    const double length = own[1].time - own[0].time;
    EXPECT_NEAR(m.at(own[0].time + length / 4),
      hermite(own[0].value, firstSlope * length, own[1].value, slope * length, 0.25), 1e-6)
      << std::hex << flags;
  };
  const Keys keys{ { 0, 0 }, { 1, 2 }, { 3, 3 } };
  between(timeIndependent, keys, 1, 2);
  between(0, keys, 1.25, 2);
  between(0x1000 | timeIndependent, { { 0, 0 }, { 1, 2 }, { 3, 2 } }, 0, 2); // clamped: as high as a neighbour
  between(0x1000 | timeIndependent, keys, 1, 2);
  between(0x1000 | timeIndependent, { { 0, 2 }, { 1, 2 }, { 3, 5 } }, 0, 0);
  between(0x4000 | timeIndependent, { { 0, 0 }, { 1, 3 }, { 2, 3.1 } }, 0.3, 0);  // not above the next one
  between(0x4000 | timeIndependent, { { 0, 0 }, { 1, 3 }, { 2, 1 } }, 0, 0);      // a top stays one
  between(0x4000 | timeIndependent, { { 0, 3.1 }, { 1, 3 }, { 2, 0 } }, -0.3, 0); // nor below the one before
  between(0x4000 | timeIndependent, { { 0, 3 }, { 1, 1 }, { 2, 9 } }, 0, 0);      // a valley
  // biases stand in the slopes' places, in per cent: towards the next or the previous key
  between(0, { { 0, 0, 0, { 0, -50 } }, { 1, 2, 0, { 50, 0 } }, { 3, 3 } }, (1.25 + 0.5) / 2, 2);
  between(0, { { 0, 0, 0, { 0, 50 } }, { 1, 2, 0, { -50, 0 } }, { 3, 3 } }, (1.25 + 2) / 2, 2);
  between(0, { { 0, 0, 0, { 0, -600 } }, { 1, 2, 0, { 600, 0 } }, { 3, 3 } }, 1.25 * -5 + 0.5 * 6 - 40, 2);
}

TEST(FbxMotion, TensionContinuityBias)
{
  const double t = 0.5;
  const double c = 0.25;
  const double b = -0.5;
  Moving m({ { 0, 0, 8 | 0x200 }, { 1, 2, 8 | 0x200, { t, c } }, { 3, 3, linear } });
  m.Maker.item(m.Curve).children[3].values = { FbxMaker::Numbers{ 0, 0, 0, 0, t, c, b, 0, 0, 0, 0, 0 } };
  const auto slope = [=](double s) { return 0.5 * (1 - t) * ((1 + b) * (1 + s) * 2 + (1 - b) * (1 - s) * 0.5); };
  EXPECT_NEAR(m.at(0.5), hermite(0, 2, 2, slope(-c), 0.5), 1e-9) << "on its left";
  EXPECT_NEAR(m.at(1.5), hermite(2, slope(c) * 2, 3, 0, 0.25), 1e-9) << "on its right";
}

TEST(FbxMotion, CurvesGoOnAsTheySay)
{
  const auto modelOf = [](const std::string& before, const std::string& after, std::int64_t times = -1)
  {
    Moving m({ { 2, 1, linear }, { 3, 2, linear }, { 4, 5, linear } });
    const auto item = [times](const std::string& name, const std::string& type) {
      return FbxItem{ name, {}, { { "Type", { type } }, { "Repetition", { times } } } };
    };
    m.Maker.item(m.Curve).children.push_back(item("Pre-Extrapolation", before));
    m.Maker.item(m.Curve).children.push_back(item("Post-Extrapolation", after));
    return m;
  };
  auto m = modelOf("C", "C");
  EXPECT_EQ(m.at(1), 1);
  EXPECT_EQ(m.at(9), 5);
  m = modelOf("K", "K");
  EXPECT_NEAR(m.at(1), 0, 1e-9);
  EXPECT_NEAR(m.at(6), 11, 1e-9);
  m = modelOf("R", "R");
  EXPECT_NEAR(m.at(0.5), 1.5, 1e-9);
  EXPECT_NEAR(m.at(4.5), 1.5, 1e-9);
  EXPECT_NEAR(m.at(7.5), 3.5, 1e-9);
  m = modelOf("M", "M");
  EXPECT_NEAR(m.at(1.5), 1.5, 1e-9);
  EXPECT_NEAR(m.at(4.5), 3.5, 1e-9);
  EXPECT_NEAR(m.at(6.5), 1.5, 1e-9);
  m = modelOf("A", "A");
  EXPECT_NEAR(m.at(1.5), 3.5 - 4, 1e-9);
  EXPECT_NEAR(m.at(4.5), 1.5 + 4, 1e-9);
  EXPECT_NEAR(m.at(6.5), 1.5 + 8, 1e-9);
  m = modelOf("R", "A", 1);
  EXPECT_NEAR(m.at(4.5), 1.5 + 4, 1e-9);
  EXPECT_NEAR(m.at(9), 9, 1e-9) << "once, and then no further";
  m = modelOf("R", "R", 0);
  EXPECT_EQ(m.at(9), 5);
}

TEST(FbxMotion, TimesAreThoseOfTheFile)
{
  const auto middle = [](FbxMaker maker)
  {
    const std::int64_t node = maker.model();
    maker.mesh(node);
    maker.animate(maker.stack(4, 100), node, "Lcl Translation", "d|X", { { 100, 0, linear }, { 104, 8, linear } });
    const auto model = readBytes("fbx", maker.text());
    EXPECT_EQ(model->frames, 121);
    return pointsAt(*model, 1).at(0).x();
  };
  const auto flags = [](std::int64_t definition) {
    return FbxItem{ "OtherFlags", {}, { { "TCDefinition", { definition } } } };
  };
  FbxMaker maker;
  EXPECT_NEAR(middle(maker), 2, 1e-9);
  maker.version = 8000;
  maker.ticks = 141120000;
  EXPECT_NEAR(middle(maker), 2, 1e-9);
  maker.version = 7700;
  maker.header = { flags(0) };
  EXPECT_NEAR(middle(maker), 2, 1e-9);
  maker.version = 8000;
  maker.header = { flags(127) };
  maker.ticks = 46186158000.;
  EXPECT_NEAR(middle(maker), 2, 1e-9);
}

TEST(FbxMotion, LayersAddAndBlend)
{
  const auto at = [](double weight, std::int64_t mode, const std::string& property, const Numbers& below,
                    const Numbers& own, bool byNumber = false)
  {
    FbxMaker maker;
    const std::int64_t node = maker.model();
    maker.mesh(node, { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
    const std::int64_t base = maker.stack(1);
    const std::int64_t layer = maker.layer(weight, mode);
    maker.set(layer, "RotationAccumulationMode", Numbers{ byNumber ? 1. : 0. });
    maker.set(layer, "ScaleAccumulationMode", Numbers{ byNumber ? 1. : 0. });
    const char* const components[] = { "d|X", "d|Y", "d|Z" };
    for (std::size_t i = 0; i < 2; ++i)
    {
      const std::int64_t curves = maker.add("AnimationCurveNode", "");
      maker.connect(curves, i == 0 ? base : layer);
      maker.connect(curves, node, property);
      for (std::size_t c = 0; c < 3; ++c)
      {
        maker.set(curves, components[c], Numbers{ (i == 0 ? below : own)[c] });
      }
    }
    return pointsAt(*readBytes("fbx", maker.text()), 0.5);
  };
  const char* const shift = "Lcl Translation";
  expectAt(at(100, 0, shift, { 1, 2, 3 }, { 10, 20, 30 }), 0, { 12, 22, 33 });
  expectAt(at(25, 0, shift, { 1, 2, 3 }, { 10, 20, 30 }), 0, { 4.5, 7, 10.5 });
  expectAt(at(25, 2, shift, { 1, 2, 3 }, { 9, 2, 3 }), 0, { 4, 2, 3 });
  expectAt(at(25, 1, shift, { 1, 2, 3 }, { 9, 2, 3 }), 0, { 10, 2, 3 }); // takes its place whole
  const char* const turn = "Lcl Rotation";
  expectAt(at(100, 0, turn, { 90, 0, 0 }, { 0, 0, 90 }), 0, { 0, 0, 1 });       // x to y, then y to z
  expectAt(at(100, 0, turn, { 90, 0, 0 }, { 0, 0, 90 }, true), 0, { 0, 1, 0 }); // 90, 0, 90 degrees
  const double half = std::sqrt(0.5);
  expectAt(at(50, 2, turn, { 0, 0, 0 }, { 0, 0, 90 }), 0, { half, half, 0 });
  expectAt(at(50, 0, turn, { 0, 0, 30 }, { 0, 0, 90 }), 0, { std::cos(75 * fbxDegree), std::sin(75 * fbxDegree), 0 });
  expectAt(at(50, 0, turn, { 0, 90, 0 }, { 0, 0, 90 }), 0, { 0, half, -half }); // where angles are not unique
  const char* const scale = "Lcl Scaling";
  expectAt(at(50, 0, scale, { 2, 1, 1 }, { 9, 1, 1 }), 0, { 6, 0, 0 });
  expectAt(at(50, 2, scale, { 4, 1, 1 }, { 9, 1, 1 }), 0, { 6, 0, 0 });
  expectAt(at(50, 0, scale, { 2, 1, 1 }, { -9, 1, 1 }), 0, { -6, 0, 0 });
  expectAt(at(0, 0, scale, { 2, 1, 1 }, { 0, 1, 1 }), 0, { 2, 0, 0 }); // without a weight it is not there
  expectAt(at(0, 0, scale, { 2, 1, 1 }, { -9, 1, 1 }), 0, { 2, 0, 0 });
  expectAt(at(100, 2, scale, { 0, 1, 1 }, { -9, 1, 1 }), 0, { -9, 0, 0 });
  expectAt(at(50, 0, scale, { 2, 1, 1 }, { 9, 0, 0 }, true), 0, { 6.5, 0, 0 });
}

TEST(FbxMotion, WhatACurveNodeDoesNotSayStaysAsItStands)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.mesh(node, { 1, 1, 1, 0, 1, 0, 0, 0, 1 });
  maker.set(node, "Lcl Scaling", { 2, 3, 4 });
  maker.animate(maker.stack(1), node, "Lcl Scaling", "d|X", { { 0, 5, linear } });
  expectAt(pointsAt(*readBytes("fbx", maker.text()), 0.5), 0, { 5, 3, 4 });
  maker.animate(maker.layer(100, 0), node, "Lcl Scaling", "d|Y", { { 0, 2, linear } });
  expectAt(pointsAt(*readBytes("fbx", maker.text()), 0.5), 0, { 5, 6, 4 });
}

TEST(FbxMotion, StacksWithoutTimesLastAsLongAsTheirKeys)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.mesh(node);
  const std::int64_t layer = maker.stack(1);
  maker.item(layer - 1).children.clear(); // the stack's properties
  maker.animate(layer, node, "Lcl Translation", "d|X", { { 0, 0, linear }, { 3, 6, linear } });
  const auto model = readBytes("fbx", maker.text());
  EXPECT_EQ(model->frames, 91);
  expectAt(pointsAt(*model, 2), 0, { 4, 0, 0 });
  const auto ticks = static_cast<std::int64_t>(maker.ticks);
  maker.takes = { { "Take", { std::string("Take") }, { { "LocalTime", { ticks, 2 * ticks } } } } };
  const auto taken = readBytes("fbx", maker.text());
  EXPECT_EQ(taken->frames, 31);
  expectAt(pointsAt(*taken, 0), 0, { 2, 0, 0 });
}

TEST(FbxMotion, WeightsOfLayersMoveToo)
{
  FbxMaker maker;
  const std::int64_t node = maker.model();
  maker.mesh(node);
  const std::int64_t base = maker.stack(1);
  maker.animate(base, node, "Lcl Translation", "d|X", { { 0, 1, linear } });
  const std::int64_t layer = maker.layer(100, 0);
  maker.animate(layer, node, "Lcl Translation", "d|X", { { 0, 4, linear } });
  maker.animate(layer, layer, "Weight", "d|Weight", { { 0, 0, linear }, { 1, 100, linear } });
  expectAt(pointsAt(*readBytes("fbx", maker.text()), 0.25), 0, { 2, 0, 0 });
}

namespace
{
/// A geometry whose first point blend shapes lift along z, by 1 where each is reached.
class FbxShapes : public testing::Test
{
protected:
  FbxShapes()
  {
    this->Node = this->Maker.model();
    this->Mesh = this->Maker.mesh(this->Node);
    this->Blend = this->Maker.add("Deformer", "BlendShape");
    this->Maker.connect(this->Blend, this->Mesh);
  }
  std::int64_t channel(const Numbers& full)
  {
    const std::int64_t channel = this->Maker.add("Deformer", "BlendShapeChannel", { { "FullWeights", { full } } });
    this->Maker.connect(channel, this->Blend);
    return channel;
  }
  void shape(std::int64_t channel, double x, double z)
  {
    const std::int64_t shape = this->Maker.add(
      "Geometry", "Shape", { { "Indexes", { FbxMaker::Integers{ 0 } } }, { "Vertices", { Numbers{ x, 0, z } } } });
    this->Maker.connect(shape, channel);
  }
  Eigen::Vector3d first() { return readBytes("fbx", this->Maker.text())->rest->positions[0]; }

  FbxMaker Maker;
  std::int64_t Node;
  std::int64_t Mesh;
  std::int64_t Blend;
};
} // namespace

TEST_F(FbxShapes, StandAsTheFileLeavesThem)
{
  const std::int64_t one = this->channel({ 100 });
  this->shape(one, 0, 1);
  EXPECT_EQ(this->first().z(), 0);
  this->Maker.item(one).children.push_back({ "DeformPercent", { 25. } });
  EXPECT_EQ(this->first().z(), 0.25);
  this->Maker.set(one, "DeformPercent", Numbers{ 75 });
  EXPECT_EQ(this->first().z(), 0.75);
  const std::int64_t two = this->channel({ 100 });
  this->shape(two, 1, 1);
  this->Maker.set(two, "DeformPercent", Numbers{ 50 });
  EXPECT_EQ(this->first(), Eigen::Vector3d(0.5, 0, 1.25));
}

TEST_F(FbxShapes, HaveOthersBetween)
{
  const std::int64_t channel = this->channel({ 100, 50, -20 });
  this->shape(channel, 0, 4); // at 100
  this->shape(channel, 1, 1); // at 50
  this->shape(channel, 0, -2);
  const std::int64_t layer = this->Maker.stack(4);
  this->Maker.animate(layer, channel, "DeformPercent", "d|DeformPercent", { { 0, -100, linear }, { 4, 300, linear } });
  const auto model = readBytes("fbx", this->Maker.text());
  const auto at = [&model](double percent) { return pointsAt(*model, percent / 100 + 1); };
  expectAt(at(0), 0, { 0, 0, 0 });
  expectAt(at(0.5), 0, { 0.01, 0, 0.01 });
  expectAt(at(25), 0, { 0.5, 0, 0.5 });
  expectAt(at(50), 0, { 1, 0, 1 });
  expectAt(at(75), 0, { 0.5, 0, 2.5 });
  expectAt(at(100), 0, { 0, 0, 4 });
  expectAt(at(150), 0, { -1, 0, 7 });
  expectAt(at(-10), 0, { 0, 0, -1 });
  expectAt(at(-40), 0, { 0, 0, -4 });
}

TEST_F(FbxShapes, GoTheOtherWayWhereNothingIsThere)
{
  const std::int64_t channel = this->channel({ 50 });
  this->shape(channel, 0, 1);
  this->Maker.set(channel, "DeformPercent", Numbers{ -25 });
  EXPECT_EQ(this->first().z(), -0.5);
}

TEST_F(FbxShapes, PercentagesThatAreNoNumbersAreWhole)
{
  const std::int64_t channel = this->channel({ std::nan("") });
  this->shape(channel, 0, 1);
  this->Maker.set(channel, "DeformPercent", Numbers{ 50 });
  EXPECT_EQ(this->first().z(), 0.5);
}

TEST_F(FbxShapes, OfBlenderHaveSharesOfTheirVertices)
{
  const std::int64_t channel = this->channel({ 50, 100 });
  const std::int64_t shape = this->Maker.add("Geometry", "Shape",
    { { "Indexes", { FbxMaker::Integers{ 0, 1 } } }, { "Vertices", { Numbers{ 0, 0, 1, 0, 0, 1 } } } });
  this->Maker.connect(shape, channel);
  this->Maker.set(channel, "DeformPercent", Numbers{ 100 });
  const auto model = readBytes("fbx", this->Maker.text());
  EXPECT_EQ(model->rest->positions[0].z(), 0.5);
  EXPECT_EQ(model->rest->positions[1].z(), 1);
}

TEST_F(FbxShapes, OfFbx2011StandInTheGeometry)
{
  this->Maker.item(this->Mesh)
    .children.push_back({ "Shape", { std::string("Up") },
      { { "Indexes", { FbxMaker::Integers{ 0 } } }, { "Vertices", { Numbers{ 0, 0, 1 } } } } });
  this->Maker.set(this->Mesh, "Up", Numbers{ 25 });
  EXPECT_EQ(this->first().z(), 0.25);
  this->Maker.animate(this->Maker.stack(1), this->Mesh, "Up", "d|Up", { { 0, 0, linear }, { 1, 100, linear } });
  expectAt(pointsAt(*readBytes("fbx", this->Maker.text()), 0.5), 0, { 0, 0, 0.5 });
}

namespace
{
/// Two points at (2, 0, 0) and (3, 0, 0), and one that no bone moves; a bone at (1, 0, 0) turns about z, another one
/// stays.
class FbxSkinned : public testing::Test
{
protected:
  FbxSkinned()
  {
    this->Node = this->Maker.model();
    this->Mesh = this->Maker.mesh(this->Node, { 2, 0, 0, 3, 0, 0, 0, 5, 0 });
    this->Skin = this->Maker.add("Deformer", "Skin");
    this->Maker.connect(this->Skin, this->Mesh);
    this->Bone = this->Maker.model(0, "bone");
    this->Maker.set(this->Bone, "Lcl Translation", { 1, 0, 0 });
    const std::int64_t still = this->Maker.model(0, "still");
    this->cluster(this->Bone, { 0, 1 }, { 0.5, 1 }, -1);
    this->cluster(still, { 0 }, { 0.5 }, 0);
    this->Maker.animate(
      this->Maker.stack(1), this->Bone, "Lcl Rotation", "d|Z", { { 0, 0, linear }, { 1, 180, linear } });
    this->Maker.set(this->Node, "Lcl Translation", { 0, 0, 7 }); // which skinned points do not see
  }
  void cluster(std::int64_t bone, const FbxMaker::Integers& points, const Numbers& weights, double shift)
  {
    const std::int64_t cluster = this->Maker.add("Deformer", "Cluster",
      { { "Indexes", { points } }, { "Weights", { weights } },
        { "Transform", { Numbers{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, shift, 0, 0, 1 } } } });
    this->Maker.connect(cluster, this->Skin);
    this->Maker.connect(bone, cluster);
  }
  std::vector<Eigen::Vector3d> middle() { return pointsAt(*readBytes("fbx", this->Maker.text()), 0.5); }

  FbxMaker Maker;
  std::int64_t Node;
  std::int64_t Mesh;
  std::int64_t Skin;
  std::int64_t Bone;
};
} // namespace

TEST_F(FbxSkinned, PointsFollowTheirBones)
{
  const auto points = this->middle();
  expectAt(points, 1, { 1, 2, 0 });
  expectAt(points, 0, { 1.5, 0.5, 0 }); // half way between (2, 0) and (1, 1)
  expectAt(points, 2, { 0, 5, 7 });
}

TEST_F(FbxSkinned, ByDualQuaternionsPointsTurn)
{
  // half way between staying and a quarter turn about (1, 0): an eighth
  const Eigen::Vector3d eighth(1 + std::sqrt(0.5), std::sqrt(0.5), 0);
  FbxItem& skin = this->Maker.item(this->Skin);
  skin.children.push_back({ "SkinningType", { std::string("DualQuaternion") } });
  expectAt(this->middle(), 0, eighth);
  expectAt(this->middle(), 1, { 1, 2, 0 });
  expectAt(this->middle(), 2, { 0, 5, 7 });
  skin.children.back().values = { std::string("Blend") };
  expectAt(this->middle(), 0, { 1.5, 0.5, 0 });
  skin.children.push_back({ "Indexes", { FbxMaker::Integers{ 1, 0 } } });
  skin.children.push_back({ "BlendWeights", { Numbers{ 1, 0.25 } } });
  expectAt(this->middle(), 0, 0.25 * eighth + 0.75 * Eigen::Vector3d(1.5, 0.5, 0));
}

TEST_F(FbxSkinned, DualQuaternionsKeepScales)
{
  this->Maker.item(this->Skin).children.push_back({ "SkinningType", { std::string("DualQuaternion") } });
  this->Maker.set(this->Bone, "Lcl Scaling", { 3, 1, 1 });
  expectAt(this->middle(), 1, { 1, 6, 0 });
}

TEST_F(FbxSkinned, TheGeometrysOwnTransformComesFirst)
{
  this->Maker.set(this->Node, "GeometricTranslation", { 1, 0, 0 });
  expectAt(this->middle(), 1, { 1, 3, 0 });
}

TEST_F(FbxSkinned, MovesAlsoWhenReadFromTheCache)
{
  const auto model = readBytes("fbx", this->Maker.text());
  EXPECT_EQ(model->animations.at(0).name, "Take");
  const auto kept = dgtk::AssimpDeformation::restored(model->deformation->saved());
  std::vector<Eigen::Vector3d> points;
  kept->positionsAt(0, 0.5 * model->animations[0].fps, points);
  EXPECT_EQ(points, this->middle());
}
