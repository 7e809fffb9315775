// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkHdf5File.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"

#include <array>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
constexpr const char* springName = "spring";
constexpr int gzipLevel = 5;

/// A kind of truth: "flow_FW" in frame_left's sequence is layer flow_forward.
struct Truth
{
  const char* folder;
  const char* layer;
  const char* member;
  const char* extension;
  int step; ///< frames to the other picture
};
constexpr Truth truths[] = { { "disp1", "disparity", "disparity", "dsp5", 0 },
  { "disp2_FW", "disparity_forward", "disparity", "dsp5", 1 },
  { "disp2_BW", "disparity_backward", "disparity", "dsp5", -1 }, { "flow_FW", "flow_forward", "flow", "flo5", 1 },
  { "flow_BW", "flow_backward", "flow", "flo5", -1 } };

/// Where the files of an eye at a frame are.
struct EyePlace
{
  std::string folder; ///< "train/0001/"
  std::string side;   ///< "left" or "right"
  std::string number; ///< "0001"
  std::string path(const std::string& kind, const std::string& extension) const
  {
    const std::string stem = kind + '_' + this->side;
    return this->folder + stem + '/' + stem + '_' + this->number + '.' + extension;
  }
};

/// Light of a code of 8 bits.
double lightOf(double code)
{
  static const std::array<double, 256> table = []
  {
    std::array<double, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
    {
      made[i] = portable::linearFromSrgb(double(i) / 255);
    }
    return made;
  }();
  return table[static_cast<std::size_t>(code)];
}

/// Half as wide and high: the mean of four pixels' light, rounded to 8 bits.
void writeHalfPicture(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name)
{
  const std::unique_ptr<RowReader> reader = dataset.open(shot, layer, { "png" });
  PngEncoder::Header header;
  header.width = reader->info().width / 2;
  header.height = reader->info().height / 2;
  header.srgb = true;
  const ExportedPixels pixels{ layer, &shot, { "half-picture", { { "rounding", { 0.5 } } } } };
  writePng(sink, name, pixels, header,
    [&](int y, unsigned char* row)
    {
      const Rows rows = reader->read(2);
      for (int i = 0; i < 3 * header.width; ++i)
      {
        double light = 0;
        for (int k = 0; k < 4; ++k)
        {
          light += lightOf(valueAt(rows, i / 3 * 2 + k % 2, 2 * y + k / 2, i % 3)) / 4;
        }
        row[i] = static_cast<unsigned char>(255 * portable::srgbFromLinear(light) + 0.5);
      }
    });
  sink.rounding({ layer, "levels", 0.5, std::uint64_t(header.width) * unsigned(header.height), 0 });
}

/// In pixels of the picture, two of the layer's.
void writeTruth(
  ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const Truth& truth, const std::string& name)
{
  ClassedRows rows(dataset, shot, truth.layer);
  const ImageInfo& info = rows.info();
  FloatRounder rounder(std::numeric_limits<float>::quiet_NaN(), truth.layer, "px");
  Hdf5File file(gzipLevel);
  file.add(truth.member, Hdf5File::Type::Float32, { info.height, info.width, info.channels },
    [&](int, void* row)
    {
      rows.next();
      for (int i = 0; i < info.width * info.channels; ++i)
      {
        static_cast<float*>(row)[i] = rounder(rows.at(i / info.channels, i % info.channels) / 2);
      }
    });
  sink.write(name, file.bytes(), { truth.layer, &shot, { "hdf5", { { "factor", { 0.5 } } } } });
  sink.rounding(rounder.account());
  rows.reportGone(sink, info.channels);
}

class SpringExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    ExportNeeds needs{ { exported::color().of(options) } };
    for (const Truth& truth : truths)
    {
      needs.layers.emplace_back(truth.layer);
    }
    return needs;
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, springName);
    requirePng(options, springName);
    requireConsecutive(dataset, springName);
    requireNoSkew(dataset, springName);
    dataset.metres();
    for (const CameraEyes& pair : pairsOf(dataset, springName))
    {
      requireOneMatrix(dataset, pair, springName);
      for (const std::string& camera : { pair.left, pair.right })
      {
        for (const DatasetShot* shot : dataset.shotsOf(camera))
        {
          checkShot(dataset, *shot, options);
        }
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "size", "pictures are half as wide and high as the dataset's, ground truth as large" },
      { "unit", "flow and disparity: pixels of the pictures; poses: metres" },
      { "pixel_centre", "(0.5, 0.5): cx is half of the width in the middle" },
      { "axes", "x right, y down, z forward; poses are the left camera's axes from the world's" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    int number = 0;
    for (const CameraEyes& pair : pairsOf(dataset, springName))
    {
      const std::string folder = "train/" + padded(++number, 4) + '/';
      addEye(plan, dataset, pair.left, "left", folder, options);
      addEye(plan, dataset, pair.right, "right", folder, options);
      plan.series.push_back(seriesOf(cameras(dataset, pair.left, folder + "cam_data/")));
    }
    return plan;
  }

private:
  static void checkShot(const DatasetView& dataset, const DatasetShot& shot, const OptionValues& options)
  {
    const std::string color = exported::color().of(options);
    requireFile(dataset, shot, color, springName, { "png" });
    for (const Truth& truth : truths)
    {
      if (dataset.shot(shot.name(), shot.frame() + truth.step))
      {
        requireFile(dataset, shot, truth.layer, springName);
      }
    }
    const std::string place = "camera " + quoted(shot.name()) + " at frame " + std::to_string(shot.frame());
    if (shot.camera.width % 2 != 0 || shot.camera.height % 2 != 0)
    {
      throw UsageError(std::string(springName) + ": " + place +
                       " has an odd width or height; the dataset must be rendered " +
                       "twice as wide and high as the pictures will be");
    }
    const ImageInfo info = dataset.open(shot, color, { "png" })->info();
    if (info.type != PixelType::UInt8 || info.channels < 3)
    {
      throw UsageError(
        std::string(springName) + ": the picture of " + place + " does not have three colours of 8 bits");
    }
  }

  static void addEye(ExportPlan& plan, const DatasetView& dataset, const std::string& camera, const std::string& side,
    const std::string& folder, const OptionValues& options)
  {
    plan.series.push_back(seriesOf(dataset, camera,
      [&dataset, side, folder, options](const DatasetShot& shot, std::size_t i) {
        return item(dataset, shot, { folder, side, padded(static_cast<int>(i + 1), 4) }, options);
      }));
  }

  static ExportItem item(
    const DatasetView& dataset, const DatasetShot& shot, const EyePlace& place, const OptionValues& options)
  {
    ExportItem item{ { place.path("frame", "png") }, {} };
    std::vector<std::pair<const Truth*, std::string>> there;
    for (const Truth& truth : truths)
    {
      if (dataset.shot(shot.name(), shot.frame() + truth.step))
      {
        there.emplace_back(&truth, place.path(truth.folder, truth.extension));
        item.files.push_back(there.back().second);
      }
    }
    item.write = [&dataset, &shot, picture = item.files[0], there, options](ExportSink& sink)
    {
      writeHalfPicture(sink, dataset, shot, exported::color().of(options), picture);
      for (const auto& [truth, name] : there)
      {
        writeTruth(sink, dataset, shot, *truth, name);
      }
    };
    return named(shot, item);
  }

  static ExportItem cameras(const DatasetView& dataset, const std::string& camera, const std::string& folder)
  {
    const std::string first = folder + "intrinsics.txt";
    const std::string second = folder + "extrinsics.txt";
    return { { first, second }, [&dataset, camera, first, second](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> intrinsics = sink.open(first);
        const std::unique_ptr<ExportFile> extrinsics = sink.open(second);
        for (const DatasetShot* shot : dataset.shotsOf(camera))
        {
          const Eigen::Matrix3d K = intrinsicsOf(shot->camera, PixelCentre::Half) / 2;
          intrinsics->write(numbersLine({ K(0, 0), K(1, 1), K(0, 2), K(1, 2) }) + '\n');
          Rigid3 view = cameraFromWorld(shot->camera);
          view.translation *= dataset.metres();
          extrinsics->write(matrixLine(view) + '\n');
        }
        intrinsics->finish();
        extrinsics->finish();
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeSpringExporter() { return std::make_unique<SpringExporter>(); }

} // namespace dgtk
