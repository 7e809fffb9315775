// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameOutput_h
#define dgtkFrameOutput_h

#include "dgtkDrawnBand.h"
#include "dgtkFileSink.h"
#include "dgtkLayers.h"
#include "dgtkSerialQueue.h"

#include <memory>
#include <vector>

namespace dgtk
{

/// Derives and writes all files of one job while its bands arrive, top to bottom. The work is done by the pool;
/// submit() returns at once.
class FrameOutput
{
public:
  /// `folder`: the dataset.
  FrameOutput(const std::string& folder, const JobContext& context);

  void submit(const std::shared_ptr<DrawnBand>& band);
  /// Waits for everything submitted; rethrows what failed.
  void wait();
  /// Waits and completes the files. To be called once, after the last band.
  std::vector<FinishedFile> finish();

private:
  /// A pass and where it goes.
  struct Lane
  {
    std::unique_ptr<LayerPass> pass;
    std::unique_ptr<FileSink> sink;
    bool readsColor = false;
  };
  ThreadPool& Pool;
  std::vector<Lane> Lanes;
  std::vector<std::unique_ptr<SerialQueue>> Queues; // one a lane; destroyed first: they wait for their jobs
};

} // namespace dgtk

#endif
