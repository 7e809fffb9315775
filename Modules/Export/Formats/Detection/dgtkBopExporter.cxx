// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopPictures.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dgtk
{

namespace
{
using Json = nlohmann::ordered_json;
constexpr const char* bopName = "bop";

const NumbersOption& depthScale()
{
  static const NumbersOption row("depth_scale", "X", 1, 0, "millimetres of a code of BOP's depth maps; default 0.1");
  return row;
}
double scaleOf(const OptionValues& options)
{
  const std::vector<double> given = depthScale().of(options);
  return given.empty() ? 0.1 : given[0];
}

const NamesOption& objectNames()
{
  static const NamesOption row("objects", "NAMES", "objects and classes that have poses; default all");
  return row;
}

/// Ids of the objects that have poses.
std::vector<std::uint32_t> objectsOf(const DatasetView& dataset, const OptionValues& options)
{
  std::vector<std::string> wanted = objectNames().of(options);
  std::vector<std::uint32_t> ids;
  std::vector<std::string> known;
  for (const ObjectRecord& object : dataset.objects())
  {
    const auto named = [&](const std::string& name) { return name == object.name || name == object.objectClass; };
    known.push_back(object.name);
    known.push_back(object.objectClass);
    if (wanted.empty() || std::any_of(wanted.begin(), wanted.end(), named))
    {
      ids.push_back(object.id);
    }
  }
  for (const std::string& name : wanted)
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw UsageError("objects: no object and no class " + quoted(name));
    }
  }
  return ids;
}

class BopExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &depthScale(), &objectNames() }; }

  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "objects", "boxes", "amodal" },
      { { "models", "on" } } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePinholes(dataset, bopName);
    requireNoSkew(dataset, bopName); // of camera.json
    dataset.metres();
    requireEverywhere(dataset, exported::color().of(options), bopName, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), bopName);
    for (const char* layer : { "objects", "boxes", "amodal" })
    {
      requireEverywhere(dataset, layer, bopName);
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    return this->planScenes({ &dataset }, options);
  }

  /// Each camera of each scene is a scene of BOP's; models are those of all.
  ExportPlan planScenes(const std::vector<const DatasetView*>& scenes, const OptionValues& options) const override
  {
    ExportPlan plan;
    const DatasetView& dataset = *scenes.front();
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", "x right, y down, z forward; R and t lead to the camera's axes" }, { "unit", "mm" },
      { "models", "origin in the middle of their box, scale in them" },
      { "mask", "all pixels in the image, hidden or not; exact, not by a tolerance of depth" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    std::vector<bop::Model> models;
    std::vector<std::shared_ptr<bop::Setting>> settings;
    for (const DatasetView* scene : scenes)
    {
      settings.push_back(std::make_shared<bop::Setting>());
      settings.back()->idOf = bop::addModels(*scene, objectsOf(*scene, options), models);
    }
    std::map<int, Eigen::Vector3d> origins;
    for (const bop::Model& model : models)
    {
      plan.items.push_back(bop::modelItem(model));
      plan.items.back().dataset = model.dataset;
      origins[model.id] = bop::originOf(model);
    }
    int place = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i)
    {
      settings[i]->origins = origins;
      settings[i]->depthScale = scaleOf(options);
      settings[i]->options = options;
      place = addScene(plan, *scenes[i], settings[i], models, place);
    }
    plan.documents.push_back(listing("models/models_info.json", "models", "{\n  ", ",\n  ", "\n}\n"));
    plan.documents.push_back(listing("models_eval/models_info.json", "models", "{\n  ", ",\n  ", "\n}\n"));
    plan.documents.push_back(listing("test_targets_bop19.json", "targets", "[\n  ", ",\n  ", "\n]\n"));
    plan.documents.push_back(wholeSet(dataset, options));
    return plan;
  }

