// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExporter.h"

#include <set>
#include <utility>

namespace dgtk
{

void ExportSink::write(const std::string& name, const std::string& bytes, const ExportedPixels& pixels)
{
  const std::unique_ptr<ExportFile> file = this->open(name, pixels);
  file->write(bytes);
  file->finish();
}

void Exporter::check(const DatasetView&, const OptionValues&) const {}

ExportPlan Exporter::planScenes(const std::vector<const DatasetView*>& scenes, const OptionValues& options) const
{
  ExportPlan all;
  std::set<std::string> documents;
  for (const DatasetView* scene : scenes)
  {
    ExportPlan plan = this->plan(*scene, options);
    for (ExportItem& item : plan.items)
    {
      item.dataset = scene;
      all.items.push_back(std::move(item));
    }
    for (ExportSeries& series : plan.series)
    {
      all.series.push_back({ series.count, [scene, make = std::move(series.item)](std::size_t i)
        {
          ExportItem item = make(i);
          item.dataset = scene;
          return item;
        } });
    }
    for (ExportItem& document : plan.documents)
    {
      if (documents.insert(document.files.at(0)).second)
      {
        document.dataset = scene;
        all.documents.push_back(std::move(document));
      }
    }
    all.names.insert(all.names.end(), plan.names.begin(), plan.names.end());
    all.warnings.insert(all.warnings.end(), plan.warnings.begin(), plan.warnings.end());
    all.conventions = std::move(plan.conventions);
  }
  return all;
}

} // namespace dgtk
