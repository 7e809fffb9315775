// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadowNotes.h"
#include "dgtkTestScene.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

// Shadows of boxes on the plane y = 0 against where geometry puts them.

using namespace dgtk;
using namespace dgtk::test;

namespace
{

struct Block
{
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};
const Block head{ { -1, 0, -1 }, { 1, 2, 1 } };

std::shared_ptr<const Model> modelOf(const Block& block)
{
  ModelBuilder model;
  model.part(matte({ 1, 1, 1 }));
  model.box(block.low, block.high);
  return model.finish();
}

std::shared_ptr<SceneState> onGround(double half, const LightState& light, const std::vector<Block>& blocks)
{
  ModelBuilder ground;
  ground.part(matte({ 1, 1, 1 }));
  ground.quad({ -half, 0, half }, { half, 0, half }, { half, 0, -half }, { -half, 0, -half });
  auto state = std::make_shared<SceneState>();
  state->instances.push_back(instanceOf(ground.finish()));
  for (const Block& block : blocks)
  {
    state->instances.push_back(instanceOf(modelOf(block)));
  }
  state->lights.push_back(light);
  return state;
}

LightState lamp(LightKind kind, const Eigen::Vector3d& position)
{
  LightState light;
  light.name = "lamp";
  light.kind = kind;
  light.position = position;
  light.exponent = 0;
  light.coneAngle = 55;
  light.shadows = true;
  return light;
}
LightState sun() { return lamp(LightKind::Directional, { -6, 5, 2 }); }

View camera(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double far = 2000)
{
  return viewOf(makePinholeFromFov(320, 240, 45, 0), eye, target, 0.1, far);
}

/// Whether the segment from x towards the light, at most to its place, meets a block.
bool blocked(const LightState& light, const Eigen::Vector3d& x, const std::vector<Block>& blocks)
{
  const bool parallel = light.kind == LightKind::Directional;
  const Eigen::Vector3d way = parallel ? Eigen::Vector3d(light.position - light.target) : light.position - x;
  return std::any_of(blocks.begin(), blocks.end(),
    [&](const Block& block)
    {
      double from = 1e-9;
      double to = parallel ? 1e300 : 1;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double a = (block.low[axis] - x[axis]) / way[axis];
        const double b = (block.high[axis] - x[axis]) / way[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
      }
      return from < to;
    });
}

bool inCone(const LightState& light, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d axis = (light.target - light.position).normalized();
  return light.kind != LightKind::Spot ||
         axis.dot((x - light.position).normalized()) > std::cos(light.coneAngle * 3.14159265358979323846 / 180);
}

struct Count
{
  int dark = 0;  ///< pixels of the ground that should be in shadow
  int light = 0; ///< and others
  int wrong = 0;
};

/// Compares each pixel of the ground that is not within `rim` pixels of the border of a shadow.
Count compare(const SceneState& state, const View& view, const std::vector<Block>& blocks, const ColorBuffer& colors,
  const VisibilityBuffer& hits, int rim)
{
  const int width = view.model->width();
  const int height = view.model->height();
  const auto at = [width](int x, int y) { return std::size_t(y) * width + x; };
  std::vector<int> expected(at(0, height), 0); // 1: dark, 2: light, 0: neither, not the ground
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const CameraRay ray = view.model->rayThrough({ x + 0.5, y + 0.5 });
      const Rigid3& pose = view.camera_from_world;
      const Eigen::Vector3d origin = pose.rotation.transpose() * (ray.origin - pose.translation);
      const Eigen::Vector3d direction = pose.rotation.transpose() * ray.direction;
      const Eigen::Vector3d ground = origin - direction * (origin.y() / direction.y());
      const bool shown = hits.hits[at(x, y)].object == 1 && inCone(state.lights[0], ground);
      expected[at(x, y)] = !shown ? 0 : blocked(state.lights[0], ground, blocks) ? 1 : 2;
    }
  }
  Count count;
  for (int y = rim; y + rim < height; ++y)
  {
    for (int x = rim; x + rim < width; ++x)
    {
      const int own = expected[at(x, y)];
      bool clear = own != 0;
      for (int dy = -rim; dy <= rim; ++dy)
      {
        for (int dx = -rim; dx <= rim; ++dx)
        {
          clear = clear && expected[at(x + dx, y + dy)] == own;
        }
      }
      if (clear)
      {
        const double value = colorAt(colors, x, y).x();
        ++(own == 1 ? count.dark : count.light);
        count.wrong += own == 1 ? value > 0.01 : value < 0.03;
      }
    }
  }
  return count;
}

Count countWrong(
  const std::shared_ptr<const SceneState>& state, const View& view, const std::vector<Block>& blocks, int rim = 2)
{
  VisibilityBuffer hits;
  const ColorBuffer colors = renderColor(state, view, 1, &hits);
  savePicture(::testing::UnitTest::GetInstance()->current_test_info()->name(), colors);
  return compare(*state, view, blocks, colors, hits, rim);
}

} // namespace

