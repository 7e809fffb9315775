// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStageViews_h
#define dgtkStageViews_h

#include "dgtkSceneDescription.h"
#include "dgtkSceneState.h"

#include <vector>

namespace dgtk
{

/// The lights that are on at a frame; the head light for a scene without any.
std::vector<LightState> lightsAt(const SceneDescription& scene, double frame);

/// camera_from_world. Throws InputError, with the camera and the frame, where there is none.
Rigid3 poseIn(const SceneDescription& scene, const CameraDescription& camera, double frame);

/// Points on the unit disc: Vogel's spiral, in bit-reversed order.
std::vector<Eigen::Vector2d> lensPoints(int count);

/// The view through a point of the lens (camera axes, scene units from its centre): points at depth `focus` keep their
/// place in the image.
View throughLens(const View& view, const Eigen::Vector2d& point, double focus);

} // namespace dgtk

#endif
