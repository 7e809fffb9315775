// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKeptSource_h
#define dgtkKeptSource_h

// Private to Pipeline.

#include "dgtkFrameSource.h"
#include "dgtkThreadPool.h"
#include "dgtkTracedQueries.h"

#include <functional>
#include <memory>

#include <sys/types.h>

namespace dgtk
{

/// What draws, kept from picture to picture; for any thread, and for processes forked from the one that made it.
class KeptSource
{
public:
  ~KeptSource() { this->drop(); }
  /// For draw(), what does the drawing, queries of the stage, and threads.
  using Draw = std::function<void(FrameSource&, SceneQueries&, ThreadPool&)>;
  void use(const FrameSourceOptions& options, const std::shared_ptr<const Stage>& stage, const Draw& draw);

private:
  void drop();
  void leaveInherited();

  pid_t Process = 0; // that of the members below
  std::unique_ptr<ThreadPool> Pool;
  FrameSourceOptions Options; // of Source
  std::unique_ptr<FrameSource> Source;
  std::shared_ptr<const Stage> Scene; // of Queries
  std::unique_ptr<TracedQueries> Queries;
};

} // namespace dgtk

#endif
