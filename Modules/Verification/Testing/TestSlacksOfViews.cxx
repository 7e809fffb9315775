// SPDX-License-Identifier: BSD-3-Clause
// What the checks of two views leave open, as TestSlacks does for those of one.
#include "dgtkHandMade.h"

#include "dgtkCheck.h"
#include "dgtkSeenPoint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using Eigen::Vector2d;
using test::HandMade;
using test::triangleModel;
using test::wallModel;

/// What another camera has in its own plane projects by rounding alone.
TEST(Slacks, PointsInTheOtherCamerasPlane)
{
  const auto made = [](double behind)
  {
    auto pair = std::make_unique<HandMade>(
      std::vector<std::string>{ wallModel(2) }, std::vector<std::string>{}, std::vector<std::string>{ "a", "b" });
    pair->camera(1).t.z() = -2 - 2 * behind;
    pair->image("a/correspondence_b/000000.npy", 2, [](int, int, int) { return 3; });
    return pair;
  };
  EXPECT_EQ(made(1e-8)->verify("motion", "correspondence_b").bad, 48u);
  EXPECT_EQ(made(1e-10)->verify("motion", "correspondence_b").bad, 0u);
}

/// A pair is rectified up to rounding: otherwise there is no disparity.
TEST(Slacks, RectifiedPairs)
{
  using Change = void (*)(CameraRecord&, double);
  const Change changes[] = {
    [](CameraRecord& b, double by) { b.K(0, 0) += 100 * by; },
    [](CameraRecord& b, double by) { b.K(1, 2) += 100 * by; },
    [](CameraRecord& b, double by) { b.R(0, 1) += by; },
    [](CameraRecord& b, double by) { b.t.y() += 0.1 * by; },
    [](CameraRecord& b, double by) { b.t.z() += 0.1 * by; },
  };
  for (const Change change : changes)
  {
    for (const double by : { 1e-8, 1e-10 })
    {
      HandMade made({ wallModel(2) }, {}, { "a", "b" });
      made.camera(1).t.x() = -0.1;
      change(made.camera(1), by);
      made.image("a/disparity/000000.npy", 1, [](int, int, int) { return 5; });
      EXPECT_EQ(made.verify("epipolar", "").bad, by > 1e-9 ? 1u : 0u) << &change - changes;
    }
  }
}

/// At map coordinates rounding is more than a part of the displacement.
TEST(Slacks, RectifiedPairsFarFromTheOrigin)
{
  for (const double by : { 1e-7, 3e-9 })
  {
    HandMade made({ triangleModel({ -3e7, -3e7, 2 }, { 6e7, -3e7, 2 }, { 0, 6e7, 2 }) }, {}, { "a", "b" });
    made.camera(0).t.y() = 5e6;
    made.camera(1).t = { -0.1, 5e6 + by, 0 };
    made.image("a/disparity/000000.npy", 1, [](int, int, int) { return 5; });
    EXPECT_EQ(made.verify("epipolar", "").bad, by > 1e-8 ? 1u : 0u) << by;
  }
}

/// Where left and right have changed sides one frame later, there is no disparity of then.
TEST(Slacks, RectifiedPairsThatChangeSides)
{
  const std::string standing = R"(, "position": {"keys": [[0, [0, 0, 0]], [1, [0, 0, 0]]]})";
  for (const bool changed : { false, true })
  {
    HandMade made({ wallModel(2) }, { standing }, { "a", "b" });
    made.camera(1).t.x() = -0.1;
    made.later().t.x() = changed ? -0.1 : 0;
    CameraRecord& other = made.later();
    other.name = "b";
    other.t.x() = changed ? 0 : -0.1;
    made.image("a/disparity_forward/000000.npy", 1, [&](int, int, int) { return changed ? -5 : 5; });
    EXPECT_EQ(made.verify("epipolar", "").bad, changed ? 1u : 0u);
  }
}

