// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlacement_h
#define dgtkPlacement_h

#include "dgtkOnDemand.h"
#include "dgtkSampleDraws.h"
#include "dgtkSampleModels.h"
#include "dgtkSampleRule.h"
#include "dgtkSceneDescription.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

/// What became of an object with a rule `place`.
struct PlaceOutcome
{
  std::size_t index = 0; ///< of the object in the description
  SampleNote note;       ///< `kept` false: whoever called takes the object out, with what hangs on it
};

/// Puts the objects that have a rule `place`, in the order of the description: sets their position and orientation, or
/// key frames of a fall. Rules are in that order, too; the result has one entry a rule. A draw has a path that begins
/// with the rule's. Objects without a rule stand where they are. Throws InputError for a rule that says nothing that
/// can be done, SampleRefused where a rule that cannot be kept says so.
std::vector<PlaceOutcome> placeObjects(
  SceneDescription& scene, const std::vector<SampleRule>& rules, const SampleDraws& draws, SampleModels& models);

/// This library is loaded when something is placed: see dgtkOnDemand.h.
struct PlacementCalls
{
  decltype(&dgtk::placeObjects) placeObjects;
};

inline const PlacementCalls& placement() { return onDemand<PlacementCalls>("dgtkPlacement"); }

} // namespace dgtk

extern "C" const dgtk::PlacementCalls* dgtkPlacementCalls();

#endif
