// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
constexpr double roundTrip = 1e-12; // of the image's size: a dozen roundings
constexpr double glPixels = 1e-9;   // pixels: agreement of two different chains of matrices

Eigen::Matrix3d matrixK(double fx, double fy, double cx, double cy, double skew)
{
  Eigen::Matrix3d K;
  K << fx, skew, cx, 0, fy, cy, 0, 0, 1;
  return K;
}

/// A linear camera with its image moved.
class Moved final : public dgtk::CameraModel
{
public:
  Moved(std::shared_ptr<const dgtk::CameraModel> inner, const Eigen::Vector2d& by)
    : CameraModel(inner->width(), inner->height())
    , Inner(std::move(inner))
    , By(by)
  {
  }
  std::string name() const override { return this->Inner->name(); }
  dgtk::CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    return this->Inner->rayThrough(pixel - this->By);
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d found;
    const bool seen = this->Inner->project(x, found);
    pixel = seen ? Eigen::Vector2d(found + this->By) : pixel;
    return seen;
  }
  std::optional<dgtk::LinearProjection> linear() const override
  {
    dgtk::LinearProjection moved = *this->Inner->linear();
    moved.K.topRightCorner<2, 1>() += this->By;
    return moved;
  }

private:
  std::shared_ptr<const dgtk::CameraModel> Inner;
  Eigen::Vector2d By;
};

struct Member
{
  std::string label;
  std::shared_ptr<const dgtk::CameraModel> model;
};

/// Every model of the module in several shapes: the laws below hold for all of them.
std::vector<Member> family()
{
  return { { "square", dgtk::makePinholeFromFov(640, 480, 45, 0) },
    { "anamorphic", dgtk::makePinholeFromFov(640, 480, 70, 2.35) },
    { "wide", dgtk::makePinholeFromFov(101, 57, 170, 0) }, { "tele", dgtk::makePinholeFromFov(4096, 4096, 0.5, 0) },
    { "huge", dgtk::makePinholeFromFov(65536, 65536, 60, 0) }, { "pixel", dgtk::makePinholeFromFov(1, 1, 90, 0) },
    { "calibrated", dgtk::makePinhole(1280, 960, matrixK(1100.5, 1043.25, 601.75, 512.125, 3.5)) },
    { "outside", dgtk::makePinhole(320, 200, matrixK(300, 280, -150, 430, -20)) },
    { "parallel", dgtk::makeOrthographic(640, 480, 12.5, 0) },
    { "parallelWide", dgtk::makeOrthographic(333, 777, 0.01, 1.9) },
    { "parallelMoved", std::make_shared<Moved>(dgtk::makeOrthographic(640, 480, 12.5, 0), Eigen::Vector2d(70, -30)) } };
}

dgtk::View viewOf(const std::shared_ptr<const dgtk::CameraModel>& model)
{
  dgtk::View view;
  view.name = "test";
  view.model = model;
  view.camera_from_world = dgtk::lookAtPose({ 3, -2, 7 }, { -1, 0.5, 0.25 }, { 0.1, 1, -0.2 });
  view.near = 0.25;
  view.far = 400;
  return view;
}

const auto messageOf = [](const auto& body) { return dgtk::test::thrownBy<dgtk::UsageError>(body); };

/// A lens whose rays are a pinhole's but that does not say so.
class Unsaid final : public dgtk::CameraModel
{
public:
  explicit Unsaid(std::shared_ptr<const dgtk::CameraModel> inner)
    : CameraModel(inner->width(), inner->height())
    , Inner(std::move(inner))
  {
  }
  std::string name() const override { return "unsaid"; }
  dgtk::CameraRay rayThrough(const Eigen::Vector2d& pixel) const override { return this->Inner->rayThrough(pixel); }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    return this->Inner->project(x, pixel);
  }

private:
  std::shared_ptr<const dgtk::CameraModel> Inner;
};
} // namespace

TEST(CameraFamily, ProjectsEveryPointOfARayOntoItsPixel)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-0.25, 1.25);
  for (const Member& member : family())
  {
    SCOPED_TRACE(member.label);
    const double size = std::max({ 1.0, double(member.model->width()), double(member.model->height()) });
    for (int i = 0; i < 500; ++i)
    {
      const Eigen::Vector2d pixel(unit(random) * member.model->width(), unit(random) * member.model->height());
      const dgtk::CameraRay ray = member.model->rayThrough(pixel);
      ASSERT_EQ(ray.direction.z(), 1);
      ASSERT_EQ(ray.origin.z(), 0);
      for (const double t : { 1e-3, 0.1, 1.0, 17.3, 1e5 })
      {
        Eigen::Vector2d back;
        ASSERT_TRUE(member.model->project(ray.origin + t * ray.direction, back));
        ASSERT_LE((back - pixel).norm(), roundTrip * (size + pixel.norm() + member.model->linear()->K.norm()));
      }
    }
  }
}

