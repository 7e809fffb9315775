// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFragmentList.h"
#include "dgtkPieces.h"
#include "dgtkPixelFilter.h"
#include "dgtkRasterCamera.h"
#include "dgtkRasterLights.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

// What is computed before and after OpenGL draws.

using namespace dgtk;

namespace
{
using Values = std::array<float, 4>;

Fragment fragment(float pixel, float depth, float number, float triangle, float color = 0)
{
  return { pixel, depth, number, triangle, { color, color, color, color } };
}

std::vector<std::array<float, 4>> keysOf(const std::vector<Fragment>& fragments)
{
  std::vector<std::array<float, 4>> keys;
  keys.reserve(fragments.size());
  for (const Fragment& f : fragments)
  {
    keys.push_back({ f.pixel, f.depth, f.number, f.triangle });
  }
  return keys;
}

View viewThrough(const std::shared_ptr<const CameraModel>& model)
{
  View view;
  view.model = model;
  view.camera_from_world = lookAtPose({ 3, -2, 7 }, { -1, 0.5, 0.25 }, { 0.1, 1, -0.2 });
  view.near = 0.5;
  view.far = 40;
  return view;
}
} // namespace

TEST(Fragments, AreSortedByPixelDepthDrawAndTriangle)
{
  std::vector<Fragment> fragments{ fragment(2, 0.5f, 0, 7), fragment(0, 0.25f, 1, 2), fragment(0, 0.75f, 9, 9),
    fragment(0, 0.25f, 0, 5), fragment(0, 0.25f, 1, 1), fragment(2, 0.5f, 0, 7), fragment(2, 0.5f, 1, 7),
    fragment(1, 0, 3, 3), fragment(0, -0.5f, 0, 0) };
  sortFragments(fragments, 4);
  EXPECT_THAT(keysOf(fragments),
    testing::ElementsAre(Values{ 0, 0.75f, 9, 9 }, Values{ 0, 0.25f, 0, 5 }, Values{ 0, 0.25f, 1, 1 },
      Values{ 0, 0.25f, 1, 2 }, Values{ 2, 0.5f, 0, 7 }, Values{ 2, 0.5f, 1, 7 }));
}

