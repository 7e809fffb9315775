// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWorkPlan_h
#define dgtkWorkPlan_h

#include "dgtkGenerator.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkLayer.h"
#include "dgtkRepresentation.h"
#include "dgtkStage.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// One camera at one frame: an independent job of the work plan.
struct Job
{
  std::size_t camera = 0; ///< index into the scene's cameras
  int frame = 0;
};

/// A representation and the files that hold it.
struct PlannedLayer
{
  std::shared_ptr<const Representation> representation;
  LayerSpec spec;
  std::vector<std::string> formats;
};

class FrameLayer;
class PovLibrary;

/// A frame layer and its file formats.
struct PlannedFrameLayer
{
  std::shared_ptr<const FrameLayer> layer;
  std::vector<std::string> formats;
};

/// A request, checked and resolved against its scene. Depends on nothing else.
struct WorkPlan
{
  GeneratorRequest request;
  std::vector<std::string> layers; ///< in the order of generatorLayers()
  std::vector<PlannedLayer> representations;
  std::vector<PlannedFrameLayer> frameLayers;
  std::vector<std::string> colorFormats; ///< "png", "exr"; empty when no colour is written
  bool tiles = false;
  bool calibration = false;
  bool raster = false;          ///< engine of the visibility buffer: raster or ray
  bool layersReadColor = false; ///< some frame layer needs Band::rgb
  /// What decides the noise of the noisy layers, besides the scene.
  std::vector<std::pair<std::string, std::string>> noise;
  std::vector<Job> jobs;
  std::vector<EmptyRecord> empty;         ///< layers that some pictures do not have
  std::shared_ptr<PovLibrary> povLibrary; ///< of the layer pov, for a run with files; null without it

  bool drawsColor() const { return !this->colorFormats.empty() || this->tiles || this->layersReadColor; }
  bool needsHits() const { return !this->representations.empty() || !this->frameLayers.empty(); }
  /// Whether a layer is among those asked for.
  bool has(const std::string& layer) const;
  /// File formats of a frame layer; empty when it is not asked for.
  std::vector<std::string> formatsOf(const std::string& frameLayer) const;
  /// Specification of the colour layer in a format.
  LayerSpec colorSpec(const std::string& format) const;
  /// Relative paths of the files of the tiles layer, in the order in which they are completed.
  std::vector<std::string> tileNames(const std::string& camera, int frame, const CameraModel& model) const;
  /// Relative path of a file of the dataset.
  static std::string fileName(
    const std::string& camera, const std::string& layer, int frame, const std::string& extension);
};

/// Throws UsageError for a request that does not fit the scene.
WorkPlan makeWorkPlan(const GeneratorRequest& request, const Stage& stage);

/// The request as ordered key and value pairs: what the manifest records and what decides whether a run can be resumed.
std::vector<std::pair<std::string, std::string>> describeRequest(const WorkPlan& plan);

/// What the scenes of the layer pov share, in a dataset's folder. `announce` is told the name of each file, relative to
/// it, before it is written.
std::shared_ptr<PovLibrary> makePovLibrary(
  const std::string& folder, const std::function<void(const std::string& name)>& announce);

/// File name extension of a format, without the dot.
std::string formatExtension(const std::string& format);

} // namespace dgtk

#endif