TEST(Shadows, OfAHeadOnAKilometreOfGround)
{
  const View view = camera({ 4, 1.7, 5 }, { 0.5, 1, 0 });
  const Count count = countWrong(onGround(500, sun(), { head }), view, { head });
  EXPECT_GT(count.dark, 1000);
  EXPECT_GT(count.light, 20000);
  EXPECT_EQ(count.wrong, 0);
}

TEST(Shadows, NearAndFarInOnePicture)
{
  std::vector<Block> blocks;
  for (const double z : { 0.0, -15.0, -60.0, -250.0 })
  {
    const double size = 1 - z / 15;
    blocks.push_back({ { -size, 0, z - size }, { size, 2 * size, z + size } });
  }
  for (const double far : { 400.0, 2000.0 })
  {
    const Count count = countWrong(onGround(1000, sun(), blocks), camera({ 9, 4, 9 }, { 0.2, 2, -10 }, far), blocks);
    EXPECT_GT(count.dark, 900);
    EXPECT_GT(count.light, 10000);
    EXPECT_EQ(count.wrong, 0);
  }
}

TEST(Shadows, InAValleyBelowTheCamera)
{
  // beside the rock's edge, which the nearest map holds, the light goes on down to the valley
  const std::vector<Block> blocks{ { { -40, 0, 0 }, { 40, 60, 80 } }, { { -2, 0, -52 }, { 2, 20, -48 } } };
  for (const double aside : { -2.0, 0.0, 2.0 })
  {
    const LightState light = lamp(LightKind::Directional, { aside, 5, 3 });
    const View view = camera({ 0, 62, 0.5 }, { -12 * aside, 0, -39 });
    const Count count = countWrong(onGround(500, light, blocks), view, blocks);
    EXPECT_GT(count.dark, 200);
    EXPECT_GT(count.light, 5000);
    EXPECT_EQ(count.wrong, 0);
  }
}

TEST(Shadows, RemainWhenSomethingIsParkedFarAway)
{
  const View view = camera({ 4, 3, 5 }, { 0.5, 1, 0 });
  using Kind = LightKind;
  for (const LightState& light : { sun(), lamp(Kind::Spot, { -3, 5, 1 }), lamp(Kind::Point, { -3, 4, 1 }) })
  {
    for (const double away : { 1e3, 1e6 })
    {
      const auto state = onGround(20, light, { head });
      state->instances.push_back(instanceOf(modelOf(head), { 0, 0, away }));
      // a map from a place has larger texels far from it, and shadows that begin a few of them too late
      const Count count = countWrong(state, view, { head }, light.kind == Kind::Directional ? 2 : 6);
      EXPECT_GT(count.dark, 1000) << int(light.kind) << ' ' << away;
      EXPECT_GT(count.light, 10000) << int(light.kind) << ' ' << away;
      EXPECT_EQ(count.wrong, 0) << int(light.kind) << ' ' << away;
    }
  }
}

TEST(Shadows, OfWhatTheCameraDoesNotSee)
{
  const Block tower{ { -101, 90, -1 }, { -99, 92, 1 } }; // its shadow falls 108 to 112 along x, 36 down z from it
  const View view = camera({ 9.2, 20, -36 }, { 9.2, 0, -36.01 });
  const Count count = countWrong(onGround(500, sun(), { tower }), view, { tower });
  EXPECT_GT(count.dark, 1000);
  EXPECT_GT(count.light, 20000);
  EXPECT_EQ(count.wrong, 0);
}

TEST(Shadows, UnderAParallelProjection)
{
  const View view = viewOf(makeOrthographic(320, 240, 8, 0), { 40, 30, 50 }, { 1, 0, 0 }, 0.1, 2000);
  const Count count = countWrong(onGround(500, sun(), { head }), view, { head });
  EXPECT_GT(count.dark, 1000);
  EXPECT_GT(count.light, 20000);
  EXPECT_EQ(count.wrong, 0);
}

