// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmap.h"
#include "dgtkColmapRigs.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkMovingObjects.h"

namespace dgtk
{

namespace
{
constexpr const char* colmapName = "colmap";

class ColmapExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return colmap::optionRows(); }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects", "tracks" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, colmapName);
    for (const DatasetShot& shot : dataset.shots())
    {
      colmap::modelOf(shot.camera, PixelCentre::Half, colmapName);
    }
    requireEverywhere(dataset, exported::color().of(options), colmapName, { "png" });
    requireEverywhere(dataset, "objects", colmapName);
    requireEverywhere(dataset, "tracks", colmapName, { "npy" });
    colmap::checkRigs(dataset, options, colmapName);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "(0.5, 0.5)" },
      { "axes", "x right, y down, z forward; poses are the camera's axes from the world's" },
      { "quaternion", "w x y z" }, { "points", "ids are places in tracks/points.json, from 1; two pictures or more" },
      { "moving", colmap::moving().of(options) } };
    for (const std::shared_ptr<const colmap::Views>& views : colmap::viewsOf(dataset, options, PixelCentre::Half))
    {
      const std::vector<std::uint32_t> black = colmap::leftOut(dataset, *views);
      plan.series.push_back({ views->shots.size(), [&dataset, views, black, options](std::size_t i)
        { return picture(dataset, *views, *views->shots[i], black, options); } });
      const bool each = colmap::moving().of(options) == "frame";
      const std::string folder = "sparse/" + (each ? padded(*colmap::frameOf(*views), 6) : std::string("0")) + '/';
      plan.items.push_back(colmap::modelItem(dataset, views, folder, options));
    }
    return plan;
  }

private:
  static ExportItem picture(const DatasetView& dataset, const colmap::Views& views, const DatasetShot& shot,
    const std::vector<std::uint32_t>& black, const OptionValues& options)
  {
    const std::string name = views.name(shot);
    const std::string picture = "images/" + name;
    const std::string mask = black.empty() ? "" : "masks/" + name + ".png";
    ExportItem item{ { picture },
      [&dataset, &shot, options, picture, mask, black](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        if (!mask.empty())
        {
          writeMovingMask(sink, dataset, shot, mask, black, true);
        }
      },
      { { shot.name(), shot.frame(), picture } } };
    if (!mask.empty())
    {
      item.files.push_back(mask);
    }
    return item;
  }
};
} // namespace

std::unique_ptr<Exporter> makeColmapExporter() { return std::make_unique<ColmapExporter>(); }

} // namespace dgtk
