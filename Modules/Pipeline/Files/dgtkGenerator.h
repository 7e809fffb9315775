// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGenerator_h
#define dgtkGenerator_h

#include "dgtkPipelineModule.h"

#include "dgtkFolderContents.h"
#include "dgtkLayerRequest.h"
#include "dgtkRequestOptions.h"
#include "dgtkSceneDescription.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

class RunSession;

/// Consecutive pictures of a run that is made in parts: each part is like a dataset, in a folder of its own; the first
/// one has the documents of the whole.
struct RunBlock
{
  std::string folder;    ///< partName() below the run's
  std::size_t first = 0; ///< among the run's pictures
  std::size_t count = 0;
};

/// A dataset: what it holds, which is all that decides its bytes, and how the run is made.
struct GeneratorRequest : LayerRequest
{
  std::string scene;                           ///< path of a .scene or .json file
  std::optional<SceneDescription> description; ///< instead of `scene`; its own `file` is empty
  std::vector<ClassDescription> classes;       ///< numbers of the classes of a scene that fixes none; empty: its own
  std::string folder;                          ///< where the dataset goes
  bool resume = false;                         ///< keep the finished files of an interrupted run of the same request
  bool replace = false; ///< remove what another request, or an interrupted run, has left; not with resume
  std::shared_ptr<RunSession> session; ///< what it shares with other runs, see makeRunSession(); null: nothing
  std::optional<RunBlock> block;       ///< only these pictures, as a part of the dataset in `folder`
};

/// State of a run, reported at its start and after every finished picture (one camera at one frame).
struct GeneratorProgress
{
  std::size_t done = 0;
  std::size_t total = 0;
  std::size_t kept = 0; ///< of those that are done, from an interrupted run
};

struct GeneratorResult
{
  std::size_t pictures = 0; ///< camera x frame
  std::size_t files = 0;
  std::size_t kept = 0;      ///< pictures kept from an interrupted run
  std::string visibility;    ///< engine used: "raster" or "ray"
  std::string glDescription; ///< one line, empty when OpenGL was not used
  bool interrupted = false;  ///< stopped by `cancel`; a run with resume completes the dataset
  std::vector<std::string> warnings;
};

struct GeneratorCallbacks
{
  std::function<void(const GeneratorProgress&)> progress; ///< called from the calling thread
  std::function<void(const std::string&)> message;        ///< one line: engine chosen, warnings
  const std::atomic<bool>* cancel = nullptr;              ///< checked between rows of tiles, and while POV-Ray draws
};

/// What names a request in the manifest's `request_hash`: everything that decides the bytes of its files, the contents
/// of the files that its scene names included, and how its folder stands to them. Loads the scene with its models,
/// which takes as long as it takes. Throws UsageError and InputError.
DGTKPIPELINE_EXPORT std::string requestHash(const GeneratorRequest& request);

/// What runs that follow one another may share: models, pictures, trees for rays, threads.
DGTKPIPELINE_EXPORT std::shared_ptr<RunSession> makeRunSession();

/// Renders the dataset. Throws FolderError, before anything is changed, when the folder holds an interrupted run or the
/// dataset of another request and neither `resume` nor `replace` applies, and in any case when it holds somebody's
/// files (see folderContents()); else UsageError, InputError or MachineError. What was finished before stays and can be
/// resumed.
DGTKPIPELINE_EXPORT GeneratorResult generate(const GeneratorRequest& request, const GeneratorCallbacks& callbacks = {});

} // namespace dgtk

#endif
