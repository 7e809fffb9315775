// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkItemMotion_h
#define dgtkItemMotion_h

#include "dgtkWidgetsModule.h"

#include "dgtkScenePlaces.h"
#include "dgtkViewHandles.h"

#include <vector>

namespace dgtk
{

/// The rotation b followed by a.
DGTKWIDGETS_EXPORT Quaternion product(const Quaternion& a, const Quaternion& b);
/// About an axis of unit length.
DGTKWIDGETS_EXPORT Quaternion turn(const Eigen::Vector3d& axis, double degrees);

/// Items of a scene as they are before they are moved, rotated or scaled together in the world.
class DGTKWIDGETS_EXPORT ItemMotion
{
public:
  /// Children of objects among `items` go with their parents. `places` are those of the scene at `frame`.
  ItemMotion(const SceneDescription& scene, const ScenePlaces& places, const SceneItems& items, int frame);

  /// Items that are changed.
  const SceneItems& items() const { return this->Items; }
  int frame() const { return this->Frame; }
  /// An object's origin, a light's or camera's place; of several the mean.
  Eigen::Vector3d pivot() const;
  /// Orthonormal: for scaling one object its own axes, else the world's.
  Eigen::Matrix3d axes(HandleMode mode) const;
  /// Whether such a motion changes anything: there is nothing to scale of a single light, or to rotate of a point
  /// light.
  bool can(HandleMode mode) const;

  /// Gives the items at frame() the values that they had, moved. Values that have keys get one there; others are
  /// changed at all frames. Rotations below parents with uneven scales are exact in the world's directions, up to the
  /// shear that no orientation can undo. A camera's up vector is changed only where the pose asks for it.
  void apply(SceneDescription& scene, const WorldMotion& motion) const;

private:
  struct Start
  {
    Eigen::Vector3d place{ 0, 0, 0 }; ///< in the world
    Eigen::Vector3d position{ 0, 0, 0 };
    Eigen::Vector3d target{ 0, 0, 0 }; ///< look-at point
    Eigen::Vector3d up{ 0, 1, 0 };
    Eigen::Vector3d scale{ 1, 1, 1 };
    Quaternion orientation;
    Eigen::Matrix3d parent = Eigen::Matrix3d::Identity();         ///< world from parent
    Eigen::Matrix3d parentRotation = Eigen::Matrix3d::Identity(); ///< its nearest orthogonal matrix
  };
  void applyToObject(ObjectDescription& object, const Start& start, const WorldMotion& motion) const;
  void applyToLight(LightDescription& light, const Start& start, const WorldMotion& motion) const;
  void applyToCamera(CameraDescription& camera, const Start& start, const WorldMotion& motion) const;
  /// The unit axes of an object in the world.
  static Eigen::Matrix3d ownAxes(const Start& start);
  Eigen::Vector3d ownFactors(const Start& start, const WorldMotion& motion) const;

  SceneItems Items;
  int Frame;
  std::vector<Start> Starts;
  std::vector<bool> Directed; ///< lights with a target, and cameras: a rotation changes them where they are
};

} // namespace dgtk

#endif
