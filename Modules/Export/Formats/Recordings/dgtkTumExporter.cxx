// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr const char* tumName = "tum";

/// The time of a frame, the same text everywhere: seconds with six decimals.
std::string tumTime(const DatasetView& dataset, const DatasetShot& shot)
{
  constexpr long long million = 1000000;
  const long long micros = std::llround(dataset.seconds(shot.frame()) * double(million));
  const long long size = std::llabs(micros);
  return (micros < 0 ? "-" : "") + std::to_string(size / million) + '.' + padded(static_cast<int>(size % million), 6);
}

/// Relatives of the set, which lay out the same files in other ways.
const ChoiceOption& dialect()
{
  static const ChoiceOption row("dialect", { "tum", "icl-nuim", "eth3d-slam" },
    "whose TUM RGB-D: the benchmark's own, ICL-NUIM's (numbered frames, y up), ETH3D SLAM's");
  return row;
}
bool isIcl(const OptionValues& options) { return dialect().of(options) == "icl-nuim"; }

/// How a dialect calls a picture: its time, or its number among the camera's pictures.
std::string stampOf(const DatasetView& dataset, const DatasetShot& shot, const OptionValues& options)
{
  return isIcl(options) ? std::to_string(shot.frame()) : tumTime(dataset, shot);
}

class TumExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &dialect() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options) } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, tumName);
    requirePinholes(dataset, tumName);
    requireNoSkew(dataset, tumName);
    requireFixedIntrinsics(dataset, tumName);
    dataset.metres();
    if (isIcl(options) && dataset.frames().front() < 0)
    {
      throw UsageError(
        "tum: ICL-NUIM's frames are numbered from 0, but there is frame " + std::to_string(dataset.frames().front()));
    }
    for (const int frame : isIcl(options) ? std::vector<int>() : dataset.frames())
    {
      if (std::abs(dataset.seconds(frame)) * 1e6 >= 9.2e18)
      {
        throw UsageError("tum: frame " + std::to_string(frame) + " has no time: microseconds have 63 bits");
      }
    }
    requireEverywhere(dataset, exported::color().of(options), tumName, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), tumName);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", isIcl(options) ? "x right, y up, z forward, left-handed: the world's y turned round; poses are the "
                                 "world's axes from the camera's"
                               : "x right, y down, z forward; poses are the world's axes from the camera's" },
      { "dialect", dialect().of(options) }, { "quaternion", "x y z w" },
      { "depth", "z, 5000 codes a metre, 0 for none" }, { "metres_per_unit", shortest(dataset.metres()) } };
    const std::vector<std::string> cameras = dataset.cameras();
    SafeNames names;
    for (const std::string& camera : cameras)
    {
      const std::string folder = cameras.size() == 1 ? "" : names.of(camera) + '/';
      plan.series.push_back(seriesOf(dataset, camera,
        [&dataset, folder, options](const DatasetShot& shot, std::size_t)
        { return named(shot, item(dataset, shot, folder, options)); }));
      plan.series.push_back(seriesOf(documents(dataset, camera, folder, options)));
    }
    return plan;
  }

private:
  static ExportItem item(
    const DatasetView& dataset, const DatasetShot& shot, const std::string& folder, const OptionValues& options)
  {
    const std::string time = stampOf(dataset, shot, options);
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
    const std::string pairs = dialect().of(options) == "eth3d-slam" ? "associated.txt" : "associations.txt";
    for (const std::string& name : { std::string("rgb.txt"), std::string("depth.txt"), std::string("groundtruth.txt"),
           pairs, std::string("calibration.txt") })
    {
      item.files.push_back(folder + name);
    }
    item.write = [&dataset, camera, folder, pairs, options](ExportSink& sink)
    { writeDocuments(sink, dataset, camera, folder, pairs, options); };
    return item;
  }

  static void writeDocuments(ExportSink& sink, const DatasetView& dataset, const std::string& camera,
    const std::string& folder, const std::string& pairs, const OptionValues& options)
  {
    const std::string extension = '.' + pictureExtension(options);
    const auto open = [&](const std::string& name, const std::string& head)
    {
      std::unique_ptr<ExportFile> file = sink.open(folder + name);
      file->write(head);
      return file;
    };
    const auto rgb = open("rgb.txt", "# color images\n# file: the dataset's pictures\n# timestamp filename\n");
    const auto depth = open("depth.txt", "# depth maps\n# file: 5000 codes a metre\n# timestamp filename\n");
    const auto poses = open("groundtruth.txt",
      isIcl(options) ? "" : "# ground truth trajectory\n# file: world from camera\n# timestamp tx ty tz qx qy qz qw\n");
    const auto both = open(pairs, "");
    for (const DatasetShot* shot : dataset.shotsOf(camera))
    {
      const std::string time = stampOf(dataset, *shot, options);
      const std::string first = time + " rgb/" + time + extension;
      const std::string second = time + " depth/" + time + ".png";
      rgb->write(first + '\n');
      depth->write(second + '\n');
      both->write(isIcl(options) ? second + ' ' + first + '\n' : first + ' ' + second + '\n');
      poses->write(time + ' ' + poseLine(shot->camera, dataset.metres(), isIcl(options)) + '\n');
    }
    rgb->finish();
    depth->finish();
    poses->finish();
    both->finish();
    const Eigen::Matrix3d K = intrinsicsOf(dataset.shotsOf(camera).front()->camera, PixelCentre::Integer);
    const double sign = isIcl(options) ? -1 : 1;
    sink.write(folder + "calibration.txt", numbersLine({ K(0, 0), sign * K(1, 1), K(0, 2), K(1, 2) }) + '\n');
  }

  /// With y up the world's y is turned round with the camera's: what is left is a rotation again.
  static std::string poseLine(const CameraRecord& camera, double metres, bool yUp)
  {
    Rigid3 pose = cameraFromWorld(camera).inverse();
    if (yUp)
    {
      const Eigen::DiagonalMatrix<double, 3> flip(1, -1, 1);
      pose.rotation = flip * pose.rotation * flip;
      pose.translation = flip * pose.translation;
    }
    const Eigen::Vector3d place = pose.translation * metres;
    const Eigen::Vector4d q = quaternionOf(pose.rotation);
    return numbersLine({ place.x(), place.y(), place.z(), q[1], q[2], q[3], q[0] });
  }
};
} // namespace

std::unique_ptr<Exporter> makeTumExporter() { return std::make_unique<TumExporter>(); }

} // namespace dgtk
