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

/// A point of an object's surface, world frame.
struct DrawnSurfacePoint
{
  Eigen::Vector3d x_in_world{ 0, 0, 0 };
  Eigen::Vector3d normal_in_world{ 0, 1, 0 }; ///< of the triangle, unit length, on its front side
};

/// The point of the surface of an object, as it is at a frame, that three uniforms in [0, 1) stand for: the first
/// chooses the triangle by its area in the world, the others the point in it, so that uniforms give points uniform over
/// the area. Throws what SampleModels::model() throws, and InputError, at the object's line, for a model without area.
DrawnSurfacePoint pointOnSurface(const SceneDescription& scene, std::size_t object, double frame,
  const std::array<double, 3>& uniforms, SampleModels& models);

/// This library is loaded when something is placed: see dgtkOnDemand.h.
struct PlacementCalls
{
  decltype(&dgtk::placeObjects) placeObjects;
  decltype(&dgtk::pointOnSurface) pointOnSurface;
};

inline const PlacementCalls& placement() { return onDemand<PlacementCalls>("dgtkPlacement"); }

} // namespace dgtk

extern "C" const dgtk::PlacementCalls* dgtkPlacementCalls();

#endif
