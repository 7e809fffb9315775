// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportLayers.h"

#include "dgtkText.h"

#include <algorithm>
#include <filesystem>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// Files of values before pictures of them; colours the other way round.
int rankOf(const std::string& extension, const LayerSpec& layer)
{
  static const std::vector<std::string> values{ "npy", "dgd", "flo", "pfm", "exr", "ppm", "png" };
  const auto at = std::find(values.begin(), values.end(), extension);
  const int rank = static_cast<int>(at - values.begin());
  return layer.meaning == Meaning::Picture ? -rank : rank;
}

/// Whole pictures of the view: no parts of them, no lists.
bool isShown(const DatasetFile& file, const LayerSpec& spec)
{
  const bool ranks = spec.meaning == Meaning::Coverage && spec.channels > 1;
  const bool part = fs::path(file.path).stem().string().find('_') != std::string::npos;
  return spec.meaning != Meaning::Surfaces && spec.meaning != Meaning::Record && !ranks && !part &&
         isLayerFile(file.path);
}

/// As the columns of the contact sheet and Python's outputs are called.
std::string labelOf(const DatasetFile& file)
{
  const std::string folder = fs::path(file.path).parent_path().filename().string();
  const std::string classes = "_class";
  const std::size_t length = file.layer.size();
  const bool isClass =
    length > classes.size() && file.layer.compare(length - classes.size(), classes.size(), classes) == 0;
  return isClass && folder != file.layer ? folder + classes : folder;
}
} // namespace

Counted countedOf(const LayerSpec& spec, const std::string& path)
{
  const bool values = extensionOf(path) != "png";
  switch (spec.meaning)
  {
    case Meaning::Depth:
    case Meaning::Distance:
    case Meaning::Displacement:
      return values ? Counted::Numbers : Counted::Nothing;
    case Meaning::Picture:
      return extensionOf(path) == "png" && spec.channels != 2 ? Counted::Brightness : Counted::Nothing;
    case Meaning::Id:
      return spec.channels == 1 ? Counted::Objects : Counted::Nothing;
    case Meaning::Class:
      return spec.channels == 1 ? Counted::Classes : Counted::Nothing;
    default:
      return Counted::Nothing;
  }
}

std::vector<ReportLayer> reportLayers(const ReportSource& source)
{
  std::vector<std::map<std::string, std::pair<std::size_t, LayerSpec>>> specs(source.scenes.size());
  for (std::size_t scene = 0; scene < specs.size(); ++scene)
  {
    const std::vector<LayerRecord>& layers = source.scenes[scene].view->manifest().layers;
    for (std::size_t i = 0; i < layers.size(); ++i)
    {
      specs[scene].emplace(layers[i].spec.name, std::make_pair(i, layers[i].spec));
    }
  }
  std::map<std::string, std::pair<std::size_t, ReportLayer>> found; // by label, with the place in the manifest
  for (const std::size_t picture : source.read)
  {
    const ReportPicture& one = source.pictures[picture];
    for (const DatasetFile& file : source.viewOf(one).filesOf(*one.shot))
    {
      const auto spec = specs[one.scene].find(file.layer);
      if (spec == specs[one.scene].end() || !isShown(file, spec->second.second))
      {
        continue;
      }
      const std::string label = labelOf(file);
      auto& [order, layer] =
        found.emplace(label, std::make_pair(spec->second.first, ReportLayer{ label, spec->second.second, {} }))
          .first->second;
      std::string& path = layer.files[picture];
      const LayerSpec& meant = layer.spec;
      if (path.empty() || rankOf(extensionOf(file.path), meant) < rankOf(extensionOf(path), meant))
      {
        path = file.path;
      }
    }
  }
  std::vector<std::pair<std::size_t, ReportLayer>> sorted;
  sorted.reserve(found.size());
  for (auto& [label, layer] : found)
  {
    sorted.push_back(std::move(layer));
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ReportLayer> layers;
  for (auto& [order, layer] : sorted)
  {
    layers.push_back(std::move(layer));
  }
  return layers;
}

} // namespace dgtk
