// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewHandles_h
#define dgtkViewHandles_h

#include "dgtkDocumentModule.h"

#include "dgtkViewCamera.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dgtk
{

enum class HandleMode
{
  None,
  Move,
  Rotate,
  Scale
};

/// What is grasped, and what a motion keeps to.
struct Handle
{
  enum class Kind
  {
    Free, ///< move in the view's plane, rotate about the direction of view, scale evenly
    Axis, ///< along or about one axis
    Plane ///< along the two others
  };
  Kind kind = Kind::Free;
  int axis = 0; ///< 0 to 2; of Plane the normal
  bool operator==(const Handle& o) const { return this->kind == o.kind && this->axis == o.axis; }
  bool operator!=(const Handle& o) const { return !(*this == o); }
};

/// Where handles are: at `pivot` (world), along the columns of `axes` (orthonormal).
struct HandlePlace
{
  HandleMode mode = HandleMode::None;
  Eigen::Vector3d pivot{ 0, 0, 0 };
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// A part of the picture of a handle, in pixels of the view.
struct HandleShape
{
  Handle handle;
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
  bool filled = false;
};

/// The handles as one view shows them, of the same size in pixels everywhere. Pixels as in ViewCamera.
class DGTKDOCUMENT_EXPORT ViewHandles
{
public:
  ViewHandles(const HandlePlace& place, const ViewCamera& camera, double width, double height);

  /// Those that can be used in this view; none where the pivot is not before the eye.
  const std::vector<HandleShape>& shapes() const { return this->Shapes; }
  /// The nearest one within a few pixels.
  std::optional<Handle> hit(const Eigen::Vector2d& pixel) const;

  /// Pixels from the pivot to the end of an arrow, and to a ring.
  static double length();

private:
  void addMove();
  void addRotate();
  void addScale();
  void addSquare(int normal);
  void addRing(int axis);
  void addPatch(const Handle& handle, const Eigen::Vector2d& center, double reach);
  /// Pixel of pivot + axes * offset * length().
  Eigen::Vector2d at(const Eigen::Vector3d& offset) const;
  /// Whether an axis is long enough in the picture to be pulled.
  bool isLong(int axis) const;

  HandlePlace Place;
  const ViewCamera& Camera;
  double Width;
  double Height;
  double Size = 0; ///< world units of length()
  Eigen::Vector2d Center{ 0, 0 };
  Eigen::Vector3d ToEye{ 0, 0, 1 }; ///< in the handles' axes
  std::vector<HandleShape> Shapes;
};

/// What is to happen to things in the world.
struct WorldMotion
{
  HandleMode mode = HandleMode::None;
  Eigen::Vector3d translation{ 0, 0, 0 };             ///< Move, world units
  Eigen::Vector3d pivot{ 0, 0, 0 };                   ///< Rotate and Scale
  Eigen::Vector3d axis{ 0, 0, 1 };                    ///< Rotate: unit length, world
  double degrees = 0;                                 ///< Rotate
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< Scale: orthonormal columns, world
  Eigen::Vector3d factors{ 1, 1, 1 };                 ///< Scale: along the columns, > 0
};

/// A drag with the mouse as a motion in the world: the point that was grasped stays under the mouse as far as the
/// handle allows.
class DGTKDOCUMENT_EXPORT HandleDrag
{
public:
  /// `grasped`: a point of what is dragged (world), which gives the depth of free motions. `start`: pixel of the press.
  HandleDrag(const HandlePlace& place, const Handle& handle, const Eigen::Vector3d& grasped, const ViewCamera& camera,
    double width, double height, const Eigen::Vector2d& start);

  const Handle& handle() const { return this->Grip; }
  /// Goes on with another one, from the same start.
  void constrain(const Handle& handle);
  /// Since the start. With step > 0 in steps: the components of a translation are multiples of it, angles of 15
  /// degrees, factors of 0.1. Where no motion belongs to the pixel (a plane seen from its edge) the last one holds.
  const WorldMotion& motion(const Eigen::Vector2d& pixel, double step);

private:
  void move(const Eigen::Vector2d& pixel, double step);
  void rotate(const Eigen::Vector2d& pixel, double step);
  void scale(const Eigen::Vector2d& pixel, double step);
  WorldRay ray(const Eigen::Vector2d& pixel) const;
  Eigen::Vector3d axis() const; ///< of the grip, world; of a free one towards the eye
  /// Of the ray's nearest point on the line through `point` along `along`; nothing where they are nearly parallel.
  std::optional<double> alongLine(
    const WorldRay& ray, const Eigen::Vector3d& point, const Eigen::Vector3d& along) const;
  std::optional<Eigen::Vector3d> inPlane(
    const WorldRay& ray, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  std::optional<double> rawAngle(const Eigen::Vector2d& pixel) const; ///< radians, (-pi, pi] about a ring seen openly
  double rawFactor(const Eigen::Vector2d& pixel) const;

  HandlePlace Place;
  Handle Grip;
  Handle Grasped; ///< at the press
  Eigen::Vector3d Anchor;
  ViewCamera Camera;
  double Width;
  double Height;
  Eigen::Vector2d Start;
  double Size; ///< world units of ViewHandles::length() at the pivot
  double Raw = 0;
  double Turned = 0; ///< radians, beyond half a turn too
  WorldMotion Last;
};

} // namespace dgtk

#endif
