// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovColorSource_h
#define dgtkPovColorSource_h

// Private to Pipeline.

#include "dgtkPovRenderOptions.h"

#include "dgtkLayer.h"
#include "dgtkPovExport.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

class ThreadPool;

struct PovColorSettings
{
  OptionValues options;
  std::string folder; ///< a folder `.povray` in it is made, and removed at the end
  int samples = 1;    ///< where the options do not say how many points
  const std::atomic<bool>* cancel = nullptr;
};

/// Colours by POV-Ray. Images are drawn in ranges of rows that depend on their size only, each by a process of its own
/// on one thread; with radiosity or focal blur in one piece. setScene() and colorOf() to be used from one thread.
class PovColorSource
{
public:
  /// Throws MachineError without POV-Ray.
  PovColorSource(const PovColorSettings& settings, ThreadPool& pool);
  ~PovColorSource();

  void setScene(const std::shared_ptr<const SceneState>& state, const View& view);
  /// Draws rows of the current scene when it is called: RGB float32, display-referred, of full-width rows. May be
  /// called on any thread, while this source goes on. Throws what PovRunner::run() throws.
  std::function<std::vector<float>()> colorOf(const PixelRect& band);

private:
  struct Studio;
  struct Picture;
  std::shared_ptr<Studio> Self;
  std::shared_ptr<Picture> Current;
};

} // namespace dgtk

#endif
