// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkFile.h"
#include "dgtkGltf.h"
#include "dgtkJsonFault.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

namespace dgtk
{

namespace
{
using gltf::Json;
using gltf::Place;

constexpr const char* gltfName = "gltf";
constexpr const char* sceneName = "scene.gltf";
constexpr const char* bufferName = "scene.bin";

bool isPicture(const std::string& name)
{
  const std::string extension = extensionOf(name);
  return extension == "png" || extension == "jpg" || extension == "jpeg";
}

/// Whether a PNG has an alpha channel.
bool isTranslucent(const std::string& path)
{
  constexpr std::size_t colorType = 25; // in IHDR
  const std::string bytes = extensionOf(path) == "png" ? readFile(path) : "";
  return bytes.size() > colorType && (bytes[colorType] == 4 || bytes[colorType] == 6);
}

nlohmann::json sceneOf(const DatasetView& dataset)
{
  const std::string path = Folder(dataset.folder()).fileAt("scene.json");
  try
  {
    return nlohmann::json::parse(readFile(path));
  }
  catch (const nlohmann::json::exception& error)
  {
    throw jsonFault(path, 0, error.what());
  }
}

std::string textureName(const std::string& picture) { return "textures/" + picture; }

/// Files of the models, each once, sorted.
std::set<std::string> modelsOf(const DatasetView& dataset)
{
  std::set<std::string> files;
  for (const ObjectRecord& object : dataset.objects())
  {
    files.insert(object.geometryFile);
  }
  return files;
}

bool isMirrored(const PoseRecord& pose) { return pose.scale.x() < 0; }

Place placeOf(const PoseRecord& pose, double metres)
{
  return { pose.t * metres, quaternionOf(pose.R), pose.scale.cwiseAbs() * metres };
}

Place placeOf(const CameraRecord& camera, double metres)
{
  const Rigid3 pose = worldFromCameraGL(camera);
  return { pose.translation * metres, quaternionOf(pose.rotation), Eigen::Vector3d::Ones() };
}

/// The median of all places, in whole kilometres, metres of the scene's axes: float32 is fine near 0 alone.
Eigen::Vector3d originOf(const DatasetView& dataset)
{
  std::vector<Eigen::Vector3d> places;
  for (const DatasetShot& shot : dataset.shots())
  {
    places.push_back(cameraFromWorld(shot.camera).inverse().translation);
  }
  for (const int frame : dataset.frames())
  {
    for (const PoseRecord& pose : dataset.poses(frame))
    {
      places.push_back(pose.t);
    }
  }
  constexpr double kilometre = 1000;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto middle = places.begin() + std::ptrdiff_t(places.size() / 2);
    std::nth_element(
      places.begin(), middle, places.end(), [axis](const auto& p, const auto& q) { return p[axis] < q[axis]; });
    origin[axis] += kilometre * std::round((*middle)[axis] * dataset.metres() / kilometre); // no -0
  }
  return origin;
}

/// What there is of an object over the frames.
struct ObjectPlaces
{
  std::vector<Place> places;
  Json visible = Json::array(); ///< [first, last] of frames in a row
  bool mirrored = false;
};

/// Writes the asset: the world, cameras, objects, lights are its nodes in this order.
class GltfWriter
{
public:
  GltfWriter(const DatasetView& dataset, ExportSink& sink)
    : Dataset(dataset)
    , Sink(sink)
    , Scene(sceneOf(dataset))
    , File(sink.open(bufferName))
    , Buffer(*this->File)
  {
    for (const int frame : dataset.frames())
    {
      this->Times.push_back(dataset.seconds(frame));
    }
    this->Origin = originOf(dataset);
  }

  void write()
  {
    this->Asset["asset"] = { { "version", "2.0" }, { "generator", "DGTk" } };
    this->Asset["scene"] = 0;
    this->Asset["scenes"] = Json::array({ { { "nodes", { 0 } } } });
    this->addWorld();
    this->addCameras();
    this->addObjects();
    this->addLights();
    this->Nodes[0]["children"] = this->Children;
    this->Asset["nodes"] = this->Nodes;
    if (!this->Animation["channels"].empty())
    {
      this->Asset["animations"] = Json::array({ this->Animation });
    }
    this->Buffer.describe(this->Asset, bufferName);
    this->File->finish();
    for (const LayerRounding& one : { this->Rounding.places, this->Rounding.turns })
    {
      if (one.values > 0)
      {
        this->Sink.rounding(one);
      }
    }
    this->Sink.write(sceneName, this->Asset.dump(1) + '\n');
  }

private:
  std::size_t addNode(const std::string& name, Json node)
  {
    node["name"] = name;
    this->Nodes.push_back(node);
    this->Children.push_back(this->Nodes.size() - 1);
    return this->Nodes.size() - 1;
  }

