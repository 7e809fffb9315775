// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkInstantSource.h"
#include "dgtkStageSamples.h"

#include <gtest/gtest.h>

using namespace dgtk;
using namespace dgtk::test;

TEST(InstantSource, PartsOfAPictureHaveOneTimeEach)
{
  const auto partsOf = [](const RollingShutter& shutter, const PixelRect& rect)
  {
    CameraParameters parameters{ 4, 3, std::nullopt, { { "fovY", { 60 } } } };
    parameters.rollingShutter = shutter;
    return timedRects(*makeCamera("pinhole", parameters), rect);
  };
  const std::vector<TimedRect> rows = partsOf({ 3, RollingShutter::Direction::Down }, { 1, 0, 3, 3 });
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2].rect, (PixelRect{ 1, 2, 3, 1 }));
  EXPECT_DOUBLE_EQ(rows[2].time, 1);
  const std::vector<TimedRect> columns = partsOf({ 4, RollingShutter::Direction::Right }, { 1, 0, 3, 3 });
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].rect, (PixelRect{ 1, 0, 1, 3 }));
  EXPECT_DOUBLE_EQ(columns[0].time, -0.5);
  EXPECT_EQ(partsOf({}, { 0, 0, 4, 3 }).size(), 1u);
}

TEST(InstantSource, IsTheSceneAtAnyTime)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"name": "cart", "model": "models/square.ac", "position": {"keys": [[0, [0, 0, 0]], [8, [4, 0, 0]]]}},
    {"name": "rider", "model": "models/runner.md2", "parent": "cart",
     "orientation": {"keys": [[0, [1, 0, 0, 0]], [8, [0, 0, 1, 0]]]}, "scale": [2, 1, 1]},
    {"name": "stone", "model": "models/square.ac"},
    {"name": "lamp", "model": "models/square.ac", "visible": {"keys": [[0, true], [3, false]]}}],
    "cameras": [{"name": "eye", "rollingShutter": {"duration": 2, "direction": "left"}, "width": 8, "height": 4,
     "eye": {"keys": [[0, [0, 0, 9]], [8, [1, 2, 9]]]}, "lookAt": [0, 0, 0]}]})");
  const View view = stage->view(0, 3);
  ASSERT_TRUE(view.instants);
  EXPECT_EQ(view.instants->frame(), 3);
  EXPECT_EQ(view.model->timeAt({ 0.5, 1 }), 0.875);
  EXPECT_EQ(stage->view(0, 3, 16, 8).model->timeAt({ 15.5, 1 }), -0.9375);
  using Motion = InstantSource::Motion;
  EXPECT_EQ(view.instants->motions(), (std::vector<Motion>{ Motion::Rigid, Motion::Any, Motion::None, Motion::Any }));
  EXPECT_EQ(stage->movingObjects(), (std::vector<bool>{ true, true, false, false }));
  for (const double frame : { 2.1, 2.9375, 3.0, 3.7 })
  {
    const InstantSource::Instant now = view.instants->at(frame);
    const auto expected = stage->at(frame);
    EXPECT_EQ(now.camera_from_world.translation, stage->view(0, frame).camera_from_world.translation);
    EXPECT_EQ(view.instants->poseAt(frame).rotation, stage->view(0, frame).camera_from_world.rotation);
    EXPECT_EQ(view.instants->isVisibleAt(frame, 4), frame < 3);
    for (std::uint32_t id = 1; id <= 4; ++id)
    {
      const Instance& instance = expected->instances[id - 1];
      EXPECT_EQ(now.state->instances[id - 1].world_from_object, instance.world_from_object);
      EXPECT_EQ(now.state->instances[id - 1].visible, instance.visible);
      EXPECT_EQ(view.instants->placeAt(frame, id), instance.world_from_object);
      EXPECT_EQ(view.instants->instanceAt(frame, id).geometry->positions, instance.geometry->positions);
      const auto& corners = instance.model->triangles[0];
      const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
      const Eigen::Vector3d point = 0.5 * p[corners[0]] + 0.3 * p[corners[1]] + 0.2 * p[corners[2]];
      EXPECT_LT(
        (view.instants->pointAt(frame, id, 0, { 0.3, 0.2 }).x_in_world - instance.world_from_object * point).norm(),
        1e-14);
    }
  }
  EXPECT_FALSE(
    folder.load(R"({"objects": [], "cameras": [{"eye": [0, 0, 9], "lookAt": [0, 0, 0]}]})")->view(0, 0).instants);
}
