// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMovingObjects.h"

#include "dgtkExportPng.h"

#include <algorithm>

namespace dgtk
{

std::vector<std::uint32_t> movingObjects(const DatasetView& dataset)
{
  std::vector<std::uint32_t> ids;
  for (const ObjectRecord& object : dataset.objects())
  {
    if (!object.isStatic)
    {
      ids.push_back(object.id);
    }
  }
  return ids;
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
