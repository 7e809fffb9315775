// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWorkPlan_h
#define dgtkWorkPlan_h

#include "dgtkLayerRequest.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkStage.h"

#include <cstdint>
#include <memory>
#include <set>
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

/// What layers read of a picture; nothing else is drawn.
struct DGTKLAYERS_EXPORT LayerNeeds
{
  bool hits = false;                 ///< Band::hits
  bool color = false;                ///< Band::rgb
  bool sharp = false;                ///< Band::sharp
  bool peeled = false;               ///< Band::peeled
  bool samples = false;              ///< several points a pixel
  bool whole = false;                ///< all rows, from the top: not some of them only
  bool linear = false;               ///< cameras with a linear() projection, as what is drawn does
  std::vector<std::uint32_t> mattes; ///< objects of Band::mattes

  static LayerNeeds ofHits();
  static LayerNeeds ofColor();
  static LayerNeeds ofLinear();
  /// Adds what others need; mattes are those of one layer.
  void add(const LayerNeeds& more);
};

class Layer;

/// A layer of a plan and its file formats.
struct PlannedLayer
{
  std::shared_ptr<const Layer> layer;
  std::vector<std::string> formats;
  bool linear = false;          ///< LayerNeeds::linear
  std::shared_ptr<void> shared; ///< Layer::makeShared(), for a run with files
};

/// A request, checked and resolved against its scene. Depends on nothing else.
struct DGTKLAYERS_EXPORT WorkPlan
{
  LayerRequest request;
  std::vector<PlannedLayer> layers; ///< in the order of generatorLayers()
  LayerNeeds needs;                 ///< of all of them
  bool raster = false;              ///< engine of the visibility buffer: raster or ray
  bool drawn = false;               ///< OpenGL makes the colours; else, but for POV-Ray's, rays do
  /// What decides the noise of the noisy layers, besides the scene.
  std::vector<std::pair<std::string, std::string>> noise;
  std::vector<Job> jobs;
  std::set<std::size_t> curved;   ///< cameras without a linear() projection, or with a rolling shutter
  std::vector<EmptyRecord> empty; ///< layers that some pictures do not have

  bool drawsColor() const { return this->needs.color || this->needs.sharp; }
  /// File formats of a layer; empty when it is not asked for.
  std::vector<std::string> formatsOf(const std::string& layer) const;
  /// Relative path of a file of the dataset, without extension.
  static std::string stem(const std::string& camera, const std::string& layer, int frame);
};

/// Whether a built-in renderer makes the colours, if any are made: OpenGL or rays.
DGTKLAYERS_EXPORT bool drawsItself(const LayerRequest& request);

/// Whether colours or ids may come from OpenGL, whatever the layers are; nothing else starts it.
DGTKLAYERS_EXPORT bool mayUseOpenGL(const LayerRequest& request);

/// Throws UsageError for a request that does not fit the scene.
DGTKLAYERS_EXPORT WorkPlan makeWorkPlan(const LayerRequest& request, const Stage& stage);

/// The request as ordered key and value pairs: what the manifest records and what decides whether a run can be resumed.
DGTKLAYERS_EXPORT std::vector<std::pair<std::string, std::string>> describeRequest(
  const WorkPlan& plan, const Stage& stage);

/// File name extension of a format, without the dot. A format that is no image's is its extension.
DGTKLAYERS_EXPORT std::string formatExtension(const std::string& format);

} // namespace dgtk

#endif