TEST(RasterLights, AreInViewCoordinatesDirectionalOnesFirst)
{
  std::vector<LightState> lights(5);
  lights[0].kind = LightKind::Spot;
  lights[0].position = { 1, 2, 3 };
  lights[0].target = { 1, 2, 8 };
  lights[0].coneAngle = 60;
  lights[0].exponent = 4;
  lights[0].attenuation = { 0.25, 0.5, 0.75 };
  lights[0].ambient = { 0.1, 0.2, 0.3 };
  lights[0].diffuse = { 0.4, 0.5, 0.6 };
  lights[0].specular = { 0.7, 0.8, 0.9 };
  lights[0].intensity = 2;
  lights[1].kind = LightKind::Point;
  lights[1].position = { -4, 0, 1 };
  lights[2].kind = LightKind::Directional;
  lights[2].position = { 0, 3, 0 };
  lights[2].target = { 0, 1, 0 };
  lights[3].kind = LightKind::Head;
  lights[4].kind = LightKind::Spot;
  lights[4].target = { 0, 0, -1 };
  lights[4].coneAngle = 90; // no cone
  // The world turned a quarter about z, then moved.
  Eigen::Matrix4d view_from_world = Eigen::Matrix4d::Identity();
  view_from_world.topLeftCorner<2, 2>() << 0, -1, 1, 0;
  view_from_world.topRightCorner<3, 1>() = Eigen::Vector3d(10, 20, 30);
  const RasterLights found = rasterLights(lights, view_from_world, { 3, -1, 0, -1, -1 });
  EXPECT_EQ(found.counts, (std::array<int, lightLawCount>{ 2, 2, 1 })); // parallel, point, cone
  EXPECT_EQ(found.count(), 5);
  EXPECT_FALSE(found.headOnly);
  ASSERT_EQ(found.values.size(), 5u * RasterLights::stride);
  const auto first = [&](int light, int row) { return found.values[std::size_t(light * RasterLights::stride + row)]; };
  const auto three = [&](int light, int row)
  { return Eigen::Vector3f(first(light, row)[0], first(light, row)[1], first(light, row)[2]); };
  EXPECT_EQ(three(0, 1), Eigen::Vector3f(1, 0, 0)); // away from the light, at +y of the world
  EXPECT_EQ(first(0, 2)[3], 1);                     // its map is the first
  EXPECT_EQ(three(1, 1), Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(first(1, 2)[3], 0);
  EXPECT_EQ(three(2, 0), Eigen::Vector3f(10, 16, 31));
  EXPECT_EQ(three(3, 0), Eigen::Vector3f(10, 20, 30));
  EXPECT_EQ(three(4, 0), Eigen::Vector3f(8, 21, 33));
  EXPECT_FLOAT_EQ(first(4, 0)[3], 0.5f);
  EXPECT_EQ(first(4, 1), (Values{ 0, 0, 1, 4 }));
  EXPECT_EQ(first(4, 2), (Values{ 0.25f, 0.5f, 0.75f, 4 }));
  EXPECT_EQ(three(4, 3), Eigen::Vector3f(0.2f, 0.4f, 0.6f));
  EXPECT_EQ(three(4, 4), Eigen::Vector3f(0.8f, 1.0f, 1.2f));
  EXPECT_EQ(three(4, 5), Eigen::Vector3f(1.4f, 1.6f, 1.8f));
  EXPECT_TRUE(rasterLights({ lights[3] }, view_from_world).headOnly);
  EXPECT_FALSE(rasterLights({ lights[2] }, view_from_world).headOnly);
  EXPECT_FALSE(rasterLights({ lights[3], lights[3] }, view_from_world).headOnly);
}

TEST(RasterCamera, ProjectsLikeItsModel)
{
  Eigen::Matrix3d K;
  K << 90, 7, 40, 0, 80, 20, 0, 0, 1;
  for (const auto& model : { makePinhole(96, 72, K), makeOrthographic(96, 72, 9, 1.5) })
  {
    const View view = viewThrough(model);
    for (const int samples : { 1, 3 })
    {
      for (const bool zeroToOne : { true, false })
      {
        const PixelRect rect{ 16, 8, 32, 24 };
        const RasterCamera camera = rasterCamera(view, rect, samples, zeroToOne);
        EXPECT_EQ(camera.perspective, model->linear()->perspective);
        EXPECT_EQ(camera.near, view.near);
        EXPECT_EQ(camera.far, view.far);
        EXPECT_EQ(camera.focal, samples * std::max(model->linear()->K(0, 0), model->linear()->K(1, 1)));
        for (const Eigen::Vector3d& x_in_camera :
          { Eigen::Vector3d(0.3, -0.2, 0.5), Eigen::Vector3d(-2, 1, 7), Eigen::Vector3d(5, 9, 40) })
        {
          const Eigen::Vector3d x_in_world = view.camera_from_world.inverse() * x_in_camera;
          const Eigen::Vector4d clip = camera.clip_from_view * (camera.view_from_world * x_in_world.homogeneous());
          Eigen::Vector2d pixel;
          ASSERT_TRUE(model->project(x_in_camera, pixel));
          pixel *= samples;
          EXPECT_NEAR(clip.x() / clip.w(), 2 * (pixel.x() - rect.x) / rect.width - 1, 1e-12);
          EXPECT_NEAR(clip.y() / clip.w(), 1 - 2 * (pixel.y() - rect.y) / rect.height, 1e-12);
          const double z = x_in_camera.z();
          const double depth = model->linear()->perspective ? 0.5 / 39.5 * (40 / z - 1) : (40 - z) / 39.5;
          EXPECT_NEAR(clip.z() / clip.w(), zeroToOne ? depth : 2 * depth - 1, 1e-12);
        }
      }
    }
  }
}

TEST(PixelFilters, WeightsAreThoseOfTheirShapes)
{
  const auto weights = [](const char* name, int samples)
  {
    int margin = -1;
    std::vector<double> found = pixelFilterWeights(pixelFilterFromName(name), samples, margin);
    EXPECT_EQ(found.size(), std::size_t((2 * margin + 1) * samples)) << name;
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      sum += found[i];
      EXPECT_DOUBLE_EQ(found[i], found[found.size() - 1 - i]) << name;
    }
    EXPECT_NEAR(sum, 1, 1e-15) << name;
    return found;
  };
  EXPECT_THAT(weights("box", 4), testing::Each(0.25));
  // 1 - |x| at -0.75, -0.25, 0.25, 0.75
  EXPECT_THAT(weights("triangle", 2), testing::ElementsAre(0, 0.125, 0.375, 0.375, 0.125, 0));
  EXPECT_THAT(weights("triangle", 1), testing::ElementsAre(0, 1, 0));
  const std::vector<double> gaussian = weights("gaussian", 2); // exp(-2 x^2) - exp(-4.5)
  EXPECT_NEAR(gaussian[3] / gaussian[4],
    (std::exp(-2 * 0.0625) - std::exp(-4.5)) / (std::exp(-2 * 0.5625) - std::exp(-4.5)), 1e-12);
  // Mitchell and Netravali 1988 at 0, 1 and 2 pixels: 8 / 9, 1 / 18, 0
  const std::vector<double> mitchell = weights("mitchell", 1);
  ASSERT_EQ(mitchell.size(), 5u);
  EXPECT_NEAR(mitchell[2], 8.0 / 9, 1e-15);
  EXPECT_NEAR(mitchell[1], 1.0 / 18, 1e-15);
  EXPECT_NEAR(mitchell[0], 0, 1e-15);
  // and at quarters of pixels: (7 x^3 - 12 x^2 + 16 / 3) / 6, beyond 1 (-7 x^3 / 3 + 12 x^2 - 20 x + 32 / 3) / 6
  const std::vector<double> quarters = weights("mitchell", 2);
  ASSERT_EQ(quarters.size(), 10u);
  const double inner = (7 * 0.015625 - 12 * 0.0625 + 16.0 / 3) / 6;
  EXPECT_NEAR(quarters[6] / quarters[5], (7 * 0.421875 - 12 * 0.5625 + 16.0 / 3) / 6 / inner, 1e-12);
  EXPECT_NEAR(quarters[7] / quarters[5], (-7 * 1.953125 / 3 + 12 * 1.5625 - 20 * 1.25 + 32.0 / 3) / 6 / inner, 1e-12);
  EXPECT_NEAR(quarters[8] / quarters[5], (-7 * 5.359375 / 3 + 12 * 3.0625 - 20 * 1.75 + 32.0 / 3) / 6 / inner, 1e-12);
  const std::vector<double> lanczos = weights("lanczos", 2); // at 0.25 and 1.25 pixels
  const auto sinc = [](double x) { return std::sin(M_PI * x) / (M_PI * x); };
  ASSERT_EQ(lanczos.size(), 14u);
  EXPECT_NEAR(lanczos[9] / lanczos[7], sinc(1.25) * sinc(1.25 / 3) / (sinc(0.25) * sinc(0.25 / 3)), 1e-12);
  EXPECT_LT(lanczos[9], 0);
}

