// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopPictures.h"

#include "dgtkExport.h"
#include "dgtkExportPng.h"
#include "dgtkMaskPng.h"
#include "dgtkRunLengths.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dgtk::bop
{

namespace
{
using Json = nlohmann::ordered_json;
constexpr double pictureMillimetres = 1000; ///< of a metre

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
std::vector<BoxRecord> instancesOf(
  const DatasetView& dataset, const DatasetShot& shot, const std::map<std::uint32_t, int>& idOf)
{
  std::vector<BoxRecord> instances;
  for (const BoxRecord& box : dataset.boxes(shot))
  {
    if (idOf.count(box.id) > 0 && box.pixelsWhole > 0)
    {
      instances.push_back(box);
    }
  }
  return instances;
}

/// The picture of one item, while it is written.
class Picture
{
public:
  Picture(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const Place& place,
    const Setting& setting, const std::vector<BoxRecord>& instances)
    : Sink(sink)
    , Dataset(dataset)
    , Shot(shot)
    , At(place)
    , Set(setting)
    , Instances(instances)
    , Factor(pictureMillimetres * dataset.metres())
  {
  }

  void write()
  {
    const OptionValues& options = this->Set.options;
    const std::string rgb = this->At.file("rgb", pictureExtension(options));
    writePicture(this->Sink, this->Dataset, this->Shot, exported::color().of(options), rgb, options);
    this->writeDepth();
    this->noteCamera();
    const Json image{ { "id", this->At.image }, { "file_name", rgb.substr(this->At.folder.size()) },
      { "width", this->Shot.camera.width }, { "height", this->Shot.camera.height } };
    this->Sink.note(this->At.list("images"), image.dump());
    this->writeTruth();
  }

private:
  std::string key() const { return '"' + std::to_string(this->At.image) + "\": "; }

  void writeDepth()
  {
    LinearCode code;
    code.factor = this->Factor;
    code.scale = this->Set.depthScale;
    code.unit = "mm";
    const int height = this->Shot.camera.height;
    this->Valid.assign(std::size_t(this->Shot.camera.width) * std::size_t(height), 0);
    writeCodedPng(this->Sink, this->Dataset, this->Shot, exported::depth().of(this->Set.options),
      this->At.file("depth"), code, this->Set.options, {},
      [&](int y, const std::vector<std::uint32_t>& codes)
      {
        for (std::size_t x = 0; x < codes.size(); ++x)
        {
          this->Valid[x * std::size_t(height) + std::size_t(y)] = codes[x] != code.nothing;
        }
      });
  }

  void noteCamera()
  {
    const Rigid3 pose = cameraFromWorld(this->Shot.camera);
    const Json camera{ { "cam_K", listOf(intrinsicsOf(this->Shot.camera, PixelCentre::Integer)) },
      { "depth_scale", this->Set.depthScale }, { "cam_R_w2c", listOf(pose.rotation) },
      { "cam_t_w2c", listOf(Eigen::Vector3d(pose.translation * this->Factor)) } };
    this->Sink.note(this->At.list("camera"), this->key() + camera.dump());
  }

  void writeTruth()
  {
    const std::map<std::uint32_t, RunLengths> visible = masksOf(this->Dataset.read(this->Shot, "objects").pixels);
    const AmodalMasks whole = this->Dataset.amodal(this->Shot);
    const RunLengths none{ whole.width, whole.height, { std::uint64_t(whole.width) * std::uint64_t(whole.height) } };
    for (const BoxRecord& box : this->Instances)
    {
      const auto seen = visible.find(box.id);
      const auto amodal =
        std::find_if(whole.masks.begin(), whole.masks.end(), [&](const MaskRecord& one) { return one.id == box.id; });
      const RunLengths all =
        amodal == whole.masks.end() ? none : RunLengths{ whole.width, whole.height, amodal->counts };
      this->writeInstance(box, seen == visible.end() ? none : seen->second, all);
    }
    this->Sink.note(this->At.list("gt"), this->key() + this->Poses.dump());
    this->Sink.note(this->At.list("info"), this->key() + this->Infos.dump());
    for (const auto& [id, count] : this->Targets)
    {
      if (this->At.split.rfind("test", 0) == 0 && count > 0)
      {
        this->Sink.note("targets",
          Json{ { "im_id", this->At.image }, { "inst_count", count }, { "obj_id", id }, { "scene_id", this->At.scene } }
            .dump());
      }
    }
  }

  void writeInstance(const BoxRecord& box, const RunLengths& own, const RunLengths& all)
  {
    const std::size_t instance = this->Poses.size();
    const int id = this->Set.idOf.at(box.id);
    this->writeMask("mask", instance, all);
    this->writeMask("mask_visib", instance, own);
    const Eigen::Vector3d t = (box.t + box.R * this->Set.origins.at(id)) * this->Factor;
    this->Poses.push_back({ { "cam_R_m2c", listOf(box.R) }, { "cam_t_m2c", listOf(t) }, { "obj_id", id } });
    const double fraction = double(box.pixelsVisible) / double(box.pixelsWhole);
    const bool sees = box.pixelsVisible > 0;
    this->Infos.push_back({ { "bbox_obj", boxOf(box.whole, sees) }, { "bbox_visib", boxOf(box.visible, sees) },
      { "px_count_all", box.pixelsWhole }, { "px_count_valid", countIn(all, this->Valid) },
      { "px_count_visib", box.pixelsVisible }, { "visib_fract", fraction } });
    constexpr double least = 0.1; ///< of an object is visible where it is to be found
    const bool wanted = fraction >= least;
    this->Targets[id] += wanted ? 1 : 0;
    if (sees)
    {
      this->Sink.note(this->At.list("coco"), this->annotation(instance, id, own, all, wanted).dump());
    }
  }

  void writeMask(const std::string& kind, std::size_t instance, const RunLengths& mask)
  {
    this->Sink.write(this->At.mask(kind, instance), maskPng(mask));
  }

  Json annotation(std::size_t instance, int id, const RunLengths& own, const RunLengths& all, bool wanted) const
  {
    constexpr int most = 100000; ///< instances of a picture
    const auto box = [](const RunLengths& mask)
    {
      const Eigen::Vector4d b = mask.box();
      return Json{ b[0], b[1], b[2], b[3] };
    };
    return { { "id", std::int64_t(this->At.image) * most + std::int64_t(instance) + 1 }, { "image_id", this->At.image },
      { "category_id", id }, { "iscrowd", 0 }, { "area", own.area() }, { "bbox", box(all) },
      { "segmentation", { { "size", { own.height, own.width } }, { "counts", own.counts } } }, { "width", own.width },
      { "height", own.height }, { "ignore", !wanted } };
  }

  ExportSink& Sink;
  const DatasetView& Dataset;
  const DatasetShot& Shot;
  const Place& At;
  const Setting& Set;
  const std::vector<BoxRecord>& Instances;
  double Factor;           ///< millimetres of a scene unit
  std::vector<char> Valid; ///< pixels whose depth has a code, column by column as run lengths have them
  Json Poses = Json::array();
  Json Infos = Json::array();
  std::map<int, int> Targets; ///< of an obj_id: instances to be found
};
} // namespace

ExportItem pictureItem(const DatasetView& dataset, const DatasetShot& shot, const Place& place,
  const std::shared_ptr<const Setting>& setting)
{
  const std::string rgb = place.file("rgb", pictureExtension(setting->options));
  ExportItem item{ { rgb, place.file("depth") }, {}, { { shot.name(), shot.frame(), rgb } } };
  const auto instances = std::make_shared<const std::vector<BoxRecord>>(instancesOf(dataset, shot, setting->idOf));
  for (std::size_t i = 0; i < instances->size(); ++i)
  {
    item.files.push_back(place.mask("mask", i));
    item.files.push_back(place.mask("mask_visib", i));
  }
  item.write = [&dataset, &shot, place, setting, instances](ExportSink& sink)
  { Picture(sink, dataset, shot, place, *setting, *instances).write(); };
  return item;
}

} // namespace dgtk::bop
