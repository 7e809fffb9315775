// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkItemMotion_h
#define dgtkItemMotion_h

#include "dgtkDocumentModule.h"

#include "dgtkScenePlaces.h"
#include "dgtkViewHandles.h"

#include <vector>

namespace dgtk
{

/// The rotation b followed by a.
DGTKDOCUMENT_EXPORT Quaternion product(const Quaternion& a, const Quaternion& b);
/// About an axis of unit length.
DGTKDOCUMENT_EXPORT Quaternion turn(const Eigen::Vector3d& axis, double degrees);

/// What handles stand at, and rotations and scalings go about.
enum class HandlePivot
{
  Center, ///< of the box about what is selected, of several the common box
  Origin  ///< of the object, of several the mean
};

/// Items of a scene as they are before they are moved, rotated or scaled together in the world.
class DGTKDOCUMENT_EXPORT ItemMotion
{
public:
  /// Children of objects among `items` go with their parents. `places` are those of the scene at `frame`.
  ItemMotion(const SceneDescription& scene, const ScenePlaces& places, const SceneItems& items, int frame);

  /// Items that are changed.
  const SceneItems& items() const { return this->Items; }
  int frame() const { return this->Frame; }
  /// Of a light or a camera always its place.
  Eigen::Vector3d pivot(HandlePivot wanted = HandlePivot::Center) const;
  /// Orthonormal: for scaling one object its own axes, else the world's.
  Eigen::Matrix3d axes(HandleMode mode) const;
  /// Whether such a motion changes anything: there is nothing to scale of a single light, or to rotate of a point
  /// light.
  bool can(HandleMode mode) const;

  /// Gives the items at frame() the values that they had, moved. Values that have keys get one there; others are
  /// changed at all frames. Rotations below parents with uneven scales are exact in the world's directions, up to the
  /// shear that no orientation can undo; the pivot of a single object stays where it is. An object that turns or grows
  /// about another point than its origin steps aside as often as it turns or grows: at frame() alone where the
  /// orientation (the scale) has keys, and a position without keys gets some at their frames, so that those poses stay;
  /// at all frames where it has none, and all keys of the position take the same step (exact at other frames where
  /// what is not changed of orientation and scale has no keys). A camera's up vector is changed only where the pose
  /// asks for it.
  void apply(SceneDescription& scene, const WorldMotion& motion) const;
  /// Whether a rotation of the world cannot be had of one of the objects: its parent's uneven scale shears what turns
  /// in it. Such a turn is that of the parent's axes without their scale (the polar decomposition's), so that turns
  /// follow one another as in the world: back is as it was, and so is once around.
  bool shears(const WorldMotion& motion) const;

private:
  struct Start
  {
    Eigen::Vector3d place{ 0, 0, 0 }; ///< in the world
    Eigen::Vector3d position{ 0, 0, 0 };
    Track<Eigen::Vector3d> path;       ///< an object's position
    Eigen::Vector3d target{ 0, 0, 0 }; ///< look-at point
    Eigen::Vector3d up{ 0, 1, 0 };
    Eigen::Vector3d scale{ 1, 1, 1 };
    Quaternion orientation;
    Eigen::Matrix3d parent = Eigen::Matrix3d::Identity();         ///< world from parent
    Eigen::Matrix3d parentRotation = Eigen::Matrix3d::Identity(); ///< its nearest orthogonal matrix
  };
  static Quaternion turnInParent(const Start& start, const WorldMotion& motion);
  /// Of a single object's position, in its parent.
  static Eigen::Vector3d stepInParent(const Start& start, const WorldMotion& motion);
  void applyToObject(ObjectDescription& object, const Start& start, const WorldMotion& motion) const;
  void applyToLight(LightDescription& light, const Start& start, const WorldMotion& motion) const;
  void applyToCamera(CameraDescription& camera, const Start& start, const WorldMotion& motion) const;
  /// The unit axes of an object in the world.
  static Eigen::Matrix3d ownAxes(const Start& start);
  Eigen::Vector3d ownFactors(const Start& start, const WorldMotion& motion) const;

  SceneItems Items;
  int Frame;
  Eigen::Vector3d Center{ 0, 0, 0 };
  std::vector<Start> Starts;
  std::vector<bool> Directed; ///< lights with a target, and cameras: a rotation changes them where they are
};

} // namespace dgtk

#endif