// A piece of 2 x 1 pixels of an image of 5 x 4; samples come from the bottom up, colours go from the top down.
TEST(PixelFilters, PiecesAreMadeOfTheirSamples)
{
  for (const char* name : { "box", "triangle" })
  {
    const SampleFilter filter(pixelFilterFromName(name), 2);
    const int margin = std::string(name) == "box" ? 0 : 1;
    EXPECT_EQ(filter.margin(), margin);
    const PixelRect piece{ 3, 2, 2, 1 };
    const PixelRect drawn = filter.drawn(piece);
    EXPECT_EQ(drawn.x, 3 - margin);
    EXPECT_EQ(drawn.y, 2 - margin);
    EXPECT_EQ(drawn.width, 2 + 2 * margin);
    EXPECT_EQ(drawn.height, 1 + 2 * margin);
    const int width = 2 * drawn.width;
    const int height = 2 * drawn.height;
    std::vector<float> samples(std::size_t(width) * height * 4, 0.0f);
    // The upper left sample of the right pixel: red 0.5, green too bright, blue below nothing.
    const int x = 2 * (margin + 1);
    const int fromTop = 2 * margin;
    float* sample = samples.data() + (std::size_t(height - 1 - fromTop) * width + x) * 4;
    sample[0] = 0.5f;
    sample[1] = 8;
    sample[2] = -8;
    ColorBuffer colors;
    colors.rect = { 1, 0, 5, 4 };
    colors.rgb.assign(std::size_t(5) * 4 * 3, 0.125f);
    filter.apply(SampleImage::upwards(samples, width), piece, colors);
    const double own = margin ? 0.375 * 0.375 : 0.25;
    const double beside = margin ? 0.125 * 0.375 : 0;
    for (int i = 0; i < 20; ++i)
    {
      const double weight = i == 2 * 5 + 2 ? beside : i == 2 * 5 + 3 ? own : NAN;
      for (int c = 0; c < 3; ++c)
      {
        const double expected = std::isnan(weight) ? 0.125 : c == 0 ? 0.5 * weight : c == 1 ? weight : 0;
        EXPECT_FLOAT_EQ(colors.rgb[std::size_t(3 * i + c)], float(expected)) << name << ' ' << i << ' ' << c;
      }
    }
  }
}