/// The tolerance grows as rays become parallel; those that are say nothing of the depth.
TEST(Slacks, AnglesOfTriangulation)
{
  const auto rowAt = [](double angle, double off)
  {
    HandMade made({ wallModel(2) }, {}, { "a", "b" });
    made.camera(1).t.x() = -2 * angle;
    made.image("a/correspondence_b/000000.npy", 2,
      [&](int x, int y, int c) { return c == 0 ? x + 0.5 - 100 * angle + off : y + 0.5; });
    return made.verify("triangulation", "correspondence_b");
  };
  for (const double angle : { 1e-2, 1e-4, 1e-6 })
  {
    EXPECT_EQ(rowAt(angle, 1e-6).bad, 48u) << angle;
    EXPECT_EQ(rowAt(angle, 0).bad, 0u) << angle;
    EXPECT_EQ(rowAt(angle, 0).count, 48u) << angle;
  }
  EXPECT_EQ(rowAt(1e-10, 1e-6).count + rowAt(0, 0).count, 0u);
  EXPECT_EQ(rowAt(1e-10, 1e-6).skipped, 0u);
}

/// A camera "b1" is not "b" one frame later, but "b+1" is, where no camera has that name.
TEST(Slacks, NamesOfOtherViews)
{
  for (const std::string other : { "b1", "b+1", "b-1" })
  {
    HandMade made({ wallModel(2) }, {}, { "a", "b", other });
    made.camera(2).t.x() = -0.1;
    made.image(
      "a/correspondence_" + other + "/000000.npy", 2, [](int x, int y, int c) { return c == 0 ? x - 4.5 : y + 0.5; });
    EXPECT_EQ(made.verify("motion", "correspondence_" + other).count, 48u) << other;
    EXPECT_EQ(made.verify("motion", "correspondence_" + other).bad, 0u) << other;
  }
}

/// A wall that the camera nears, so that four pixels of the later picture come from a small area.
TEST(Slacks, SmallAreasOnTheWayBack)
{
  const auto badAt = [](double area)
  {
    const double larger = 1 / std::sqrt(area);
    HandMade made({ wallModel(2) });
    made.later().t.z() = -2 + 2 / larger;
    const auto flow = [](double factor)
    { return [factor](int x, int y, int c) { return (factor - 1) * (c == 0 ? x - 4 : y - 2); }; };
    made.image("a/flow_forward/000000.npy", 2,
      [&](int x, int y, int c) { return flow(larger)(x, y, c) + (x == 4 && y == 2 ? 1e-3 : 0); });
    made.image("a/flow_backward/000001.npy", 2, flow(1 / larger));
    return made.verify("forward-backward", "flow").bad;
  };
  EXPECT_EQ(badAt(0.2), 1u);
  EXPECT_EQ(badAt(0.002), 0u);
}

/// The roundings of float32 flows; that of 3.25 pixels is 2^-23.
TEST(Slacks, RoundingsOfTheLoop)
{
  const auto badAt = [](double roundings)
  {
    HandMade made({ wallModel(2) });
    made.later().t.x() = -0.065;
    const double off = roundings * std::pow(2.0, -23);
    made.image(
      "a/flow_forward/000000.npy", 2,
      [&](int x, int y, int c) { return c == 1 ? 0 : -3.25 + (x == 5 && y == 2 ? off : 0); }, true);
    made.image(
      "a/flow_backward/000001.npy", 2, [](int, int, int c) { return c == 1 ? 0 : 3.25; }, true);
    return made.verify("forward-backward", "flow").bad;
  };
  EXPECT_EQ(badAt(80), 1u);
  EXPECT_EQ(badAt(2), 0u);
}

