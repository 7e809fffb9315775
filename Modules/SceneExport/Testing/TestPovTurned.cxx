// SPDX-License-Identifier: BSD-3-Clause
// The functions that say where the interpolated normals of a triangle face away, against the interpolation itself.
#include "dgtkPovTurned.h"

#include "dgtkSyntheticScene.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <regex>
#include <string>

namespace dgtk
{
namespace
{

/// Numbers of nine digits times lengths of 10, a few of them.
constexpr double tolerance = 1e-6;

using TurnedCorners = std::array<Eigen::Vector3d, 3>;

/// The value of a sum of (c + a * x + b * y + d * z) * (w), w: x - e or a number.
double valueAt(const std::string& text, const Eigen::Vector3d& p)
{
  const std::string number = R"((-?[0-9.e-]+))";
  const std::regex term(R"(\()" + number + R"( \+ )" + number + R"( \* x \+ )" + number + R"( \* y \+ )" + number +
                        R"( \* z\) \* \(([^()]*)\))");
  double sum = 0;
  int terms = 0;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), term); at != std::sregex_iterator(); ++at, ++terms)
  {
    const std::smatch& m = *at;
    const std::string way = m[5];
    const bool isPlace = way.find("xyz"[terms]) == 0;
    const double factor = isPlace ? p[terms] - std::stod(way.substr(4)) : std::stod(way);
    sum += (std::stod(m[1]) + std::stod(m[2]) * p.x() + std::stod(m[3]) * p.y() + std::stod(m[4]) * p.z()) * factor;
  }
  EXPECT_EQ(terms, 3) << text;
  return sum;
}

class PovTurnedFunction : public testing::Test
{
protected:
  TurnedCorners Points{ Eigen::Vector3d(-0.4, -0.3, 1), Eigen::Vector3d(-4, 3, 10), Eigen::Vector3d(3, -3, 10) };
  TurnedCorners Normals;
  Instance Object;
  View V;

  void SetUp() override
  {
    const Eigen::Vector3d own =
      (this->Points[1] - this->Points[0]).cross(this->Points[2] - this->Points[0]).normalized();
    this->Normals = { -own, own, (own + Eigen::Vector3d(0.25, 0, 0)).normalized() };
    this->V.model = makePinholeFromFov(64, 48, 90, 0);
    this->V.near = 0.1;
    this->V.far = 100;
  }

  std::string function(bool shared = false, bool back = false)
  {
    const auto model = test::makeSoup({ 1, 1, 1, 1 });
    auto geometry = std::make_shared<Geometry>(*model->rest);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t from = back && k > 0 ? 3 - k : k; // the other way around it is seen from behind
      geometry->positions[k] = this->Points[from];
      geometry->normals[k] = ((back ? -1 : 1) * this->Normals[from]).cast<float>();
    }
    model->rest = geometry;
    const Affine3 place = this->Object.world_from_object;
    this->Object = test::SceneBuilder().add(model).state()->instances[0];
    this->Object.world_from_object = place;
    const PovTurned found = povTurned(this->Object, this->V, shared);
    return found.empty() ? std::string() : found.begin()->second;
  }

  /// The normal at a place of the triangle, from its areas.
  Eigen::Vector3d normalAt(const Eigen::Vector3d& weights) const
  {
    Eigen::Vector3d sum(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum += weights[Eigen::Index(k)] * this->Normals[k].cast<float>().cast<double>();
    }
    return sum;
  }

  void expectFunction(const std::string& text, const Eigen::Vector3d& eye, bool perspective)
  {
    ASSERT_FALSE(text.empty());
    const Eigen::Vector3d own = (this->Points[1] - this->Points[0]).cross(this->Points[2] - this->Points[0]);
    const Eigen::Vector3d first = perspective ? Eigen::Vector3d(this->Points[0] - eye) : eye;
    const double side = own.dot(first) > 0 ? -1 : 1;
    for (const Eigen::Vector3d& weights : { Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
           Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.2, 0.3, 0.5), Eigen::Vector3d(0.6, 0.3, 0.1) })
    {
      const Eigen::Vector3d p =
        weights[0] * this->Points[0] + weights[1] * this->Points[1] + weights[2] * this->Points[2];
      const Eigen::Vector3d way = perspective ? Eigen::Vector3d(p - eye) : eye;
      EXPECT_NEAR(valueAt(text, p), side * this->normalAt(weights).dot(way), tolerance) << weights.transpose();
    }
  }
};

