// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkRaySource.h"
#include "dgtkSyntheticScene.h"
#include "dgtkThreadPool.h"
#include "dgtkWholeObjects.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
std::vector<ObjectPixels> around(const std::shared_ptr<const SceneState>& state, const View& view, int threads = 1)
{
  ThreadPool pool(threads);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  query->setScene(state);
  return objectsAround(state, view, *query, *source, pool);
}

using Box = std::array<int, 4>;
Box boxOf(const ObjectPixels& pixels) { return { pixels.x0, pixels.y0, pixels.x1, pixels.y1 }; }

/// All surfaces along the ray of every pixel of the canvas.
std::vector<ObjectPixels> byAllRays(const std::shared_ptr<const SceneState>& state, const View& view)
{
  const int width = view.model->width();
  const int height = view.model->height();
  const auto query = makeOcclusionQuery();
  query->setScene(state);
  std::vector<ObjectPixels> found(state->instances.size());
  std::vector<Hit> hits;
  for (int y = -height; y < 2 * height; ++y)
  {
    for (int x = -width; x < 2 * width; ++x)
    {
      if (x >= 0 && x < width && y >= 0 && y < height)
      {
        continue;
      }
      query->allHits(view, { x + 0.5, y + 0.5 }, hits);
      std::set<std::uint32_t> objects;
      for (const Hit& hit : hits)
      {
        objects.insert(hit.object);
      }
      for (const std::uint32_t object : objects)
      {
        found[object - 1].add(x, y, false);
      }
    }
  }
  return found;
}

void expectSame(const std::vector<ObjectPixels>& found, const std::vector<ObjectPixels>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found[i].count, expected[i].count) << "object " << i + 1;
    if (expected[i].count > 0)
    {
      EXPECT_EQ(boxOf(found[i]), boxOf(expected[i])) << "object " << i + 1;
    }
  }
}

/// A square of the plane z = 0 between two pixels of the picture, as far as they are.
std::shared_ptr<Model> squareBetween(const View& view, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  const auto at = [&](const Eigen::Vector2d& pixel)
  {
    const CameraRay ray = view.model->rayThrough(pixel);
    const Eigen::Vector3d origin = view.camera_from_world.inverse() * ray.origin;
    const Eigen::Vector3d direction = view.camera_from_world.rotation.transpose() * ray.direction;
    return Eigen::Vector3d(origin - origin.z() / direction.z() * direction);
  };
  const Eigen::Vector3d corner = at(from);
  return makeQuad({ corner, at({ to.x(), from.y() }) - corner, at({ from.x(), to.y() }) - corner });
}
} // namespace

TEST(ObjectsAround, SquaresBetweenKnownPixels)
{
  const View view = makeView(); // 64 x 48
  const auto state = SceneBuilder()
                       .add(squareBetween(view, { 50.2, 10.2 }, { 90.4, 30.4 }))   // over the right border
                       .add(squareBetween(view, { 10.2, 10.2 }, { 30.4, 30.4 }))   // inside
                       .add(squareBetween(view, { -20.2, -30.2 }, { -9.8, -9.8 })) // beside a corner
                       .add(squareBetween(view, { 120.2, 10.2 }, { 140.4, 30.4 })) // over the canvas's border
                       .add(squareBetween(view, { 130.2, 10.2 }, { 140.4, 30.4 })) // beyond it
                       .add(squareBetween(view, { -900, -900 }, { 900, 900 }))
                       .state();
  const std::vector<ObjectPixels> found = around(state, view);
  ASSERT_EQ(found.size(), 6U);
  EXPECT_EQ(found[0].count, 26U * 20U); // columns 64 to 89, rows 10 to 29
  EXPECT_EQ(boxOf(found[0]), (Box{ 64, 10, 90, 30 }));
  EXPECT_EQ(found[1].count, 0U);
  EXPECT_EQ(found[2].count, 10U * 20U);
  EXPECT_EQ(boxOf(found[2]), (Box{ -20, -30, -10, -10 }));
  EXPECT_EQ(found[3].count, 8U * 20U);
  EXPECT_EQ(boxOf(found[3]), (Box{ 120, 10, 128, 30 }));
  EXPECT_EQ(found[4].count, 0U);
  EXPECT_EQ(found[5].count, 8U * 64U * 48U);
  EXPECT_EQ(boxOf(found[5]), (Box{ -64, -48, 128, 96 }));
}

