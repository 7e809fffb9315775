// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKeypointTruth_h
#define dgtkKeypointTruth_h

#include "dgtkGroundTruthModule.h"

#include "dgtkCorrespondence.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace dgtk
{

/// Part of the diagonal of an object's box: what lies by less in front of one of its keypoints does not hide it, so
/// that a joint may be inside a limb.
constexpr double keypointDepth = 0.01;

/// A named point of an object in a view.
struct SeenKeypoint
{
  /// Camera frame; of a view with `instants` at the time at which it is seen, or the picture's own where it is not.
  Eigen::Vector3d x_in_camera{ 0, 0, 0 };
  std::optional<Eigen::Vector2d> pixel; ///< also outside the image; nothing for Behind
  VisibilityClass visibility = VisibilityClass::NoSurface;
};

/// Where the keypoints of an object (id >= 1) are in a view; `occlusion` is of `state`. Surfaces up to `depth` (scene
/// units, along the ray) in front of a point do not hide it. Thread-safe.
DGTKGROUNDTRUTH_EXPORT std::vector<SeenKeypoint> seeKeypoints(
  const SceneState& state, std::uint32_t id, const View& view, const OcclusionQuery& occlusion, double depth);

} // namespace dgtk

#endif
