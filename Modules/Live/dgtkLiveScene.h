// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLiveScene_h
#define dgtkLiveScene_h

#include "dgtkLiveModule.h"

#include "dgtkModelLibrary.h"
#include "dgtkViewCamera.h"

#include "dgtkTracedQueries.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

class HitShader;

/// The eye of a perspective view of the editor, the same at all frames, as a camera without a name. near and far hold
/// all of `box` that is not very near: far is 10,000 times near.
DGTKLIVE_EXPORT CameraDescription liveCamera(const ViewCamera& camera, const WorldBox& box);

/// A scene that is being edited as it is at one moment, for questions from other threads: the stage that `dgtk render`
/// would have of it, and rays through it. Thread-safe.
class DGTKLIVE_EXPORT LiveScene
{
public:
  /// Copies both; geometry is shared. What rays need of the geometry is taken over from the scene `before` a change.
  LiveScene(const SceneDescription& scene, const ModelLibrary& models, const LiveScene* before = nullptr);

  using Moment = SceneQueries::Moment;
  /// The last few are kept. Throws what Stage::make(), Stage::at() and makeOcclusionQuery() throw.
  Moment at(int frame) const;
  /// Throws what Stage::make() throws.
  std::shared_ptr<const Stage> stage() const;

  /// The stage with this camera among its own, and the camera's index. One without a name is none of the scene's.
  std::shared_ptr<const Stage> stageWith(const CameraDescription& camera, std::size_t& index) const;

  /// Keeps what was made to shade it, for the textures that it holds, until the next one.
  void keep(std::shared_ptr<const HitShader> shader) const;

  /// Names of the objects with an id: objectNames()[id - 1].
  std::vector<std::string> objectNames() const { return this->stage()->objectNames(); }

  const SceneDescription& description() const { return this->Scene; }
  int firstFrame() const { return this->First; }
  int lastFrame() const { return this->Last; }

private:
  std::shared_ptr<TracedQueries> queries() const;

  SceneDescription Scene;
  ModelLibrary Models;
  int First = 0;
  int Last = 0;
  mutable std::mutex Mutex;
  mutable std::shared_ptr<TracedQueries> Queries; ///< made when it is first asked for
  mutable std::shared_ptr<const HitShader> Shader;
  mutable std::shared_ptr<TracedQueries> Before; ///< of the scene before, until there is an own moment
};

} // namespace dgtk

#endif
