// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameOutput.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <exception>

namespace dgtk
{

FrameOutput::FrameOutput(const std::string& folder, const JobContext& context, int bands)
  : Missing(bands)
  , Whole(context.pool)
{
  for (PlannedPass& planned : passesOf(context.plan, context.queries.stage(), context.job))
  {
    Lane lane;
    lane.readsColor = planned.readsColor;
    lane.pass = planned.layers.front().layer.makePass(context, planned.layers);
    lane.sink = std::make_unique<FileSink>(folder, context, planned.outputs());
    this->Lanes.push_back(std::move(lane));
    this->Queues.push_back(std::make_unique<SerialQueue>(context.pool));
  }
  if (bands == 0)
  {
    this->complete();
  }
}

/// Lanes come after the band is whole: those that found it in the making would wait for it, and not work.
void FrameOutput::submit(const std::shared_ptr<DrawnBand>& band)
{
  this->Whole.submit(
    [this, band]
    {
      band->whole(false);
      this->toLanes(
        [band](Lane& lane)
        {
          const WorkTime derive(WorkStage::Derive);
          lane.pass->band(band->whole(lane.readsColor), *lane.sink);
        });
    });
  if (--this->Missing == 0)
  {
    this->complete();
  }
}

/// The last encoding (PNG compresses at the end) is work for the pool as well.
void FrameOutput::complete()
{
  this->Whole.submit(
    [this]
    {
      this->toLanes(
        [](Lane& lane)
        {
          lane.pass->finish(*lane.sink);
          lane.finished = lane.sink->finish();
        });
    });
}

void FrameOutput::toLanes(const std::function<void(Lane&)>& job)
{
  for (std::size_t i = 0; i < this->Lanes.size(); ++i)
  {
    this->Queues[i]->submit([job, lane = &this->Lanes[i]] { job(*lane); });
  }
}

bool FrameOutput::isDone() const
{
  return this->Missing == 0 && this->Whole.isDone() && // and what follows from it is in the lanes
         std::all_of(this->Queues.begin(), this->Queues.end(), [](const auto& queue) { return queue->isDone(); });
}

void FrameOutput::wait()
{
  // For all of them, also after a failure: what they write to may end with the caller.
  std::exception_ptr failure;
  const auto waitFor = [&failure](SerialQueue& queue)
  {
    try
    {
      queue.wait();
    }
    catch (...)
    {
      failure = failure ? failure : std::current_exception();
    }
  };
  waitFor(this->Whole); // it fills the others
  for (const auto& queue : this->Queues)
  {
    waitFor(*queue);
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

std::vector<FinishedFile> FrameOutput::finish()
{
  this->wait();
  std::vector<FinishedFile> all;
  for (const Lane& lane : this->Lanes)
  {
    all.insert(all.end(), lane.finished.begin(), lane.finished.end());
  }
  return all;
}

} // namespace dgtk
