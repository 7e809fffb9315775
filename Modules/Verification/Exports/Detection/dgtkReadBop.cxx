// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopAnnotations.h"
#include "dgtkExportPixels.h"
#include "dgtkJsonFile.h"
#include "dgtkLongDocuments.h"
#include "dgtkReadTexts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <utility>

// bop_toolkit's docs/bop_datasets_format.md and inout.py.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;
using BopPoints = std::vector<Eigen::Vector3d>;

Eigen::Matrix3d matrixIn(const Json& list) { return matrixOf(numberList(list, 9)); }

Eigen::Vector3d vectorOf(const Json& list)
{
  const std::vector<double> numbers = numberList(list, 3);
  return { numbers[0], numbers[1], numbers[2] };
}

/// Vertices of a .ply, as text or as doubles that begin each row.
BopPoints verticesOf(const std::string& path)
{
  const std::string bytes = readFile(path);
  std::istringstream stream(bytes);
  std::size_t count = 0;
  std::size_t rowBytes = 0;
  std::size_t doubles = 0; ///< that begin a row
  bool ascii = false;
  bool vertices = false;
  for (std::string line; std::getline(stream, line) && line != "end_header";)
  {
    std::istringstream words(line);
    std::string first;
    std::string second;
    words >> first >> second;
    ascii = ascii || line == "format ascii 1.0";
    vertices = first == "element" ? second == "vertex" : vertices;
    if (first == "element" && vertices)
    {
      words >> count;
    }
    doubles += first == "property" && vertices && second == "double" && rowBytes == 8 * doubles ? 1 : 0;
    rowBytes += first == "property" && vertices ? (second == "double" ? 8 : second == "float" ? 4 : 1) : 0;
  }
  if (!ascii && doubles < 3)
  {
    throw InputError(path, "has vertices that do not begin with three doubles");
  }
  BopPoints points;
  const auto start = std::size_t(std::max<std::streamoff>(0, stream.tellg()));
  for (std::size_t i = 0; i < count; ++i)
  {
    Eigen::Vector3d x(0, 0, 0);
    std::string line;
    if (ascii && std::getline(stream, line))
    {
      std::istringstream(line) >> x[0] >> x[1] >> x[2];
    }
    else if (!ascii && start + (i + 1) * rowBytes <= bytes.size())
    {
      std::memcpy(x.data(), bytes.data() + start + i * rowBytes, sizeof(double) * 3);
    }
    else
    {
      throw InputError(path, "ends too early");
    }
    points.push_back(x);
  }
  if (points.empty())
  {
    throw InputError(path, "has no vertices");
  }
  return points;
}

class SetJudge
{
public:
  explicit SetJudge(ExportJudge& judge)
    : Judge(judge)
    , Unit(1000 * metresOf(judge.source()))
  {
    for (const std::string& part : judge.source().parts())
    {
      this->Poses.emplace(part, judge.source().dataset() + "/" + part + posesName);
    }
    this->Infos = this->document("models/models_info.json");
    judge.holds("models_eval", "models_eval/models_info.json", "all",
      this->document("models_eval/models_info.json") == this->Infos, "another", "as in models");
    for (const auto& [id, info] : this->Infos.items())
    {
      const std::string file = "models/obj_" + digitsOf(id, 6) + ".ply";
      this->Models[std::stoi(id)] = verticesOf(judge.source().path(file));
      this->judgeInfo(file, info, this->Models[std::stoi(id)]);
      const bool same =
        readFile(judge.source().path(file)) == readFile(judge.source().path("models_eval" + file.substr(6)));
      judge.holds("models", "models_eval" + file.substr(6), id, same, "another", "as in models");
    }
  }

  void judgeScene(const std::string& folder)
  {
    const Json cameras = this->document(folder + "scene_camera.json");
    const Json poses = this->document(folder + "scene_gt.json");
    const Json infos = this->document(folder + "scene_gt_info.json");
    BopAnnotations annotations(this->Judge, folder + "scene_gt_coco.json");
    this->Annotations = &annotations;
    this->Annotated = 0;
    const std::size_t pictures = this->Judge.source().picturesBelow(folder + "rgb/");
    for (const auto& [name, document] : { std::pair<const char*, const Json*>{ "scene_camera.json", &cameras },
           { "scene_gt.json", &poses }, { "scene_gt_info.json", &infos } })
    {
      this->Judge.exact("pictures", "", folder + name, "", double(document->size()), double(pictures));
    }
    for (const auto& [image, camera] : cameras.items())
    {
      const std::string stem = folder + "rgb/" + digitsOf(image, 6);
      const ExportedName* picture = this->Judge.source().named(stem + ".png");
      picture = picture ? picture : pictureOf(this->Judge, folder + "scene_camera.json", stem + ".jpg");
      if (picture)
      {
        this->judgeCamera(folder + "scene_camera.json", camera, *picture);
        this->use(
          folder + "scene_gt.json", [&, &id = image] { this->judgeInstances(folder, id, poses, infos, *picture); });
      }
    }
    std::set<int> kinds;
    for (const auto& [id, points] : this->Models)
    {
      kinds.insert(id);
    }
    annotations.judgeRest(folder, kinds, this->Annotated);
  }

