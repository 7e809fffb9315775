// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjectPoses_h
#define dgtkObjectPoses_h

#include "dgtkStageModule.h"

#include "dgtkRigid3.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace dgtk
{

struct ObjectDescription;
struct SceneDescription;

/// Where the objects of a scene are: parents before children, what never moves computed once. Indices are those of the
/// description, which must outlive this; every parent must be there. Immutable.
class DGTKSTAGE_EXPORT ObjectPoses
{
public:
  static constexpr std::size_t noParent = std::numeric_limits<std::size_t>::max();

  explicit ObjectPoses(const SceneDescription& scene);

  /// Whether it or one of its ancestors has key frames.
  bool moves(std::size_t object) const { return this->Places[object].moves; }
  std::size_t parentOf(std::size_t object) const { return this->Places[object].parent; }
  /// world_from_object of all objects at a frame; a scale of 0 is no error here.
  std::vector<Affine3> at(double frame) const;
  /// That of one object.
  Affine3 of(std::size_t object, double frame) const;

private:
  struct Place
  {
    std::size_t parent = noParent;
    bool moves = false;        ///< it or one of its ancestors has key frames
    Affine3 world_from_object; ///< of one that does not move
  };

  const SceneDescription& Scene;
  std::vector<Place> Places;
  std::vector<std::size_t> ParentsFirst;
};

/// parent_from_object at a frame.
DGTKSTAGE_EXPORT Affine3 localPose(const ObjectDescription& object, double frame);

} // namespace dgtk

#endif
