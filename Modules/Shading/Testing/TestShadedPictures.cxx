// SPDX-License-Identifier: BSD-3-Clause
// Light against closed forms; the renderers are compared in RenderGL and Pipeline.
#include "dgtkShadedGround.h"

#include "dgtkCameraEntry.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// Whether the way from a point of the ground to a light is cut by a box, and by one that is `more` larger.
bool isCut(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::AlignedBox3d& box, double more)
{
  double first = 0;
  double last = 1;
  for (int c = 0; c < 3; ++c)
  {
    const double a = (box.min()[c] - more - from[c]) / (to[c] - from[c]);
    const double b = (box.max()[c] + more - from[c]) / (to[c] - from[c]);
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last;
}

/// Has rays through its image alone.
class Framed final : public CameraModel
{
public:
  Framed(int width, int height)
    : CameraModel(width, height)
  {
  }
  std::string name() const override { return "framed"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const bool inside = pixel.x() >= 0 && pixel.x() <= this->width() && pixel.y() >= 0 && pixel.y() <= this->height();
    const Eigen::Vector3d d(pixel.x() - this->width() / 2.0, pixel.y() - this->height() / 2.0, this->width());
    return { Eigen::Vector3d::Zero(), inside ? d.normalized() : Eigen::Vector3d::Zero() };
  }
  bool project(const Eigen::Vector3d&, Eigen::Vector2d&) const override { return false; }
};

ColorBuffer filtered(const std::shared_ptr<const SceneState>& state, const View& view, PixelFilter filter, int samples)
{
  ThreadPool pool(2);
  const auto source = makeRayPictures(pool);
  source->setFilter(filter);
  source->setScene(state, view);
  ColorBuffer colors;
  source->renderColor({ 0, 0, view.model->width(), view.model->height() }, samples, colors, nullptr);
  return colors;
}
} // namespace

TEST(ShadedPictures, PlaneUnderAPointLightThatFades)
{
  const auto state = ground().state();
  LightState light = lightAt(LightKind::Point, { 1, 2, 0.5 });
  light.attenuation = { 0.5, 0.2, 0.1 };
  light.intensity = 0.9;
  state->lights.push_back(light);
  const View view = fromAbove();
  const Picture picture = draw(state, view);
  const int seen = forGround(view, picture,
    [&](int x, int y, const Eigen::Vector3d& p)
    {
      const double d = (light.position - p).norm();
      const double expected = 0.9 * (light.position.y() / d) / (0.5 + 0.2 * d + 0.1 * d * d);
      ASSERT_NEAR(picture.at(x, y), expected, 0.01 * step) << x << ' ' << y;
    });
  EXPECT_GT(seen, 10000);
}

TEST(ShadedPictures, ConeOfASpot)
{
  const auto state = ground().state();
  LightState light = lightAt(LightKind::Spot, { 0, 3, 0 }, { 0.5, 0, 0.2 });
  light.coneAngle = 25;
  light.exponent = 3;
  state->lights.push_back(light);
  const View view = fromAbove();
  const Picture picture = draw(state, view);
  const Eigen::Vector3d axis = (light.target - light.position).normalized();
  int lit = 0;
  forGround(view, picture,
    [&](int x, int y, const Eigen::Vector3d& p)
    {
      const Eigen::Vector3d way = (p - light.position).normalized();
      const double inside = way.dot(axis);
      const double edge = std::cos(25 * M_PI / 180);
      if (std::abs(inside - edge) > 1e-6)
      {
        const double expected = inside > edge ? std::pow(inside, 3) * -way.y() : 0;
        ASSERT_NEAR(picture.at(x, y), expected, 0.01 * step) << x << ' ' << y;
        lit += inside > edge;
      }
    });
  EXPECT_GT(lit, 1000);
}

