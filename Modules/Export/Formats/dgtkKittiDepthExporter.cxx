// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkKitti.h"

namespace dgtk
{

namespace
{
constexpr const char* format = "kitti-depth";

class KittiDepthExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options) } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, format);
    requirePinholes(dataset, format);
    requireFixedIntrinsics(dataset, format);
    dataset.metres();
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), format);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = kitti::conventions(dataset);
    plan.conventions.push_back({ "depth", "z, 256 codes a metre, 0 for none" });
    SafeNames names;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      for (const std::string& camera : dataset.cameras())
      {
        const std::string drive = split.name + '/' + names.of(camera) + '/';
        const DatasetShot* first = nullptr;
        for (const DatasetShot* shot : dataset.shotsOf(camera))
        {
          if (split.holds(*shot))
          {
            plan.items.push_back(item(dataset, *shot, drive, options));
            plan.names.push_back({ camera, shot->frame(), plan.items.back().files[0] });
            first = first ? first : shot;
          }
        }
        if (first)
        {
          plan.items.push_back({ { drive + "calib_cam_to_cam.txt" },
            [first, drive](ExportSink& sink) {
              sink.write(drive + "calib_cam_to_cam.txt", kitti::camToCam(first->camera, nullptr, 0), { "", first, {} });
            } });
        }
      }
    }
    return plan;
  }

private:
  static ExportItem item(
    const DatasetView& dataset, const DatasetShot& shot, const std::string& drive, const OptionValues& options)
  {
    const std::string number = padded(shot.frame(), 10);
    const std::string picture = drive + "image_02/data/" + number + ".png";
    const std::string map = drive + "proj_depth/groundtruth/image_02/" + number + ".png";
    return { { picture, map }, [&dataset, &shot, options, picture, map](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        writeCodedPng(
          sink, dataset, shot, exported::depth().of(options), map, kitti::code256(dataset.metres(), "m"), options);
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeKittiDepthExporter() { return std::make_unique<KittiDepthExporter>(); }

} // namespace dgtk
