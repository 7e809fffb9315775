// SPDX-License-Identifier: BSD-3-Clause
// Where the pictures of lenses end, and closed forms of their rays.
#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using testing::HasSubstr;

namespace
{
using Numbers = std::map<std::string, std::vector<double>>;

/// 200 x 100 pixels, one unit of the plane is 50 pixels, the middle is (100, 50).
std::shared_ptr<const CameraModel> lens(const std::string& model, const Numbers& numbers)
{
  Eigen::Matrix3d K;
  K << 50, 0, 100, 0, 50, 50, 0, 0, 1;
  return makeCamera(model, { 200, 100, K, numbers });
}

std::shared_ptr<const CameraModel> byFieldOfView(const std::string& model, Numbers numbers, double degrees)
{
  numbers["fovY"] = { degrees };
  return makeCamera(model, { 200, 100, std::nullopt, numbers });
}

Eigen::Vector3d at(double angle, double around = 0.3)
{
  return { std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle) };
}

bool sees(const CameraModel& camera, double angle)
{
  Eigen::Vector2d pixel;
  return camera.project(at(angle), pixel);
}

/// Whether there is a ray at a distance from the middle of lens().
bool hasRay(const CameraModel& camera, double radius)
{
  return camera.rayThrough({ 100 + 50 * radius * std::cos(0.3), 50 + 50 * radius * std::sin(0.3) }).exists();
}

void expectEnd(const CameraModel& camera, double angle, double radius)
{
  constexpr double little = 1e-3;
  EXPECT_TRUE(sees(camera, angle - little));
  EXPECT_FALSE(sees(camera, angle + little));
  EXPECT_TRUE(hasRay(camera, radius - little));
  EXPECT_FALSE(hasRay(camera, radius + little));
}

std::string refusalOf(const std::string& model, const Numbers& numbers)
{
  return test::thrownBy<UsageError>([&] { byFieldOfView(model, numbers, 170); });
}
} // namespace

TEST(LensDomain, ADistortionEndsWhereItFoldsBack)
{
  // r (1 - 0.3 r^2) grows up to r = 1 / sqrt(0.9)
  const double fold = 1 / std::sqrt(0.9);
  expectEnd(*lens("pinhole", { { "distortion", { -0.3, 0, 0, 0 } } }), std::atan(fold), fold * (1 - 0.3 / 0.9));
  // r / (1 + r^2 / 4) grows up to r = 2
  expectEnd(*lens("pinhole", { { "distortion", { 0, 0, 0, 0, 0, 0.25, 0, 0 } } }), std::atan(2.0), 2 / (1 + 4 * 0.25));
  // a pole: r / (1 - r^2 / 4)
  const auto pole = lens("pinhole", { { "distortion", { 0, 0, 0, 0, 0, -0.25, 0, 0 } } });
  EXPECT_TRUE(sees(*pole, std::atan(1.99)));
  EXPECT_FALSE(sees(*pole, std::atan(2.01)));
  EXPECT_TRUE(hasRay(*pole, 100)) << "the whole plane";
  // growing
  const auto cushion = lens("pinhole", { { "distortion", { 0.2, 0.1, 0, 0 } } });
  EXPECT_TRUE(sees(*cushion, 1.57));
  EXPECT_FALSE(sees(*cushion, 1.58));
  EXPECT_TRUE(hasRay(*cushion, 100));
}

TEST(LensDomain, TheTangentialPartMovesTheEnd)
{
  const auto camera = lens("pinhole", { { "distortion", { -0.3, 0, 0.02, -0.01 } } });
  EXPECT_TRUE(sees(*camera, std::atan(0.9)));
  EXPECT_FALSE(sees(*camera, std::atan(1.05))) << "it folds towards one side before";
}

TEST(LensDomain, AFisheyeSeesAllAround)
{
  const auto equidistant = lens("fisheye", { { "distortion", { 0, 0, 0, 0 } } });
  Eigen::Vector2d pixel;
  ASSERT_TRUE(equidistant->project(at(3.1, pi), pixel));
  EXPECT_NEAR(pixel.x(), 100 - 50 * 3.1, 1e-9);
  EXPECT_TRUE(hasRay(*equidistant, 3.1));
  EXPECT_FALSE(hasRay(*equidistant, 3.2)) << "beyond the opposite of the axis";
  EXPECT_FALSE(equidistant->project({ 0, 0, -1 }, pixel)) << "a whole circle of pixels";
  // angle - angle^3 / 10 grows up to sqrt(10 / 3)
  const double fold = std::sqrt(10.0 / 3);
  expectEnd(*lens("fisheye", { { "distortion", { -0.1, 0, 0, 0 } } }), fold, fold * (1 - fold * fold / 10));
}

