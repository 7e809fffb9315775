// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameOutput_h
#define dgtkFrameOutput_h

#include "dgtkMattingSource.h"
#include "dgtkSerialQueue.h"
#include "dgtkWorkPlan.h"

#include "dgtkLayerWriter.h"
#include "dgtkRasterSource.h"
#include "dgtkVisibility.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

/// A horizontal band of an image: one row of canonical tiles, full width.
struct Band
{
  PixelRect rect;
  std::vector<Hit> hits;    ///< empty when no representation is asked for
  std::vector<float> rgb;   ///< empty when no colour is asked for; display-referred
  std::vector<float> sharp; ///< colours of the frame's own instant and the lens's centre; empty unless asked for
  /// Surfaces behind one another as OpenGL peels them, for each tile from left to right the ranks from near to far;
  /// empty unless asked for.
  std::vector<std::vector<SurfaceLayer>> peeled;
  std::vector<MattePixels> mattes; ///< one for each of FrameSourceOptions::mattes
};

/// A band as drawing leaves it.
class DrawnBand
{
public:
  Band band;
  std::function<void()> rest = [] {}; ///< to be done until `band` is whole; waits for no other job

  std::function<void()> color = [] {}; ///< to be done until Band::rgb is there, where that takes longer than the rest

  /// Does the rest when it is called first, in whichever thread. With `colored`, Band::rgb is there as well.
  const Band& whole(bool colored = true)
  {
    std::call_once(this->Once, this->rest);
    if (colored)
    {
      std::call_once(this->ColorOnce, this->color);
    }
    return this->band;
  }

private:
  std::once_flag Once;
  std::once_flag ColorOnce;
};

/// A file of the dataset that is complete.
struct FinishedFile
{
  FileRecord record; ///< its path is relative to the dataset's folder
  std::string layer;
  bool shared = false; ///< of no camera and frame; other jobs may have finished it, too
};

/// The files of one lane: layers that are written by one job at a time.
class OutputLane
{
public:
  virtual ~OutputLane() = default;
  virtual void write(const Band& band) = 0;
  virtual std::vector<FinishedFile> finish() = 0;
};

/// Derives and writes all image files of one job while its bands arrive, top to bottom. The work is done by the pool;
/// submit() returns at once.
class FrameOutput
{
public:
  explicit FrameOutput(const struct JobContext& context);

  void submit(const std::shared_ptr<DrawnBand>& band);
  /// Waits for everything submitted; rethrows what failed.
  void wait();
  /// Waits and completes the files. To be called once, after the last band.
  std::vector<FinishedFile> finish();

private:
  void addLane(std::unique_ptr<OutputLane> lane, bool readsColor);
  ThreadPool& Pool;
  std::vector<bool> ReadsColor; // one a lane
  std::vector<std::unique_ptr<OutputLane>> Lanes;
  std::vector<std::unique_ptr<SerialQueue>> Queues; // one a lane; destroyed first: they wait for their jobs
};

} // namespace dgtk

#endif