// A smooth ball of flat triangles: its shadow ends where its shading does, and it does not shadow itself elsewhere.
TEST(ShadedPictures, TerminatorOfABall)
{
  ViewOptions options;
  options.width = options.height = 120;
  options.eye = { 0, 0, 4 };
  for (const bool shadows : { false, true })
  {
    SceneBuilder scene;
    scene.add(matte(makeSphere({ { 0, 0, 0 }, 1, 96, 192 }), true));
    const auto state = scene.state();
    LightState light = lightAt(LightKind::Directional, { 5, 1, 1 });
    light.shadows = shadows;
    state->lights.push_back(light);
    const View view = makeView(options);
    const Picture picture = draw(state, view);
    const Eigen::Vector3d toLight = light.position.normalized();
    int lit = 0;
    for (int i = 0; i < options.width * options.height; ++i)
    {
      const int x = i % options.width;
      const int y = i / options.width;
      const Eigen::Vector3d d = view.model->rayThrough({ x + 0.5, y + 0.5 }).direction.normalized();
      const double middle = 4 * d.z();
      const double inside = middle * middle - 15;
      if (inside > 0.05 && picture.hits.at(x, y).object == 1)
      {
        const Eigen::Vector3d p = (middle - std::sqrt(inside)) * d;
        const Eigen::Vector3d normal(p.x(), -p.y(), 4 - p.z()); // of the world: y up, z towards the eye
        const double expected = std::max(0.0, normal.dot(toLight));
        ASSERT_NEAR(picture.at(x, y), expected, 1.5 * step) << x << ' ' << y << " shadows " << shadows;
        lit += expected > 0;
      }
    }
    EXPECT_GT(lit, 1000);
  }
}

TEST(ShadedPictures, HardShadowOfABoxOnAPlane)
{
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.5, 0, -0.4), Eigen::Vector3d(0.3, 1.2, 0.4)); // stands on the plane
  for (const LightKind kind : { LightKind::Point, LightKind::Directional, LightKind::Spot })
  {
    SceneBuilder scene = ground();
    scene.add(matte(makeBox({ box.min(), box.max() })));
    const auto state = scene.state();
    LightState light = lightAt(kind, { 2, 3, 1.5 });
    light.coneAngle = 80;
    light.exponent = 0;
    light.shadows = true;
    state->lights.push_back(light);
    const View view = fromAbove();
    const Picture picture = draw(state, view);
    const double pixel = (onGround(view, 81, 60) - onGround(view, 80, 60)).norm();
    int shadowed = 0;
    int lit = 0;
    forGround(view, picture,
      [&](int x, int y, const Eigen::Vector3d& p)
      {
        const Eigen::Vector3d to =
          kind == LightKind::Directional ? Eigen::Vector3d(p + 10 * light.position) : light.position;
        const bool cut = isCut(p, to, box, -pixel / 2);
        if (cut == isCut(p, to, box, pixel / 2)) // not at the edge
        {
          ASSERT_EQ(picture.at(x, y) == 0, cut) << x << ' ' << y << " kind " << int(kind);
          ++(cut ? shadowed : lit);
        }
      });
    EXPECT_GT(shadowed, 100) << int(kind);
    EXPECT_GT(lit, 5000) << int(kind);
  }
}

TEST(ShadedPictures, LightGoesThroughGlassAndHoles)
{
  QuadOptions quad;
  quad.corner = { -1, 1, 1 };
  quad.sideU = { 2, 0, 0 };
  quad.sideV = { 0, 0, -2 };
  const auto opaque = matte(makeQuad(quad));
  const auto glass = matte(makeQuad(quad));
  glass->materials[0].opacity = 0.5;
  const auto tinted = matte(makeQuad(quad));
  tinted->colors.assign(tinted->rest->positions.size(), { 255, 255, 255, 0 });
  const auto mapped = matte(makeQuad(quad));
  Image clear;
  clear.width = clear.height = 1;
  clear.rgba = { 255, 255, 255, 0 };
  clear.hasAlpha = true;
  mapped->colorMap = std::make_shared<Image>(clear);
  mapped->colorMapAt.assign(mapped->rest->positions.size(), { 0.5, 0.5 });
  const auto leaf = matte(makeQuad(quad));
  addCutOut(*leaf, 2, 3);
  const auto litShare = [](const std::shared_ptr<Model>& cover)
  {
    SceneBuilder scene = ground();
    scene.add(cover);
    const auto state = scene.state();
    LightState light = lightAt(LightKind::Directional, { 0, 5, 0 });
    light.shadows = true;
    state->lights.push_back(light);
    ViewOptions options;
    options.eye = { 0, 0.5, 3 };
    options.lookAt = { 0, 0, 0 };
    const View view = makeView(options);
    const Picture picture = draw(state, view);
    double lit = 0;
    double all = 0;
    forGround(view, picture,
      [&](int x, int y, const Eigen::Vector3d& p)
      {
        const bool under = p.cwiseAbs().maxCoeff() < 0.99;
        all += under;
        lit += under && picture.at(x, y) > 0;
      });
    return lit / all;
  };
  EXPECT_EQ(litShare(opaque), 0);
  EXPECT_EQ(litShare(glass), 1);
  EXPECT_EQ(litShare(tinted), 1);
  EXPECT_EQ(litShare(mapped), 1);
  const double holes = litShare(leaf);
  EXPECT_GT(holes, 0.1);
  EXPECT_LT(holes, 0.9);
}

