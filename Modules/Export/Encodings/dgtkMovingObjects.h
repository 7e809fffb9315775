// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMovingObjects_h
#define dgtkMovingObjects_h

// Private to Export: what formats of scenes that stand still do with the rest.

#include "dgtkExporter.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// Ids, sorted, of the objects that do not stay at all frames of the scene, deform, or are there at some of the shots'
/// frames alone.
std::vector<std::uint32_t> movingObjects(const DatasetView& dataset);

/// The dataset's points of tracks; those on objects with one of the sorted ids are not static.
std::vector<TrackPoint> trackPointsBut(const DatasetView& dataset, const std::vector<std::uint32_t>& ids);

/// A gray PNG of 8 bits: 255 where the layer `objects` has one of the ids, 0 elsewhere; `standing`: the other way
/// round.
void writeMovingMask(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& name,
  const std::vector<std::uint32_t>& ids, bool standing);

} // namespace dgtk

#endif
