// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"

#include <algorithm>
#include <cctype>
#include <limits>

namespace dgtk
{

namespace
{
constexpr const char* flyingthingsName = "flyingthings";
constexpr float nothing = 1e10F; ///< finite, so that a masked loss stays a number
constexpr int firstNumber = 6;   ///< of a sequence's pictures

FloatFile pfm(int channels, const std::string& unit)
{
  FloatFile form;
  form.channels = channels;
  form.nothing = nothing;
  form.unit = unit;
  return form;
}

/// One eye at one frame.
struct Eye
{
  const DatasetShot* shot = nullptr;
  std::string sequence; ///< "TRAIN/A/0000/"
  std::string side;     ///< "left" or "right"
  std::string number;   ///< "0006"
  std::string path(const std::string& folder, const std::string& extension) const
  {
    return folder + this->sequence + this->side + '/' + this->number + extension;
  }
};

/// Layers that lead to the frame after, or before.
struct Direction
{
  const char* flow;
  const char* disparity;
  const char* folder;
  const char* flowFile;
};
constexpr Direction directions[] = {
  { "flow_forward", "disparity_forward", "into_future/", "OpticalFlowIntoFuture_" },
  { "flow_backward", "disparity_backward", "into_past/", "OpticalFlowIntoPast_" },
};

std::string flowPath(const Eye& eye, const Direction& way)
{
  return "optical_flow/" + eye.sequence + way.folder + eye.side + '/' + way.flowFile + eye.number +
         (eye.side == "left" ? "_L.pfm" : "_R.pfm");
}
std::string changePath(const Eye& eye, const Direction& way)
{
  return "disparity_change/" + eye.sequence + way.folder + eye.side + '/' + eye.number + ".pfm";
}

void writeFlow(ExportSink& sink, const DatasetView& dataset, const Eye& eye, const Direction& way)
{
  ClassedRows rows(dataset, *eye.shot, way.flow);
  writeFloats(sink, flowPath(eye, way), { way.flow, eye.shot, { "flow-pfm", { { "nothing", { double(nothing) } } } } },
    pfm(3, "px"), rows.info().width, rows.info().height, 2,
    [&](int, double* row)
    {
      rows.next();
      for (int i = 0; i < 2 * rows.info().width; ++i)
      {
        row[i] = rows.at(i / 2, i % 2);
      }
    });
  rows.reportGone(sink, 2);
}

void writeChange(ExportSink& sink, const DatasetView& dataset, const Eye& eye, const Direction& way)
{
  ClassedRows there(dataset, *eye.shot, way.disparity);
  ClassedRows here(dataset, *eye.shot, "disparity");
  writeFloats(sink, changePath(eye, way),
    { way.disparity, eye.shot, { "disparity-change", { { "nothing", { double(nothing) } } } } }, pfm(1, "px"),
    here.info().width, here.info().height, 1,
    [&](int, double* row)
    {
      there.next();
      here.next();
      for (int x = 0; x < here.info().width; ++x)
      {
        row[x] = there.at(x) - here.at(x);
      }
    });
  there.reportGone(sink, 1);
}

/// Readers of the set pair the files of a folder by their order, so that none may be missing: where a frame has no
/// layer, there is nothing at all its pixels.
void writeNothing(
  ExportSink& sink, const Eye& eye, const std::string& layer, const std::string& name, int channels, int filled)
{
  const CameraRecord& camera = eye.shot->camera;
  writeFloats(sink, name, { layer, eye.shot, { "nothing", { { "nothing", { double(nothing) } } } } },
    pfm(channels, "px"), camera.width, camera.height, filled,
    [&](int, double* row) { std::fill_n(row, filled * camera.width, std::numeric_limits<double>::quiet_NaN()); });
}

void writeObjects(ExportSink& sink, const DatasetView& dataset, const Eye& eye)
{
  PixelEncoding encoding{ "ids", { { "nothing", { 0 } } } };
  std::vector<double>& codes = encoding.numbers["codes"];
  for (const ObjectRecord& object : dataset.objects())
  {
    codes.insert(codes.end(), { double(object.id), double(object.id) });
  }
  const std::unique_ptr<RowReader> reader = dataset.open(*eye.shot, "objects");
  writeFloats(sink, eye.path("object_index/", ".pfm"), { "objects", eye.shot, encoding }, pfm(1, "id"),
    reader->info().width, reader->info().height, 1,
    [&](int y, double* row)
    {
      const Rows rows = reader->read(1);
      for (int x = 0; x < rows.width(); ++x)
      {
        row[x] = idAt(rows, x, y);
      }
    });
}

std::string upper(std::string text)
{
  for (char& c : text)
  {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return text;
}

class FlyingThingsExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "disparity", "disparity_forward", "disparity_backward", "flow_forward",
      "flow_backward", "objects" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, flyingthingsName);
    requireConsecutive(dataset, flyingthingsName);
    for (const CameraEyes& eyes : pairsOf(dataset, flyingthingsName))
    {
      requireOneMatrix(dataset, eyes, flyingthingsName);
      for (const std::string& camera : { eyes.left, eyes.right })
      {
        for (const DatasetShot* shot : dataset.shotsOf(camera))
        {
          requireFile(dataset, *shot, exported::color().of(options), flyingthingsName, { "png" });
          requireFile(dataset, *shot, "disparity", flyingthingsName);
          requireFile(dataset, *shot, "objects", flyingthingsName);
        }
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less; files hold neither K nor baseline" },
      { "axes", "cameras: world's axes from the camera's, x right, y up, z back; flow: y down" },
      { "unit", "the dataset's" }, { "nothing", "1e10, in every .pfm" } };
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      int number = 0;
      for (const CameraEyes& eyes : pairsOf(dataset, flyingthingsName))
      {
        addSequence(plan, dataset, eyes, split, upper(split.name) + "/A/" + padded(number++, 4) + '/', options);
      }
    }
    return plan;
  }

private:
  static void addSequence(ExportPlan& plan, const DatasetView& dataset, const CameraEyes& eyes,
    const DatasetSplit& split, const std::string& sequence, const OptionValues& options)
  {
    std::vector<std::uint32_t> lefts = shotNumbers(dataset, eyes.left);
    lefts.erase(
      std::remove_if(lefts.begin(), lefts.end(), [&](std::uint32_t i) { return !split.holds(dataset.shots()[i]); }),
      lefts.end());
    plan.series.push_back({ 2 * lefts.size(), [&dataset, lefts, sequence, right = eyes.right, options](std::size_t i)
      {
        const DatasetShot& left = dataset.shots()[lefts[i / 2]];
        const bool isLeft = i % 2 == 0;
        return item(dataset,
          { isLeft ? &left : dataset.shot(right, left.frame()), sequence, isLeft ? "left" : "right",
            padded(firstNumber + static_cast<int>(i / 2), 4) },
          options);
      } });
    const std::string name = "camera_data/" + sequence + "camera_data.txt";
    plan.series.push_back(seriesOf({ { name }, [&dataset, lefts, right = eyes.right, name](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open(name);
        int number = firstNumber;
        for (const std::uint32_t i : lefts)
        {
          const DatasetShot& left = dataset.shots()[i];
          file->write("Frame " + std::to_string(number++) + '\n' + "L " + matrixLine(worldFromCameraGL(left.camera)) +
                      "\nR " + matrixLine(worldFromCameraGL(dataset.shot(right, left.frame())->camera)) + "\n\n");
        }
        file->finish();
      } }));
  }