TEST(LensDomain, TheSphereEndsWhereRaysTouchIt)
{
  const double xi = 1.6;
  expectEnd(*lens("omnidirectional", { { "xi", { xi } } }), std::acos(-1 / xi), 1 / std::sqrt(xi * xi - 1));
  const auto inside = lens("omnidirectional", { { "xi", { 0.5 } } });
  EXPECT_TRUE(sees(*inside, std::acos(-0.499)));
  EXPECT_FALSE(sees(*inside, std::acos(-0.501)));
  EXPECT_TRUE(hasRay(*inside, 50)) << "the whole plane";
  // alpha 0.8 is xi = 4, of which the plane is 5 times as far
  expectEnd(*lens("eucm", { { "alpha", { 0.8 } } }), std::acos(-0.25), 5 / std::sqrt(15.0));
  expectEnd(*lens("double-sphere", { { "alpha", { 0.8 } } }), std::acos(-0.25), 5 / std::sqrt(15.0));
}

TEST(LensDomain, TheUnifiedModelsAreOneWhereTheyMeet)
{
  // x / (alpha rho + (1 - alpha) z) is 1 / (1 - alpha) times x / (xi rho + z), xi = alpha / (1 - alpha)
  const double alpha = 0.6;
  const auto eucm = lens("eucm", { { "alpha", { alpha } } });
  const auto doubled = lens("double-sphere", { { "alpha", { alpha } } });
  const auto omni = lens("omnidirectional", { { "xi", { alpha / (1 - alpha) } } });
  for (const double angle : { 0.0, 0.2, 1.0, 1.7, 2.1 })
  {
    Eigen::Vector2d a;
    Eigen::Vector2d b;
    Eigen::Vector2d c;
    ASSERT_TRUE(eucm->project(at(angle), a) && doubled->project(at(angle), b) && omni->project(at(angle), c));
    EXPECT_LE((a - b).norm(), 1e-11);
    const Eigen::Vector2d middle(100, 50);
    EXPECT_LE((a - middle - (c - middle) / (1 - alpha)).norm(), 1e-11);
  }
}

TEST(Equirectangular, HasLongitudesAndLatitudes)
{
  const auto camera = makeCamera("equirectangular", { 200, 100, std::nullopt });
  const auto expectSeen = [&](double x, double y, const Eigen::Vector3d& direction)
  {
    EXPECT_LE((camera->rayThrough({ x, y }).direction - direction).norm(), 1e-14) << x << " " << y;
    Eigen::Vector2d pixel;
    ASSERT_TRUE(camera->project(7 * direction, pixel));
    EXPECT_LE((pixel - Eigen::Vector2d(x, y)).norm(), 1e-12);
  };
  expectSeen(100, 50, { 0, 0, 1 });
  expectSeen(150, 50, { 1, 0, 0 });
  expectSeen(50, 50, { -1, 0, 0 });
  expectSeen(100, 75, { 0, std::sqrt(0.5), std::sqrt(0.5) }); // y is down
  expectSeen(200, 50, { 0, 0, -1 });
  Eigen::Vector2d pixel;
  ASSERT_TRUE(camera->project({ 0, -3, 0 }, pixel));
  EXPECT_EQ(pixel, Eigen::Vector2d(100, 0)) << "the pole";
  for (const Eigen::Vector2d& outside : { Eigen::Vector2d(-1, 50), { 201, 50 }, { 100, -1 }, { 100, 101 } })
  {
    EXPECT_FALSE(camera->rayThrough(outside).exists());
  }
}

TEST(Lens, RaysThroughCentresAreThoseBesideThem)
{
  std::vector<std::shared_ptr<const CameraModel>> lenses; // more than those whose centres are kept
  for (int i = 0; i < 6; ++i)
  {
    const std::vector<double> distortion{ -0.05 * i, 0.01, 0.002 * i, -0.001 };
    lenses.push_back(lens("pinhole", { { "distortion", distortion } }));
    lenses.push_back(lens("omnidirectional", { { "xi", { 0.4 } }, { "distortion", distortion } }));
  }
  for (int pixel = 0; pixel < 200 * 100; ++pixel)
  {
    const Eigen::Vector2d centre(pixel % 200 + 0.5, pixel / 200 + 0.5);
    for (const auto& camera : lenses)
    {
      const Eigen::Vector2d beside = centre + 1e-9 * (Eigen::Vector2d(100, 50) - centre); // further in
      const CameraRay ray = camera->rayThrough(centre);
      ASSERT_EQ(ray.exists(), camera->rayThrough(beside).exists());
      ASSERT_NEAR((ray.direction - camera->rayThrough(beside).direction).norm(), 0, 1e-6);
      ASSERT_EQ(ray.direction, camera->rayThrough(centre).direction);
    }
  }
}

