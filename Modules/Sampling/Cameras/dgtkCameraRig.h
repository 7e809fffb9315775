// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraRig_h
#define dgtkCameraRig_h

#include "dgtkJson.h"
#include "dgtkSceneDescription.h"

#include <cstddef>
#include <vector>

namespace dgtk
{

/// Which cameras of a random scene's list are mounted on which, by their rules `rig`: in each group the camera that is
/// mounted on none comes first and every other after the one that it is mounted on; groups are in the order of their
/// first cameras. A camera without a rig is a group of its own. Throws InputError for a camera that is not there, and
/// for a circle.
std::vector<std::vector<std::size_t>> rigsOf(const JsonDocument& scene);

/// Gives a camera the pose that its rule `rig` has on `base`: `position` and `orientation`, key frames of every frame
/// from the first to the last key frame of the pose of `base`. Throws InputError for what the rule cannot mean.
void mountOn(JsonNode& camera, const JsonDocument& rig, const CameraDescription& base);

} // namespace dgtk

#endif
