// SPDX-License-Identifier: BSD-3-Clause
// What hides points from a camera with a rolling shutter, where some of it moves.
#include "dgtkRaySource.h"

#include "dgtkCameraEntry.h"
#include "dgtkInstantSource.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

/// The vertices of the last object are moved, by an offset at each frame; the rest stands still, the camera at the
/// origin.
class LastMoves final : public InstantSource
{
public:
  LastMoves(std::shared_ptr<const SceneState> state, std::function<Eigen::Vector3d(double)> offset)
    : State(std::move(state))
    , Offset(std::move(offset))
    , Motions(this->State->instances.size(), Motion::None)
  {
    this->Motions.back() = Motion::Any;
  }
  double frame() const override { return 7; }
  Instant at(double frame) const override
  {
    auto state = std::make_shared<SceneState>(*this->State);
    state->instances.back() = this->instanceAt(frame, std::uint32_t(state->instances.size()));
    return { state, {} };
  }
  Instance instanceAt(double frame, std::uint32_t object) const override
  {
    Instance instance = this->State->instances[object - 1];
    if (object == this->State->instances.size())
    {
      auto geometry = std::make_shared<Geometry>(*instance.geometry);
      for (Eigen::Vector3d& position : geometry->positions)
      {
        position += this->Offset(frame);
      }
      instance.geometry = geometry;
    }
    return instance;
  }
  const std::vector<Motion>& motions() const override { return this->Motions; }
  Rigid3 poseAt(double) const override { return {}; }
  Affine3 placeAt(double, std::uint32_t object) const override
  {
    return this->State->instances[object - 1].world_from_object;
  }
  bool isVisibleAt(double, std::uint32_t) const override { return true; }
  Point pointAt(double, std::uint32_t, std::uint32_t, const Eigen::Vector2d&) const override
  {
    throw std::logic_error("pointAt");
  }

private:
  std::shared_ptr<const SceneState> State;
  std::function<Eigen::Vector3d(double)> Offset;
  std::vector<Motion> Motions;
};

/// The object that hides a point at a frame: of a camera that looks along z, 45 degrees to either side, and is open
/// from half a frame before its own, 7, to half a frame after it.
std::uint32_t hiddenBy(const std::shared_ptr<const SceneState>& state,
  const std::function<Eigen::Vector3d(double)>& offset, double frame, const Eigen::Vector3d& x_in_world)
{
  CameraParameters of{ 40, 40, std::nullopt, { { "fovY", { 90 } } } };
  of.rollingShutter = { 1, RollingShutter::Direction::Down };
  View view;
  view.model = makeCamera("pinhole", of);
  view.near = 0.5;
  view.far = 100;
  view.instants = std::make_shared<LastMoves>(state, offset);
  const auto query = makeOcclusionQuery();
  query->setScene(state);
  const Hit target;
  Hit found;
  query->occludersAt(view, &frame, &x_in_world, &target, 1, &found);
  return found.object;
}
} // namespace

// A box that stands from 2 to 8 hides its own back; the pane is before it, within it or behind it.
TEST(MovingOccluders, TheNearestHidesWhetherItMovesOrNot)
{
  const auto state = SceneBuilder()
                       .add(makeBox({ { -9, -9, 2 }, { 9, 9, 8 } }))
                       .add(makeQuad({ { -9, -9, 0 }, { 18, 0, 0 }, { 0, 18, 0 } }))
                       .state();
  for (const auto& [depth, hider] : { std::pair(1.0, 2u), std::pair(5.0, 1u), std::pair(9.0, 1u) })
  {
    const auto offset = [z = depth](double frame) { return Eigen::Vector3d(0.1 * frame, 0, z); };
    EXPECT_EQ(hiddenBy(state, offset, 7.25, { 1.2, 0.7, 8 }), hider) << depth;
  }
}

// A pane that swings 2 to either side, 8 times while the shutter is open.
TEST(MovingOccluders, WhatChangesItsShapeIsMetAtAnyTime)
{
  const auto state = SceneBuilder().add(makeQuad({ { -0.1, -0.1, 5 }, { 0.2, 0, 0 }, { 0, 0.2, 0 } })).state();
  const auto offset = [](double frame)
  { return Eigen::Vector3d(2 * std::sin(16 * M_PI * (frame - 6.5) + M_PI / 4), 0, 0); };
  for (int i = 0; i < 64; ++i)
  {
    const double frame = 6.5 + (i + 0.5) / 64;
    const Eigen::Vector3d behind = 2 * (offset(frame) + Eigen::Vector3d(0.04, 0.03, 5));
    EXPECT_EQ(hiddenBy(state, offset, frame, behind), 1u) << frame;
    EXPECT_EQ(hiddenBy(state, offset, frame, behind + Eigen::Vector3d(0, 1, 0)), 0u) << frame;
  }
}
