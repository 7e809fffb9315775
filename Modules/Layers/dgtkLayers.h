// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayers_h
#define dgtkLayers_h

#include "dgtkBand.h"
#include "dgtkLayerSink.h"
#include "dgtkSceneQueries.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkPlan.h"

#include "dgtkDatasetDocuments.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

class Layer;

/// What the passes of a job may use. What it refers to outlives them.
struct JobContext
{
  const WorkPlan& plan;
  Job job;
  std::string camera; ///< its name
  std::shared_ptr<const SceneState> state;
  View view;
  SceneQueries& queries; ///< other frames and cameras
  ThreadPool& pool;
};

/// Derives the outputs of one or several layers from the bands of one picture, which arrive top to bottom. But for
/// those of layers that need the whole, they may be some of its rows only, next to one another: what looks at
/// neighbours takes the outermost ones for the picture's edge. One thread at a time.
class LayerPass
{
public:
  virtual ~LayerPass() = default;
  /// The next band; holds what the layers need.
  virtual void band(const Band&, LayerSink&) {}
  /// After the last band.
  virtual void finish(LayerSink&) {}
};

/// A layer and those of a pass's outputs that are its own; they follow those of the layer before.
struct PassLayer
{
  const Layer& layer;
  const PlannedLayer& planned;
  std::vector<LayerOutput> outputs;
};

/// Where a run keeps what the pictures of a layer share.
struct SharedPlace
{
  std::function<std::string()> folder; ///< gives the dataset's folder
  /// To be told of a file, relative to the folder, before it is written.
  std::function<void(const std::string& name)> announce;
};

/// A kind of image or document of a picture (one camera at one frame): what it needs, what it gives, and how. Stateless
/// and thread-safe. One file; one row `dgtk_layer(...)` in CMakeLists.txt registers it.
class DGTKLAYERS_EXPORT Layer
{
public:
  virtual ~Layer() = default;
  /// Name, file formats (the first is the default) and one sentence.
  virtual LayerInfo info() const = 0;
  virtual LayerNeeds needs(const LayerRequest&, const Stage&) const = 0;
  /// Throws UsageError for a request that it cannot fulfil.
  virtual void check(const WorkPlan&, const Stage&, const PlannedLayer&) const {}
  /// What the manifest says of its images in a format; several where it has several, none where it has no image of its
  /// own.
  virtual std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const = 0;
  /// Its own options, besides its file formats. They live as long as the program.
  virtual std::vector<const OptionRow*> options() const { return {}; }
  /// Keys and values about the noise of sensors, besides the scene; they stand last, each once.
  virtual std::vector<std::pair<std::string, std::string>> noise(const WorkPlan&, const Stage&) const { return {}; }
  /// What a job has of it, each once; nothing where it lacks something else than a linear projection (outputsOf()).
  virtual std::vector<LayerOutput> outputs(const WorkPlan&, const Stage&, const Job&, const PlannedLayer&) const = 0;
  /// What a picture needs to have it, to follow "needs"; "" where none is without but by design.
  virtual std::string requirement() const { return {}; }
  /// What deserves a word before a run of it, lines.
  virtual std::vector<std::string> notes(const WorkPlan&, const Stage&) const { return {}; }
  /// Made once a run, before the first picture: what all its passes share. Null for nothing.
  virtual std::shared_ptr<void> makeShared(const SharedPlace&) const { return nullptr; }
  /// Files of the dataset that a finished file of the layer needs and that other pictures may need, too, relative to
  /// the dataset.
  virtual std::vector<std::string> sharedFiles(const std::string& /*path*/) const { return {}; }
  /// Layers with the same key are made by one pass, that of the first of them.
  virtual std::string passKey() const { return this->info().layer; }
  /// For layers that have outputs.
  virtual std::unique_ptr<LayerPass> makePass(const JobContext&, const std::vector<PassLayer>&) const = 0;
};

using LayerList = std::vector<std::shared_ptr<const Layer>>;

/// The layer that is the picture itself.
extern DGTKLAYERS_EXPORT const char* const pictureLayer;

/// All layers, in the order of "all".
DGTKLAYERS_EXPORT const LayerList& layers();

/// Adds layers of a program of its own, after all others; before anything asks for layers or options:
/// `const bool added = addLayers({ std::make_shared<Curvature>() });` beside the class is a row. True.
DGTKLAYERS_EXPORT bool addLayers(const LayerList& more);

/// Layers of a job that are made by one pass.
struct DGTKLAYERS_EXPORT PlannedPass
{
  std::vector<PassLayer> layers;
  bool readsColor = false;
  std::vector<LayerOutput> outputs() const;
};
/// What has to be done for a job, in the order of its layers.
DGTKLAYERS_EXPORT std::vector<PlannedPass> passesOf(const WorkPlan& plan, const Stage& stage, const Job& job);

/// What a job has of a layer of the plan.
DGTKLAYERS_EXPORT std::vector<LayerOutput> outputsOf(
  const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned);

/// What a job needs to have a layer of the plan, to follow "needs"; "" where none is without but by design.
DGTKLAYERS_EXPORT std::string requirementOf(const WorkPlan& plan, const Job& job, const PlannedLayer& planned);

/// All outputs of a job, in the order of its layers.
DGTKLAYERS_EXPORT std::vector<LayerOutput> outputsOf(const WorkPlan& plan, const Stage& stage, const Job& job);

/// An image output of the size of the job's picture.
DGTKLAYERS_EXPORT LayerOutput imageOutput(const WorkPlan& plan, const Stage& stage, const Job& job,
  const LayerSpec& spec, const std::vector<std::string>& formats);
/// Name of the option of a layer's file formats.
DGTKLAYERS_EXPORT std::string formatOption(const std::string& layer);

/// A document of a picture; its format is its extension.
DGTKLAYERS_EXPORT LayerOutput documentOutput(
  const Stage& stage, const Job& job, const LayerSpec& spec, const std::string& format);

} // namespace dgtk

#endif
