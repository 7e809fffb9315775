// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleRun_h
#define dgtkSampleRun_h

#include "dgtkSamplingModule.h"

#include "dgtkError.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace dgtk
{

/// Samples [first, last] of a random scene as files.
struct SampleRequest
{
  std::string scene;
  std::string folder;
  int first = 0;
  int last = 0;                      ///< included, at most largestSample
  std::optional<std::uint64_t> seed; ///< instead of the scene's
  bool replace = false;              ///< samples of an earlier run go
  int threads = 1;
};

struct SampleCallbacks
{
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress; ///< called by one thread at a time
};

struct SampleResult
{
  std::size_t written = 0;
  std::size_t refused = 0;
  std::size_t leftOut = 0; ///< objects and cameras
  bool interrupted = false;
};

/// The folder holds something that is in the way; `mayBeReplaced`: samples of an earlier run.
class DGTKSAMPLING_EXPORT SampleFolderError : public UsageError
{
public:
  SampleFolderError(const std::string& message, bool mayBeReplaced)
    : UsageError(message)
    , MayBeReplaced(mayBeReplaced)
  {
  }
  bool mayBeReplaced() const { return this->MayBeReplaced; }

private:
  bool MayBeReplaced;
};

/// Writes FOLDER/<six digits>.json for each sample that is not refused, and FOLDER/samples.json last
/// (Documentation/Formats/samples.md). The same bytes with any number of threads, and where an interrupted run of the
/// same samples was before. Throws what Sampler throws, and
/// SampleFolderError before anything is written.
DGTKSAMPLING_EXPORT SampleResult writeSamples(const SampleRequest& request, const SampleCallbacks& callbacks = {});

} // namespace dgtk

#endif
