// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveMatch_h
#define dgtkLiveMatch_h

#include "dgtkLiveScene.h"

#include "dgtkCorrespondence.h"

#include <optional>
#include <string>

namespace dgtk
{

/// A camera at a frame, at its own size.
struct MatchView
{
  View view; ///< its name is the camera's
  int frame = 0;
};

/// Where an image point of one view is in another; all that the two views know about it.
struct LiveMatch
{
  Eigen::Vector2d from{ 0, 0 }; ///< pixels
  Correspondence to;
  Hit hit;            ///< object 0: no surface, and what follows but `line` means nothing
  std::string object; ///< its name
  std::uint32_t part = 0;
  std::uint32_t triangle = 0; ///< within the part
  double depthFrom = 0;       ///< z in the camera frame
  double depthTo = 0;
  Eigen::Vector3d worldFrom{ 0, 0, 0 };
  Eigen::Vector3d worldTo{ 0, 0, 0 };  ///< of the same surface point, at the other frame
  std::string occluder;                ///< name of what hides it there; empty: nothing
  std::optional<Eigen::Vector3d> line; ///< epipolarLine()
  double lineDistance = 0;             ///< of the match from the line, pixels; NaN where there is no line
  std::string message;                 ///< what went wrong, one line
};

/// The same as correspondPixel(), with more around it. Throws UsageError for a point outside the image.
DGTKLIVE_EXPORT LiveMatch liveMatch(
  const LiveScene& scene, const MatchView& from, const Eigen::Vector2d& pixel, const MatchView& to);

} // namespace dgtk

#endif