TEST(ShadedPictures, WhatStandsBehindALightCastsNoShadow)
{
  SceneBuilder scene = ground();
  scene.add(matte(makeBox({ { -3, 2, -3 }, { 3, 2.5, 3 } }))); // a ceiling just above the light
  const auto state = scene.state();
  LightState light = lightAt(LightKind::Point, { 0, 1.99, 0 });
  light.shadows = true;
  state->lights.push_back(light);
  ViewOptions options;
  options.eye = { 0, 1, 3.9 };
  options.lookAt = { 0, 0, 0 };
  const View view = makeView(options);
  const Picture picture = draw(state, view);
  const int seen = forGround(
    view, picture, [&](int x, int y, const Eigen::Vector3d&) { ASSERT_GT(picture.at(x, y), 0) << x << ' ' << y; });
  EXPECT_GT(seen, 1000);
}

// The same surface point has the same colour under every lens.
TEST(ShadedPictures, LensesSeeTheSameColours)
{
  SceneBuilder scene = ground(6);
  scene.add(matte(makeSphere({ { 0, 0.5, 0 }, 1, 40, 80 })));
  const auto state = scene.state();
  state->lights.push_back(lightAt(LightKind::Point, { 2, 4, 3 }));
  const View pinhole = fromAbove();
  View hidden = pinhole;
  hidden.model = hideLinear(pinhole.model);
  const Picture straight = draw(state, pinhole);
  const Picture general = draw(state, hidden);
  ASSERT_EQ(straight.colors.rgb.size(), general.colors.rgb.size());
  for (std::size_t i = 0; i < straight.colors.rgb.size(); ++i)
  {
    ASSERT_NEAR(double(straight.colors.rgb[i]), double(general.colors.rgb[i]), 1e-5) << i;
  }
  View round = pinhole;
  round.model = makeEquidistant(400, 400, 150);
  const Picture fisheye = draw(state, round);
  int compared = 0;
  for (int y = 4; y < 116; y += 3)
  {
    for (int x = 4; x < 156; x += 3)
    {
      Eigen::Vector2d at;
      const CameraRay ray = pinhole.model->rayThrough({ x + 0.5, y + 0.5 });
      ASSERT_TRUE(round.model->project(ray.direction, at));
      const int column = int(at.x());
      const int row = int(at.y());
      const Hit& hit = straight.hits.at(x, y);
      if (hit.object == 1 && fisheye.hits.at(column, row).object == 1)
      {
        EXPECT_NEAR(straight.at(x, y), fisheye.at(column, row), 0.01) << x << ' ' << y;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(ShadedPictures, IsBlackWhereTheLensDoesNotReach)
{
  const auto state = SceneBuilder().state();
  state->background = { 0.25, 0.5, 0.75 };
  View view = makeView();
  CameraParameters parameters{ 64, 48, std::nullopt };
  parameters.K = Eigen::Matrix3d::Identity();
  parameters.K->topRows<2>() << 7, 0, 32, 0, 7, 24; // 180 degrees from the axis are 22 pixels
  parameters.numbers["distortion"] = { 0, 0, 0, 0 };
  view.model = makeCamera("fisheye", parameters);
  const Picture picture = draw(state, view);
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_EQ(picture.at(32, 24, channel), 0.25 * (channel + 1));
    EXPECT_EQ(picture.at(60, 24, channel), 0);
    EXPECT_EQ(picture.at(2, 2, channel), 0);
  }
}

TEST(ShadedPictures, FootprintsOfLensesAreThoseOfTheirRays)
{
  const auto floor = ground(20).state();
  auto model = std::make_shared<Model>(*floor->instances[0].model);
  auto image = std::make_shared<Image>();
  image->width = image->height = 256;
  for (int i = 0; i < 256 * 256; ++i)
  {
    const auto value = std::uint8_t((i / 4 + i / 1024) % 2 ? 255 : 0);
    image->rgba.insert(image->rgba.end(), { value, value, value, 255 });
  }
  model->textures.push_back({ "checks", "", image });
  model->materials[0].texture = 0;
  const auto materials = std::make_shared<const std::vector<Material>>(model->materials);
  floor->instances[0].model = model;
  floor->instances[0].materials = materials;
  floor->lights.push_back(lightAt(LightKind::Directional, { 0, 1, 0 }));
  View view = fromAbove();
  const Picture straight = draw(floor, view);
  view.model = hideLinear(view.model);
  const Picture general = draw(floor, view);
  double sum = 0;
  for (std::size_t i = 0; i < straight.colors.rgb.size(); ++i)
  {
    sum += std::abs(double(straight.colors.rgb[i]) - double(general.colors.rgb[i]));
  }
  EXPECT_LT(sum / double(straight.colors.rgb.size()), 0.5 * step); // differences instead of the derivative
}

TEST(ShadedPictures, LightAboveWhiteIsKeptBehindGlassAndOnIt)
{
  SceneBuilder scene = ground();
  const auto glass = groundModel();
  glass->materials[0].opacity = 0.25;
  scene.add(glass, { Eigen::Matrix3d::Identity(), { 0, 0.5, 0 } });
  const auto state = scene.state();
  state->lights.push_back(lightAt(LightKind::Directional, { 0, 1, 0 }));
  state->lights[0].intensity = 4;
  const View view = fromAbove();
  const Picture picture = draw(state, view);
  EXPECT_EQ(picture.hits.at(80, 60).object, 2U);
  EXPECT_NEAR(picture.at(80, 60), 4, 0.01 * step);
}

TEST(ShadedPictures, AreTheSameForAnyThreadsAndAnyPieces)
{
  SceneBuilder scene = ground();
  const auto glass = matte(makeSphere({ { 0.5, 1, 0 }, 0.7, 12, 20 }));
  glass->materials[0].opacity = 0.4;
  scene.add(matte(makeSphere({ { -0.5, 0.5, 0 }, 1, 12, 20 }))).add(glass);
  const auto state = scene.state();
  LightState light = lightAt(LightKind::Point, { 2, 4, 3 });
  light.shadows = true;
  state->lights = { light, lightAt(LightKind::Head, { 0, 0, 0 }) };
  const View view = fromAbove();
  for (const int samples : { 1, 3 })
  {
    const Picture one = draw(state, view, samples, 1);
    EXPECT_EQ(draw(state, view, samples, 2).colors.rgb, one.colors.rgb);
    EXPECT_EQ(draw(state, view, samples, 5).colors.rgb, one.colors.rgb);
    ThreadPool pool(2);
    const auto source = makeRayPictures(pool);
    source->setScene(state, view);
    ColorBuffer piece;
    const PixelRect rect{ 33, 21, 70, 50 };
    source->renderColor(rect, samples, piece, nullptr);
    for (int y = 0; y < rect.height; ++y)
    {
      for (int i = 0; i < rect.width * 3; ++i)
      {
        ASSERT_EQ(piece.rgb[std::size_t(y) * rect.width * 3 + i],
          one.colors.rgb[(std::size_t(rect.y + y) * 160 + rect.x) * 3 + i])
          << samples << ' ' << y << ' ' << i;
      }
    }
  }
}

TEST(ShadedPictures, WhatIsLeftToBeDoneNeedsNoSource)
{
  const auto state = ground().state();
  state->lights.push_back(lightAt(LightKind::Point, { 1, 2, 0.5 }));
  const View view = fromAbove();
  const PixelRect whole{ 0, 0, 160, 120 };
  ThreadPool pool(2);
  auto source = makeRayPictures(pool);
  source->setScene(state, view);
  ColorBuffer late;
  VisibilityBuffer hits;
  const auto rest = source->drawColor(whole, 1, late, &hits);
  ColorBuffer other;
  source->setScene(SceneBuilder().state(), view);
  source->renderColor(whole, 1, other, nullptr);
  source.reset();
  rest();
  EXPECT_EQ(late.rgb, draw(state, view).colors.rgb);
}

TEST(ShadedPictures, LightAboveWhiteIsKept)
{
  const auto state = ground().state();
  LightState light = lightAt(LightKind::Directional, { 0, 1, 0 });
  light.intensity = 7;
  state->lights.push_back(light);
  EXPECT_NEAR(draw(state, fromAbove()).at(80, 60), 7, 1e-5);
  EXPECT_NEAR(draw(state, fromAbove(), 2).at(80, 60), 7, 1e-5);
}

TEST(ShadedPictures, FiltersKeepAnEvenBackgroundWhereNoRayIsBesideTheImage)
{
  const auto state = SceneBuilder().state();
  state->background = { 0.25, 0.5, 0.75 };
  View view = fromAbove();
  view.model = std::make_shared<Framed>(7, 5);
  for (int filter = 0; filter < 5; ++filter)
  {
    const ColorBuffer colors = filtered(state, view, PixelFilter(filter), 2);
    for (std::size_t i = 0; i < colors.rgb.size(); ++i)
    {
      ASSERT_NEAR(double(colors.rgb[i]), 0.25 * double(i % 3 + 1), 1e-6) << filter << ' ' << i;
    }
  }
}

TEST(ShadedPictures, FiltersOfAPanoramaGoOnBeyondItsSeamAndItsPoles)
{
  constexpr int width = 32;
  constexpr int height = 16;
  constexpr int samples = 2;
  int margin = 0;
  const std::vector<double> weights = pixelFilterWeights(PixelFilter::Lanczos, samples, margin);
  for (const int side : { 1, -1 }) // above the ground, and below it
  {
    const auto state = ground(1000).state();
    LightState light = lightAt(LightKind::Point, { 0.7, 2.0 * side, -0.4 });
    light.attenuation = { 1, 0, 0.2 };
    state->lights.push_back(light);
    const Eigen::Vector3d eye(0, side, 0);
    View view = fromAbove();
    view.model = makeCamera("equirectangular", { width, height, std::nullopt });
    view.camera_from_world = lookAtPose(eye, eye - Eigen::Vector3d::UnitZ(), { 0, 1, 0 });
    const ColorBuffer colors = filtered(state, view, PixelFilter::Lanczos, samples);
    const auto colorAt = [&](double x, double y)
    {
      const double right = (x / width - 0.5) * 2 * M_PI;
      const double below = (y / height - 0.5) * M_PI;
      const Eigen::Vector3d d(
        std::cos(below) * std::sin(right), std::sin(below), std::cos(below) * std::cos(right)); // also beyond the pole
      const Eigen::Vector3d turned = view.camera_from_world.rotation.transpose() * d;
      const double far = (eye - side * turned / turned.y() - light.position).norm();
      return 2 / far / (1 + 0.2 * far * far);
    };
    const int first = side > 0 ? height / 2 + margin + 1 : 0;
    for (int y = first; y < first + height / 2 - margin - 1; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        double expected = 0;
        for (std::size_t i = 0; i < weights.size() * weights.size(); ++i)
        {
          const std::size_t column = i % weights.size();
          const std::size_t row = i / weights.size();
          expected +=
            weights[column] * weights[row] *
            colorAt(x - margin + (double(column) + 0.5) / samples, y - margin + (double(row) + 0.5) / samples);
        }
        ASSERT_NEAR(double(colors.rgb[std::size_t(3) * (y * width + x)]), expected, 1e-5)
          << side << ' ' << x << ' ' << y;
      }
    }
  }
}
