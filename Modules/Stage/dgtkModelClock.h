// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelClock_h
#define dgtkModelClock_h

#include "dgtkStageModule.h"

#include "dgtkModel.h"
#include "dgtkSceneDescription.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace dgtk
{

/// A moment of a deforming model: `frame` of one of its animations. wrap > 0: on the way from the last frame to the
/// first, that part of it.
struct ModelMoment
{
  int animation = 0;
  double frame = 0;
  double wrap = 0;
};

/// Index of the animation that a description names; -1 when the model has none. Throws InputError, with the scene's
/// file and the object's line, where it has no such sequence.
DGTKSTAGE_EXPORT int findAnimation(const SceneDescription& scene, const ObjectDescription& object, const Model& model);

/// The moment of a model at a scene frame, see AnimationDescription. Files with one pose a frame (MD2) pass from the
/// last frame to the first in the time of one frame when they loop; in others the last frame is the first again.
DGTKSTAGE_EXPORT ModelMoment momentAt(
  const AnimationDescription& description, const Model& model, int animation, double frame, double sceneFps);

/// Frames that a sequence takes at the model's own speed until it is done or, with `loop`, until it begins again;
/// unit: the model's frames.
DGTKSTAGE_EXPORT double sequenceSpan(const Model& model, int animation, bool loop);

/// Shared geometries of deforming models; an entry lives as long as somebody uses it. Thread-safe.
class DGTKSTAGE_EXPORT GeometryCache
{
public:
  /// The models outlive the cache.
  std::shared_ptr<const Geometry> get(const Model& model, const ModelMoment& moment);

private:
  using Key = std::tuple<const Model*, int, double, double>;
  std::mutex Mutex;
  std::map<Key, std::weak_ptr<const Geometry>> Entries;
};

/// The vertices of an object's model at a scene frame: its rest geometry where it does not deform. Throws what
/// findAnimation() throws.
DGTKSTAGE_EXPORT std::shared_ptr<const Geometry> geometryAt(const SceneDescription& scene,
  const ObjectDescription& object, const Model& model, double frame, GeometryCache& cache);

/// The corners of one triangle of that geometry, for less.
DGTKSTAGE_EXPORT std::array<Eigen::Vector3d, 3> cornersAt(const SceneDescription& scene,
  const ObjectDescription& object, const Model& model, double frame, std::uint32_t triangle);

} // namespace dgtk

#endif