TEST(ObjectsAround, WhatIsHiddenCountsAndWhatIsBeyondNearAndFarDoesNot)
{
  View view = makeView(); // from z = 5
  view.near = 1;
  view.far = 20;
  const QuadOptions wall{ { -90, -90, 0 }, { 180, 0, 0 }, { 0, 180, 0 } };
  const auto state = SceneBuilder()
                       .add(makeQuad(wall))
                       .add(makeQuad(wall), placement({ 0, 0, -3 }))
                       .add(makeQuad(wall), placement({ 0, 0, -15.5 }))
                       .add(makeQuad(wall), placement({ 0, 0, 4.5 }))
                       .add(makeQuad(wall), placement({ 0, 0, 9 }))
                       .state();
  const std::vector<ObjectPixels> found = around(state, view);
  const std::uint64_t all = 8U * 64U * 48U;
  EXPECT_EQ(found[0].count, all);
  EXPECT_EQ(found[1].count, all);
  for (int i = 2; i < 5; ++i)
  {
    EXPECT_EQ(found[std::size_t(i)].count, 0U) << i;
  }
}

// Floors that reach behind the camera, balls that touch the border, several behind one another.
TEST(ObjectsAround, EqualsAllRaysUnderEveryKindOfCamera)
{
  SphereOptions ball;
  ball.radius = 1.3;
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -40, -1, -40 }, { 80, 0, 0 }, { 0, 0, 80 } }))
                       .add(makeSphere(ball), placement({ 2.8, 0.3, 1 }))
                       .add(makeSphere(ball), placement({ 2.2, 0.6, -2 }))
                       .add(makeBox(), placement({ -4.03, 2.07, 1.01 }))
                       .add(makeBox(), placement({ 0, 0, 9 }))
                       .state();
  ViewOptions above;
  above.eye = { 0.1, 1.5, 5 };
  const View view = makeView(above);
  for (int kind = 0; kind < 4; ++kind)
  {
    const std::shared_ptr<const CameraModel> models[] = { view.model, makeOrthographic(64, 48, 4, 0),
      makeEquidistant(64, 48, 30), makeEquidistant(64, 48, 10) };
    View other = view;
    other.model = models[kind];
    const std::vector<ObjectPixels> found = around(state, other);
    expectSame(found, byAllRays(state, other));
    expectSame(found, around(state, other, 3));
    EXPECT_GT(found[0].count, 0U) << kind;
    EXPECT_EQ(found[1].count > 0, kind != 2) << kind; // the whole ball is in that picture
  }
}

namespace
{
/// A pinhole that has rays in a circle around the middle of its image only.
class Porthole final : public CameraModel
{
public:
  Porthole(std::shared_ptr<const CameraModel> model, double radius)
    : CameraModel(model->width(), model->height())
    , Model(std::move(model))
    , Radius(radius)
  {
  }
  std::string name() const override { return "porthole"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d middle(this->width() / 2.0, this->height() / 2.0);
    CameraRay ray = this->Model->rayThrough(pixel);
    ray.direction = (pixel - middle).norm() < this->Radius ? ray.direction.normalized() : Eigen::Vector3d::Zero();
    return ray;
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    return this->Model->project(x, pixel);
  }

private:
  std::shared_ptr<const CameraModel> Model;
  double Radius;
};
} // namespace

TEST(ObjectsAround, OnlyPixelsWithARayCount)
{
  View view = makeView();
  const double radius = 40.3;
  view.model = std::make_shared<Porthole>(view.model, radius);
  const auto state = SceneBuilder().add(makeQuad({ { -90, -90, 0 }, { 180, 0, 0 }, { 0, 180, 0 } })).state();
  std::uint64_t expected = 0;
  for (int y = -48; y < 96; ++y)
  {
    for (int x = -64; x < 128; ++x)
    {
      const bool inside = x >= 0 && x < 64 && y >= 0 && y < 48;
      expected += !inside && std::hypot(x + 0.5 - 32, y + 0.5 - 24) < radius ? 1 : 0;
    }
  }
  EXPECT_GT(expected, 500U);
  EXPECT_EQ(around(state, view)[0].count, expected);
}

// All directions are in the image: what is around it would be seen twice.
TEST(ObjectsAround, NothingIsAroundAPanorama)
{
  View view = makeView();
  view.model = makeCamera("equirectangular", { 64, 48, std::nullopt });
  const auto state = SceneBuilder().add(makeBox({ { -9, -9, -9 }, { 9, 9, 9 } })).state();
  EXPECT_EQ(around(state, view)[0].count, 0U);
}
