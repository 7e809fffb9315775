// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkContactSheet_h
#define dgtkContactSheet_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"

#include <string>

namespace dgtk
{

struct ContactSheetOptions
{
  int thumbnailWidth = 200; ///< pixels; heights follow the first image's shape
  int maxFrames = 6;        ///< evenly chosen, the first and the last among them
  int maxCameras = 8;       ///< the first ones
};

/// Draws the images of the dataset in `folder` into one PNG: a row for each camera and frame, a column for each layer.
/// Depth is drawn in colours from near (bright) to far, ids in distinct colours, vectors as red, green and blue.
/// `path` is relative to the folder, as in the returned record, or absolute. Throws InputError for a file that cannot
/// be read.
DGTKDATASETIO_EXPORT DatasetFile writeContactSheet(const std::string& folder, const Manifest& manifest,
  const std::string& path, const ContactSheetOptions& options = {});
/// The same by the folder's manifest.json.
DGTKDATASETIO_EXPORT DatasetFile writeContactSheet(
  const std::string& folder, const std::string& path, const ContactSheetOptions& options = {});

} // namespace dgtk

#endif