  /// What holds for the whole set.
  void judgeWhole()
  {
    this->use("camera.json",
      [&]
      {
        const Json camera = this->document("camera.json");
        const auto number = [&](const char* key) { return camera.at(key).get<double>(); };
        const Eigen::Matrix3d K = matrixOf({ number("fx"), 0, number("cx"), 0, number("fy"), number("cy"), 0, 0, 1 });
        const ExportedName& first = this->Judge.source().record().names.at(0);
        this->Judge.intrinsics("camera.json", first.camera, first.frame, fromWholeCentres(K), 1e-9);
        this->Judge.size("camera.json", first.camera, first.frame, camera.at("width"), camera.at("height"));
        this->judgeScale("camera.json", camera, first);
      });
    const std::string file = "test_targets_bop19.json";
    if (this->Judge.source().exported(file))
    {
      this->use(file,
        [&]
        {
          for (const Json& one : this->document(file))
          {
            const std::array<int, 3> key{ one.at("scene_id"), one.at("im_id"), one.at("obj_id") };
            const auto found = this->Targets.find(key);
            const int count = found == this->Targets.end() ? 0 : found->second;
            this->Judge.exact("targets", "instances", file, one.dump(), one.at("inst_count"), count);
            this->Targets.erase(key);
          }
        });
      this->Judge.exact("targets", "left", file, "all", double(this->Targets.size()), 0);
    }
  }

private:
  Json document(const std::string& name) const { return readJsonFile(this->Judge.source().path(name)); }
  template <typename Body>
  void use(const std::string& name, const Body& body) const
  {
    useJson(this->Judge.source().path(name), body);
  }

  /// Millimetres of a code of the depth maps, as those of a picture were made.
  void judgeScale(const std::string& file, const Json& camera, const ExportedName& picture) const
  {
    std::string depth = picture.name;
    depth.replace(depth.rfind("/rgb/"), 5, "/depth/").replace(depth.rfind('.'), std::string::npos, ".png");
    const ExportedFile* map = this->Judge.source().exported(depth);
    this->Judge.exact(
      "depth_scale", "mm", file, depth, camera.at("depth_scale"), map ? numberOf(map->encoding, "scale", 0) : 0);
  }

  void judgeInfo(const std::string& file, const Json& info, const BopPoints& points)
  {
    Eigen::Vector3d least = points.at(0);
    Eigen::Vector3d most = least;
    double widest = 0;
    constexpr std::size_t few = 1500; // of more points the diameter is bounded only
    for (const Eigen::Vector3d& x : points)
    {
      least = least.cwiseMin(x);
      most = most.cwiseMax(x);
      for (std::size_t k = 0; k < points.size() && points.size() <= few; ++k)
      {
        widest = larger(widest, (x - points[k]).norm());
      }
    }
    const char* axes = "xyz";
    for (int i = 0; i < 3; ++i)
    {
      this->Judge.number("models_info", "mm", file, "min", info.at(std::string("min_") + axes[i]), least[i], 1e-9);
      this->Judge.number(
        "models_info", "mm", file, "size", info.at(std::string("size_") + axes[i]), most[i] - least[i], 1e-9);
    }
    const double diameter = info.at("diameter");
    const bool possible =
      diameter >= widest * (1 - 1e-12) && (points.size() > few || diameter <= widest * (1 + 1e-12)) &&
      diameter <= (most - least).norm() * (1 + 1e-12) && diameter >= (most - least).maxCoeff() * (1 - 1e-12);
    this->Judge.holds("models_info", file, "diameter", possible, std::to_string(diameter), "one of the model");
  }

  void judgeCamera(const std::string& file, const Json& camera, const ExportedName& picture)
  {
    this->use(file,
      [&]
      {
        this->judgeScale(file, camera, picture);
        this->Judge.intrinsics(
          file, picture.camera, picture.frame, fromWholeCentres(matrixIn(camera.at("cam_K"))), 1e-9);
        this->Judge.pose(file, picture.camera, picture.frame, matrixIn(camera.at("cam_R_w2c")),
          vectorOf(camera.at("cam_t_w2c")) / this->Unit, 1e-9);
      });
  }

