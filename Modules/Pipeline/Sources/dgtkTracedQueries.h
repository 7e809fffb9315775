// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTracedQueries_h
#define dgtkTracedQueries_h

#include "dgtkPipelineModule.h"

#include "dgtkSceneQueries.h"

#include <list>
#include <memory>
#include <mutex>
#include <optional>

namespace dgtk
{

/// The last few moments are kept.
class DGTKPIPELINE_EXPORT TracedQueries : public SceneQueries
{
public:
  explicit TracedQueries(std::shared_ptr<const Stage> stage);

  Moment at(int frame) override;
  const Stage& stage() const override { return *this->Scene; }
  std::unique_ptr<VisibilitySource> makeSource(ThreadPool& pool) const override;

private:
  std::optional<Moment> find(int frame);

  std::shared_ptr<const Stage> Scene;
  std::mutex Mutex;       ///< of the list; never held for long
  std::mutex Building;    ///< one moment is made at a time
  std::list<Moment> Kept; ///< last used first
};

} // namespace dgtk

#endif
