// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGenerator_h
#define dgtkGenerator_h

#include "dgtkPipelineModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkFolderContents.h"
#include "dgtkRequestOptions.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

struct SceneDescription;

/// Frames first, first + step, ... up to last, included.
struct FrameRange
{
  int first = 0;
  int last = 0;
  int step = 1; ///< >= 1
};

/// What a dataset is to hold. Everything that decides its bytes, and how the run is made.
struct GeneratorRequest
{
  std::string scene;                ///< path of a .scene or .json file
  std::string folder;               ///< where the dataset goes
  std::vector<std::string> layers;  ///< names of generatorLayers(); empty: the usual ones
  std::vector<std::string> cameras; ///< names; empty: all
  std::optional<FrameRange> frames; ///< none: every frame of the scene
  int width = 0;                    ///< pixels; 0: the camera's own size, or 640 x 480
  int height = 0;
  OptionValues options; ///< of requestOptions() and runOptions(): `options["points_step"] = "2"`
  bool resume = false;  ///< keep the finished files of an interrupted run of the same request
  bool replace = false; ///< remove what another request, or an interrupted run, has left; not with resume
};

/// State of a run, reported at its start and after every finished picture (one camera at one frame).
struct GeneratorProgress
{
  std::size_t done = 0;
  std::size_t total = 0;
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

/// One row of the list of layers.
struct LayerInfo
{
  std::string layer;
  std::vector<std::string> formats; ///< the first is the default
  std::string description;
  bool usual = false;         ///< taken where no layers are asked for
  std::string filesOnly = {}; ///< why dgtkRenderer does not give it as arrays; empty: it does
  /// Whether a picture of the scene could have it; null: of any scene.
  bool (*appliesTo)(const SceneDescription& scene) = nullptr;
  std::vector<const OptionRow*> options = {}; ///< its own and that of its formats; set by generatorLayers()
  /// What datasets say of its images, format by format; set by generatorLayers().
  std::vector<LayerRecord> records = {};
};
/// Every layer that can be asked for, in the order of `--layers all`.
DGTKPIPELINE_EXPORT std::vector<LayerInfo> generatorLayers();

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

/// Renders the dataset. Throws FolderError, before anything is changed, when the folder holds an interrupted run or the
/// dataset of another request and neither `resume` nor `replace` applies, and in any case when it holds somebody's
/// files (see folderContents()); else UsageError, InputError or MachineError. What was finished before stays and can be
/// resumed.
DGTKPIPELINE_EXPORT GeneratorResult generate(const GeneratorRequest& request, const GeneratorCallbacks& callbacks = {});

} // namespace dgtk

#endif