  void addWorld()
  {
    const Eigen::Vector3d& o = this->Origin;
    const bool upright = this->Scene.value("upAxis", "y") == "z";
    Json world{ { "name", "world" } };
    if (!o.isZero(0))
    {
      world["translation"] = { o.x(), upright ? o.z() : o.y(), upright ? -o.y() : o.z() };
    }
    if (upright)
    {
      const double half = std::sqrt(0.5);
      world["rotation"] = { -half, 0.0, 0.0, half };
    }
    this->Nodes.push_back(world);
  }

  /// Depths that the scene's camera sees, metres.
  std::pair<double, double> rangeOf(const std::string& camera) const
  {
    double near = 0.1;
    double far = 1000;
    for (const nlohmann::json& one : this->Scene.value("cameras", nlohmann::json::array()))
    {
      const bool same = one.value("name", "") == utf8FromBytes(camera);
      const auto number = [&](const char* key, double usual)
      { return same && one.contains(key) && one[key].is_number() ? one[key].get<double>() : usual; };
      near = number("near", near);
      far = number("far", far);
    }
    return { near * this->Dataset.metres(), far * this->Dataset.metres() };
  }

  void addCameras()
  {
    for (const std::string& name : this->Dataset.cameras())
    {
      const std::vector<const DatasetShot*> shots = this->Dataset.shotsOf(name);
      const CameraRecord& camera = shots.front()->camera;
      const auto [near, far] = this->rangeOf(name);
      const Eigen::Matrix3d& K = camera.K;
      Json perspective{ { "yfov", 2 * portable::atan(camera.height / (2 * K(1, 1))) },
        { "aspectRatio", camera.width * K(1, 1) / (camera.height * K(0, 0)) }, { "znear", near } };
      if (std::isfinite(far) && far > near)
      {
        perspective["zfar"] = far;
      }
      const Json extras{ { "K", { { K(0, 0), K(0, 1), K(0, 2) }, { K(1, 0), K(1, 1), K(1, 2) }, { 0.0, 0.0, 1.0 } } },
        { "width", camera.width }, { "height", camera.height } };
      std::vector<Place> places;
      std::vector<double> times;
      for (const DatasetShot* shot : shots)
      {
        places.push_back(this->fromOrigin(placeOf(shot->camera, this->Dataset.metres())));
        times.push_back(this->Dataset.seconds(shot->frame()));
      }
      Json node = gltf::placedNode(places.front());
      node.erase("scale");
      node["camera"] = this->Asset["cameras"].size();
      this->Asset["cameras"].push_back({ { "name", utf8FromBytes(name) }, { "type", "perspective" },
        { "perspective", perspective }, { "extras", extras } });
      gltf::animate(
        this->Animation, this->Buffer, this->addNode(utf8FromBytes(name), node), times, places, this->Rounding);
    }
  }

  Place fromOrigin(Place place) const
  {
    place.t -= this->Origin;
    return place;
  }

  std::map<std::uint32_t, ObjectPlaces> placesOf(const std::set<std::uint32_t>& objects) const
  {
    std::map<std::uint32_t, ObjectPlaces> all;
    int last = -1;
    for (const int frame : this->Dataset.frames())
    {
      for (const PoseRecord& pose : this->Dataset.poses(frame))
      {
        if (objects.count(pose.id) == 0)
        {
          continue;
        }
        ObjectPlaces& one = all[pose.id];
        one.places.push_back(this->fromOrigin(placeOf(pose, this->Dataset.metres())));
        one.mirrored = isMirrored(pose);
        const bool follows = !one.visible.empty() && one.visible.back()[1] == last;
        if (pose.visible && follows)
        {
          one.visible.back()[1] = frame;
        }
        else if (pose.visible)
        {
          one.visible.push_back({ frame, frame });
        }
      }
      last = frame;
    }
    return all;
  }

