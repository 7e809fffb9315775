// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkSintelFiles.h"

#include <limits>

namespace dgtk
{

namespace
{
constexpr const char* sintelName = "sintel";

const ChoiceOption& occlusions()
{
  static const ChoiceOption row("occlusions", { "flow", "stereo" },
    "what the folder of this name says: hidden in the next picture, as the flow's set; or in the right one, as "
    "stereo's");
  return row;
}

/// The pictures of a camera, and of the right one of its pair.
struct Scene
{
  std::string name;
  std::string right; ///< "" for none
  std::vector<std::uint32_t> shots;
};

/// What a frame of a scene has.
struct Frame
{
  const DatasetShot* left = nullptr;
  const DatasetShot* right = nullptr; ///< null: no pair, or no disparity
  bool flows = false;                 ///< to a next picture
  std::string place;                  ///< "SCENE/frame_0001"
};

class SintelExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &occlusions() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "flow_forward", "objects" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, sintelName);
    requireWhole(options, sintelName);
    requirePinholes(dataset, sintelName);
    requireConsecutive(dataset, sintelName);
    requireEverywhere(dataset, exported::color().of(options), sintelName, { "png" });
    for (const Scene& scene : scenesOf(dataset))
    {
      if (!scene.right.empty() && dataset.has("disparity"))
      {
        requireOneMatrix(dataset, { dataset.shots()[scene.shots.front()].name(), scene.right, "" }, sintelName);
      }
      for (const std::uint32_t i : scene.shots)
      {
        const DatasetShot& shot = dataset.shots()[i];
        requireFile(dataset, shot, exported::depth().of(options), sintelName);
        requireFile(dataset, shot, "objects", sintelName);
        if (dataset.shot(shot.name(), shot.frame() + 1))
        {
          requireFile(dataset, shot, "flow_forward", sintelName);
        }
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", "x right, y down, z forward; cameras are the camera's axes from the world's" },
      { "unit", "the dataset's; depth +inf for none" },
      { "occlusions",
        "255 where the classes of the flow are 2 to 5; invalid: class 0; outofframe: disparity's class 4" },
      { "of_occlusions", occlusions().of(options) } };
    for (const Scene& scene : scenesOf(dataset))
    {
      plan.series.push_back(seriesOf(dataset, scene.shots,
        [&dataset, scene, options](const DatasetShot& shot, std::size_t i)
        { return item(dataset, frameOf(dataset, scene, shot, i), options); }));
    }
    return plan;
  }

private:
  /// Without disparities the right camera of a pair is a scene like any other.
  static std::vector<Scene> scenesOf(const DatasetView& dataset)
  {
    std::vector<Scene> scenes;
    SafeNames names;
    const std::vector<CameraEyes> all = eyesOfDisparities(dataset);
    for (const CameraEyes& eyes : all)
    {
      names.of(eyes.left);
    }
    for (const CameraEyes& eyes : all)
    {
      scenes.push_back({ eyes.name, eyes.right, shotNumbers(dataset, eyes.left) });
      Scene lonely;
      for (const std::uint32_t number : shotNumbers(dataset, eyes.right))
      {
        const DatasetShot* left = dataset.shot(eyes.left, dataset.shots()[number].frame());
        if (!left || dataset.file(*left, "disparity").empty())
        {
          lonely.shots.push_back(number);
        }
      }
      if (!lonely.shots.empty())
      {
        lonely.name = names.of(eyes.name + "/right"); // no camera is called so
        scenes.push_back(lonely);
      }
    }
    return scenes;
  }

  static Frame frameOf(const DatasetView& dataset, const Scene& scene, const DatasetShot& left, std::size_t place)
  {
    const bool pair = !scene.right.empty() && !dataset.file(left, "disparity").empty();
    return { &left, pair ? dataset.shot(scene.right, left.frame()) : nullptr,
      dataset.shot(left.name(), left.frame() + 1) != nullptr,
      scene.name + "/frame_" + padded(static_cast<int>(place + 1), 4) };
  }

  static std::string path(const char* folder, const Frame& one, const char* extension)
  {
    return std::string("training/") + folder + '/' + one.place + extension;
  }