TEST(CameraFamily, RefusesPointsBehindAndLeavesThePixel)
{
  for (const Member& member : family())
  {
    SCOPED_TRACE(member.label);
    Eigen::Vector2d pixel(-3, -4);
    EXPECT_FALSE(member.model->project({ 0.1, 0.2, -1 }, pixel));
    EXPECT_FALSE(member.model->project({ 0.1, 0.2, std::nan("") }, pixel));
    EXPECT_EQ(member.model->project({ 0.1, 0.2, 0 }, pixel), !member.model->linear()->perspective);
    if (member.model->linear()->perspective)
    {
      EXPECT_EQ(pixel, Eigen::Vector2d(-3, -4));
    }
  }
}

TEST(CameraFamily, ManyAtOnceAreEachAlone)
{
  for (const Member& member : family())
  {
    std::vector<Eigen::Vector2d> pixels;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 7; ++i)
    {
      pixels.emplace_back(13.25 * i - 20, 40 - 9.5 * i);
      points.emplace_back(0.3 * i - 1, 0.7 - 0.1 * i, 2.0 - i); // the last ones behind the camera
    }
    std::vector<dgtk::CameraRay> rays(8);
    std::vector<Eigen::Vector2d> found(8, Eigen::Vector2d(-7, -7));
    std::vector<std::uint8_t> seen(8, 9);
    member.model->raysThrough(pixels.data(), 7, rays.data());
    member.model->projectAll(points.data(), 7, found.data(), seen.data());
    for (std::size_t i = 0; i < 7; ++i)
    {
      const dgtk::CameraRay ray = member.model->rayThrough(pixels[i]);
      EXPECT_EQ(rays[i].origin, ray.origin) << member.label;
      EXPECT_EQ(rays[i].direction, ray.direction) << member.label;
      Eigen::Vector2d pixel(-7, -7);
      EXPECT_EQ(seen[i], member.model->project(points[i], pixel) ? 1 : 0) << member.label;
      EXPECT_EQ(found[i], pixel) << member.label;
    }
    EXPECT_EQ(seen[0], 1) << member.label;
    EXPECT_EQ(seen[6], 0) << member.label;
    EXPECT_EQ(seen[7], 9) << "beyond their number";
  }
}

TEST(CameraFamily, LinearProjectionIsTheModel)
{
  for (const Member& member : family())
  {
    SCOPED_TRACE(member.label);
    const dgtk::LinearProjection linear = *member.model->linear();
    const Eigen::Vector3d x(0.3, -0.2, 1.7);
    const Eigen::Vector3d h = linear.K * (linear.perspective ? x : Eigen::Vector3d(x.x(), x.y(), 1));
    Eigen::Vector2d pixel;
    ASSERT_TRUE(member.model->project(x, pixel));
    EXPECT_LE((pixel - h.head<2>() / h.z()).norm(), roundTrip * (1 + pixel.norm() + linear.K.norm()));
  }
}

TEST(CameraFamily, OpenGLMatricesProjectAlike)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Member& member : family())
  {
    SCOPED_TRACE(member.label);
    const dgtk::View view = viewOf(member.model);
    const dgtk::OpenGLMatrices gl = dgtk::openGLMatrices(view);
    for (int i = 0; i < 200; ++i)
    {
      const Eigen::Vector2d pixel(unit(random) * member.model->width(), unit(random) * member.model->height());
      const dgtk::CameraRay ray = member.model->rayThrough(pixel);
      const double depth = view.near + unit(random) * (view.far - view.near);
      const Eigen::Vector3d x = view.camera_from_world.inverse() * (ray.origin + depth * ray.direction);
      const Eigen::Vector4d clip = gl.projection * (gl.modelView * Eigen::Vector4d(x.x(), x.y(), x.z(), 1));
      const Eigen::Vector3d ndc = clip.head<3>() / clip.w();
      const Eigen::Vector2d window(
        (ndc.x() + 1) / 2 * member.model->width(), (1 - ndc.y()) / 2 * member.model->height());
      const double scale = std::max(1.0, member.model->linear()->K.norm() / 1000); // narrow views magnify rounding
      ASSERT_LE((window - pixel).norm(), glPixels * scale);
      ASSERT_LE(std::abs(ndc.z()), 1 + 1e-12);
    }
  }
}

