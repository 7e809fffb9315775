// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkKitti.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr const char* kittiOdometryName = "kitti-odometry";

class KittiOdometryExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override { return { { exported::color().of(options) } }; }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, kittiOdometryName);
    requireWhole(options, kittiOdometryName);
    requirePinholes(dataset, kittiOdometryName);
    requireFixedIntrinsics(dataset, kittiOdometryName);
    dataset.metres();
    dataset.seconds(0);
    requireEverywhere(dataset, exported::color().of(options), kittiOdometryName, { "png" });
    for (const CameraEyes& eyes : eyesOf(dataset))
    {
      requireRig(dataset, eyes);
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = kitti::conventions(dataset);
    plan.conventions.push_back({ "poses", "the left camera's axes at the first frame from those at each frame" });
    plan.conventions.push_back({ "times", "seconds since the first frame" });
    int number = 0;
    for (const CameraEyes& eyes : eyesOf(dataset))
    {
      const std::string sequence = padded(number++, 2);
      addPictures(plan, dataset, eyes, "sequences/" + sequence + '/', options);
      plan.series.push_back(seriesOf(documents(dataset, eyes, sequence)));
    }
    return plan;
  }

private:
  static void requireRig(const DatasetView& dataset, const CameraEyes& eyes)
  {
    if (eyes.right.empty())
    {
      return;
    }
    const std::vector<const DatasetShot*> lefts = dataset.shotsOf(eyes.left);
    const auto baseline = [&](const DatasetShot* left)
    { return baselineMetres(dataset, *left, *dataset.shot(eyes.right, left->frame())); };
    const double first = baseline(lefts.front());
    for (const DatasetShot* left : lefts)
    {
      if (std::abs(baseline(left) - first) > 1e-9 * first)
      {
        throw UsageError(std::string(kittiOdometryName) + ": cameras " + quoted(eyes.left) + " and " +
                         quoted(eyes.right) + " are not equally far apart at all frames, which the format cannot say");
      }
    }
  }

  static void addPictures(ExportPlan& plan, const DatasetView& dataset, const CameraEyes& eyes,
    const std::string& folder, const OptionValues& options)
  {
    for (const std::string& camera : { eyes.left, eyes.right })
    {
      const std::string pictures = folder + (camera == eyes.left ? "image_2/" : "image_3/");
      const auto item = [&dataset, pictures, options](const DatasetShot& shot, std::size_t i)
      {
        const std::string name = pictures + padded(static_cast<int>(i), 6) + ".png";
        return named(shot, { { name }, [&dataset, &shot, name, options](ExportSink& sink)
                             { writePicture(sink, dataset, shot, exported::color().of(options), name, options); } });
      };
      plan.series.push_back(seriesOf(dataset, camera, item));
    }
  }

  static ExportItem documents(const DatasetView& dataset, const CameraEyes& eyes, const std::string& sequence)
  {
    const std::string calib = "sequences/" + sequence + "/calib.txt";
    const std::string times = "sequences/" + sequence + "/times.txt";
    const std::string poses = "poses/" + sequence + ".txt";
    return { { calib, times, poses }, [&dataset, eyes, calib, times, poses](ExportSink& sink)
      {
        const std::vector<const DatasetShot*> shots = dataset.shotsOf(eyes.left);
        const DatasetShot& first = *shots.front();
        sink.write(calib, calibration(dataset, first, dataset.shot(eyes.right, first.frame())));
        const std::unique_ptr<ExportFile> timesFile = sink.open(times);
        const std::unique_ptr<ExportFile> posesFile = sink.open(poses);
        for (const DatasetShot* shot : shots)
        {
          timesFile->write(scientific(dataset.seconds(shot->frame()) - dataset.seconds(first.frame())) + '\n');
          posesFile->write(poseLine(first, *shot, dataset.metres()) + '\n');
        }
        timesFile->finish();
        posesFile->finish();
      } };
  }

  static std::string scientific(double value)
  {
    char text[40];
    std::snprintf(text, sizeof text, "%.12e", value);
    return text;
  }

  static std::string poseLine(const DatasetShot& first, const DatasetShot& shot, double metres)
  {
    const bool same = shot.frame() == first.frame(); // the identity without rounding
    const Rigid3 pose = same ? Rigid3() : cameraFromWorld(first.camera) * cameraFromWorld(shot.camera).inverse();
    std::vector<double> numbers;
    for (int i = 0; i < 3; ++i)
    {
      numbers.insert(
        numbers.end(), { pose.rotation(i, 0), pose.rotation(i, 1), pose.rotation(i, 2), pose.translation[i] * metres });
    }
    return numbersLine(numbers);
  }

  static std::string calibration(const DatasetView& dataset, const DatasetShot& left, const DatasetShot* right)
  {
    const std::string first = kitti::projectionLine(left.camera, 0);
    const std::string second =
      right ? kitti::projectionLine(right->camera, -baselineMetres(dataset, left, *right)) : first;
    return "P0: " + first + "\nP1: " + second + "\nP2: " + first + "\nP3: " + second + "\nTr: " + kitti::scannerLine() +
           '\n';
  }
};
} // namespace

std::unique_ptr<Exporter> makeKittiOdometryExporter() { return std::make_unique<KittiOdometryExporter>(); }

} // namespace dgtk