  /// The objects of a picture, found by where their models' vertices are.
  void judgeInstances(const std::string& folder, const std::string& image, const Json& allPoses, const Json& allInfos,
    const ExportedName& picture)
  {
    const Json& poses = allPoses.at(image);
    const std::string file = folder + "scene_gt.json";
    const std::vector<BoxRecord>& boxes = this->Judge.source().boxes(picture.camera, picture.frame);
    const std::string infoFile = folder + "scene_gt_info.json";
    const std::size_t infos = allInfos.contains(image) ? allInfos.at(image).size() : 0;
    this->Judge.exact("instances", "", file, picture.name, double(poses.size()), double(infos));
    const std::vector<PoseRecord> posed = this->Poses.at(this->Judge.source().partOf(picture.camera)).at(picture.frame);
    std::set<std::uint32_t> found;
    for (std::size_t i = 0; i < poses.size() && i < infos; ++i)
    {
      this->use(infoFile, [&] { this->count(folder, image, poses[i].at("obj_id"), allInfos.at(image)[i]); });
      const std::string where = picture.name + ", instance " + std::to_string(i);
      const BoxRecord* box = this->boxOf(poses[i], picture, boxes, posed);
      this->Judge.holds("poses", file, where, box && found.insert(box->id).second, "a pose", "that of an object, once");
      if (box)
      {
        this->use(infoFile,
          [&]
          {
            this->judgeNumbers(infoFile, where, allInfos.at(image)[i], *box);
            this->judgeValid(folder, image, i, allInfos.at(image)[i], where);
          });
        this->judgeMasks(folder, image, i, *box, picture, poses[i].at("obj_id"));
      }
    }
    for (const BoxRecord& box : boxes)
    {
      const bool wanted = this->isPosed(picture.camera, box.id) && box.pixelsWhole > 0;
      this->Judge.holds("instances", file, picture.name, found.count(box.id) > 0 || !wanted, "none", box.name);
    }
  }

  /// What other documents have to say of an instance.
  void count(const std::string& folder, const std::string& image, int model, const Json& info)
  {
    this->Annotated += info.at("px_count_visib") > 0;
    if (folder.rfind("test", 0) == 0 && info.at("visib_fract") >= least)
    {
      ++this->Targets[{ std::stoi(folder.substr(folder.find('/') + 1)), std::stoi(image), model }];
    }
  }

  bool isPosed(const std::string& camera, std::uint32_t id) const
  {
    for (const auto& [key, text] : this->Judge.source().record().request)
    {
      if (key == "objects" && !text.empty())
      {
        const ObjectRecord* object = this->Judge.source().object(camera, id);
        const std::string list = ',' + text + ',';
        return object && (list.find(',' + object->name + ',') != std::string::npos ||
                           list.find(',' + object->objectClass + ',') != std::string::npos);
      }
    }
    return true;
  }

  /// `posed`: poses of the picture's frame.
  const BoxRecord* boxOf(const Json& pose, const ExportedName& picture, const std::vector<BoxRecord>& boxes,
    const std::vector<PoseRecord>& posed)
  {
    const BopPoints& model = this->Models.at(pose.at("obj_id"));
    const Eigen::Matrix3d R = matrixIn(pose.at("cam_R_m2c"));
    const Eigen::Vector3d t = vectorOf(pose.at("cam_t_m2c"));
    const CameraRecord* camera = this->Judge.source().camera(picture.camera, picture.frame);
    const std::string part = this->Judge.source().partOf(picture.camera);
    for (const BoxRecord& box : boxes)
    {
      const auto known =
        std::find_if(posed.begin(), posed.end(), [&](const PoseRecord& one) { return one.id == box.id; });
      const ObjectRecord* object = this->Judge.source().object(picture.camera, box.id);
      if (known == posed.end() || !object || object->geometryFile.empty())
      {
        continue;
      }
      const BopPoints& own = this->geometry(part + object->geometryFile);
      double apart = own.size() == model.size() ? 0 : infinite;
      for (std::size_t k = 0; k < own.size() && apart < 1e-6; ++k)
      {
        const Eigen::Vector3d world = known->matrix * own[k].homogeneous();
        const Eigen::Vector3d there = (camera->R * world + camera->t) * this->Unit;
        apart = larger(apart, (R * model[k] + t - there).norm() / std::max(1.0, there.norm()));
      }
      if (apart < 1e-6)
      {
        this->Judge.number("vertices", "share", "models/models_info.json", picture.name, apart, 0, 1e-9);
        return &box;
      }
    }
    return nullptr;
  }

