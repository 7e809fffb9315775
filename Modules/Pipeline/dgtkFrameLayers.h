// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameLayers_h
#define dgtkFrameLayers_h

#include "dgtkFrameOutput.h"
#include "dgtkSceneQueries.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkFile.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// What the lanes of a job may use. What it refers to outlives them.
struct JobContext
{
  const WorkPlan& plan;
  Job job;
  std::string camera; ///< its name
  std::shared_ptr<const SceneState> state;
  View view;
  SceneQueries& queries; ///< other frames and cameras
  ThreadPool& pool;

  /// Where a file of the dataset goes.
  FilePlace path(const std::string& name) const { return { this->plan.request.folder, name }; }
};

/// A layer that needs more than a pixel of one visibility buffer: neighbours, other views, samples, objects. Stateless;
/// one row of the table in dgtkFrameLayers.cxx.
class FrameLayer
{
public:
  virtual ~FrameLayer() = default;
  /// Name, file formats (the first is the default) and one sentence.
  virtual LayerInfo info() const = 0;
  /// Throws UsageError for a request that it cannot fulfil.
  virtual void check(const WorkPlan&, const Stage&) const {}
  /// What the manifest says of its files in a format; several where a layer has several images.
  virtual std::vector<LayerRecord> specs(const std::string& format) const = 0;
  /// The same, for a layer whose specification depends on the request.
  virtual std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const
  {
    return this->specs(format);
  }
  /// Options of the request that decide its files, for the manifest and for resuming.
  virtual std::vector<std::pair<std::string, std::string>> options(const GeneratorRequest&) const { return {}; }
  /// Whether its lane reads Band::peeled.
  virtual bool needsPeeling() const { return false; }
  /// Whether its lane reads Band::rgb.
  virtual bool needsColor() const { return false; }
  /// Whether its lane reads Band::sharp.
  virtual bool needsSharpColor() const { return false; }
  /// Every file that a job writes, relative to the dataset; empty when the job has none.
  virtual std::vector<std::string> files(const WorkPlan&, const Stage&, const Job&) const = 0;
  /// Files of the dataset that a finished file of the layer needs and that other jobs may need, too, relative to the
  /// dataset.
  virtual std::vector<std::string> sharedFiles(const std::string& /*path*/) const { return {}; }
  /// What deserves a word before a run of it, one line; "" for nothing.
  virtual std::string note(const WorkPlan&) const { return {}; }
  /// What a picture needs to have files of the layer, to follow "needs"; "" where none is without but by design.
  virtual std::string needs() const { return {}; }
  /// The lane that writes them; called for jobs that have files.
  virtual std::unique_ptr<OutputLane> makeLane(const JobContext&) const = 0;
};

/// All frame layers, in the order of `--layers all`.
const std::vector<std::shared_ptr<const FrameLayer>>& frameLayers();

} // namespace dgtk

#endif
