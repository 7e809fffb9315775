// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkKitti.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr const char* kittiDepthName = "kitti-depth";

class KittiDepthExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options) } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, kittiDepthName);
    requirePinholes(dataset, kittiDepthName);
    requireFixedIntrinsics(dataset, kittiDepthName);
    dataset.metres();
    requireEverywhere(dataset, exported::color().of(options), kittiDepthName, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), kittiDepthName);
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
        std::vector<std::uint32_t> shots = shotNumbers(dataset, camera);
        shots.erase(
          std::remove_if(shots.begin(), shots.end(), [&](std::uint32_t i) { return !split.holds(dataset.shots()[i]); }),
          shots.end());
        if (!shots.empty())
        {
          const DatasetShot* const first = &dataset.shots()[shots.front()];
          plan.series.push_back(seriesOf(dataset, shots,
            [&dataset, drive, options](const DatasetShot& shot, std::size_t)
            { return named(shot, item(dataset, shot, drive, options)); }));
          plan.series.push_back(seriesOf({ { drive + "calib_cam_to_cam.txt" },
            [first, drive](ExportSink& sink) {
              sink.write(drive + "calib_cam_to_cam.txt", kitti::camToCam(first->camera, nullptr, 0), { "", first, {} });
            } }));
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
