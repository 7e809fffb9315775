// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSeenPoint_h
#define dgtkSeenPoint_h

#include "dgtkSight.h"

namespace dgtk
{

/// Visibility classes of CONVENTIONS.
enum SeenClass
{
  NothingSeen,
  VisibleSeen,
  OtherObjectSeen,
  OwnObjectSeen,
  OutsideSeen,
  BehindSeen
};

/// A surface point as a camera sees it.
struct SeenPoint
{
  Hit hit;
  bool gone = false;     ///< its object is not there, or never was
  bool projects = false; ///< not behind the camera
  Eigen::Vector3d x_in_camera{ 0, 0, 0 };
  Eigen::Vector2d pixel{ 0, 0 }; ///< where it projects
};

/// Part of the depth within which a surface is the point's own: the rounding of its place.
constexpr double seenSlack = 1e-9;
/// Directions, and parts of the depth, that a ray may pass by a silhouette.
constexpr double silhouetteReach = 1e-4;
/// Pixels: as near to the image's border, inside and outside are a matter of rounding.
constexpr double borderSlack = 1e-6;

/// The class by the ray through the point itself.
int classOf(const Sight& sight, const SeenPoint& point);

/// Whether class `found` is as right: beside a silhouette, the border or the limits of depth.
bool isOpenClass(const Sight& sight, const SeenPoint& point, int found);

} // namespace dgtk

#endif
