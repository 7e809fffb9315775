// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTracedQueries.h"

#include "dgtkRaySource.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::size_t mostKept = 4; // a frame, its neighbours, and the next job's
}

TracedQueries::TracedQueries(std::shared_ptr<const Stage> stage)
  : Scene(std::move(stage))
{
}

SceneQueries::Moment TracedQueries::at(int frame)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found =
    std::find_if(this->Kept.begin(), this->Kept.end(), [&](const Moment& moment) { return moment.frame == frame; });
  if (found != this->Kept.end())
  {
    this->Kept.splice(this->Kept.begin(), this->Kept, found);
    return this->Kept.front();
  }
  Moment moment{ frame, this->Scene->at(frame), nullptr };
  std::shared_ptr<OcclusionQuery> occlusion = makeOcclusionQuery();
  occlusion->setScene(moment.state);
  moment.occlusion = std::move(occlusion);
  this->Kept.push_front(moment);
  if (this->Kept.size() > mostKept)
  {
    this->Kept.pop_back();
  }
  return moment;
}

std::unique_ptr<VisibilitySource> TracedQueries::makeSource(ThreadPool& pool) const { return makeRaySource(pool); }

} // namespace dgtk
