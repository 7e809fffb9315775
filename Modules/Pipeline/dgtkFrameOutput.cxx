// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameOutput.h"

#include "dgtkFrameLayers.h"
#include "dgtkOutputLanes.h"

#include <exception>

namespace dgtk
{

FrameOutput::FrameOutput(const JobContext& context)
  : Pool(context.pool)
{
  const WorkPlan& plan = context.plan;
  const Job& job = context.job;
  const std::string& camera = context.camera;
  const View& view = context.view;
  for (const std::string& format : plan.colorFormats)
  {
    this->addLane(makeColorLane(plan, job, camera, view, format), true);
  }
  if (plan.tiles)
  {
    this->addLane(makeTilesLane(plan, job, camera, view), true);
  }
  if (!plan.representations.empty())
  {
    this->addLane(makeGeometryLane(plan, job, camera, context.state, view, context.pool), false);
  }
  for (const PlannedFrameLayer& planned : plan.frameLayers)
  {
    if (!planned.layer->files(plan, context.queries.stage(), job).empty())
    {
      this->addLane(planned.layer->makeLane(context), planned.layer->needsColor());
    }
  }
}

void FrameOutput::addLane(std::unique_ptr<OutputLane> lane, bool readsColor)
{
  this->ReadsColor.push_back(readsColor);
  this->Lanes.push_back(std::move(lane));
  this->Queues.push_back(std::make_unique<SerialQueue>(this->Pool));
}

void FrameOutput::submit(const std::shared_ptr<DrawnBand>& band)
{
  for (std::size_t i = 0; i < this->Lanes.size(); ++i)
  {
    OutputLane* lane = this->Lanes[i].get();
    this->Queues[i]->submit([lane, band, colored = this->ReadsColor[i]] { lane->write(band->whole(colored)); });
  }
}

void FrameOutput::wait()
{
  // For all of them, also after a failure: what they write to may end with the caller.
  std::exception_ptr failure;
  for (const auto& queue : this->Queues)
  {
    try
    {
      queue->wait();
    }
    catch (...)
    {
      failure = failure ? failure : std::current_exception();
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

std::vector<FinishedFile> FrameOutput::finish()
{
  // the last encoding (PNG compresses at the end) is work for the pool as well
  std::vector<std::vector<FinishedFile>> finished(this->Lanes.size());
  for (std::size_t i = 0; i < this->Lanes.size(); ++i)
  {
    OutputLane* lane = this->Lanes[i].get();
    this->Queues[i]->submit([lane, out = &finished[i]] { *out = lane->finish(); });
  }
  this->wait();
  std::vector<FinishedFile> all;
  for (std::vector<FinishedFile>& files : finished)
  {
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

} // namespace dgtk
