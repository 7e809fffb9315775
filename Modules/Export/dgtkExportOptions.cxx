// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"

#include "dgtkError.h"
#include "dgtkExporterEntry.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

namespace dgtk
{

namespace exported
{
const NamesOption& cameras()
{
  static const NamesOption row("cameras", "NAMES", "some of the cameras (default: all)");
  return row;
}
const NamesOption& split()
{
  static const NamesOption row(
    "split", "NAME=A:B,...", "parts of the dataset by frames, such as train=0:79,val=80:99 (default: one of all)");
  return row;
}
const NumbersOption& unitMetres()
{
  static const NumbersOption row("unit_metres", "X", 1, 0, "metres of a scene unit, where the dataset does not say it");
  return row;
}
const ChoiceOption& color()
{
  static const ChoiceOption row("color", "LAYER", { "color", "color_sharp", "color_noisy" }, "layer of the pictures");
  return row;
}
const ChoiceOption& depth()
{
  static const ChoiceOption row("depth", "LAYER", { "depth", "depth_noisy" }, "layer of the depth maps");
  return row;
}
const ChoiceOption& imageFormat()
{
  static const ChoiceOption row("image_format", { "png", "jpg" }, "files of the pictures; jpg loses");
  return row;
}
const IntegerOption& quality()
{
  static const IntegerOption row("quality", 95, 1, 100, "of JPEG");
  return row;
}
const ChoiceOption& outOfRange()
{
  static const ChoiceOption row("out_of_range", { "void", "refuse" },
    "what becomes of values that a format has no code for: nothing there, counted; or no export");
  return row;
}
const SwitchOption& undistort()
{
  static const SwitchOption row("undistort", "plain pinholes alone: a camera with a lens gives way to its pinhole twin "
                                             "in the dataset, or is refused with the twin that is needed");
  return row;
}
const SwitchOption& link()
{
  static const SwitchOption row("link", "hard links to the dataset's files where bytes are equal");
  return row;
}
const IntegerOption& threads()
{
  static const IntegerOption row("threads", 0, 0, 1024, "threads to work with (0: all processors)");
  return row;
}
} // namespace exported

const std::vector<const OptionRow*>& exportOptions()
{
  static const std::vector<const OptionRow*> all{ &exported::cameras(), &exported::split(), &exported::unitMetres(),
    &exported::color(), &exported::depth(), &exported::imageFormat(), &exported::quality(), &exported::outOfRange(),
    &exported::undistort(), &exported::link(), &exported::threads() };
  return all;
}

std::vector<const OptionRow*> allExportOptions()
{
  std::vector<const OptionRow*> all = exportOptions();
  std::set<std::string> names;
  for (const OptionRow* row : all)
  {
    names.insert(row->name);
  }
  for (const ExporterRow& row : exporterRows())
  {
    for (const OptionRow* option : row.make()->options())
    {
      if (names.insert(option->name).second)
      {
        all.push_back(option);
      }
    }
  }
  return all;
}

const ExporterRow& findExporter(const std::string& name)
{
  std::vector<std::string> names;
  for (const ExporterRow& row : exporterRows())
  {
    if (row.info.name == name)
    {
      return row;
    }
    names.push_back(row.info.name);
  }
  const std::string near = nearest(name, names);
  throw UsageError("format: there is no exporter " + quoted(name) +
                   (near.empty() ? " (expected one of " + joined(names) + ")" : ", did you mean " + near + "?"));
}

ExportNeeds needsOf(const std::vector<std::string>& formats)
{
  ExportNeeds all;
  std::set<std::string> layers;
  for (const std::string& format : formats)
  {
    const ExportNeeds needs = findExporter(format).make()->needs({});
    layers.insert(needs.layers.begin(), needs.layers.end());
    all.options.insert(needs.options.begin(), needs.options.end());
  }
  all.layers.assign(layers.begin(), layers.end());
  return all;
}

void addNeeds(const std::vector<std::string>& formats, std::vector<std::string>& layers, OptionValues& options)
{
  const ExportNeeds needs = needsOf(formats);
  for (const std::string& layer : needs.layers)
  {
    if (std::find(layers.begin(), layers.end(), layer) == layers.end() && layers != std::vector<std::string>{ "all" })
    {
      layers.push_back(layer);
    }
  }
  options.insert(needs.options.begin(), needs.options.end());
}

namespace
{
[[noreturn]] void refuseSplit(const std::string& what, const std::string& found)
{
  throw UsageError("split: expected " + what + ", found " + quoted(found));
}

int numberIn(const std::string& text, const std::string& part)
{
  int value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size())
  {
    refuseSplit("NAME=A:B", part);
  }
  return value;
}

DatasetSplit splitOf(const std::string& part)
{
  const std::size_t equals = part.find('=');
  const std::size_t colon = equals == std::string::npos ? equals : part.find(':', equals);
  if (equals == 0 || colon == std::string::npos)
  {
    refuseSplit("NAME=A:B", part);
  }
  DatasetSplit split{ part.substr(0, equals), numberIn(part.substr(equals + 1, colon - equals - 1), part),
    numberIn(part.substr(colon + 1), part) };
  SafeNames names;
  if (names.of(split.name) != split.name || split.last < split.first)
  {
    refuseSplit("a name of letters, digits, - and _, and A <= B", part);
  }
  return split;
}
} // namespace

std::vector<DatasetSplit> splitsOf(const DatasetView& dataset, const OptionValues& options, const std::string& usual)
{
  const std::vector<DatasetShot>& shots = dataset.shots();
  const SceneOfMany& scene = dataset.scene();
  std::vector<DatasetSplit> splits;
  for (const std::string& part : exported::split().of(options))
  {
    const DatasetSplit split = splitOf(part);
    for (const DatasetSplit& other : splits)
    {
      if (other.name == split.name || (split.first <= other.last && other.first <= split.last))
      {
        refuseSplit("parts that do not overlap", part);
      }
    }
    if (!scene.name.empty() && (split.last < 0 || split.first >= scene.count)) // others may be in it
    {
      refuseSplit("some of the scenes 0 to " + std::to_string(scene.count - 1), part);
    }
    if (scene.name.empty() &&
        std::none_of(shots.begin(), shots.end(), [&](const auto& shot) { return split.holds(shot); }))
    {
      refuseSplit("frames of the dataset", part);
    }
    splits.push_back(split);
  }
  return splits.empty() ? std::vector<DatasetSplit>{ { usual, 0, std::numeric_limits<int>::max() } } : splits;
}

std::vector<std::uint32_t> shotsIn(const DatasetView& dataset, const DatasetSplit& split)
{
  std::vector<std::uint32_t> numbers;
  for (const DatasetShot& shot : dataset.shots())
  {
    if (split.holds(shot))
    {
      numbers.push_back(static_cast<std::uint32_t>(shot.index));
    }
  }
  return numbers;
}

} // namespace dgtk
