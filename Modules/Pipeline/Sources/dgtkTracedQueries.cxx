// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTracedQueries.h"

#include "dgtkRaySource.h"

#include <algorithm>
#include <iterator>

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

std::optional<SceneQueries::Moment> TracedQueries::find(int frame)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found =
    std::find_if(this->Kept.begin(), this->Kept.end(), [&](const Moment& moment) { return moment.frame == frame; });
  if (found == this->Kept.end())
  {
    return std::nullopt;
  }
  this->Kept.splice(this->Kept.begin(), this->Kept, found);
  return this->Kept.front();
}

SceneQueries::Moment TracedQueries::at(int frame)
{
  if (const std::optional<Moment> known = this->find(frame))
  {
    return *known;
  }
  const std::lock_guard<std::mutex> building(this->Building);
  if (const std::optional<Moment> known = this->find(frame))
  {
    return *known;
  }
  Moment moment{ frame, this->Scene->at(frame), nullptr };
  std::shared_ptr<OcclusionQuery> occlusion = makeOcclusionQuery();
  occlusion->setScene(moment.state);
  moment.occlusion = std::move(occlusion);
  std::list<Moment> dropped; // destroyed after the lock
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Kept.push_front(moment);
  if (this->Kept.size() > mostKept)
  {
    dropped.splice(dropped.begin(), this->Kept, std::prev(this->Kept.end()));
  }
  return moment;
}

std::unique_ptr<VisibilitySource> TracedQueries::makeSource(ThreadPool& pool) const { return makeRaySource(pool); }

} // namespace dgtk
