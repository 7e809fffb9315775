// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportSeries_h
#define dgtkExportSeries_h

// Private to Export: plans of many pictures that hold a few bytes a picture.

#include "dgtkExporter.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// The item of a shot that is at some place among those of a series, from 0.
using ShotItem = std::function<ExportItem(const DatasetShot& shot, std::size_t place)>;

/// An item for each of some shots, by their numbers.
ExportSeries seriesOf(const DatasetView& dataset, const std::vector<std::uint32_t>& shots, const ShotItem& item);
/// For each shot of a camera.
ExportSeries seriesOf(const DatasetView& dataset, const std::string& camera, const ShotItem& item);
/// Of one item, between others.
ExportSeries seriesOf(const ExportItem& item);

/// Numbers of the shots of a camera, in their order.
std::vector<std::uint32_t> shotNumbers(const DatasetView& dataset, const std::string& camera);

/// The item, and that the format calls the shot as the item's first file.
ExportItem named(const DatasetShot& shot, ExportItem item);
/// What a format that has many pictures in a file calls each: items without files.
ExportSeries namesOf(const DatasetView& dataset, const std::vector<std::uint32_t>& shots,
  const std::function<std::string(const DatasetShot&)>& name);

/// Throws UsageError for another part than train, val and test.
void requireUsualSplits(const DatasetView& dataset, const OptionValues& options, const std::string& format);
/// The notes of a key, elements of a list in JSON, a line each.
void writeNotes(ExportSink& sink, ExportFile& file, const std::string& key);

} // namespace dgtk

#endif
