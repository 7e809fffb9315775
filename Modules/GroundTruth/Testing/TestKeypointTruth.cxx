// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeypointTruth.h"

#include "dgtkCameraEntry.h"
#include "dgtkInstantSource.h"
#include "dgtkRaySource.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

using namespace dgtk;

namespace
{
constexpr double hiding = 1; ///< what stands up to so far in front of a point does not hide it

/// A camera at the origin that looks along z, y down: 40 x 40 pixels, 45 degrees to either side.
View straightView()
{
  View view;
  view.model = makePinholeFromFov(40, 40, 90, 0);
  view.near = 0.5;
  view.far = 10;
  return view;
}

/// Nothing moves; object 1 is there at some frames.
class Appearing : public InstantSource
{
public:
  Appearing(std::shared_ptr<const SceneState> state, std::function<bool(double)> isThere)
    : State(std::move(state))
    , IsThere(std::move(isThere))
  {
  }
  double frame() const override { return 7; }
  Instant at(double) const override { throw std::logic_error("at"); }
  Instance instanceAt(double, std::uint32_t id) const override { return this->State->instances[id - 1]; }
  const std::vector<Motion>& motions() const override { throw std::logic_error("motions"); }
  Rigid3 poseAt(double) const override { return {}; }
  Affine3 placeAt(double, std::uint32_t) const override { throw std::logic_error("placeAt"); }
  bool isVisibleAt(double frame, std::uint32_t) const override { return this->IsThere(frame); }
  Point pointAt(double, std::uint32_t, std::uint32_t, const Eigen::Vector2d&) const override
  {
    throw std::logic_error("pointAt");
  }

private:
  std::shared_ptr<const SceneState> State;
  std::function<bool(double)> IsThere;
};

/// A far small object with a keypoint, and a wall across the view.
class Keypoints : public testing::Test
{
protected:
  SeenKeypoint see(const Eigen::Vector3d& x, double wall, bool ofWall = false)
  {
    const auto state =
      test::SceneBuilder()
        .add(test::makeQuad({ { 50, 50, 50 }, { 1, 0, 0 }, { 0, 1, 0 } }))
        .add(test::makeQuad({ { -50, -50, 0 }, { 100, 0, 0 }, { 0, 100, 0 } }), test::placement({ 0, 0, wall }))
        .state();
    const std::uint32_t id = ofWall ? 2 : 1;
    Instance& instance = state->instances[id - 1];
    instance.keypoints = { { "tip", ofWall ? Eigen::Vector3d(x - Eigen::Vector3d(0, 0, wall)) : x } };
    instance.visible = this->Visible;
    this->V.instants = this->IsThere ? std::make_shared<Appearing>(state, this->IsThere) : nullptr;
    const auto query = makeOcclusionQuery();
    query->setScene(state);
    return seeKeypoints(*state, id, this->V, *query, hiding).at(0);
  }

  View V = straightView();
  bool Visible = true;
  std::function<bool(double)> IsThere;
};
} // namespace

// At (3, 0, 4) the ray is 1.25 long for each unit of depth.
TEST_F(Keypoints, AreHiddenByWhatStandsFartherInFrontOfThemAlongTheRay)
{
  const Eigen::Vector3d x(3, 0, 4);
  EXPECT_EQ(this->see(x, 5).visibility, VisibilityClass::Visible) << "the wall is behind";
  EXPECT_EQ(this->see(x, 3.25).visibility, VisibilityClass::Visible) << "the wall is 0.94 in front";
  EXPECT_EQ(this->see(x, 3.1).visibility, VisibilityClass::OccludedByOther) << "the wall is 1.12 in front";
  EXPECT_EQ(this->see(x, 3.1, true).visibility, VisibilityClass::OccludedByOwn);
  EXPECT_EQ(this->see(x, 0.4).visibility, VisibilityClass::Visible) << "the wall is nearer than the near plane";
  EXPECT_EQ(this->see({ 0, 0, 1.25 }, 0.6).visibility, VisibilityClass::Visible) << "no more than 0.75 behind near";
  const SeenKeypoint seen = this->see(x, 5);
  EXPECT_EQ(seen.x_in_camera, x);
  ASSERT_TRUE(seen.pixel);
  EXPECT_LE((*seen.pixel - Eigen::Vector2d(35, 20)).norm(), 1e-12);
}

TEST_F(Keypoints, OutsideTheImageOrBehindAreOfThoseClasses)
{
  SeenKeypoint seen = this->see({ 5, 0, 4 }, 20);
  EXPECT_EQ(seen.visibility, VisibilityClass::Outside);
  ASSERT_TRUE(seen.pixel);
  EXPECT_LE((*seen.pixel - Eigen::Vector2d(45, 20)).norm(), 1e-12);
  EXPECT_EQ(this->see({ 0, 0, 10.5 }, 20).visibility, VisibilityClass::Outside) << "beyond far";
  EXPECT_EQ(this->see({ 0, 0, 0.25 }, 20).visibility, VisibilityClass::Outside) << "before near";
  EXPECT_EQ(this->see({ 0, 0, 10 }, 20).visibility, VisibilityClass::Visible) << "at far";
  seen = this->see({ 1, 2, -3 }, 20);
  EXPECT_EQ(seen.visibility, VisibilityClass::Behind);
  EXPECT_FALSE(seen.pixel);
  EXPECT_EQ(seen.x_in_camera, Eigen::Vector3d(1, 2, -3));
  this->Visible = false;
  EXPECT_EQ(this->see({ 0, 0, 4 }, 20).visibility, VisibilityClass::NoSurface);
}

// Rows from the top to the bottom are seen from half a frame before the picture's own, 7, to half a frame after it.
TEST_F(Keypoints, OfARollingShutterAreThereAtTheTimeOfTheirRow)
{
  CameraParameters of = this->V.model->parameters();
  of.rollingShutter = { 1, RollingShutter::Direction::Down };
  this->V.model = makeCamera("pinhole", of);
  const Eigen::Vector3d above(5, -2, 4);
  const Eigen::Vector3d below(5, 2, 4);
  const Eigen::Vector3d behind(0, 0, -4);
  this->IsThere = [](double frame) { return frame > 7; };
  for (const bool now : { true, false })
  {
    this->Visible = now;
    EXPECT_EQ(this->see(above, 20).visibility, VisibilityClass::NoSurface) << now;
    EXPECT_EQ(this->see(below, 20).visibility, VisibilityClass::Outside) << now;
    // what is never seen has the picture's own time
    EXPECT_EQ(this->see(behind, 20).visibility, now ? VisibilityClass::Behind : VisibilityClass::NoSurface);
  }
}
