// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveScene_h
#define dgtkLiveScene_h

#include "dgtkWidgetsModule.h"

#include "dgtkModelStore.h"
#include "dgtkViewCamera.h"

#include "dgtkVisibility.h"

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// A camera at a frame and at its neighbours.
struct LiveView
{
  View now;
  View before; ///< one frame earlier
  View after;  ///< one frame later
};

/// The eye of a perspective view of the editor, which is the same at all frames. near and far hold all of `box` that is
/// not very near: far is 10,000 times near.
DGTKWIDGETS_EXPORT LiveView liveView(const ViewCamera& camera, const WorldBox& box, int width, int height);

/// A scene that is being edited as it is at one moment, for questions from other threads: the states that `dgtk render`
/// would have of it, and rays through them. Thread-safe.
class DGTKWIDGETS_EXPORT LiveScene
{
public:
  /// Copies both; geometry is shared. What rays need of the geometry is taken over from the scene `before` a change.
  LiveScene(const SceneDescription& scene, const ModelStore& models, const LiveScene* before = nullptr);

  struct Moment
  {
    int frame = 0;
    std::shared_ptr<const SceneState> state;
    std::shared_ptr<const OcclusionQuery> occlusion;
  };
  /// Objects as Stage::at(frame) has them, ids included. The last few are kept. Throws what placeScene()
  /// and makeOcclusionQuery() throw.
  Moment at(int frame) const;

  /// A camera of this or any scene, as Stage::view(). Throws InputError where its pose is undefined.
  LiveView view(const CameraDescription& camera, int frame, int width = 0, int height = 0) const;

  /// What surfaces get from the environment; null where there is none.
  std::shared_ptr<const EnvironmentLight> environmentLight() const;

  /// Names of the objects with an id: objectNames()[id - 1].
  std::vector<std::string> objectNames() const;

  const SceneDescription& description() const { return this->Scene; }
  int firstFrame() const { return this->First; }
  int lastFrame() const { return this->Last; }

private:
  SceneDescription Scene;
  ModelStore Models;
  int First = 0;
  int Last = 0;
  std::optional<Moment> find(int frame) const;
  mutable std::mutex Mutex;       ///< of the lists; never held for long
  mutable std::mutex Building;    ///< one moment is made at a time
  mutable std::list<Moment> Kept; ///< last used first
  mutable std::list<Moment> Old;  ///< of the scene before, until there are own ones
};

} // namespace dgtk

#endif