  static ExportItem item(const DatasetView& dataset, const Frame& one, const OptionValues& options)
  {
    const bool ofFlow = occlusions().of(options) == "flow";
    ExportItem item;
    item.files = { path("final", one, ".png"), path("depth", one, ".dpt"), path("camdata_left", one, ".cam"),
      path("segmentation", one, ".png") };
    if (one.flows)
    {
      item.files.insert(item.files.end(), { path("flow", one, ".flo"), path("invalid", one, ".png") });
    }
    if (one.right)
    {
      item.files.insert(item.files.end(), { path("final_left", one, ".png"), path("final_right", one, ".png"),
                                            path("disparities", one, ".png"), path("outofframe", one, ".png") });
    }
    if (ofFlow ? one.flows : one.right != nullptr)
    {
      item.files.push_back(path("occlusions", one, ".png"));
    }
    item.write = [&dataset, one, options, ofFlow](ExportSink& sink)
    {
      writeAlways(sink, dataset, one, options);
      if (one.flows)
      {
        writeFlow(sink, dataset, one, ofFlow);
      }
      if (one.right)
      {
        writeStereo(sink, dataset, one, options, !ofFlow);
      }
    };
    item.names.push_back({ one.left->name(), one.left->frame(), path("final", one, ".png") });
    if (one.right)
    {
      item.names.push_back({ one.right->name(), one.right->frame(), path("final_right", one, ".png") });
    }
    return item;
  }

  static void writeAlways(ExportSink& sink, const DatasetView& dataset, const Frame& one, const OptionValues& options)
  {
    writePicture(sink, dataset, *one.left, exported::color().of(options), path("final", one, ".png"), options);
    FloatFile depth;
    depth.kind = FloatFile::Kind::Dpt;
    depth.nothing = std::numeric_limits<float>::infinity();
    depth.unit = "scene units";
    writeFloatLayer(sink, dataset, *one.left, exported::depth().of(options), path("depth", one, ".dpt"), depth);
    sink.write(path("camdata_left", one, ".cam"), sintel::cameraBytes(one.left->camera), { "", one.left, {} });
    std::map<std::uint32_t, std::uint32_t> ids;
    for (const ObjectRecord& object : dataset.objects())
    {
      ids[object.id] = object.id;
    }
    writeIdPng(sink, dataset, *one.left, "objects", path("segmentation", one, ".png"), ids, IdBytes::RedHigh);
  }

  static void writeFlow(ExportSink& sink, const DatasetView& dataset, const Frame& one, bool occluded)
  {
    FloatFile flow;
    flow.kind = FloatFile::Kind::Flo;
    flow.channels = 2;
    flow.nothing = 1e10F;
    flow.unit = "px";
    writeFloatLayer(sink, dataset, *one.left, "flow_forward", path("flow", one, ".flo"), flow);
    writeIdPng(sink, dataset, *one.left, "flow_forward_class", path("invalid", one, ".png"), { { 0, 255 } });
    if (occluded)
    {
      writeIdPng(sink, dataset, *one.left, "flow_forward_class", path("occlusions", one, ".png"),
        { { 2, 255 }, { 3, 255 }, { 4, 255 }, { 5, 255 } });
    }
  }

  static void writeStereo(
    ExportSink& sink, const DatasetView& dataset, const Frame& one, const OptionValues& options, bool occluded)
  {
    const std::string color = exported::color().of(options);
    writePicture(sink, dataset, *one.left, color, path("final_left", one, ".png"), options);
    writePicture(sink, dataset, *one.right, color, path("final_right", one, ".png"), options);
    sintel::writeDisparity(sink, dataset, *one.left, path("disparities", one, ".png"), options);
    writeIdPng(sink, dataset, *one.left, "disparity_class", path("outofframe", one, ".png"), { { 4, 255 } });
    if (occluded)
    {
      writeIdPng(
        sink, dataset, *one.left, "disparity_class", path("occlusions", one, ".png"), { { 2, 255 }, { 3, 255 } });
    }
  }
};
} // namespace

std::unique_ptr<Exporter> makeSintelExporter() { return std::make_unique<SintelExporter>(); }

} // namespace dgtk
