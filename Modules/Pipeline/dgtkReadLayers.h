// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadLayers_h
#define dgtkReadLayers_h

// Private to Pipeline.

#include "dgtkArraySink.h"
#include "dgtkDatasetView.h"

#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// The layers of which some picture has a file, in the order of the registry, and the names of their outputs.
std::vector<std::pair<std::string, std::vector<std::string>>> layersOf(const DatasetView& dataset);

/// Layers of a picture, or single outputs, each once, as ArraySink gives them. Throws UsageError for what the picture
/// does not have, and InputError for files that cannot be read or have another size than the picture.
std::vector<LayerArray> readLayers(
  const DatasetView& dataset, const DatasetShot& shot, const std::vector<std::string>& names);

} // namespace dgtk

#endif