namespace
{
/// A triangle of a ground from behind the camera to the horizon, and one that is far enough.
struct Ground
{
  Ground()
  {
    auto rest = std::make_shared<Geometry>();
    rest->positions = { { -300, -1, 5 }, { 300, -1, 5 }, { 0, -1, -900 }, { -1, 0, -20 }, { 1, 0, -20 },
      { 0, 1, -21 } };
    rest->normals.assign(6, Eigen::Vector3f(0, 1, 0));
    rest->normals[2] = Eigen::Vector3f(1, 0, 0);
    this->Shape.rest = rest;
    this->Shape.triangles = { { 0, 1, 2 }, { 3, 4, 5 }, { 2, 1, 0 } };
    this->Shape.uvs = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 0, 1 } };
    this->Shape.colors = { { 0, 10, 0, 255 }, { 200, 10, 0, 255 }, { 0, 10, 250, 55 }, {}, {}, {} };
    this->Range.model = &this->Shape;
    this->Range.geometry = rest.get();
    this->Range.count = 3;
    this->Range.view_from_object = Eigen::Matrix4d::Identity();
    this->Range.extent = 900;
    this->Range.least = -5;
    this->Range.largest = 900;
    Eigen::Matrix3d K;
    K << 400, 0, 320, 0, 400, 240, 0, 0, 1;
    View view;
    view.model = makePinhole(640, 480, K);
    view.near = 0.5;
    view.far = 2000;
    this->Camera = rasterCamera(view, { 0, 0, 640, 480 }, 1, true);
  }

  Model Shape;
  PieceRange Range;
  RasterCamera Camera;
};
} // namespace

