// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKeypoints_h
#define dgtkKeypoints_h

#include "dgtkSceneDescription.h"
#include "dgtkSceneState.h"

#include <vector>

namespace dgtk
{

/// Throws InputError, with the scene's file and the object's line, for a keypoint at a vertex that the model lacks or
/// does not number, or that is of no triangle.
void checkKeypoints(const SceneDescription& scene, const ObjectDescription& object, const Model& model);

/// The keypoints of an object whose model's vertices are these; those of missing vertices are left out.
std::vector<KeypointState> keypointsAt(const ObjectDescription& object, const Model& model, const Geometry& geometry);

} // namespace dgtk

#endif