TEST(CameraFamily, OpenGLDepthRunsFromNearToFar)
{
  for (const Member& member : family())
  {
    SCOPED_TRACE(member.label);
    dgtk::View view = viewOf(member.model);
    view.camera_from_world = {};
    const dgtk::OpenGLMatrices gl = dgtk::openGLMatrices(view);
    for (const auto& [depth, ndc] : { std::pair(view.near, -1.0), std::pair(view.far, 1.0) })
    {
      const Eigen::Vector4d clip = gl.projection * (gl.modelView * Eigen::Vector4d(0, 0, depth, 1));
      EXPECT_NEAR(clip.z() / clip.w(), ndc, 1e-12);
    }
  }
}

TEST(Pinhole, FieldOfViewIsK)
{
  const double f = 240 / std::tan(20 * dgtk::pi / 180);
  const Eigen::Matrix3d square = dgtk::makePinholeFromFov(640, 480, 40, 0)->linear()->K;
  EXPECT_LE((square - matrixK(f, f, 320, 240, 0)).norm(), 1e-10);
  EXPECT_EQ(square(0, 0), square(1, 1));
  const Eigen::Matrix3d wide = dgtk::makePinholeFromFov(640, 480, 40, 2)->linear()->K;
  EXPECT_LE((wide - matrixK(320 / (2 * std::tan(20 * dgtk::pi / 180)), f, 320, 240, 0)).norm(), 1e-10);
  const auto fromK = dgtk::makePinhole(640, 480, wide);
  EXPECT_EQ(fromK->rayThrough({ 12, 34 }).direction,
    dgtk::makePinholeFromFov(640, 480, 40, 2)->rayThrough({ 12, 34 }).direction);
}

TEST(Pinhole, TopAndBottomRowsSpanTheFieldOfView)
{
  const auto camera = dgtk::makePinholeFromFov(640, 480, 90, 0);
  EXPECT_NEAR(camera->rayThrough({ 320, 0 }).direction.y(), -1, 1e-15); // y is down: the top row looks up
  EXPECT_NEAR(camera->rayThrough({ 320, 480 }).direction.y(), 1, 1e-15);
  EXPECT_NEAR(camera->rayThrough({ 640, 240 }).direction.x(), 4.0 / 3, 1e-15);
}

TEST(Orthographic, PixelSizeIsTheViewHeight)
{
  const auto camera = dgtk::makeOrthographic(200, 100, 5, 0);
  EXPECT_LE((camera->rayThrough({ 0, 0 }).origin - Eigen::Vector3d(-5, -2.5, 0)).norm(), 1e-15);
  EXPECT_LE(
    (dgtk::makeOrthographic(200, 100, 5, 3)->rayThrough({ 200, 100 }).origin - Eigen::Vector3d(7.5, 2.5, 0)).norm(),
    1e-15);
}

TEST(LookAtPose, ClosedForms)
{
  // Looking down the world's -z with +y up: OpenGL's own camera.
  const dgtk::Rigid3 ahead = dgtk::lookAtPose({ 0, 0, 5 }, { 0, 0, 0 }, { 0, 1, 0 });
  EXPECT_EQ(ahead.rotation, Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal()));
  EXPECT_EQ(ahead.translation, Eigen::Vector3d(0, 0, 5));
  // From above, the world's -z at the top of the image.
  const dgtk::Rigid3 above = dgtk::lookAtPose({ 0, 10, 0 }, { 0, 0, 0 }, { 0, 0, -1 });
  EXPECT_LE((above * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 0, 10)).norm(), 1e-15);
  EXPECT_LE((above * Eigen::Vector3d(0, 0, -1) - Eigen::Vector3d(0, -1, 10)).norm(), 1e-15);
}