TEST(Pieces, CoverWhatTheyAreCutFromOnceWithDepthsThatDouble)
{
  const Ground ground;
  EXPECT_TRUE(mayNeedPieces(ground.Range, ground.Camera));
  Pieces pieces;
  makePieces(ground.Range, ground.Camera, pieces);
  EXPECT_THAT(pieces.others, testing::ElementsAre(std::make_pair(1u, 1u)));
  ASSERT_EQ(pieces.positions.size() % 9, 0u);
  ASSERT_EQ(pieces.triangles.size(), pieces.positions.size() / 3);
  ASSERT_EQ(pieces.uvs.size(), pieces.triangles.size() * 2);
  ASSERT_EQ(pieces.colors.size(), pieces.triangles.size() * 4);
  double area[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i + 2 < pieces.triangles.size(); i += 3)
  {
    const auto t = static_cast<std::size_t>(pieces.triangles[i]);
    ASSERT_TRUE(t == 0 || t == 2);
    Eigen::Vector3d x[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const float* p = &pieces.positions[3 * (i + k)];
      x[k] = { p[0], p[1], p[2] };
      EXPECT_EQ(pieces.triangles[i + k], pieces.triangles[i]);
      EXPECT_FLOAT_EQ(p[1], -1);
      // Texture coordinates, normals and colours are linear on the triangle: v is the weight of the far corner.
      const double v = (5 - p[2]) / 905;
      const double u = (p[0] + 300 * (1 - v)) / 600;
      EXPECT_NEAR(pieces.uvs[2 * (i + k)], u, 1e-5);
      EXPECT_NEAR(pieces.uvs[2 * (i + k) + 1], v, 1e-5);
      const double color[4] = { 200 * u, 10, 250 * v, 255 - 200 * v };
      for (std::size_t channel = 0; channel < 4; ++channel)
      {
        EXPECT_NEAR(pieces.colors[4 * (i + k) + channel], color[channel], 0.51);
      }
      EXPECT_NEAR(pieces.normals[3 * (i + k)], v, 1e-5);
      EXPECT_NEAR(pieces.normals[3 * (i + k) + 1], 1 - v, 1e-5);
    }
    const double upwards = (x[1] - x[0]).cross(x[2] - x[0]).y() / 2;
    EXPECT_GT(t == 0 ? upwards : -upwards, 0) << "its own winding";
    area[t] += std::abs(upwards);
    const auto depths = std::minmax({ -x[0].z(), -x[1].z(), -x[2].z() });
    EXPECT_GE(depths.first, 0.5 * (1 - 1e-6));
    EXPECT_LE(depths.second, 4 * depths.first * (1 + 1e-6));
  }
  // What is left beyond near of an isosceles triangle 905 high.
  const double all = 600 * 905 / 2.0;
  const double beyond = all * (899.5 / 905) * (899.5 / 905);
  EXPECT_NEAR(area[0] / beyond, 1, 1e-5);
  EXPECT_NEAR(area[2] / beyond, 1, 1e-5);
}

TEST(Pieces, OfWhatBeginsInTheNearPlane)
{
  Ground ground;
  ground.Range.view_from_object(2, 3) = -5.5; // depths from near on
  Pieces pieces;
  makePieces(ground.Range, ground.Camera, pieces);
  double area[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i + 2 < pieces.triangles.size(); i += 3)
  {
    const float* p = &pieces.positions[3 * i];
    const double ax = p[3] - p[0], az = p[5] - p[2], bx = p[6] - p[0], bz = p[8] - p[2];
    area[static_cast<std::size_t>(pieces.triangles[i])] += std::abs(ax * bz - az * bx) / 2;
  }
  EXPECT_NEAR(area[0], 600 * 905 / 2.0, 3);
  EXPECT_NEAR(area[2], 600 * 905 / 2.0, 3);
}

TEST(Pieces, AreNotMadeOfWhatIsNotSeenOrNeedsNone)
{
  Ground ground;
  Pieces pieces;
  ground.Camera.near = 1000; // all nearer
  makePieces(ground.Range, ground.Camera, pieces);
  EXPECT_TRUE(pieces.empty());
  EXPECT_FALSE(mayNeedPieces(ground.Range, ground.Camera));
  ground.Camera.near = 0.5;
  ground.Range.view_from_object(1, 3) = 5000; // above the image
  makePieces(ground.Range, ground.Camera, pieces);
  EXPECT_TRUE(pieces.empty());
  EXPECT_THAT(pieces.others, testing::ElementsAre(std::make_pair(0u, 3u)));
  ground.Range.least = 4;
  ground.Range.largest = 16;
  ground.Range.extent = 20;
  EXPECT_FALSE(mayNeedPieces(ground.Range, ground.Camera));
  ground.Range.largest = 16.1; // beyond four times
  EXPECT_TRUE(mayNeedPieces(ground.Range, ground.Camera));
  ground.Range.largest = 16;
  ground.Range.extent = 4 * 2e4 / 400 + 1; // rounding beyond 1 / 512 pixel
  EXPECT_TRUE(mayNeedPieces(ground.Range, ground.Camera));
  ground.Camera.perspective = false;
  EXPECT_FALSE(mayNeedPieces(ground.Range, ground.Camera));
}
