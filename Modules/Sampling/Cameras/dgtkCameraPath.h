// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraPath_h
#define dgtkCameraPath_h

#include "dgtkSampleDraws.h"
#include "dgtkSampleRule.h"
#include "dgtkSampleWorld.h"
#include "dgtkTrack.h"

#include <cstdint>
#include <vector>

namespace dgtk
{

/// A path of a camera as key frames.
struct TravelledPath
{
  std::vector<Key<Eigen::Vector3d>> eye;
  std::vector<Key<Eigen::Vector3d>> lookAt; ///< empty where the camera says where it looks
  int attempts = 1;                         ///< of a walk
};

/// What a rule `path` (orbit, spline or walk) gives in an attempt of its camera. `looks`: the camera has a lookAt of
/// its own. Throws InputError for what the rule cannot mean, SampleRefused for a walk that finds no way.
TravelledPath bakedPath(
  const SampleRule& rule, SampleWorld& world, UpAxis up, const SampleDraws& draws, std::uint32_t attempt, bool looks);

} // namespace dgtk

#endif
