// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWholeObjects_h
#define dgtkWholeObjects_h

#include "dgtkGroundTruthModule.h"

#include "dgtkObjectTruth.h"

#include <memory>
#include <vector>

namespace dgtk
{

class ThreadPool;

/// Pixels around an image in which objects are met, hidden or not, between near and far: those of a canvas of three
/// times the image's width and height with the image in its middle, but for the image's own. Pixels of a lens beyond
/// its domain have no ray and meet nothing. By object id - 1, without runs, in pixels of the image: borders may be
/// negative or beyond its size. `occlusion` is of `state`; `source` gets another scene. Only where the projected
/// triangles may be are rays traced, in strips of bounded size.
DGTKGROUNDTRUTH_EXPORT std::vector<ObjectPixels> objectsAround(const std::shared_ptr<const SceneState>& state,
  const View& view, const OcclusionQuery& occlusion, VisibilitySource& source, ThreadPool& pool);

} // namespace dgtk

#endif
