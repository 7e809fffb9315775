// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopModels.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkRunLengths.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
using Json = nlohmann::ordered_json;
constexpr const char* format = "bop";
constexpr double millimetres = 1000; ///< of a metre

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

/// A picture's place in the set.
struct Place
{
  std::string split;
  std::string folder; ///< "SPLIT/%06d/"
  int scene = 0;
  int image = 0;
  std::string list(const std::string& name) const { return name + ':' + this->folder; }
  std::string file(const std::string& kind, const std::string& extension = "png") const
  {
    return this->folder + kind + '/' + padded(this->image, 6) + '.' + extension;
  }
  std::string mask(const std::string& kind, std::size_t instance) const
  {
    return this->folder + kind + '/' + padded(this->image, 6) + '_' + padded(int(instance), 6) + ".png";
  }
};

Json listOf(const Eigen::Matrix3d& matrix)
{
  Json list = Json::array();
  for (int i = 0; i < 9; ++i)
  {
    list.push_back(matrix(i / 3, i % 3));
  }
  return list;
}
Json listOf(const Eigen::Vector3d& vector) { return { vector[0], vector[1], vector[2] }; }

/// [x, y, w, h] as calc_2d_bbox has it: w is the last column less the first; -1s without a visible pixel.
Json boxOf(const std::optional<Eigen::Vector4d>& borders, bool visible)
{
  if (!borders || !visible)
  {
    return { -1, -1, -1, -1 };
  }
  const Eigen::Vector4d& b = *borders;
  return { b[0], b[1], b[2] - 1 - b[0], b[3] - 1 - b[1] };
}

void writeMask(ExportSink& sink, const std::string& name, const RunLengths& mask)
{
  std::vector<unsigned char> pixels(std::size_t(mask.width) * std::size_t(mask.height));
  std::size_t at = 0;
  for (std::size_t i = 0; i < mask.counts.size(); ++i)
  {
    for (std::uint64_t k = 0; k < mask.counts[i]; ++k, ++at)
    {
      pixels[at % std::size_t(mask.height) * std::size_t(mask.width) + at / std::size_t(mask.height)] =
        i % 2 == 0 ? 0 : 255;
    }
  }
  PngEncoder::Header header;
  header.width = mask.width;
  header.height = mask.height;
  header.channels = 1;
  header.prediction = PngPrediction::Labels;
  writePng(sink, name, {}, header,
    [&](int y, unsigned char* row)
    { std::copy_n(pixels.begin() + std::ptrdiff_t(y) * header.width, header.width, row); });
}

/// Where depth has a code: whole rows, as run lengths have them column by column.
std::vector<char> validDepth(
  const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const LinearCode& code)
{
  ClassedRows rows(dataset, shot, layer);
  const int width = rows.info().width;
  const int height = rows.info().height;
  std::vector<char> valid(std::size_t(width) * std::size_t(height));
  for (int y = 0; y < height; ++y)
  {
    rows.next();
    for (int x = 0; x < width; ++x)
    {
      valid[std::size_t(x) * std::size_t(height) + std::size_t(y)] = code.of(rows.at(x)) != code.nothing;
    }
  }
  return valid;
}

std::uint64_t countIn(const RunLengths& mask, const std::vector<char>& valid)
{
  std::uint64_t count = 0;
  auto at = valid.begin();
  for (std::size_t i = 0; i < mask.counts.size(); ++i)
  {
    const auto end = at + std::ptrdiff_t(mask.counts[i]);
    count += i % 2 == 0 ? 0 : std::uint64_t(std::count(at, end, char(1)));
    at = end;
  }
  return count;
}

/// Objects of a picture that are in it or around it, in the order of their instances.
std::vector<BoxRecord> instancesOf(const DatasetView& dataset, const DatasetShot& shot, const bop::Models& models)
{
  std::vector<BoxRecord> instances;
  for (const BoxRecord& box : dataset.boxes(shot))
  {
    if (models.idOf.count(box.id) > 0 && box.pixelsWhole > 0)
    {
      instances.push_back(box);
    }
  }
  return instances;
}

class BopExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &depthScale(), &objectNames() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "objects", "boxes", "amodal" },
      { { "models", "on" } } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePinholes(dataset, format);
    dataset.metres();
    bop::modelsOf(dataset, objectsOf(dataset, options));
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), format);
    for (const char* layer : { "objects", "boxes", "amodal" })
    {
      requireEverywhere(dataset, layer, format);
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", "x right, y down, z forward; R and t lead to the camera's axes" }, { "unit", "mm" },
      { "models", "origin in the middle of their box, scale in them" },
      { "mask", "all pixels in the image, hidden or not; exact, not by a tolerance of depth" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    const bop::Models models = bop::modelsOf(dataset, objectsOf(dataset, options));
    std::map<int, Eigen::Vector3d> origins;
    for (const bop::Model& model : models.models)
    {
      plan.items.push_back(bop::modelItem(dataset, model));
      origins[model.id] = bop::originOf(dataset, model);
    }
    std::map<std::string, std::vector<Place>> scenes; // by folder
    const std::vector<std::string> cameras = dataset.cameras();
    for (const DatasetSplit& split : splitsOf(dataset, options, "test"))
    {
      for (const DatasetShot& shot : dataset.shots())
      {
        if (!split.holds(shot.frame()))
        {
          continue;
        }
        const int scene = int(std::find(cameras.begin(), cameras.end(), shot.name()) - cameras.begin()) + 1;
        Place place{ split.name, split.name + '/' + padded(scene, 6) + '/', scene, 0 };
        place.image = int(scenes[place.folder].size());
        scenes[place.folder].push_back(place);
        plan.items.push_back(picture(dataset, shot, place, models, origins, options));
        plan.names.push_back({ shot.name(), shot.frame(), plan.items.back().files[0] });
      }
    }
    for (const auto& [folder, places] : scenes)
    {
      addDocuments(plan, dataset, places.front(), models);
    }
    plan.documents.push_back(listing("models/models_info.json", "models", "{\n  ", ",\n  ", "\n}\n"));
    plan.documents.push_back(listing("models_eval/models_info.json", "models", "{\n  ", ",\n  ", "\n}\n"));
    plan.documents.push_back(listing("test_targets_bop19.json", "targets", "[\n  ", ",\n  ", "\n]\n"));
    plan.documents.push_back(wholeSet(dataset, options));
    return plan;
  }

private:
  static ExportItem picture(const DatasetView& dataset, const DatasetShot& shot, const Place& place,
    const bop::Models& models, const std::map<int, Eigen::Vector3d>& origins, const OptionValues& options)
  {
    const std::string rgb = place.file("rgb", pictureExtension(options));
    ExportItem item{ { rgb, place.file("depth") }, {} };
    const std::size_t count = instancesOf(dataset, shot, models).size();
    for (std::size_t i = 0; i < count; ++i)
    {
      item.files.push_back(place.mask("mask", i));
      item.files.push_back(place.mask("mask_visib", i));
    }
    item.write = [&dataset, &shot, place, models, origins, options, rgb](ExportSink& sink)
    {
      LinearCode code;
      code.factor = millimetres * dataset.metres();
      code.scale = scaleOf(options);
      code.unit = "mm";
      const std::string depth = exported::depth().of(options);
      writePicture(sink, dataset, shot, exported::color().of(options), rgb, options);
      writeCodedPng(sink, dataset, shot, depth, place.file("depth"), code, options);
      writeTruth(sink, dataset, shot, place, models, origins, validDepth(dataset, shot, depth, code));
      const Rigid3 pose = cameraFromWorld(shot.camera);
      const Json camera{ { "cam_K", listOf(intrinsicsOf(shot.camera, PixelCentre::Integer)) },
        { "depth_scale", scaleOf(options) }, { "cam_R_w2c", listOf(pose.rotation) },
        { "cam_t_w2c", listOf(Eigen::Vector3d(pose.translation * code.factor)) } };
      sink.note(place.list("camera"), key(place) + camera.dump());
      const Json image{ { "id", place.image }, { "file_name", rgb.substr(place.folder.size()) },
        { "width", shot.camera.width }, { "height", shot.camera.height } };
      sink.note(place.list("images"), image.dump());
    };
    return item;
  }

  static std::string key(const Place& place) { return '"' + std::to_string(place.image) + "\": "; }

  static void writeTruth(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const Place& place,
    const bop::Models& models, const std::map<int, Eigen::Vector3d>& origins, const std::vector<char>& valid)
  {
    const std::map<std::uint32_t, RunLengths> visible = masksOf(dataset.read(shot, "objects").pixels);
    const AmodalMasks whole = dataset.amodal(shot);
    Json poses = Json::array();
    Json infos = Json::array();
    std::map<int, int> targets;
    std::size_t instance = 0;
    for (const BoxRecord& box : instancesOf(dataset, shot, models))
    {
      const auto seen = visible.find(box.id);
      const auto amodal =
        std::find_if(whole.masks.begin(), whole.masks.end(), [&](const MaskRecord& one) { return one.id == box.id; });
      const std::uint64_t pixels = std::uint64_t(whole.width) * std::uint64_t(whole.height);
      const RunLengths none{ whole.width, whole.height, { pixels } };
      const RunLengths all =
        amodal == whole.masks.end() ? none : RunLengths{ whole.width, whole.height, amodal->counts };
      const RunLengths& own = seen == visible.end() ? none : seen->second;
      const int id = models.idOf.at(box.id);
      writeMask(sink, place.mask("mask", instance), all);
      writeMask(sink, place.mask("mask_visib", instance), own);
      const Eigen::Vector3d t = (box.t + box.R * origins.at(id)) * (millimetres * dataset.metres());
      poses.push_back({ { "cam_R_m2c", listOf(box.R) }, { "cam_t_m2c", listOf(t) }, { "obj_id", id } });
      const double fraction = double(box.pixelsVisible) / double(box.pixelsWhole);
      const bool sees = box.pixelsVisible > 0;
      infos.push_back({ { "bbox_obj", boxOf(box.whole, sees) }, { "bbox_visib", boxOf(box.visible, sees) },
        { "px_count_all", box.pixelsWhole }, { "px_count_valid", countIn(all, valid) },
        { "px_count_visib", box.pixelsVisible }, { "visib_fract", fraction } });
      constexpr double least = 0.1; ///< of an object is visible where it is to be found
      targets[id] += fraction >= least ? 1 : 0;
      if (sees)
      {
        sink.note(place.list("coco"), annotation(place, instance, id, own, all).dump());
      }
      ++instance;
    }
    sink.note(place.list("gt"), key(place) + poses.dump());
    sink.note(place.list("info"), key(place) + infos.dump());
    for (const auto& [id, count] : targets)
    {
      if (place.split.rfind("test", 0) == 0 && count > 0)
      {
        sink.note("targets",
          Json{ { "im_id", place.image }, { "inst_count", count }, { "obj_id", id }, { "scene_id", place.scene } }
            .dump());
      }
    }
  }

  static Json annotation(const Place& place, std::size_t instance, int id, const RunLengths& own, const RunLengths& all)
  {
    constexpr int most = 100000; ///< instances of a picture
    const auto box = [](const RunLengths& mask)
    {
      const Eigen::Vector4d b = mask.box();
      return Json{ b[0], b[1], b[2], b[3] };
    };
    return { { "id", std::int64_t(place.image) * most + std::int64_t(instance) + 1 }, { "image_id", place.image },
      { "category_id", id }, { "iscrowd", 0 }, { "area", own.area() }, { "bbox", box(all) },
      { "segmentation", { { "size", { own.height, own.width } }, { "counts", own.counts } } }, { "width", own.width },
      { "height", own.height }, { "ignore", false } };
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

  static void addDocuments(ExportPlan& plan, const DatasetView&, const Place& scene, const bop::Models& models)
  {
    const auto add = [&](const std::string& name, const std::string& list)
    { plan.documents.push_back(listing(scene.folder + name, scene.list(list), "{\n  ", ",\n  ", "\n}\n")); };
    add("scene_camera.json", "camera");
    add("scene_gt.json", "gt");
    add("scene_gt_info.json", "info");
    Json categories = Json::array();
    for (const bop::Model& model : models.models)
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
