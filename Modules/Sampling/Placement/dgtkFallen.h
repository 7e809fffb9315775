// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFallen_h
#define dgtkFallen_h

#include "dgtkFall.h"
#include "dgtkPlaceWorld.h"
#include "dgtkSampleDraws.h"

#include <string>
#include <vector>

namespace dgtk
{

/// An object that is dropped, and what became of it.
struct FallingObject
{
  const PlaceRule* rule = nullptr; ///< with a `drop`
  SampleNote* note = nullptr;
  std::vector<Rigid3> poses; ///< world_from_body at the frames of the fall, the last one as it lies; of what is kept
};

/// Moves the body of a rule to the place of an attempt: its middle uniform over the region; in a volume also along the
/// vertical, otherwise above what it is put on. Why there is none; "": it is there.
std::string startPlace(PlaceWorld& world, const PlaceRule& rule, const SampleDraws& draws, int attempt);

/// Drops bodies, in the order of their names, lays them down on the true meshes, measures, and says of each what became
/// of it. Those that are kept are in the world afterwards.
void dropObjects(
  PlaceWorld& world, const SceneDescription& scene, const SampleDraws& draws, std::vector<FallingObject>& falling);

Quaternion quaternionOf(const Eigen::Matrix3d& rotation);
/// The key frames of a fall where its rule asks for them.
void writeFall(ObjectDescription& object, const FallingObject& fallen);

} // namespace dgtk

#endif
