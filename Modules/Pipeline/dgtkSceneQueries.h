// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneQueries_h
#define dgtkSceneQueries_h

#include "dgtkStage.h"
#include "dgtkVisibility.h"

#include <list>
#include <memory>
#include <mutex>

namespace dgtk
{

/// States of a scene at several frames, and rays through them. The last few are kept. Thread-safe.
class SceneQueries
{
public:
  explicit SceneQueries(std::shared_ptr<const Stage> stage);

  /// A scene at a frame with what rays meet in it.
  struct Moment
  {
    int frame = 0;
    std::shared_ptr<const SceneState> state;
    std::shared_ptr<const OcclusionQuery> occlusion;
  };
  /// Throws what Stage::at and makeOcclusionQuery throw.
  Moment at(int frame);
  const Stage& stage() const { return *this->Scene; }

private:
  std::shared_ptr<const Stage> Scene;
  std::mutex Mutex;
  std::list<Moment> Kept; // last used first
};

} // namespace dgtk

#endif
