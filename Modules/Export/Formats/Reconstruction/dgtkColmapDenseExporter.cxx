// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmap.h"
#include "dgtkColmapRigs.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"

namespace dgtk
{

namespace
{
constexpr const char* colmapDenseName = "colmap-dense";

class ColmapDenseExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return colmap::optionRows(); }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "normal", "objects", "tracks" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, colmapDenseName);
    requirePinholes(dataset, colmapDenseName);
    for (const DatasetShot& shot : dataset.shots())
    {
      colmap::modelOf(shot.camera, PixelCentre::Integer, colmapDenseName);
    }
    requireEverywhere(dataset, exported::color().of(options), colmapDenseName, { "png" });
    for (const std::string& layer : { exported::depth().of(options), std::string("normal"), std::string("objects") })
    {
      requireEverywhere(dataset, layer, colmapDenseName);
    }
    requireEverywhere(dataset, "tracks", colmapDenseName, { "npy" });
    colmap::checkRigs(dataset, options, colmapDenseName);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less, as stereo_fusion has them" },
      { "axes", "x right, y down, z forward; poses are the camera's axes from the world's" },
      { "quaternion", "w x y z" }, { "depth", "z, 0 for none" }, { "normals", "camera frame, towards the camera" },
      { "moving", colmap::moving().of(options) } };
    for (const std::shared_ptr<const colmap::Views>& views : colmap::viewsOf(dataset, options, PixelCentre::Integer))
    {
      const bool each = colmap::moving().of(options) == "frame";
      const std::string folder = each ? "frame_" + padded(*colmap::frameOf(*views), 6) + '/' : "";
      const std::vector<std::uint32_t> leftOut = colmap::leftOut(dataset, *views);
      plan.series.push_back({ views->shots.size(), [&dataset, views, folder, leftOut, options](std::size_t i)
        { return maps(dataset, *views, *views->shots[i], folder, leftOut, options); } });
      plan.items.push_back(colmap::modelItem(dataset, views, folder + "sparse/", options));
      plan.items.push_back(lists(views, folder));
    }
    return plan;
  }

private:
  static ExportItem maps(const DatasetView& dataset, const colmap::Views& views, const DatasetShot& shot,
    const std::string& folder, const std::vector<std::uint32_t>& leftOut, const OptionValues& options)
  {
    const std::string name = views.name(shot);
    const std::string picture = folder + "images/" + name;
    const std::string depth = folder + "stereo/depth_maps/" + name + ".geometric.bin";
    const std::string normals = folder + "stereo/normal_maps/" + name + ".geometric.bin";
    return { { picture, depth, normals },
      [&dataset, &shot, options, picture, depth, normals, leftOut](ExportSink& sink)
      {
        FloatFile form;
        form.kind = FloatFile::Kind::Colmap;
        form.unit = "scene units";
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        writeFloatLayer(sink, dataset, shot, exported::depth().of(options), depth, form, leftOut);
        form.channels = 3;
        form.unit = "1";
        writeFloatLayer(sink, dataset, shot, "normal", normals, form, leftOut);
      },
      { { shot.name(), shot.frame(), picture } } };
  }

  static ExportItem lists(const std::shared_ptr<const colmap::Views>& views, const std::string& folder)
  {
    const std::string fusion = folder + "stereo/fusion.cfg";
    const std::string match = folder + "stereo/patch-match.cfg";
    return { { fusion, match }, [views, fusion, match](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> all = sink.open(fusion);
        const std::unique_ptr<ExportFile> pairs = sink.open(match);
        for (const DatasetShot* shot : views->shots)
        {
          all->write(views->name(*shot) + '\n');
          pairs->write(views->name(*shot) + "\n__auto__, 20\n");
        }
        all->finish();
        pairs->finish();
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeColmapDenseExporter() { return std::make_unique<ColmapDenseExporter>(); }

} // namespace dgtk
