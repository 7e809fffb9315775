// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRequestOptions.h"

#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkPovRenderOptions.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace dgtk
{

namespace option
{
constexpr int mostSamples = 16;
constexpr int mostThreads = 256;

const IntegerOption& samples()
{
  static const IntegerOption row(
    "samples", 1, 1, mostSamples, "N x N points a pixel: colour is their mean; alpha, coverage and matting count them");
  return row;
}

const ChoiceOption& filter()
{
  static const ChoiceOption row("filter", "NAME", { "box", "triangle", "gaussian", "mitchell", "lanczos" },
    "how samples become a pixel's colour: box, triangle, gaussian, mitchell, lanczos");
  return row;
}

const ChoiceOption& colorBits()
{
  static const ChoiceOption row("color_bits", { "8", "16" }, "bits a channel of colour PNG files");
  return row;
}

const ChoiceOption& renderer()
{
  static const ChoiceOption row("renderer", { "ray", "vtk", "povray" },
    "what makes colour: ray shades where the rays hit, vtk draws by OpenGL, povray is POV-Ray 3.7, installed");
  return row;
}

const NumbersOption& exposure()
{
  static const NumbersOption row("exposure", "STOPS", 1, -std::numeric_limits<double>::infinity(),
    "pictures: twice the light for each, -32 to 32; what is above white is kept until then");
  return row;
}

const ChoiceOption& tone()
{
  static const ChoiceOption row("tone", { "none", "filmic" }, "pictures: curve that bends light to white");
  return row;
}

const ChoiceOption& visibility()
{
  static const ChoiceOption row(
    "visibility", { "auto", "raster", "ray" }, "engine of the ids: OpenGL or Embree; auto is Embree");
  return row;
}

const ChoiceOption& gl()
{
  static const ChoiceOption row("gl", { "auto", "egl", "osmesa", "glx" }, "way to OpenGL");
  return row;
}

const IntegerOption& seed()
{
  static const IntegerOption row("seed", 0, 0, std::numeric_limits<int>::max(), "seed of random numbers");
  return row;
}

const IntegerOption& threads()
{
  static const IntegerOption row("threads", 0, 0, mostThreads, "threads; 0: as many as the machine has cores");
  return row;
}

const SwitchOption& pack()
{
  static const SwitchOption row("pack", "copy scene, models and textures into DIR/inputs, so that DIR can be moved");
  return row;
}

const SwitchOption& models()
{
  static const SwitchOption row(
    "models", "also write DIR/models: the geometry of each model as PLY, with its textures");
  return row;
}

const SwitchOption& contactSheet()
{
  static const SwitchOption row("contact_sheet", "also write DIR/contact.png: cameras and frames by layer");
  return row;
}
} // namespace option

namespace
{
/// One row a layer that can be written in more than one way.
std::vector<std::unique_ptr<NamesOption>> makeFormatRows()
{
  std::vector<std::unique_ptr<NamesOption>> rows;
  for (const auto& layer : layers())
  {
    const LayerInfo info = layer->info();
    if (info.formats.size() > 1)
    {
      rows.push_back(std::make_unique<NamesOption>(
        formatOption(info.layer), "NAMES", "files of the layer, of " + joinedNames(info.formats), info.formats));
    }
  }
  return rows;
}

std::vector<const OptionRow*> makeRequestOptions()
{
  std::vector<const OptionRow*> rows{ &option::samples(), &option::filter(), &option::colorBits(), &option::renderer(),
    &option::exposure(), &option::tone() };
  const auto add = [&rows](const OptionRow* row)
  {
    if (std::find(rows.begin(), rows.end(), row) == rows.end())
    {
      rows.push_back(row);
    }
  };
  for (const auto& layer : layers())
  {
    for (const OptionRow* row : layer->options())
    {
      add(row);
    }
  }
  static const std::vector<std::unique_ptr<NamesOption>> formats = makeFormatRows();
  for (const auto& row : formats)
  {
    add(row.get());
  }
  rows.insert(rows.end(), { &option::visibility(), &option::gl(), &option::seed() });
  return rows;
}
} // namespace

const std::vector<const OptionRow*>& requestOptions()
{
  static const std::vector<const OptionRow*> rows = makeRequestOptions();
  return rows;
}

const std::vector<const OptionRow*>& allOptions()
{
  static const std::vector<const OptionRow*> rows = []
  {
    std::vector<const OptionRow*> all = requestOptions();
    all.insert(all.end(), { &option::threads(), &option::pack(), &option::models(), &option::contactSheet() });
    return all;
  }();
  return rows;
}

const OptionRow& requestOption(const std::string& name)
{
  std::string known;
  for (const OptionRow* row : allOptions())
  {
    if (row->name == name)
    {
      return *row;
    }
    known += (known.empty() ? "" : ", ") + row->name;
  }
  throw UsageError("there is no option " + quoted(name) + " (expected one of " + known + ')');
}

} // namespace dgtk
