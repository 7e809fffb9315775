// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewCamera_h
#define dgtkViewCamera_h

#include "dgtkDocumentModule.h"

#include "dgtkScenePlaces.h"

#include <Eigen/Core>

#include <optional>
#include <utility>

namespace dgtk
{

enum class ViewKind
{
  Front, ///< along -z, up +y; in a world with z up: along +y, up +z
  Top,   ///< down, the front's horizontal axis to the right
  Side,  ///< from the right of the front view
  Perspective
};

/// The eye of one view of the editor. Widget pixels: x right, y down, (0, 0) the top left corner.
class DGTKDOCUMENT_EXPORT ViewCamera
{
public:
  explicit ViewCamera(ViewKind kind, UpAxis upAxis = UpAxis::Y);

  ViewKind kind() const { return this->Kind; }
  bool parallel() const { return this->Kind != ViewKind::Perspective; }
  const Eigen::Vector3d& eye() const { return this->Eye; }
  const Eigen::Vector3d& focus() const { return this->Focus; }
  /// The world's up axis, or what is upwards in the image where the view is along that axis.
  Eigen::Vector3d up() const;
  double height() const; ///< of the view in the plane through the focus, world units
  static double angle(); ///< vertical field of view of the perspective, degrees
  Eigen::Vector3d forward() const;
  /// Unit length, from a point.
  Eigen::Vector3d towardsEye(const Eigen::Vector3d& point) const;

  /// Shows the whole box, in a view of width x height pixels; an empty one stands for the surroundings of the origin.
  void frame(const WorldBox& box, double aspect);
  /// From a place to another; the horizon stays level. Straight down or up, `up` is upwards in the image; where it
  /// says nothing, what it would be if the view were tilted there. False, and nothing changes, where both places are
  /// the same, and in parallel views.
  bool look(
    const Eigen::Vector3d& eye, const Eigen::Vector3d& focus, const Eigen::Vector3d& up = Eigen::Vector3d(0, 0, 0));
  /// About the focus and the world's up axis, degrees; nothing in parallel views.
  void orbit(double right, double down);
  /// The scene follows the mouse: pixels, in a view of that height.
  void pan(double dx, double dy, double viewHeight);
  /// Above 1: things become larger.
  void zoom(double factor);

  /// Through a point of the widget.
  WorldRay ray(double x, double y, double width, double height) const;
  /// Where a point is in the widget; nothing where it is not before the eye of the perspective.
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& point, double width, double height) const;
  /// The part of a segment that is before the eye; nothing where there is none.
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segment(
    const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width, double height) const;
  /// World units of a pixel at the depth of a point.
  double unit(const Eigen::Vector3d& point, double height) const;
  /// World units that `pixels` are, along ray().
  PickReach reach(double pixels, double height) const;
  /// The motion of a point in a plane parallel to the view when the mouse moves by dx, dy pixels.
  Eigen::Vector3d motion(const Eigen::Vector3d& point, double dx, double dy, double height) const;

private:
  bool steep() const; ///< along Up
  Eigen::Vector3d right() const;
  Eigen::Vector3d upward() const; ///< in the image

  ViewKind Kind;
  Eigen::Vector3d Eye{ 0, 0, 10 };
  Eigen::Vector3d Focus{ 0, 0, 0 };
  Eigen::Vector3d Up{ 0, 1, 0 };
  Eigen::Vector3d SteepUp{ 0, 0, -1 }; ///< upwards in the image of a view along Up
};

} // namespace dgtk

#endif
