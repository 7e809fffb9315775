// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmap.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"

namespace dgtk
{

namespace
{
constexpr const char* format = "colmap-dense";

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
    requireWhole(options, format);
    requirePinholes(dataset, format);
    for (const DatasetShot& shot : dataset.shots())
    {
      colmap::modelOf(shot.camera, PixelCentre::Integer, format);
    }
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    for (const std::string& layer : { exported::depth().of(options), std::string("normal"), std::string("objects") })
    {
      requireEverywhere(dataset, layer, format);
    }
    requireEverywhere(dataset, "tracks", format, { "npy" });
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less, as stereo_fusion has them" },
      { "axes", "x right, y down, z forward; poses are the camera's axes from the world's" },
      { "quaternion", "w x y z" }, { "depth", "z, 0 for none" }, { "normals", "camera frame, towards the camera" },
      { "moving", colmap::moving().of(options) } };
    for (const colmap::Views& views : colmap::viewsOf(dataset, options, PixelCentre::Integer))
    {
      const bool each = colmap::moving().of(options) == "frame";
      const std::string folder = each ? "frame_" + padded(*colmap::frameOf(views), 6) + '/' : "";
      addMaps(plan, dataset, views, folder, options);
      plan.items.push_back(colmap::modelItem(dataset, views, folder + "sparse/", options));
      plan.items.push_back(lists(views, folder));
    }
    return plan;
  }

private:
  static void addMaps(ExportPlan& plan, const DatasetView& dataset, const colmap::Views& views,
    const std::string& folder, const OptionValues& options)
  {
    const std::vector<std::uint32_t> leftOut = colmap::leftOut(dataset, views);
    for (std::size_t i = 0; i < views.shots.size(); ++i)
    {
      const DatasetShot& shot = *views.shots[i];
      const std::string picture = folder + "images/" + views.names[i];
      const std::string depth = folder + "stereo/depth_maps/" + views.names[i] + ".geometric.bin";
      const std::string normals = folder + "stereo/normal_maps/" + views.names[i] + ".geometric.bin";
      plan.items.push_back(
        { { picture, depth, normals }, [&dataset, &shot, options, picture, depth, normals, leftOut](ExportSink& sink)
          {
            FloatFile form;
            form.kind = FloatFile::Kind::Colmap;
            form.unit = "scene units";
            writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
            writeFloatLayer(sink, dataset, shot, exported::depth().of(options), depth, form, leftOut);
            form.channels = 3;
            form.unit = "1";
            writeFloatLayer(sink, dataset, shot, "normal", normals, form, leftOut);
          } });
      plan.names.push_back({ shot.name(), shot.frame(), picture });
    }
  }

  static ExportItem lists(const colmap::Views& views, const std::string& folder)
  {
    const std::string fusion = folder + "stereo/fusion.cfg";
    const std::string match = folder + "stereo/patch-match.cfg";
    return { { fusion, match }, [names = views.names, fusion, match](ExportSink& sink)
      {
        std::string all;
        std::string pairs;
        for (const std::string& name : names)
        {
          all += name + '\n';
          pairs += name + "\n__auto__, 20\n";
        }
        sink.write(fusion, all);
        sink.write(match, pairs);
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeColmapDenseExporter() { return std::make_unique<ColmapDenseExporter>(); }

} // namespace dgtk
