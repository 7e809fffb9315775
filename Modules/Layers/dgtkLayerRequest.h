// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerRequest_h
#define dgtkLayerRequest_h

#include "dgtkLayersModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkRequestOptions.h"

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

/// What is to be made of a scene.
struct LayerRequest
{
  std::vector<std::string> layers;  ///< names of generatorLayers(); empty: the usual ones
  std::vector<std::string> cameras; ///< names; empty: all
  std::optional<FrameRange> frames; ///< none: every frame of the scene
  int width = 0;                    ///< pixels; 0: the camera's own size, or 640 x 480
  int height = 0;
  OptionValues options; ///< of allOptions(): `options["points_step"] = "2"`
  std::string picture;  ///< the only camera that is drawn, beside others that it is related to; empty: all are
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
/// Every layer that can be asked for, in the order of "all".
DGTKLAYERS_EXPORT std::vector<LayerInfo> generatorLayers();

} // namespace dgtk

#endif
