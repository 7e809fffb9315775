// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameOutput_h
#define dgtkFrameOutput_h

#include "dgtkDrawnBand.h"
#include "dgtkFileSink.h"
#include "dgtkLayers.h"
#include "dgtkSerialQueue.h"

#include <functional>
#include <memory>
#include <vector>

namespace dgtk
{

/// Derives and writes all files of one job while its bands arrive, top to bottom, and completes them after the last.
/// The work is done by the pool; submit() returns at once.
class FrameOutput
{
public:
  /// `folder`: the dataset. `bands`: how many are going to be submitted.
  FrameOutput(const std::string& folder, const JobContext& context, int bands);

  void submit(const std::shared_ptr<DrawnBand>& band);
  /// Waits for everything submitted; rethrows what failed.
  void wait();
  /// Whether finish() need not wait.
  bool isDone() const;
  /// Waits until the files are complete. To be called once, after the last band.
  std::vector<FinishedFile> finish();

private:
  /// A pass and where it goes.
  struct Lane
  {
    std::unique_ptr<LayerPass> pass;
    std::unique_ptr<FileSink> sink;
    bool readsColor = false;
    std::vector<FinishedFile> finished;
  };
  void complete();
  void toLanes(const std::function<void(Lane&)>& job);

  int Missing; ///< bands
  std::vector<Lane> Lanes;
  std::vector<std::unique_ptr<SerialQueue>> Queues; // one a lane; destroyed before them: they wait for their jobs
  SerialQueue Whole;                                // makes bands whole, and gives them to the lanes
};

} // namespace dgtk

#endif