  const BopPoints& geometry(const std::string& file)
  {
    auto known = this->Geometries.find(file);
    if (known == this->Geometries.end())
    {
      known = this->Geometries.emplace(file, verticesOf(this->Judge.source().dataset() + '/' + file)).first;
    }
    return known->second;
  }

  void judgeNumbers(const std::string& file, const std::string& where, const Json& info, const BoxRecord& box)
  {
    const auto number = [&](const char* key, double expected)
    { this->Judge.exact(key, "px", file, where, info.at(key), expected); };
    number("px_count_all", double(box.pixelsWhole));
    number("px_count_visib", double(box.pixelsVisible));
    this->Judge.number("visib_fract", "1", file, where, info.at("visib_fract"),
      double(box.pixelsVisible) / double(box.pixelsWhole), 1e-12);
    for (const char* key : { "bbox_obj", "bbox_visib" })
    {
      const auto& borders = std::string(key) == "bbox_obj" ? box.whole : box.visible;
      const Json& found = info.at(key);
      std::vector<double> expected(4, -1);
      if (box.pixelsVisible > 0 && borders)
      {
        const Eigen::Vector4d& b = *borders;
        expected = { b[0], b[1], b[2] - b[0] - 1, b[3] - b[1] - 1 };
      }
      this->Judge.holds(key, file, where, found.get<std::vector<double>>() == expected, found.dump(), "its box");
    }
  }

  static std::string maskOf(const std::string& image, std::size_t instance)
  {
    return digitsOf(image, 6) + '_' + digitsOf(instance, 6) + ".png";
  }

  /// Pixels of the amodal mask that have a depth in the export.
  void judgeValid(const std::string& folder, const std::string& image, std::size_t instance, const Json& info,
    const std::string& where)
  {
    const ExportedFrom& source = this->Judge.source();
    const std::vector<double> mask = decodePng(source.path(folder + "mask/" + maskOf(image, instance)), {}).values;
    const std::vector<double> depth =
      decodePng(source.path(folder + "depth/" + digitsOf(image, 6) + ".png"), {}).values;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < std::min(mask.size(), depth.size()); ++i)
    {
      valid += mask[i] != 0 && depth[i] != 0;
    }
    this->Judge.exact(
      "px_count_valid", "px", folder + "scene_gt_info.json", where, info.at("px_count_valid"), double(valid));
  }

  void judgeMasks(const std::string& folder, const std::string& image, std::size_t instance, const BoxRecord& box,
    const ExportedName& picture, int model)
  {
    const std::string name = maskOf(image, instance);
    const auto inside = [&](const std::string& file)
    {
      const DecodedPixels pixels = decodePng(this->Judge.source().path(file), {});
      std::vector<char> mask;
      for (const double value : pixels.values)
      {
        mask.push_back(value != 0);
      }
      return mask;
    };
    const std::string visible = folder + "mask_visib/" + name;
    const std::string whole = folder + "mask/" + name;
    const std::vector<char> own = inside(visible);
    this->Judge.mask(visible, picture.camera, picture.frame, box.id, own);
    if (box.pixelsAmodal > 0)
    {
      this->Judge.amodalMask(whole, picture.camera, picture.frame, box.id, inside(whole));
    }
    const bool wanted = double(box.pixelsVisible) >= least * double(box.pixelsWhole);
    if (box.pixelsVisible > 0)
    {
      this->Annotations->judge({ picture, std::stoll(image), instance, model, wanted }, own, inside(whole));
    }
  }

  ExportJudge& Judge;
  double Unit;
  Json Infos;
  std::map<int, BopPoints> Models;
  std::map<std::string, BopPoints> Geometries;
  std::map<std::string, PoseIndex> Poses;    ///< by part
  static constexpr double least = 0.1;       ///< of an object is seen where it is to be found
  std::size_t Annotated = 0;                 ///< instances of which something is visible
  BopAnnotations* Annotations = nullptr;     ///< of the scene
  std::map<std::array<int, 3>, int> Targets; ///< by scene, image and model
};
} // namespace

void readBop(ExportJudge& judge)
{
  useJson(judge.source().path("models/models_info.json"),
    [&]
    {
      SetJudge set(judge);
      for (const ExportedFile& one : judge.source().record().files)
      {
        const std::string& path = one.file.path;
        const std::string name = "scene_camera.json";
        if (path.size() > name.size() && path.substr(path.size() - name.size()) == name)
        {
          set.judgeScene(path.substr(0, path.size() - name.size()));
        }
      }
      set.judgeWhole();
    });
}

} // namespace dgtk