/// A point of a wall at depth 2, with a second wall at another depth that covers the image from x on.
struct Walls
{
  Walls(double depth, double from, const std::vector<std::string>& more = {})
  {
    std::vector<std::string> models{ wallModel(2),
      triangleModel({ from, -90, depth }, { 90, 0, depth }, { from, 90, depth }) };
    models.insert(models.end(), more.begin(), more.end());
    this->Made = std::make_unique<HandMade>(models);
  }
  /// The class of a point that is seen at a pixel, and whether another may be as right.
  std::pair<int, bool> seen(const Vector2d& pixel, int said) const
  {
    const std::unique_ptr<Dataset> dataset = this->Made->dataset();
    const std::shared_ptr<const Sight> sight = dataset->sight(Eye(this->Made->camera(), nullptr), 0);
    SeenPoint point;
    point.hit = { 1, 0 };
    point.projects = true;
    point.pixel = pixel;
    point.x_in_camera = sight->eye().at(pixel, 2);
    return { classOf(*sight, point), isOpenClass(*sight, point, said) };
  }
  std::unique_ptr<HandMade> Made;
};

TEST(Slacks, WhatHidesAPoint)
{
  const Vector2d centre(4.5, 2.5);
  using Found = std::pair<int, bool>;
  EXPECT_EQ(Walls(2 * (1 - 1e-8), -90).seen(centre, OutsideSeen).first, OtherObjectSeen);
  EXPECT_EQ(Walls(2 * (1 - 1e-10), -90).seen(centre, OutsideSeen).first, VisibleSeen);
  // Parts of the depth, and of the direction: of 100 pixels.
  EXPECT_EQ(Walls(2 * (1 - 1e-5), -90).seen(centre, VisibleSeen), Found(OtherObjectSeen, true));
  EXPECT_EQ(Walls(2 * (1 - 1e-3), -90).seen(centre, VisibleSeen), Found(OtherObjectSeen, false));
  EXPECT_EQ(Walls(1, -1e-5).seen(centre, VisibleSeen), Found(OtherObjectSeen, true));
  EXPECT_EQ(Walls(1, -1e-3).seen(centre, VisibleSeen), Found(OtherObjectSeen, false));
  EXPECT_EQ(Walls(1, 1e-5).seen(centre, OtherObjectSeen), Found(VisibleSeen, true));
  EXPECT_EQ(Walls(1, 1e-3).seen(centre, OtherObjectSeen), Found(VisibleSeen, false));
  EXPECT_EQ(Walls(1, -90).seen(centre, OutsideSeen), Found(OtherObjectSeen, false)) << "well inside";
}

/// Two walls that hide all of the image, one behind the other, and end in one plane with the camera.
TEST(Slacks, WaysWithoutWidth)
{
  const auto seenAt = [](double overlap)
  {
    const std::string left = triangleModel({ overlap, -90, 1.5 }, { overlap, 90, 1.5 }, { -90, 0, 1.5 });
    return Walls(1, 0, { left }).seen({ 4.5, 2.5 }, VisibleSeen);
  };
  using Found = std::pair<int, bool>;
  EXPECT_EQ(seenAt(0), Found(OtherObjectSeen, true));
  EXPECT_EQ(seenAt(1e-6), Found(OtherObjectSeen, false));
}

TEST(Slacks, BordersOfWhatIsSeen)
{
  Walls walls(9, -90);
  for (const Vector2d& at : { Vector2d(0, 3), Vector2d(8, 3), Vector2d(3, 0), Vector2d(3, 6) })
  {
    const Vector2d inwards = (Vector2d(4, 3) - at).normalized();
    EXPECT_TRUE(walls.seen(at + 1e-7 * inwards, OutsideSeen).second) << at.transpose();
    EXPECT_FALSE(walls.seen(at + 1e-5 * inwards, OutsideSeen).second) << at.transpose();
    EXPECT_EQ(walls.seen(at - 1e-7 * inwards, VisibleSeen).first, OutsideSeen) << at.transpose();
  }
  for (double CameraRecord::*limit : { &CameraRecord::near, &CameraRecord::far })
  {
    Walls limited(9, -90);
    limited.Made->camera().*limit = 2 * (1 + 1e-10);
    EXPECT_TRUE(limited.seen({ 4.5, 2.5 }, OutsideSeen).second);
    limited.Made->camera().*limit = 2 * (1 + 1e-8);
    EXPECT_FALSE(limited.seen({ 4.5, 2.5 }, OutsideSeen).second);
  }
}
} // namespace
