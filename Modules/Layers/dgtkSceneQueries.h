// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneQueries_h
#define dgtkSceneQueries_h

#include "dgtkStage.h"
#include "dgtkVisibility.h"

#include <memory>

namespace dgtk
{

class ThreadPool;

/// States of a scene at several frames, and rays through them, by whichever engine. Thread-safe.
class SceneQueries
{
public:
  virtual ~SceneQueries() = default;

  /// A scene at a frame with what rays meet in it.
  struct Moment
  {
    int frame = 0;
    std::shared_ptr<const SceneState> state;
    std::shared_ptr<const OcclusionQuery> occlusion;
  };
  /// Throws what Stage::at throws, and MachineError where the engine cannot work.
  virtual Moment at(int frame) = 0;
  virtual const Stage& stage() const = 0;
  /// Hits of any view. `pool` outlives it. Throws MachineError where the engine cannot work.
  virtual std::unique_ptr<VisibilitySource> makeSource(ThreadPool& pool) const = 0;
};

} // namespace dgtk

#endif
