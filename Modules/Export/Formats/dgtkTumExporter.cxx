// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr const char* format = "tum";

/// The time of a frame, the same text everywhere: seconds with six decimals.
std::string timeOf(const DatasetView& dataset, const DatasetShot& shot)
{
  constexpr long long million = 1000000;
  const long long micros = std::llround(dataset.seconds(shot.frame()) * double(million));
  const long long size = std::llabs(micros);
  return (micros < 0 ? "-" : "") + std::to_string(size / million) + '.' + padded(static_cast<int>(size % million), 6);
}

class TumExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options) } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, format);
    requirePinholes(dataset, format);
    requireFixedIntrinsics(dataset, format);
    dataset.metres();
    dataset.seconds(0);
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), format);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", "x right, y down, z forward; poses are the world's axes from the camera's" },
      { "quaternion", "x y z w" }, { "depth", "z, 5000 codes a metre, 0 for none" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    const std::vector<std::string> cameras = dataset.cameras();
    SafeNames names;
    for (const std::string& camera : cameras)
    {
      const std::string folder = cameras.size() == 1 ? "" : names.of(camera) + '/';
      for (const DatasetShot* shot : dataset.shotsOf(camera))
      {
        plan.items.push_back(item(dataset, *shot, folder, options));
        plan.names.push_back({ camera, shot->frame(), plan.items.back().files[0] });
      }
      plan.items.push_back(documents(dataset, camera, folder, options));
    }
    return plan;
  }

private:
  static ExportItem item(
    const DatasetView& dataset, const DatasetShot& shot, const std::string& folder, const OptionValues& options)
  {
    const std::string time = timeOf(dataset, shot);
    const std::string picture = folder + "rgb/" + time + '.' + pictureExtension(options);
    const std::string map = folder + "depth/" + time + ".png";
    return { { picture, map }, [&dataset, &shot, options, picture, map](ExportSink& sink)
      {
        LinearCode code;
        code.factor = dataset.metres();
        code.scale = 0.0002;
        code.unit = "m";
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        writeCodedPng(sink, dataset, shot, exported::depth().of(options), map, code, options);
      } };
  }

  static ExportItem documents(
    const DatasetView& dataset, const std::string& camera, const std::string& folder, const OptionValues& options)
  {
    ExportItem item;
    for (const char* name : { "rgb.txt", "depth.txt", "groundtruth.txt", "associations.txt", "calibration.txt" })
    {
      item.files.push_back(folder + name);
    }
    const std::string extension = '.' + pictureExtension(options);
    item.write = [&dataset, camera, folder, extension](ExportSink& sink)
    {
      std::string rgb = "# color images\n# file: the dataset's pictures\n# timestamp filename\n";
      std::string depth = "# depth maps\n# file: 5000 codes a metre\n# timestamp filename\n";
      std::string poses = "# ground truth trajectory\n# file: world from camera\n# timestamp tx ty tz qx qy qz qw\n";
      std::string pairs;
      for (const DatasetShot* shot : dataset.shotsOf(camera))
      {
        const std::string time = timeOf(dataset, *shot);
        const std::string first = time + " rgb/" + time + extension;
        const std::string second = time + " depth/" + time + ".png";
        rgb += first + '\n';
        depth += second + '\n';
        pairs.append(first).append(" ").append(second).append("\n");
        poses += time + ' ' + poseLine(shot->camera, dataset.metres()) + '\n';
      }
      const Eigen::Matrix3d K = intrinsicsOf(dataset.shotsOf(camera).front()->camera, PixelCentre::Integer);
      sink.write(folder + "rgb.txt", rgb);
      sink.write(folder + "depth.txt", depth);
      sink.write(folder + "groundtruth.txt", poses);
      sink.write(folder + "associations.txt", pairs);
      sink.write(folder + "calibration.txt", numbersLine({ K(0, 0), K(1, 1), K(0, 2), K(1, 2) }) + '\n');
    };
    return item;
  }

  static std::string poseLine(const CameraRecord& camera, double metres)
  {
    const Rigid3 pose = cameraFromWorld(camera).inverse();
    const Eigen::Vector3d place = pose.translation * metres;
    const Eigen::Vector4d q = quaternionOf(pose.rotation);
    return numbersLine({ place.x(), place.y(), place.z(), q[1], q[2], q[3], q[0] });
  }
};
} // namespace

std::unique_ptr<Exporter> makeTumExporter() { return std::make_unique<TumExporter>(); }

} // namespace dgtk