TEST_F(PovTurnedFunction, IsTheNormalTimesTheWayFromTheEye)
{
  this->expectFunction(this->function(), { 0, 0, 0 }, true);
  this->V.camera_from_world.translation = Eigen::Vector3d(-0.5, -0.25, 1);
  this->expectFunction(this->function(), { 0.5, 0.25, -1 }, true);
}

TEST_F(PovTurnedFunction, IsThatOfTheModelsAxes)
{
  this->Object.world_from_object.linear = 2 * Eigen::AngleAxisd(0.25, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  this->Object.world_from_object.translation = Eigen::Vector3d(0.5, 0.25, 1);
  const Eigen::Vector3d eye =
    this->Object.world_from_object.linear.inverse() * -this->Object.world_from_object.translation;
  this->expectFunction(this->function(), eye, true);
}

TEST_F(PovTurnedFunction, OfAParallelCameraHasOneWay)
{
  this->V.model = makeOrthographic(320, 240, 12, 0);
  this->expectFunction(this->function(), { 0, 0, 1 }, false);
}

TEST_F(PovTurnedFunction, IsOfTheSideThatIsSeen)
{
  const std::string front = this->function();
  const std::string back = this->function(false, true);
  ASSERT_FALSE(front.empty());
  ASSERT_FALSE(back.empty());
  for (const Eigen::Vector3d& p : { this->Points[0], this->Points[1], Eigen::Vector3d(-0.5, 0.25, 7) })
  {
    EXPECT_NEAR(valueAt(front, p), valueAt(back, p), tolerance);
  }
}

/// Few pixels need no function, of meshes that objects share fewer ones.
TEST_F(PovTurnedFunction, IsThereForEnoughPixels)
{
  std::array<int, 2> least{ 0, 0 }; // rows of the smallest image with one
  for (int rows = 96; rows > 0; --rows)
  {
    this->V.model = makePinholeFromFov(rows, rows, 90, 0);
    least[0] = this->function(false).empty() ? least[0] : rows;
    least[1] = this->function(true).empty() ? least[1] : rows;
  }
  EXPECT_GT(least[0], 0);
  EXPECT_GT(least[1], least[0]);
  const auto turnedPixels = [&](int rows)
  {
    // Pixels whose ray meets the triangle where its normal faces away.
    int count = 0;
    Eigen::Matrix3d corners;
    corners << this->Points[0], this->Points[1], this->Points[2];
    for (int i = 0; i < rows * rows; ++i)
    {
      const Eigen::Vector3d ray(
        (i % rows + 0.5 - rows / 2.0) / (rows / 2.0), (i / rows + 0.5 - rows / 2.0) / (rows / 2.0), 1);
      const Eigen::Vector3d w = corners.inverse() * ray; // weights times 1 / t
      const double t = 1 / w.sum();
      const double side =
        (this->Points[1] - this->Points[0]).cross(this->Points[2] - this->Points[0]).dot(this->Points[0]) > 0 ? -1 : 1;
      const bool meets = w.minCoeff() >= 0 && t >= this->V.near && t <= this->V.far;
      count += meets && side * this->normalAt(w).dot(ray) >= 0 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(turnedPixels(least[0]), 4);
  EXPECT_LE(turnedPixels(least[0] - 1), 4);
  EXPECT_GT(turnedPixels(least[1]), 32);
  EXPECT_LE(turnedPixels(least[1] - 1), 32);
}

TEST_F(PovTurnedFunction, IsNotOfWhatIsFlatOrUnlit)
{
  EXPECT_FALSE(this->function().empty());
  this->V.far = 1;
  EXPECT_TRUE(this->function().empty()) << "beyond the far plane";
  this->V.far = 100;
  this->V.near = 9.9;
  EXPECT_TRUE(this->function().empty()) << "before the near plane";
  this->V.near = 0.1;
  this->function();
  auto dark = std::make_shared<std::vector<Material>>(*this->Object.materials);
  for (Material& material : *dark)
  {
    material.diffuse.setZero();
  }
  this->Object.materials = dark;
  EXPECT_TRUE(povTurned(this->Object, this->V, false).empty());
  this->Object.materials = nullptr;
  this->function();
  this->Object.world_from_object.linear.col(0).setZero();
  EXPECT_TRUE(povTurned(this->Object, this->V, false).empty());
}

} // namespace
} // namespace dgtk