  static ExportItem item(const DatasetView& dataset, const Eye& eye, const OptionValues& options)
  {
    ExportItem item;
    item.files = { eye.path("frames_finalpass/", ".png"), eye.path("disparity/", ".pfm"),
      eye.path("object_index/", ".pfm") };
    for (const Direction& way : directions)
    {
      if (dataset.has(way.flow))
      {
        item.files.push_back(flowPath(eye, way));
      }
      if (dataset.has(way.disparity))
      {
        item.files.push_back(changePath(eye, way));
      }
    }
    item.write = [&dataset, eye, options](ExportSink& sink)
    {
      writePicture(
        sink, dataset, *eye.shot, exported::color().of(options), eye.path("frames_finalpass/", ".png"), options);
      writeFloatLayer(sink, dataset, *eye.shot, "disparity", eye.path("disparity/", ".pfm"), pfm(1, "px"));
      writeObjects(sink, dataset, eye);
      for (const Direction& way : directions)
      {
        if (!dataset.file(*eye.shot, way.flow).empty())
        {
          writeFlow(sink, dataset, eye, way);
        }
        else if (dataset.has(way.flow))
        {
          writeNothing(sink, eye, way.flow, flowPath(eye, way), 3, 2);
        }
        if (!dataset.file(*eye.shot, way.disparity).empty())
        {
          writeChange(sink, dataset, eye, way);
        }
        else if (dataset.has(way.disparity))
        {
          writeNothing(sink, eye, way.disparity, changePath(eye, way), 1, 1);
        }
      }
    };
    return named(*eye.shot, item);
  }
};
} // namespace

std::unique_ptr<Exporter> makeFlyingThingsExporter() { return std::make_unique<FlyingThingsExporter>(); }

} // namespace dgtk