TEST(Shadows, AreTheSameInEveryPartOfThePicture)
{
  const auto state = onGround(500, sun(), { head });
  const View view = camera({ 4, 1.7, 5 }, { 0.5, 1, 0 });
  const ColorBuffer all = renderColor(state, view);
  View other = view;
  other.camera_from_world.translation += Eigen::Vector3d(0, 0, 50);
  int differing = 0;
  for (int y = 0; y < 240; y += 120)
  {
    for (int x = 0; x < 320; x += 160)
    {
      // after something else was drawn with the same scene
      renderColor(state, other);
      source().setScene(state, view);
      ColorBuffer part;
      source().renderColor({ x, y, 160, 120 }, 1, part, nullptr);
      for (int j = 0; j < 120; ++j)
      {
        for (int i = 0; i < 160; ++i)
        {
          const std::size_t pixel = std::size_t(j) * 160 + i;
          differing += std::abs(part.rgb[3 * pixel] - colorAt(all, x + i, y + j).x()) > 1e-3;
        }
      }
    }
  }
  EXPECT_EQ(differing, 0);
  EXPECT_EQ(renderColor(state, view).rgb, all.rgb);
  View turned = view;
  turned.camera_from_world.rotation =
    Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * view.camera_from_world.rotation;
  for (const View& next : { other, turned })
  {
    renderColor(state, view);
    const ColorBuffer kept = renderColor(state, next);
    EXPECT_EQ(renderColor(std::make_shared<SceneState>(*state), next).rgb, kept.rgb);
  }
}

TEST(Shadows, MapsThatAreTooCoarseAreNamed)
{
  const View view = camera({ 4, 1.7, 5 }, { 0.5, 1, 0 });
  using Kind = LightKind;
  for (const LightState& light : { sun(), lamp(Kind::Spot, { -3, 5, 1 }), lamp(Kind::Point, { -3, 5, 1 }) })
  {
    const auto state = onGround(500, light, { head });
    EXPECT_TRUE(coarseShadows(*state, view).empty()) << int(light.kind);
    state->lights[0].shadowSize = 64;
    const std::vector<CoarseShadow> coarse = coarseShadows(*state, view);
    ASSERT_EQ(coarse.size(), 1u) << int(light.kind);
    EXPECT_EQ(coarse[0].light, 0u);
    EXPECT_GT(coarse[0].pixels, 8);
    EXPECT_LT(coarse[0].pixels, 1000);
    state->lights[0].shadows = false;
    EXPECT_TRUE(coarseShadows(*state, view).empty());
  }
}

TEST(Shadows, MapsAreCoarseWhereLightIsSeen)
{
  const View low = camera({ 4, 0.5, 5 }, { 0.5, 1, 0 });
  LightState narrow = lamp(LightKind::Spot, { -3, 5, 1 });
  narrow.shadowSize = 16;
  EXPECT_EQ(coarseShadows(*onGround(500, narrow, { head }), low).size(), 1u);
  narrow.coneAngle = 5; // a spot of a metre, far from the camera
  EXPECT_TRUE(coarseShadows(*onGround(500, narrow, { head }), low).empty());
  LightState weak = lamp(LightKind::Point, { -3, 5, 1 });
  weak.shadowSize = 16;
  EXPECT_EQ(coarseShadows(*onGround(500, weak, { head }), low).size(), 1u);
  weak.attenuation = { 1, 0, 100 };
  EXPECT_TRUE(coarseShadows(*onGround(500, weak, { head }), low).empty());
}

TEST(Shadows, MapsAreCoarseForWhatIsNearAndFar)
{
  LightState light = sun();
  light.shadowSize = 16;
  const View view = viewOf(makePinholeFromFov(320, 240, 45, 0), { 0, 4, 10 }, { 0, 4, 0 }, 3, 30);
  const auto pixels = [&view, &light](double ground, const std::vector<Block>& blocks)
  { return coarseShadows(*onGround(ground, light, blocks), view).at(0).pixels; };
  // what is nearer than the near plane or beyond the far plane is not seen
  const std::vector<Block> unseen{ head, { { -1, 2, 8 }, { 1, 5, 12 } }, { { -20, -20, -90 }, { 20, 20, -50 } } };
  EXPECT_DOUBLE_EQ(pixels(0.01, unseen), pixels(0.01, { head }));
  // a speck close to the camera takes a map, the first, which is less coarse than the others
  const std::vector<Block> speck{ head, { { 0, 4, 6.4 }, { 0.02, 4.02, 6.42 } } };
  EXPECT_GE(pixels(500, speck), pixels(500, { head }));
}

TEST(Shadows, MapsAreAsLargeAsWhatIsSeen)
{
  // The image is 8 x 6 units; 1/32 of its width is left at each side, and 4 of the 32 texels, and one for its place.
  LightState light = lamp(LightKind::Directional, { 0, 1, 0 });
  light.shadowSize = 32;
  const View view = viewOf(makeOrthographic(320, 240, 6, 0), { 0, 9, 0.001 }, { 0, 0, 0 }, 0.1, 100);
  const double least = 8 * 1.0625 / (1 - 9.0 / 32) / 32 * 240 / 6;
  const double pixels = coarseShadows(*onGround(500, light, {}), view).at(0).pixels;
  EXPECT_GT(pixels, 0.999 * least);
  EXPECT_LT(pixels, 1.001 * least * std::exp2(1 / 8.0));
}
