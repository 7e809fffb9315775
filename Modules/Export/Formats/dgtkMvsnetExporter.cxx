// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkMovingObjects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
constexpr const char* format = "mvsnet";
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
      least = depth < least ? depth : least;
      most = depth > most ? depth : most;
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

/// Which points that stay each view sees, and where they and the cameras are.
struct Sights
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> centres;         ///< one a view
  std::vector<std::vector<std::uint32_t>> seen; ///< indices of points, rising
};

Sights sightsOf(const DatasetView& dataset)
{
  Sights sights;
  const std::vector<TrackPoint> all = dataset.trackPoints();
  for (const TrackPoint& point : all)
  {
    sights.points.push_back(point.x);
  }
  for (const DatasetShot& shot : dataset.shots())
  {
    sights.centres.push_back(cameraFromWorld(shot.camera).inverse().translation);
    std::vector<std::uint32_t>& seen = sights.seen.emplace_back();
    const std::vector<TrackPlace> places =
      readTrackPlaces(dataset.pathOf(dataset.file(shot, "tracks", { "npy" })), all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (all[i].isStatic && places[i].visibility == 1)
      {
        seen.push_back(std::uint32_t(i));
      }
    }
  }
  return sights;
}

/// MVSNet's colmap2mvsnet.py: over the points that both see, by the angle between their rays, best at 5 degrees.
double scoreOf(const Sights& sights, std::size_t a, std::size_t b)
{
  constexpr double best = 5;
  constexpr double degree = 3.14159265358979323846 / 180;
  std::vector<std::uint32_t> both;
  std::set_intersection(sights.seen[a].begin(), sights.seen[a].end(), sights.seen[b].begin(), sights.seen[b].end(),
    std::back_inserter(both));
  double score = 0;
  for (const std::uint32_t i : both)
  {
    const Eigen::Vector3d one = sights.centres[a] - sights.points[i];
    const Eigen::Vector3d two = sights.centres[b] - sights.points[i];
    const double angle = std::acos(std::min(1.0, std::max(-1.0, one.dot(two) / one.norm() / two.norm()))) / degree;
    const double width = angle <= best ? 1 : 10;
    score += std::exp(-(angle - best) * (angle - best) / (2 * width * width));
  }
  return score;
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
    requireWhole(options, format);
    requirePinholes(dataset, format);
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), format);
    requireEverywhere(dataset, "objects", format);
    requireEverywhere(dataset, "tracks", format, { "npy" });
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
    for (const DatasetShot& shot : dataset.shots())
    {
      plan.items.push_back(item(dataset, shot, moving, options));
      plan.names.push_back({ shot.name(), shot.frame(), plan.items.back().files[0] });
    }
    plan.documents.push_back({ { "cams/pair.txt" }, [&dataset](ExportSink& sink) { writePairs(sink, dataset); } });
    return plan;
  }

private:
  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const std::vector<std::uint32_t>& moving,
    const OptionValues& options)
  {
    const std::string picture = "blended_images/" + number(shot) + ".jpg";
    const std::string camera = "cams/" + number(shot) + "_cam.txt";
    const std::string map = "rendered_depth_maps/" + number(shot) + ".pfm";
    return { { picture, camera, map }, [&dataset, &shot, moving, options, picture, camera, map](ExportSink& sink)
      {
        OptionValues jpeg = options; // loaders look for .jpg
        jpeg[exported::imageFormat().name] = "jpg";
        const std::string depth = exported::depth().of(options);
        FloatFile form;
        form.unit = "scene units";
        writePicture(sink, dataset, shot, exported::color().of(options), picture, jpeg);
        writeFloatLayer(sink, dataset, shot, depth, map, form, moving);
        sink.write(camera, cameraText(shot.camera, rangeOf(dataset, shot, depth), depthPlanes().of(options)));
      } };
  }

  static void writePairs(ExportSink& sink, const DatasetView& dataset)
  {
    const Sights sights = sightsOf(dataset);
    const std::unique_ptr<ExportFile> file = sink.open("cams/pair.txt");
    file->write(std::to_string(sights.centres.size()) + '\n');
    for (std::size_t a = 0; a < sights.centres.size(); ++a)
    {
      std::vector<std::pair<double, std::size_t>> others;
      for (std::size_t b = 0; b < sights.centres.size(); ++b)
      {
        const double score = a == b ? 0 : scoreOf(sights, a, b);
        if (score > 0)
        {
          others.emplace_back(-score, b); // the best first, then the first
        }
      }
      std::sort(others.begin(), others.end());
      others.resize(std::min(others.size(), mostSources));
      std::string line = std::to_string(a) + '\n' + std::to_string(others.size());
      for (const auto& [score, b] : others)
      {
        line += ' ' + std::to_string(b) + ' ' + numbersLine({ -score });
      }
      file->write(line + '\n');
    }
    file->finish();
  }
};
} // namespace

std::unique_ptr<Exporter> makeMvsnetExporter() { return std::make_unique<MvsnetExporter>(); }

} // namespace dgtk