  /// By id. The poses of all frames are read for some objects at a time.
  void addObjects()
  {
    constexpr std::size_t mostPlaces = std::size_t(1) << 17; // in memory
    const std::size_t most = std::max<std::size_t>(1, mostPlaces / this->Times.size());
    std::set<std::uint32_t> objects;
    for (const ObjectRecord& object : this->Dataset.objects())
    {
      objects.insert(object.id);
    }
    while (!objects.empty())
    {
      const auto end = std::next(objects.begin(), std::ptrdiff_t(std::min(most, objects.size())));
      for (const auto& [id, places] : this->placesOf({ objects.begin(), end }))
      {
        this->addObject(*this->Dataset.object(id), places);
      }
      objects.erase(objects.begin(), end);
    }
  }

  void addObject(const ObjectRecord& object, const ObjectPlaces& places)
  {
    Json node = gltf::placedNode(places.places.front());
    node["mesh"] = this->meshOf(object, places.mirrored);
    node["extras"] = { { "id", object.id }, { "class", utf8FromBytes(object.objectClass) },
      { "visible_frames", places.visible }, { "deforming", object.deforming }, { "mirrored", places.mirrored } };
    gltf::animate(this->Animation, this->Buffer, this->addNode(utf8FromBytes(object.name), node), this->Times,
      places.places, this->Rounding);
  }

  std::size_t meshOf(const ObjectRecord& object, bool mirrored)
  {
    const auto known = this->Meshes.find({ object.geometryFile, mirrored });
    if (known != this->Meshes.end())
    {
      return known->second;
    }
    const ModelPly model = readModelPly(Folder(this->Dataset.folder()).fileAt(object.geometryFile));
    Json mesh =
      gltf::meshOf(this->Buffer, model, mirrored, [&](const gltf::Look& look) { return this->materialOf(look); });
    mesh["name"] = utf8FromBytes(object.geometryFile);
    this->Asset["meshes"].push_back(mesh);
    return this->Meshes[{ object.geometryFile, mirrored }] = this->Asset["meshes"].size() - 1;
  }

  /// Rough and no metal, as the scene's usual materials; with the picture where there is one.
  std::size_t materialOf(gltf::Look look)
  {
    look.picture = isPicture(look.picture) ? look.picture : "";
    const auto known = this->Materials.find(look);
    if (known != this->Materials.end())
    {
      return known->second;
    }
    Json factors{ { "baseColorFactor",
                    { gltf::linear(look.color[0]), gltf::linear(look.color[1]), gltf::linear(look.color[2]), 1.0 } },
      { "metallicFactor", 0.0 }, { "roughnessFactor", 1.0 } };
    if (!look.picture.empty())
    {
      factors["baseColorTexture"] = { { "index", this->Asset["textures"].size() } };
      this->Asset["textures"].push_back({ { "source", this->Asset["images"].size() } });
      this->Asset["images"].push_back({ { "uri", textureName(look.picture) } });
      if (!look.wrap.empty())
      {
        this->Asset["textures"].back()["sampler"] = this->Asset["samplers"].size();
        this->Asset["samplers"].push_back(gltf::samplerOf(look.wrap));
      }
    }
    Json material{ { "pbrMetallicRoughness", factors }, { "doubleSided", true } };
    if (!look.picture.empty() && isTranslucent(Folder(this->Dataset.folder()).fileAt("models/" + look.picture)))
    {
      material["alphaMode"] = "BLEND";
    }
    this->Asset["materials"].push_back(material);
    return this->Materials[look] = this->Asset["materials"].size() - 1;
  }