// Lenses of one distortion that differ in a number of K each.
TEST(Lens, RaysThroughCentresAreThoseOfTheOwnMatrix)
{
  std::vector<std::shared_ptr<const CameraModel>> lenses;
  for (const auto& [row, column] : { std::pair(2, 2), { 0, 0 }, { 0, 1 }, { 0, 2 }, { 1, 1 }, { 1, 2 } })
  {
    Eigen::Matrix3d K;
    K << 100, 0, 100, 0, 100, 50, 0, 0, 1;
    K(row, column) += row < 2 ? 20 : 0;
    lenses.push_back(makeCamera("pinhole", { 200, 100, K, { { "distortion", { 0.05, 0.01, 0.002, -0.001 } } } }));
  }
  const Eigen::Vector2d centre(150.5, 80.5);
  for (const auto& camera : lenses)
  {
    Eigen::Vector2d pixel;
    ASSERT_TRUE(camera->project(camera->rayThrough(centre).direction, pixel));
    EXPECT_LE((pixel - centre).norm(), 1e-9) << "lens " << &camera - lenses.data();
  }
}

TEST(Lens, FieldOfViewIsThatWithoutTheDistortion)
{
  const auto topAngle = [](const CameraModel& camera) {
    return std::acos(camera.rayThrough({ 100, 0 }).direction.z()) * 360 / pi;
  };
  EXPECT_NEAR(topAngle(*byFieldOfView("fisheye", {}, 170)), 170, 1e-9);
  EXPECT_NEAR(topAngle(*byFieldOfView("omnidirectional", { { "xi", { 1.2 } } }, 150)), 150, 1e-9);
  EXPECT_NEAR(topAngle(*byFieldOfView("double-sphere", { { "xi", { -0.2 } }, { "alpha", { 0.6 } } }, 140)), 140, 1e-9);
  EXPECT_NEAR(topAngle(*byFieldOfView("eucm", { { "alpha", { 0.7 } }, { "beta", { 1.1 } } }, 140)), 140, 1e-9);
  const Numbers none{ { "fovY", { 60 } } };
  const Numbers some{ { "fovY", { 60 } }, { "distortion", { -0.1, 0, 0, 0 } } };
  EXPECT_EQ(*makeCamera("pinhole", { 200, 100, std::nullopt, some })->parameters().K,
    makeCamera("pinhole", { 200, 100, std::nullopt, none })->linear()->K);
}

// As of gluPerspective(); of an equidistant lens the angle is the distance.
TEST(Lens, AspectIsThatOfTheView)
{
  const auto camera = byFieldOfView("fisheye", { { "aspect", { 3 } } }, 30);
  EXPECT_NEAR(std::acos(camera->rayThrough({ 100, 0 }).direction.z()), 15 * pi / 180, 1e-9);
  EXPECT_NEAR(std::acos(camera->rayThrough({ 0, 50 }).direction.z()), 45 * pi / 180, 1e-9);
}

TEST(Lens, APinholeWithoutDistortionIsLinear)
{
  EXPECT_TRUE(lens("pinhole", { { "distortion", { 0, 0, 0, 0, 0 } } })->linear());
  EXPECT_FALSE(lens("pinhole", { { "distortion", { 0, 0, 0, 0, 1e-9 } } })->linear());
}

TEST(Lens, RefusesWhatNoLensIs)
{
  EXPECT_THAT(refusalOf("double-sphere", { { "xi", { -0.9 } }, { "alpha", { 1 } } }),
    HasSubstr("fovY is beyond the field of view of the lens (found 170 degrees)"));
  EXPECT_THAT(refusalOf("fisheye", { { "distortion", { 0, 0, 0, 0, 0 } } }), HasSubstr("expected 4"));
  EXPECT_THAT(refusalOf("eucm", { { "alpha", { 1.5 } } }), HasSubstr("alpha out of range"));
  std::vector<double> tilted(14, 0.0);
  tilted[13] = 1.6;
  EXPECT_THAT(refusalOf("pinhole", { { "distortion", tilted } }), HasSubstr("tilt of the sensor out of range"));
}
