// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkPortableMath.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace dgtk
{

namespace
{
using Json = nlohmann::ordered_json;
constexpr const char* nerfSyntheticName = "nerf-synthetic";
constexpr const char* layer = "color_rgba";

[[noreturn]] void refuseCamera(const CameraRecord& camera, const std::string& what)
{
  throw UsageError(std::string(nerfSyntheticName) + ": camera " + quoted(camera.name) + ' ' + what +
                   ", and the format has one angle of view around the middle of square pixels");
}

void requireSayable(const CameraRecord& camera, const CameraRecord& first)
{
  constexpr double pixels = 1e-9;
  const Eigen::Matrix3d& K = camera.K;
  if (std::abs(K(0, 0) - K(1, 1)) > pixels * K(0, 0) || K(0, 1) != 0)
  {
    refuseCamera(camera, "has pixels that are not square");
  }
  if (std::abs(2 * K(0, 2) - camera.width) > pixels * camera.width ||
      std::abs(2 * K(1, 2) - camera.height) > pixels * camera.height)
  {
    refuseCamera(camera, "has its principal point beside the middle");
  }
  if (std::abs(K(0, 0) - first.K(0, 0)) > pixels * K(0, 0) || camera.width != first.width ||
      camera.height != first.height)
  {
    refuseCamera(camera, "has another size or angle of view than " + quoted(first.name));
  }
}

class NerfSyntheticExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues&) const override { return { { layer }, { { "samples", "8" } } }; }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, nerfSyntheticName);
    requirePinholes(dataset, nerfSyntheticName);
    for (const DatasetShot& shot : dataset.shots())
    {
      requireSayable(shot.camera, dataset.shots().front().camera);
    }
    requireUsualSplits(dataset, options, nerfSyntheticName);
    requireEverywhere(dataset, layer, nerfSyntheticName, { "png" });
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "the angle of view is that of the whole width; the middle is at w/2, h/2" },
      { "axes", "x right, y up, z back; world from camera" }, { "alpha", "straight" } };
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const auto item = [&dataset, part = split.name, options](const DatasetShot& shot, std::size_t i)
      { return named(shot, itemOf(dataset, shot, part + "/r_" + std::to_string(i), part, options)); };
      plan.series.push_back(seriesOf(dataset, shotsIn(dataset, split), item));
      plan.documents.push_back(document(dataset, split.name));
    }
    return plan;
  }

private:
  static ExportItem itemOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& stem,
    const std::string& split, const OptionValues& options)
  {
    return { { stem + ".png" }, [&dataset, &shot, stem, split, options](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, layer, stem + ".png", options);
        const Json frame{ { "file_path", "./" + stem }, { "rotation", 0.0 },
          { "transform_matrix", matrixRows(worldFromCameraGL(shot.camera)) } };
        sink.note("frames:" + split, frame.dump());
      } };
  }

  static ExportItem document(const DatasetView& dataset, const std::string& split)
  {
    const std::string name = "transforms_" + split + ".json";
    return { { name }, [&dataset, name, split](ExportSink& sink)
      {
        const CameraRecord& first = dataset.shots().front().camera;
        const Json angle = 2 * portable::atan(first.width / (2 * first.K(0, 0)));
        const std::unique_ptr<ExportFile> file = sink.open(name);
        file->write("{\n \"camera_angle_x\": " + angle.dump() + ",\n \"frames\": [");
        writeNotes(sink, *file, "frames:" + split);
        file->write(std::string("\n ]\n}\n"));
        file->finish();
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeNerfSyntheticExporter() { return std::make_unique<NerfSyntheticExporter>(); }

} // namespace dgtk
