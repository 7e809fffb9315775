// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMovingObjects.h"

#include "dgtkExportPng.h"

#include <algorithm>
#include <map>
#include <set>

namespace dgtk
{

std::vector<std::uint32_t> movingObjects(const DatasetView& dataset)
{
  std::set<std::uint32_t> ids;
  for (const ObjectRecord& object : dataset.objects())
  {
    if (!object.isStatic)
    {
      ids.insert(object.id);
    }
  }
  std::map<std::uint32_t, bool> there; // at the first frame
  for (const int frame : dataset.frames())
  {
    for (const PoseRecord& pose : dataset.poses(frame))
    {
      if (there.emplace(pose.id, pose.visible).first->second != pose.visible)
      {
        ids.insert(pose.id);
      }
    }
  }
  return { ids.begin(), ids.end() };
}

std::vector<TrackPoint> trackPointsBut(const DatasetView& dataset, const std::vector<std::uint32_t>& ids)
{
  std::vector<TrackPoint> points = dataset.trackPoints();
  for (TrackPoint& point : points)
  {
    point.isStatic = point.isStatic && !std::binary_search(ids.begin(), ids.end(), point.object);
  }
  return points;
}

void writeMovingMask(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& name,
  const std::vector<std::uint32_t>& ids, bool standing)
{
  constexpr std::uint32_t white = 255;
  std::map<std::uint32_t, std::uint32_t> codes{ { 0, standing ? white : 0 } };
  for (const ObjectRecord& object : dataset.objects())
  {
    const bool named = std::find(ids.begin(), ids.end(), object.id) != ids.end();
    codes[object.id] = named != standing ? white : 0;
  }
  writeIdPng(sink, dataset, shot, "objects", name, codes);
}

} // namespace dgtk