private:
  /// The cameras of a dataset, whose scenes are numbered behind `before`. The last number.
  static int addScene(ExportPlan& plan, const DatasetView& dataset, const std::shared_ptr<const bop::Setting>& setting,
    const std::vector<bop::Model>& models, int before)
  {
    const std::vector<std::string> cameras = dataset.cameras();
    for (const DatasetSplit& split : splitsOf(dataset, setting->options, "test"))
    {
      for (std::size_t camera = 0; camera < cameras.size(); ++camera)
      {
        std::vector<std::uint32_t> shots = shotsIn(dataset, split);
        shots.erase(std::remove_if(shots.begin(), shots.end(),
                      [&](std::uint32_t i) { return dataset.shots()[i].name() != cameras[camera]; }),
          shots.end());
        const int number = before + int(camera) + 1;
        const bop::Place scene{ split.name, split.name + '/' + padded(number, 6) + '/', number, 0 };
        if (!shots.empty())
        {
          addDocuments(plan, scene, models);
        }
        plan.series.push_back({ shots.size(), [&dataset, shots, scene, setting](std::size_t i)
          {
            bop::Place place = scene;
            place.image = int(i);
            ExportItem item = bop::pictureItem(dataset, dataset.shots()[shots[i]], place, setting);
            item.dataset = &dataset;
            return item;
          } });
      }
    }
    return before + int(cameras.size());
  }

  /// A document of the notes of a list.
  static ExportItem listing(const std::string& name, const std::string& list, const std::string& before,
    const std::string& between, const std::string& after)
  {
    return { { name }, [name, list, before, between, after](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open(name);
        std::string next = before;
        sink.notes(list,
          [&](const std::string& text)
          {
            file->write(next + text);
            next = between;
          });
        file->write((next == before ? before : std::string()) + after);
        file->finish();
      } };
  }

  static void addDocuments(ExportPlan& plan, const bop::Place& scene, const std::vector<bop::Model>& models)
  {
    const auto add = [&](const std::string& name, const std::string& list)
    { plan.documents.push_back(listing(scene.folder + name, scene.list(list), "{\n  ", ",\n  ", "\n}\n")); };
    add("scene_camera.json", "camera");
    add("scene_gt.json", "gt");
    add("scene_gt_info.json", "info");
    Json categories = Json::array();
    for (const bop::Model& model : models)
    {
      categories.push_back({ { "id", model.id }, { "name", std::to_string(model.id) }, { "supercategory", "bop" } });
    }
    const std::string coco = scene.folder + "scene_gt_coco.json";
    plan.documents.push_back({ { coco }, [coco, scene, categories](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open(coco);
        file->write("{\n\"info\": {\"description\": \"scene " + std::to_string(scene.scene) +
                    "\"},\n\"licenses\": [],\n\"categories\": " + categories.dump());
        for (const auto& [key, list] : { std::pair<const char*, const char*>{ "images", "images" },
               std::pair<const char*, const char*>{ "annotations", "coco" } })
        {
          file->write(std::string(",\n\"") + key + "\": [");
          const char* between = "\n  ";
          sink.notes(scene.list(list),
            [&](const std::string& text)
            {
              file->write(between + text);
              between = ",\n  ";
            });
          file->write(std::string("\n]"));
        }
        file->write(std::string("\n}\n"));
        file->finish();
      } });
  }

  static ExportItem wholeSet(const DatasetView& dataset, const OptionValues& options)
  {
    return { { "camera.json", "dataset_info.json" }, [&dataset, options](ExportSink& sink)
      {
        const CameraRecord& first = dataset.shots().front().camera;
        const Eigen::Matrix3d K = intrinsicsOf(first, PixelCentre::Integer);
        const Json camera{ { "cx", K(0, 2) }, { "cy", K(1, 2) }, { "depth_scale", scaleOf(options) }, { "fx", K(0, 0) },
          { "fy", K(1, 1) }, { "height", first.height }, { "width", first.width } };
        Json info{ { "made_by", "DGTk" } };
        for (const auto& [key, text] : dataset.manifest().info)
        {
          info[key] = utf8FromBytes(text);
        }
        sink.write("camera.json", camera.dump(2) + '\n');
        sink.write("dataset_info.json", info.dump(2) + '\n');
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeBopExporter() { return std::make_unique<BopExporter>(); }

} // namespace dgtk
