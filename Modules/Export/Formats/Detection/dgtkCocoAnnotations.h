// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCocoAnnotations_h
#define dgtkCocoAnnotations_h

// Private to Export: what COCO's instances, keypoints and panoptic share.

#include "dgtkExporter.h"
#include "dgtkRunLengths.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dgtk::coco
{

using Json = nlohmann::ordered_json;

/// One line; bytes that are not UTF-8 as in all documents.
std::string textOf(const Json& value);

/// "left_000000.png"
std::string pictureName(const DatasetShot& shot, const SafeNames& names, const std::string& extension);
/// Numbers of images and annotations count from 1: COCOeval takes 0 for none.
std::int64_t imageIdOf(const DatasetShot& shot);
std::int64_t annotationIdOf(const DatasetView& dataset, const DatasetShot& shot, std::uint32_t object);
std::string imageText(const DatasetView& dataset, const DatasetShot& shot, const std::string& file);
/// [x, y, width, height]
Json boxOf(const RunLengths& mask);
/// Everything but the segmentation.
Json annotationOf(const DatasetView& dataset, const DatasetShot& shot, std::uint32_t object, const RunLengths& visible);
/// id, name, supercategory of every class.
Json categoriesOf(const DatasetView& dataset);
/// The document of a split: info, licenses, the images of notes "images:SPLIT", the annotations of
/// "`annotations`:SPLIT", these categories.
ExportItem document(const DatasetView& dataset, const std::string& name, const std::string& split,
  const std::string& annotations, const Json& categories);

} // namespace dgtk::coco

#endif