  void addLights()
  {
    std::vector<std::string> approximate;
    std::vector<std::string> without;
    Json lights = Json::array();
    for (const gltf::Light& one : gltf::lightsOf(this->Scene, this->Dataset.metres(), approximate, without))
    {
      Json node = gltf::placedNode(this->fromOrigin(one.place));
      node.erase("scale");
      node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      lights.push_back(one.light);
      this->addNode(one.light["name"].get<std::string>(), node);
    }
    if (!lights.empty())
    {
      this->Asset["extensionsUsed"] = { "KHR_lights_punctual" };
      this->Asset["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    }
  }

  const DatasetView& Dataset;
  ExportSink& Sink;
  nlohmann::json Scene;
  std::unique_ptr<ExportFile> File;
  gltf::Buffer Buffer;
  std::vector<double> Times;
  Eigen::Vector3d Origin{ 0, 0, 0 };
  gltf::KeyRounding Rounding;
  Json Asset;
  Json Nodes = Json::array();
  Json Children = Json::array();
  Json Animation{ { "name", "frames" }, { "channels", Json::array() }, { "samplers", Json::array() } };
  std::map<std::pair<std::string, bool>, std::size_t> Meshes;
  std::map<gltf::Look, std::size_t> Materials;
};

class GltfExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues&) const override { return { {}, { { "models", "on" } } }; }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, gltfName);
    requirePinholes(dataset, gltfName);
    requireNoSkew(dataset, gltfName);
    requireFixedIntrinsics(dataset, gltfName);
    dataset.metres();
    dataset.seconds(0);
    for (const ObjectRecord& object : dataset.objects())
    {
      if (object.geometryFile.empty())
      {
        throw UsageError(
          "gltf: the dataset has no model of object " + quoted(object.name) + " (render it for gltf, or with models)");
      }
    }
    requirePoses(dataset);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues&) const override
  {
    ExportPlan plan;
    std::vector<std::string> approximate;
    std::vector<std::string> without;
    gltf::lightsOf(sceneOf(dataset), dataset.metres(), approximate, without);
    plan.conventions = { { "pixel_centre", "(0.5, 0.5): extras of cameras have the dataset's K" },
      { "axes", "y up; cameras look along -z" }, { "metres_per_unit", shortest(dataset.metres()) },
      { "times", "frame / frames per second" }, { "deforming_objects", "as at the scene's first frame" } };
    addNames(plan, "approximate_lights", approximate);
    addNames(plan, "lights_left_out", without);
    addTextures(dataset, plan);
    plan.items.push_back(
      { { sceneName, bufferName }, [&dataset](ExportSink& sink) { GltfWriter(dataset, sink).write(); } });
    std::vector<std::uint32_t> all(dataset.shots().size());
    std::iota(all.begin(), all.end(), 0);
    plan.series.push_back(namesOf(dataset, all,
      [cameras = dataset.cameras()](const DatasetShot& shot)
      {
        const auto at = std::lower_bound(cameras.begin(), cameras.end(), shot.name()) - cameras.begin();
        return "nodes/" + std::to_string(at + 1) + '@' + std::to_string(shot.frame());
      }));
    return plan;
  }

private:
  /// Every object has a rotation and scale at every frame.
  static void requirePoses(const DatasetView& dataset)
  {
    std::map<std::uint32_t, bool> mirrored;
    for (const int frame : dataset.frames())
    {
      const std::vector<PoseRecord> poses = dataset.poses(frame);
      if (poses.size() < dataset.objects().size())
      {
        throw UsageError("gltf: the dataset does not say where its objects are at frame " + std::to_string(frame));
      }
      for (const PoseRecord& pose : poses)
      {
        const ObjectRecord* object = dataset.object(pose.id);
        const bool same = mirrored.emplace(pose.id, isMirrored(pose)).first->second == isMirrored(pose);
        if (object && (!pose.rigid || !same))
        {
          throw UsageError("gltf: object " + quoted(object->name) +
                           (same ? " is sheared" : " becomes its mirror image") + " at frame " + std::to_string(frame) +
                           ", which the format cannot say");
        }
      }
    }
  }

  static void addNames(ExportPlan& plan, const std::string& key, const std::vector<std::string>& names)
  {
    if (!names.empty())
    {
      plan.conventions.emplace_back(key, joined(names));
    }
  }

  static void addTextures(const DatasetView& dataset, ExportPlan& plan)
  {
    std::set<std::string> done;
    std::vector<std::string> without;
    for (const std::string& file : modelsOf(dataset))
    {
      for (const std::string& picture : picturesOfModel(Folder(dataset.folder()).fileAt(file)))
      {
        const std::string source = file.substr(0, file.rfind('/') + 1) + picture;
        if (!done.insert(picture).second)
        {
          continue;
        }
        if (!isPicture(picture))
        {
          without.push_back(picture);
          continue;
        }
        plan.items.push_back({ { textureName(picture) },
          [source, name = textureName(picture)](ExportSink& sink) { sink.copy(name, source); } });
      }
    }
    addNames(plan, "textures_left_out", without);
  }
};
} // namespace

std::unique_ptr<Exporter> makeGltfExporter() { return std::make_unique<GltfExporter>(); }

} // namespace dgtk