TEST(LookAtPose, IsProperAndCentresTheTarget)
{
  const Eigen::Vector3d eye(1e5, -3, 2e4);
  const Eigen::Vector3d target(-7, 8, 1e4);
  const dgtk::Rigid3 pose = dgtk::lookAtPose(eye, target, { 1e-5, 3e-3, 2e-4 });
  EXPECT_LE((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  const Eigen::Vector3d cross(
    pose.rotation(0, 1) * pose.rotation(1, 2) - pose.rotation(0, 2) * pose.rotation(1, 1), 0, 0);
  EXPECT_NEAR(cross.x(), pose.rotation(2, 0), 1e-14); // right x down = forward
  EXPECT_LE((pose * eye).norm(), 1e-9);
  EXPECT_LE((pose * target - Eigen::Vector3d(0, 0, (target - eye).norm())).norm(), 1e-9);
  EXPECT_LT((pose.rotation * Eigen::Vector3d(1e-5, 3e-3, 2e-4)).y(), 0); // up is upwards: negative y
}

TEST(WorldResolution, EquationsPerAxis)
{
  dgtk::View view = viewOf(dgtk::makePinholeFromFov(640, 480, 60, 0));
  view.near = 2;
  view.far = 102;
  const double yDistance = 2 * (102 - 2) * std::tan(30 * pi / 180); // equation 4.1 with the field of view of y
  dgtk::WorldResolution resolution = dgtk::worldResolution(view);
  EXPECT_NEAR(resolution.thesis.y(), yDistance / 480, 1e-12);
  EXPECT_NEAR(resolution.thesis.x(), yDistance * 640 / 480 / 640, 1e-12);
  EXPECT_NEAR(resolution.farPlane.y(), 2 * 102 * std::tan(30 * pi / 180) / 480, 1e-12);

  view.model = dgtk::makePinhole(640, 480, matrixK(500, 250, 17, 400, 0)); // off-centre: the full extent W / fx counts
  resolution = dgtk::worldResolution(view);
  EXPECT_NEAR(resolution.thesis.x(), 100.0 / 500, 1e-15);
  EXPECT_NEAR(resolution.farPlane.y(), 102.0 / 250, 1e-15);

  view.model = dgtk::makeOrthographic(200, 100, 5, 4);
  resolution = dgtk::worldResolution(view);
  EXPECT_NEAR(resolution.thesis.x(), 0.1, 1e-15);
  EXPECT_NEAR(resolution.farPlane.y(), 0.05, 1e-15);
}

TEST(WorldResolution, AsksTheRaysOfALens)
{
  dgtk::View view = viewOf(dgtk::makePinholeFromFov(640, 480, 75, 1.7));
  const dgtk::WorldResolution linear = dgtk::worldResolution(view);
  view.model = std::make_shared<Unsaid>(view.model);
  const dgtk::WorldResolution lens = dgtk::worldResolution(view);
  EXPECT_LE((linear.thesis - lens.thesis).norm(), 1e-12);
  EXPECT_LE((linear.farPlane - lens.farPlane).norm(), 1e-12);
}

TEST(CameraRefusals, NameWhatIsWrong)
{
  using testing::HasSubstr;
  const double nan = std::nan("");
  EXPECT_THAT(messageOf([] { dgtk::makePinholeFromFov(0, 480, 45, 0); }), HasSubstr("found 0 x 480"));
  EXPECT_THAT(messageOf([] { dgtk::makePinholeFromFov(640, (1 << 20) + 1, 45, 0); }), HasSubstr("1048577"));
  EXPECT_NO_THROW(dgtk::makePinholeFromFov(1 << 20, 1 << 20, 45, 0));
  EXPECT_THAT(messageOf([] { dgtk::makePinholeFromFov(640, 480, 180, 0); }), HasSubstr("found 180"));
  EXPECT_THAT(messageOf([] { dgtk::makePinholeFromFov(640, 480, 0, 0); }), HasSubstr("field of view"));
  EXPECT_THAT(messageOf([&] { dgtk::makePinholeFromFov(640, 480, nan, 0); }), HasSubstr("field of view"));
  EXPECT_THAT(messageOf([&] { dgtk::makePinholeFromFov(640, 480, 45, nan); }), HasSubstr("aspect is not finite"));
  EXPECT_THAT(messageOf([&] { dgtk::makePinhole(9, 9, matrixK(nan, 1, 0, 0, 0)); }), HasSubstr("not finite"));
  EXPECT_THAT(messageOf([] { dgtk::makePinhole(9, 9, matrixK(-5, 1, 0, 0, 0)); }), HasSubstr("found -5, 1"));
  EXPECT_THAT(messageOf([] { dgtk::makePinhole(9, 9, 2 * Eigen::Matrix3d::Identity()); }),
    HasSubstr("[fx s cx; 0 fy cy; 0 0 1]"));
  for (const auto& [row, column] : { std::pair(1, 0), { 2, 0 }, { 2, 1 } })
  {
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K(row, column) = 0.5;
    EXPECT_THAT(messageOf([&] { dgtk::makePinhole(9, 9, K); }), HasSubstr("[fx s cx; 0 fy cy; 0 0 1]")) << row;
  }
  EXPECT_THAT(messageOf([] { dgtk::makeOrthographic(9, 9, 0, 0); }), HasSubstr("view height"));
  EXPECT_THAT(messageOf([] { dgtk::lookAtPose({ 1, 2, 3 }, { 1, 2, 3 }, { 0, 1, 0 }); }), HasSubstr("coincide"));
  EXPECT_THAT(messageOf([] { dgtk::lookAtPose({ 0, 0, 0 }, { 0, 4, 0 }, { 0, 1, 0 }); }), HasSubstr("parallel"));
  EXPECT_THAT(messageOf([] { dgtk::lookAtPose({ 0, 0, 0 }, { 0, 4, 0 }, { 0, 0, 0 }); }), HasSubstr("zero"));
  EXPECT_THAT(messageOf([&] { dgtk::lookAtPose({ 0, nan, 0 }, { 0, 4, 0 }, { 0, 0, 1 }); }), HasSubstr("not finite"));

  dgtk::View view = viewOf(std::make_shared<Unsaid>(dgtk::makePinholeFromFov(640, 480, 45, 0)));
  EXPECT_THAT(messageOf([&] { dgtk::openGLMatrices(view); }), HasSubstr("'test' (unsaid) has no OpenGL matrices"));
  view.far = view.near;
  EXPECT_THAT(messageOf([&] { dgtk::worldResolution(view); }), HasSubstr("0 < near < far"));
  view.model.reset();
  EXPECT_THAT(messageOf([&] { dgtk::worldResolution(view); }), HasSubstr("has no camera model"));
}

TEST(LookAtPose, TheLengthOfUpMeansNothing)
{
  const dgtk::Rigid3 expected = dgtk::lookAtPose({ 3, -2, 7 }, { -1, 0.5, 0.25 }, { 0, 1, 0 });
  for (const double length : { 1e-300, 1e-20, 2.0, 1e20, 1e300 })
  {
    const dgtk::Rigid3 found = dgtk::lookAtPose({ 3, -2, 7 }, { -1, 0.5, 0.25 }, { 0, length, 0 });
    EXPECT_LE((found.rotation - expected.rotation).norm(), 1e-15) << length;
  }
}

TEST(LookAtPose, UpMayBeAlmostParallelToTheView)
{
  const dgtk::Rigid3 pose = dgtk::lookAtPose({ 0, 0, 0 }, { 0, 4, 0 }, { 0, 1, 1e-9 });
  EXPECT_LE((pose.rotation.row(1).transpose() - Eigen::Vector3d(0, 0, -1)).norm(), 1e-9);
  EXPECT_THAT(messageOf(
                [] {
                  dgtk::lookAtPose({ 0, 0, 0 }, { 0, 4, 0 }, { 0, 1, 1e-13 });
                }),
    testing::HasSubstr("parallel"));
}

TEST(RecordedCamera, IsTheOneThatWasRecorded)
{
  Eigen::Matrix3d K;
  K << 70, 0, 30, 0, 80, 20, 0, 0, 1;
  const auto pinhole = dgtk::makeCamera("pinhole", { 64, 48, K });
  Eigen::Vector2d pixel;
  ASSERT_TRUE(pinhole->project({ 1, 2, 4 }, pixel));
  EXPECT_EQ(pixel, Eigen::Vector2d(70 / 4.0 + 30, 80 / 2.0 + 20));
  // an image 6 scene units high and 4 wide, its K in pixels a unit
  const auto parallel = dgtk::makeOrthographic(64, 48, 6, 4 / 6.0);
  const auto again = dgtk::makeCamera("orthographic", parallel->parameters());
  for (const Eigen::Vector3d& point : { Eigen::Vector3d(0, 0, 1), { 1.5, -2, 5 }, { -1.9, 2.9, 3 } })
  {
    Eigen::Vector2d expected;
    ASSERT_TRUE(parallel->project(point, expected));
    ASSERT_TRUE(again->project(point, pixel));
    EXPECT_LT((pixel - expected).norm(), 1e-12);
  }
}
