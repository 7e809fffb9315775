// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportSeries.h"

#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"

namespace dgtk
{

ExportSeries seriesOf(const DatasetView& dataset, const std::vector<std::uint32_t>& shots, const ShotItem& item)
{
  return { shots.size(), [&dataset, shots, item](std::size_t i) { return item(dataset.shots()[shots[i]], i); } };
}

ExportSeries seriesOf(const DatasetView& dataset, const std::string& camera, const ShotItem& item)
{
  return seriesOf(dataset, shotNumbers(dataset, camera), item);
}

ExportSeries seriesOf(const ExportItem& item)
{
  return { 1, [item](std::size_t) { return item; } };
}

std::vector<std::uint32_t> shotNumbers(const DatasetView& dataset, const std::string& camera)
{
  std::vector<std::uint32_t> numbers;
  for (const DatasetShot* shot : dataset.shotsOf(camera))
  {
    numbers.push_back(static_cast<std::uint32_t>(shot->index));
  }
  return numbers;
}

ExportItem named(const DatasetShot& shot, ExportItem item)
{
  item.names.push_back({ shot.name(), shot.frame(), item.files.at(0) });
  return item;
}

ExportSeries namesOf(const DatasetView& dataset, const std::vector<std::uint32_t>& shots,
  const std::function<std::string(const DatasetShot&)>& name)
{
  return seriesOf(dataset, shots,
    [name](const DatasetShot& shot, std::size_t) {
      return ExportItem{ {}, [](ExportSink&) {}, { { shot.name(), shot.frame(), name(shot) } } };
    });
}

void requireUsualSplits(const DatasetView& dataset, const OptionValues& options, const std::string& format)
{
  for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
  {
    if (split.name != "train" && split.name != "val" && split.name != "test")
    {
      throw UsageError("split: parts of " + format + " are train, val and test, found " + split.name);
    }
  }
}

void writeNotes(ExportSink& sink, ExportFile& file, const std::string& key)
{
  const char* between = "\n  ";
  sink.notes(key,
    [&](const std::string& note)
    {
      file.write(between + note);
      between = ",\n  ";
    });
}

} // namespace dgtk
