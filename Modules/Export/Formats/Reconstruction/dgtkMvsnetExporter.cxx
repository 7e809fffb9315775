// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkMovingObjects.h"
#include "dgtkViewPairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace dgtk
{

namespace
{
constexpr const char* mvsnetName = "mvsnet";
constexpr std::size_t mostSources = 10; ///< of a view

const IntegerOption& depthPlanes()
{
  static const IntegerOption row("depth_planes", 192, 2, 4096, "depths that MVSNet's cameras ask for");
  return row;
}

std::string number(const DatasetShot& shot) { return padded(int(shot.index), 8); }

std::string rowsOf(const Eigen::MatrixXd& matrix)
{
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    std::vector<double> row;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
    {
      row.push_back(matrix(i, k));
    }
    text += numbersLine(row) + '\n';
  }
  return text;
}

/// The nearest and farthest depth of a picture, a hundredth farther where a picture has one depth: loaders divide by
/// the step. Near and far of the camera where it shows nothing.
std::pair<double, double> rangeOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer)
{
  ClassedRows rows(dataset, shot, layer);
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (int y = 0; y < rows.info().height; ++y)
  {
    rows.next();
    for (int x = 0; x < rows.info().width; ++x)
    {
      const double depth = rows.at(x);
      least = std::min(least, depth); // which keep their first where the other is no number
      most = std::max(most, depth);
    }
  }
  if (most > 0)
  {
    constexpr double flat = 1 + 1e-6;
    constexpr double apart = 1.01;
    return { least, most > flat * least ? most : apart * least };
  }
  constexpr double far = 1000; ///< times near, where there is no end
  return { shot.camera.near, std::isfinite(shot.camera.far) ? shot.camera.far : far * shot.camera.near };
}

std::string cameraText(const CameraRecord& camera, const std::pair<double, double>& range, int planes)
{
  const Rigid3 pose = cameraFromWorld(camera);
  Eigen::Matrix4d extrinsic = Eigen::Matrix4d::Identity();
  extrinsic.topLeftCorner<3, 3>() = pose.rotation;
  extrinsic.topRightCorner<3, 1>() = pose.translation;
  const double step = (range.second - range.first) / (planes - 1);
  return "extrinsic\n" + rowsOf(extrinsic) + "\nintrinsic\n" + rowsOf(intrinsicsOf(camera, PixelCentre::Half)) + '\n' +
         numbersLine({ range.first, step, double(planes), range.second }) + '\n';
}

/// A view of cams/pair.txt, and the others that go with it.
std::string pairLines(const ViewPairs& pairs, std::size_t view)
{
  const std::vector<std::pair<double, std::size_t>> others = pairs.bestOf(view, mostSources);
  std::string line = std::to_string(view) + '\n' + std::to_string(others.size());
  for (const auto& [score, other] : others)
  {
    line += ' ' + std::to_string(other) + ' ' + numbersLine({ score });
  }
  return line + '\n';
}

class MvsnetExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &depthPlanes() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "objects", "tracks" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, mvsnetName);
    requirePinholes(dataset, mvsnetName);
    requireEverywhere(dataset, exported::color().of(options), mvsnetName, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), mvsnetName);
    requireEverywhere(dataset, "objects", mvsnetName);
    requireEverywhere(dataset, "tracks", mvsnetName, { "npy" });
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "(0.5, 0.5), as the original's code" },
      { "axes", "x right, y down, z forward; the camera's axes from the world's" }, { "unit", "scene units" },
      { "depth", "z, 0 for none" } };
    if (exported::depth().of(options) != "depth")
    {
      plan.conventions.emplace_back("depth_layer", exported::depth().of(options));
    }
    const bool several = dataset.frames().size() > 1;
    const std::vector<std::uint32_t> moving = several ? movingObjects(dataset) : std::vector<std::uint32_t>();
    const auto pairs = std::make_shared<const ViewPairs>(dataset);
    plan.series.push_back({ dataset.shots().size(), [&dataset, moving, pairs, options](std::size_t i)
      { return named(dataset.shots()[i], item(dataset, dataset.shots()[i], moving, pairs, options)); } });
    plan.documents.push_back(pairList(dataset));
    return plan;
  }

private:
  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const std::vector<std::uint32_t>& moving,
    const std::shared_ptr<const ViewPairs>& pairs, const OptionValues& options)
  {
    const std::string picture = "blended_images/" + number(shot) + ".jpg";
    const std::string camera = "cams/" + number(shot) + "_cam.txt";
    const std::string map = "rendered_depth_maps/" + number(shot) + ".pfm";
    return { { picture, camera, map }, [&dataset, &shot, moving, pairs, options, picture, camera, map](ExportSink& sink)
      {
        OptionValues jpeg = options; // loaders look for .jpg
        jpeg[exported::imageFormat().name] = "jpg";
        const std::string depth = exported::depth().of(options);
        FloatFile form;
        form.unit = "scene units";
        writePicture(sink, dataset, shot, exported::color().of(options), picture, jpeg);
        writeFloatLayer(sink, dataset, shot, depth, map, form, moving);
        sink.write(camera, cameraText(shot.camera, rangeOf(dataset, shot, depth), depthPlanes().of(options)));
        sink.note("pairs", pairLines(*pairs, shot.index));
      } };
  }

  static ExportItem pairList(const DatasetView& dataset)
  {
    const std::string name = "cams/pair.txt";
    return { { name }, [&dataset, name](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open(name);
        file->write(std::to_string(dataset.shots().size()) + '\n');
        sink.notes("pairs", [&](const std::string& lines) { file->write(lines); });
        file->finish();
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeMvsnetExporter() { return std::make_unique<MvsnetExporter>(); }

} // namespace dgtk
