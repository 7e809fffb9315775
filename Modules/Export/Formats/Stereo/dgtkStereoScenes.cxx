// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStereoScenes.h"

#include "dgtkClassedRows.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
struct StereoScene
{
  const DatasetShot* left = nullptr;
  const DatasetShot* right = nullptr;
  std::string name;
};

StereoScene sceneOf(const DatasetView& dataset, const CameraEyes& pair, const DatasetShot& left)
{
  return { &left, dataset.shot(pair.right, left.frame()), pair.name + '_' + padded(left.frame(), 6) };
}

std::string folderOf(const std::string& pattern, const std::string& scene)
{
  const std::size_t at = pattern.find('%');
  return pattern.substr(0, at) + scene + pattern.substr(at + 1);
}

std::string matrixText(const CameraRecord& camera)
{
  const Eigen::Matrix3d K = intrinsicsOf(camera, PixelCentre::Integer);
  return '[' + numbersLine({ K(0, 0), 0, K(0, 2) }) + "; " + numbersLine({ 0, K(1, 1), K(1, 2) }) + "; 0 0 1]";
}

/// Smallest and largest disparity of a picture; 0, 0 for none.
std::pair<double, double> rangeOf(const DatasetView& dataset, const DatasetShot& shot)
{
  ClassedRows rows(dataset, shot, "disparity");
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (int y = 0; y < rows.info().height; ++y)
  {
    rows.next();
    for (int x = 0; x < rows.info().width; ++x)
    {
      const double d = rows.at(x);
      least = std::isnan(d) ? least : std::min(least, d);
      most = std::isnan(d) ? most : std::max(most, d);
    }
  }
  return most < least ? std::make_pair(0.0, 0.0) : std::make_pair(least, most);
}

std::string calibration(const DatasetView& dataset, const StereoScene& scene)
{
  constexpr double millimetres = 1000;
  const CameraRecord& left = scene.left->camera;
  const CameraRecord& right = scene.right->camera;
  const auto [least, most] = rangeOf(dataset, *scene.left);
  const auto line = [](const std::string& key, double value) { return key + '=' + numbersLine({ value }) + '\n'; };
  return "cam0=" + matrixText(left) + "\ncam1=" + matrixText(right) + '\n' +
         line("doffs", right.K(0, 2) - left.K(0, 2)) +
         line("baseline", baselineMetres(dataset, *scene.left, *scene.right) * millimetres) +
         line("width", left.width) + line("height", left.height) + line("ndisp", std::max(1.0, std::floor(most) + 2)) +
         line("isint", 0) + line("vmin", std::floor(least)) + line("vmax", std::ceil(most)) + line("dyavg", 0) +
         line("dymax", 0);
}

ExportItem itemOf(
  const DatasetView& dataset, const StereoScene& scene, const StereoLayout& layout, const OptionValues& options)
{
  const std::string pictures = folderOf(layout.pictures, scene.name) + '/';
  const std::string truth = folderOf(layout.truth, scene.name) + '/';
  ExportItem item;
  item.files = { pictures + "im0.png", pictures + "im1.png", pictures + "calib.txt", truth + "mask0nocc.png" };
  for (const std::string& map : layout.leftMaps)
  {
    item.files.push_back(truth + map);
  }
  if (!layout.rightMap.empty())
  {
    item.files.push_back(truth + layout.rightMap);
  }
  item.write = [&dataset, scene, layout, options, pictures, truth](ExportSink& sink)
  {
    const std::string color = exported::color().of(options);
    writePicture(sink, dataset, *scene.left, color, pictures + "im0.png", options);
    writePicture(sink, dataset, *scene.right, color, pictures + "im1.png", options);
    sink.write(pictures + "calib.txt", calibration(dataset, scene), { "", scene.left, {} });
    FloatFile form;
    form.nothing = std::numeric_limits<float>::infinity();
    form.unit = "px";
    for (const std::string& map : layout.leftMaps)
    {
      writeFloatLayer(sink, dataset, *scene.left, "disparity", truth + map, form);
    }
    if (!layout.rightMap.empty())
    {
      writeFloatLayer(sink, dataset, *scene.right, "disparity", truth + layout.rightMap, form);
    }
    writeIdPng(sink, dataset, *scene.left, "disparity_class", truth + "mask0nocc.png",
      { { 1, 255 }, { 2, 128 }, { 3, 128 }, { 4, 128 } });
  };
  item.names = { { scene.left->name(), scene.left->frame(), item.files[0] },
    { scene.right->name(), scene.right->frame(), item.files[1] } };
  return item;
}

void checkShot(
  const DatasetView& dataset, const DatasetShot& shot, const OptionValues& options, const StereoLayout& layout)
{
  const Eigen::Matrix3d& K = shot.camera.K;
  if (std::abs(K(0, 0) - K(1, 1)) > 1e-9 * K(0, 0) || K(0, 1) != 0)
  {
    throw UsageError(layout.format + ": camera " + quoted(shot.name()) +
                     " has no square pixels (expected one focal length and no skew, found " +
                     numbersLine({ K(0, 0), K(1, 1), K(0, 1) }) + ')');
  }
  requireFile(dataset, shot, exported::color().of(options), layout.format, { "png" });
  requireFile(dataset, shot, "disparity", layout.format);
}

class StereoExporter : public Exporter
{
public:
  explicit StereoExporter(const StereoLayout& layout)
    : Layout(layout)
  {
  }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "disparity" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, this->Layout.format);
    requireWhole(options, this->Layout.format);
    dataset.metres();
    for (const CameraEyes& pair : pairsOf(dataset, this->Layout.format))
    {
      for (const DatasetShot* left : dataset.shotsOf(pair.left))
      {
        checkShot(dataset, *left, options, this->Layout);
        checkShot(dataset, *dataset.shot(pair.right, left->frame()), options, this->Layout);
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "disparity", "x of the left image less x of the right one, +inf for none" }, { "baseline", "millimetres" },
      { "mask0nocc", "255 visible in the other image, 128 not, 0 unknown" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    for (const CameraEyes& pair : pairsOf(dataset, this->Layout.format))
    {
      plan.series.push_back(seriesOf(dataset, pair.left,
        [&dataset, pair, layout = this->Layout, options](const DatasetShot& left, std::size_t)
        { return itemOf(dataset, sceneOf(dataset, pair, left), layout, options); }));
    }
    return plan;
  }

private:
  const StereoLayout Layout;
};
} // namespace

std::unique_ptr<Exporter> makeStereoExporter(const StereoLayout& layout)
{
  return std::make_unique<StereoExporter>(layout);
}

} // namespace dgtk
