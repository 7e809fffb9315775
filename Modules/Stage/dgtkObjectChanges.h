// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjectChanges_h
#define dgtkObjectChanges_h

#include "dgtkStageModule.h"

#include "dgtkObjectPoses.h"
#include "dgtkStage.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace dgtk
{

/// Where an object is at a frame, and whether it is there.
struct ObjectPlace
{
  Affine3 world_from_object;
  bool visible = true;
};

/// What becomes of an object from the first frame of its scene to the last; only whole frames count.
struct ObjectChange
{
  bool moves = false;   ///< world_from_object is not the same at all of them
  bool deforms = false; ///< its vertices are not, in its own frame
};

/// The objects of a scene that have an id, over its frames: for less than their states take. Immutable.
class DGTKSTAGE_EXPORT ObjectChanges
{
public:
  /// `stage` must outlive it. Throws what Stage::at() throws at the scene's first frame.
  explicit ObjectChanges(const Stage& stage);

  /// By object id - 1.
  std::vector<ObjectPlace> placesAt(double frame) const;
  std::vector<ObjectChange> changes() const;

private:
  bool moves(std::size_t object) const;
  bool deforms(std::size_t object) const;

  const SceneDescription& Scene;
  int First;
  int Last;
  ObjectPoses Poses;
  std::shared_ptr<const SceneState> Begin; ///< at the first frame
  std::vector<std::size_t> Objects;        ///< of the description, by id - 1
};

} // namespace dgtk

#endif
