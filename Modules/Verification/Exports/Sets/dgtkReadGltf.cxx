// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExportJudge.h"
#include "dgtkFile.h"
#include "dgtkGltfStructure.h"
#include "dgtkJsonFile.h"
#include "dgtkPlyFile.h"
#include "dgtkReadTexts.h"
#include "dgtkUtf8.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

// glTF 2.0 (Khronos, ISO/IEC 12113), KHR_lights_punctual.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;
constexpr double single = 5e-7; // of float32 numbers that have been multiplied a few times

class Asset
{
public:
  Asset(ExportJudge& judge, const std::string& file, const Json& document)
    : Judge(judge)
    , File(file)
    , Document(document)
    , Numbers(document, judge.source().folder(), file)
    , Metres(metresOf(judge.source()))
  {
    for (const PoseRecord& pose : readPoses(judge.source().dataset() + '/' + posesName))
    {
      this->Poses[{ pose.frame, pose.id }] = pose;
    }
    for (const ExportedName& name : judge.source().record().names)
    {
      this->Frames.insert(name.frame);
    }
    const Json scene = readJsonFile(judge.source().dataset() + "/scene.json");
    this->Up = scene.value("upAxis", "y") == "z" ? Eigen::AngleAxisd(-std::acos(0.0), Eigen::Vector3d::UnitX()).matrix()
                                                 : Eigen::Matrix3d::Identity();
    this->Lights = scene.value("lights", Json::array());
    for (std::size_t i = 0; i < this->Lights.size(); ++i)
    {
      this->Lights[i].emplace("name", "Light" + std::to_string(i));
    }
  }

  void judge()
  {
    if (this->Frames.empty())
    {
      throw std::out_of_range("no picture");
    }
    judgeGltfStructure(this->Judge, this->File, this->Document, this->Numbers);
    this->readAnimations();
    const Json& nodes = this->Document.at("nodes");
    std::set<std::size_t> children;
    for (const Json& child : nodes.at(0).at("children"))
    {
      children.insert(child.get<std::size_t>());
    }
    this->holds("nodes", children.size() == nodes.size() - 1 && children.count(0) == 0 &&
                           *children.rbegin() < nodes.size() && nodes.at(0).at("children").size() == children.size() &&
                           nodes.at(0).at("name") == "world");
    const Eigen::Affine3d world = this->affine(0, 0);
    const Eigen::Matrix3d turn = world.linear();
    this->Origin = turn.transpose() * world.translation();
    this->holds("world", apart(turn, this->Up) < 1e-12 && this->Channels.count(0) == 0);
    for (std::size_t i = 1; i < nodes.size(); ++i)
    {
      const Json& node = nodes[i];
      if (node.contains("camera"))
      {
        this->judgeCamera(i, node);
      }
      else if (node.contains("mesh"))
      {
        this->judgeObject(i, node);
      }
      else
      {
        this->judgeLight(i, node);
      }
    }
    std::set<std::string> cameras;
    for (const ExportedName& name : this->Judge.source().record().names)
    {
      cameras.insert(name.camera);
    }
    std::size_t pictures = 0;
    for (const std::string& camera : cameras)
    {
      pictures += std::size_t(std::count_if(this->Frames.begin(), this->Frames.end(),
        [&](int frame) { return this->Judge.source().camera(camera, frame) != nullptr; }));
    }
    this->Judge.exact("cameras", "pictures", this->File, "of nodes", double(this->Pictures), double(pictures));
    this->Judge.exact("objects", "objects", this->File, "of nodes", double(this->Ids.size()),
      double(this->Judge.source().objects().size()));
    this->judgeTextures();
  }

private:
  void holds(const std::string& where, bool right)
  {
    this->Judge.holds("asset", this->File, where, right, "another", "as the dataset has it");
  }

  void readAnimations()
  {
    for (const Json& animation : this->Document.value("animations", Json::array()))
    {
      for (const Json& channel : animation.at("channels"))
      {
        const Json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
        const Json& target = channel.at("target");
        GltfChannel one;
        one.times = this->Numbers.read(sampler.at("input")).col(0);
        one.values = this->Numbers.read(
          sampler.at("output"), std::size_t(one.times.size()), target.at("path") == "rotation" ? 4 : 3);
        const bool rising = std::is_sorted(one.times.data(), one.times.data() + one.times.size());
        const bool first = this->Channels[target.at("node")].emplace(target.at("path"), one).second;
        this->holds("animation", sampler.at("interpolation") == "LINEAR" && rising && first);
      }
    }
  }

  Eigen::VectorXd valueOf(std::size_t node, const std::string& path, const Eigen::VectorXd& usual, int frame) const
  {
    const auto channels = this->Channels.find(node);
    const auto channel = channels == this->Channels.end() ? std::map<std::string, GltfChannel>::const_iterator()
                                                          : channels->second.find(path);
    const Json& one = this->Document.at("nodes").at(node);
    Eigen::VectorXd still = one.contains(path) ? gltfList(one.at(path), std::size_t(usual.size())) : usual;
    if (channels != this->Channels.end() && channel != channels->second.end())
    {
      const Eigen::VectorXd first = channel->second.at(this->timeOf(*this->Frames.begin()));
      this->Judge.number("pose of nodes", "of the largest number", this->File,
        "nodes/" + std::to_string(node) + ' ' + path,
        std::min((first - still).norm(), (first + still).norm()) / std::max(1.0, still.norm()), 0, single);
      return channel->second.at(this->timeOf(frame));
    }
    return still;
  }

  double timeOf(int frame) const { return frame / this->Judge.source().manifest().fps; }

  Eigen::Affine3d affine(std::size_t node, int frame) const
  {
    const Eigen::Vector3d t = this->valueOf(node, "translation", Eigen::Vector3d::Zero(), frame);
    const Eigen::Vector4d q = this->valueOf(node, "rotation", Eigen::Vector4d(0, 0, 0, 1), frame);
    const Eigen::Vector3d scale = this->valueOf(node, "scale", Eigen::Vector3d::Ones(), frame);
    this->Judge.number("quaternion", "1", this->File, "nodes/" + std::to_string(node), q.norm(), 1, single);
    return Eigen::Translation3d(t) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Scaling(scale);
  }

  void judgeTimes(std::size_t node)
  {
    const auto channels = this->Channels.find(node);
    if (channels == this->Channels.end())
    {
      return;
    }
    for (const auto& [path, channel] : channels->second)
    {
      for (const double time : channel.times)
      {
        double nearest = infinite;
        for (const int frame : this->Frames)
        {
          const double expected = this->timeOf(frame);
          nearest = std::abs(expected - time) < std::abs(nearest - time) ? expected : nearest;
        }
        this->Judge.number("time", "s", this->File, "nodes/" + std::to_string(node) + ' ' + path, time, nearest,
          1e-7 * (1 + std::abs(time)));
      }
    }
  }

  void judgeCamera(std::size_t index, const Json& node)
  {
    const Json& camera = this->Document.at("cameras").at(node.at("camera").get<std::size_t>());
    const Json& extras = camera.at("extras");
    const Json& perspective = camera.at("perspective");
    const Eigen::Vector3d flip(1, -1, -1);
    this->judgeTimes(index);
    for (const int frame : this->Frames)
    {
      const ExportedName* name =
        this->Judge.source().named("nodes/" + std::to_string(index) + '@' + std::to_string(frame));
      if (!name)
      {
        continue;
      }
      ++this->Pictures;
      this->judgeCentre(index, *name);
      this->holds("names", name->frame == frame && node.at("name") == utf8FromBytes(name->camera) &&
                             camera.at("name") == utf8FromBytes(name->camera));
      this->judgeRange(perspective, *name);
      const Eigen::Affine3d pose = this->affine(index, frame);
      const Eigen::Matrix3d R = flip.asDiagonal() * pose.linear().transpose();
      this->Judge.pose(
        this->File, name->camera, frame, R, -(R * (pose.translation() + this->Origin)) / this->Metres, 2e-6);
      Eigen::Matrix3d K;
      for (std::size_t i = 0; i < requireSize(extras.at("K"), 3); ++i)
      {
        K.row(Eigen::Index(i)) = gltfList(extras.at("K")[i], 3).transpose();
      }
      this->Judge.size(this->File, name->camera, frame, extras.at("width"), extras.at("height"));
      this->Judge.intrinsics(this->File, name->camera, frame, K, 1e-9);
      const double high = 2 * std::tan(perspective.at("yfov").get<double>() / 2);
      const double wide = high * perspective.at("aspectRatio").get<double>();
      this->Judge.number("field of view", "px", this->File, name->camera, extras.at("height").get<double>() / high,
        K(1, 1), 1e-9 * K(1, 1));
      this->Judge.number("field of view", "px", this->File, name->camera, extras.at("width").get<double>() / wide,
        K(0, 0), 1e-9 * K(0, 0));
    }
  }

  /// As fine as keys are, however far the world's origin is.
  void judgeCentre(std::size_t index, const ExportedName& name)
  {
    if (const CameraRecord* camera = this->Judge.source().camera(name.camera, name.frame))
    {
      const Eigen::Vector3d expected = -(camera->R.transpose() * camera->t) * this->Metres - this->Origin;
      const double off = apart(this->affine(index, name.frame).translation(), expected);
      this->Judge.number("pose of cameras", "of the distance from the world's origin", this->File, name.camera,
        off / std::max(1.0, expected.norm()), 0, single);
    }
  }

  /// Metres that a camera sees.
  void judgeRange(const Json& perspective, const ExportedName& name)
  {
    const CameraRecord* camera = this->Judge.source().camera(name.camera, name.frame);
    const double near = camera ? camera->near * this->Metres : 0;
    const double far = camera ? camera->far * this->Metres : 0;
    this->Judge.number("range", "m", this->File, name.camera, perspective.at("znear"), near, 1e-9 * near);
    if (std::isfinite(far) && far > near)
    {
      this->Judge.number("range", "m", this->File, name.camera, perspective.at("zfar"), far, 1e-9 * far);
    }
  }

  void judgeObject(std::size_t index, const Json& node)
  {
    const Json& extras = node.at("extras");
    const std::uint32_t id = extras.at("id");
    const ObjectRecord* object = this->Judge.source().object(id);
    this->holds(
      "object", object && this->Ids.insert(id).second && extras.at("class") == utf8FromBytes(object->objectClass) &&
                  extras.at("deforming") == object->deforming && node.at("name") == utf8FromBytes(object->name));
    if (!object)
    {
      return;
    }
    const std::string path = this->Judge.source().dataset() + '/' + object->geometryFile;
    const PlyFile model(path);
    const Json& mesh = this->Document.at("meshes").at(node.at("mesh").get<std::size_t>());
    this->holds("mesh", mesh.at("name") == utf8FromBytes(object->geometryFile));
    for (const Json& range : extras.at("visible_frames"))
    {
      const std::vector<double> ends = numberList(range, 2);
      this->holds("visible frames", this->Frames.count(int(ends[0])) > 0 && this->Frames.count(int(ends[1])) > 0);
    }
    const Eigen::MatrixXd points =
      this->Numbers.read(mesh.at("primitives").at(0).at("attributes").at("POSITION"), model.vertices(), 3).transpose();
    this->judgeTimes(index);
    for (const int frame : this->Frames)
    {
      const PoseRecord& pose = this->Poses.at({ frame, id });
      int listed = 0;
      for (const Json& range : extras.at("visible_frames"))
      {
        listed += frame >= range.at(0).get<int>() && frame <= range.at(1).get<int>();
      }
      this->holds("visible frames", listed == int(pose.visible));
      const Eigen::Affine3d world = this->affine(index, frame);
      this->holds("determinant", world.linear().determinant() > 0);
      double largest = 0;
      double size = 1e-300;
      for (std::size_t i = 0; i < model.vertices(); ++i)
      {
        const Eigen::Vector3d expected = this->Metres * (pose.matrix * model.vertex(i).x.homogeneous());
        const Eigen::Vector3d found = world * Eigen::Vector3d(points.col(Eigen::Index(i))) + this->Origin;
        size = std::max(size, (expected - this->Origin).norm());
        largest = larger(largest, (found - expected).norm());
      }
      this->Judge.number(
        "vertices", "of the distance from the world's origin", this->File, object->name, largest / size, 0, 1e-6);
    }
    const bool mirrored = this->Poses.at({ *this->Frames.begin(), id }).matrix.leftCols<3>().determinant() < 0;
    this->holds("mirrored", extras.at("mirrored") == mirrored);
    this->judgeMesh(mesh, model, mirrored);
  }

  /// The picture on a primitive, and what is beyond it; "" for none.
  std::string pictureOf(const Json& material) const
  {
    const Json& look = material.at("pbrMetallicRoughness");
    if (!look.contains("baseColorTexture"))
    {
      return {};
    }
    const Json& texture = this->Document.at("textures").at(look.at("baseColorTexture").at("index").get<std::size_t>());
    const std::string uri = this->Document.at("images").at(texture.at("source").get<std::size_t>()).at("uri");
    return uri.substr(uri.rfind('/') + 1) + gltfWrap(this->Document, texture);
  }

  void judgeMesh(const Json& mesh, const PlyFile& model, bool mirrored)
  {
    std::multimap<std::array<std::size_t, 3>, std::string> triangles; // and their pictures, wrapped
    for (std::size_t i = 0; i < model.triangles(); ++i)
    {
      const auto& t = model.triangle(i);
      const auto corner = [&](std::size_t k) { return std::size_t(t[k]); };
      const auto corners = sortedCorners({ corner(0), corner(mirrored ? 2 : 1), corner(mirrored ? 1 : 2) });
      triangles.emplace(corners, model.picture(i) + (model.wrap(i).empty() ? "" : ' ' + model.wrap(i)));
    }
    for (const Json& primitive : mesh.at("primitives"))
    {
      const Json& attributes = primitive.at("attributes");
      const Json& material = this->Document.at("materials").at(primitive.at("material").get<std::size_t>());
      const std::string picture = this->pictureOf(material);
      const Eigen::VectorXd factor = gltfList(material.at("pbrMetallicRoughness").at("baseColorFactor"), 4);
      const Eigen::MatrixXd colors = attributes.contains("COLOR_0")
                                       ? this->Numbers.read(attributes["COLOR_0"], model.vertices(), 3)
                                       : Eigen::MatrixXd::Ones(Eigen::Index(model.vertices()), 3);
      const Eigen::VectorXd indices = this->Numbers.read(primitive.at("indices")).col(0);
      for (Eigen::Index i = 0; i + 2 < indices.size(); i += 3)
      {
        const auto corners =
          sortedCorners({ std::size_t(indices[i]), std::size_t(indices[i + 1]), std::size_t(indices[i + 2]) });
        const auto found = triangles.find(corners);
        const bool there = found != triangles.end();
        this->Judge.holds("triangles", this->File, mesh.at("name"), there, "another triangle", "those of the model");
        if (!there)
        {
          continue;
        }
        const std::string expected = found->second;
        triangles.erase(found);
        this->Judge.holds("textures", this->File, mesh.at("name"),
          picture == expected || (picture.empty() && this->isLeftOut(expected.substr(0, expected.find(' ')))), picture,
          expected);
        for (const std::size_t corner : corners)
        {
          const Eigen::Vector3d color = factor.head(3).cwiseProduct(colors.row(Eigen::Index(corner)).transpose());
          this->judgeColor(mesh.at("name"), color, model.vertex(corner).color);
        }
      }
      this->judgeAttributes(mesh.at("name"), attributes, model, mirrored);
    }
    this->Judge.holds("triangles", this->File, mesh.at("name"), triangles.empty(),
      std::to_string(triangles.size()) + " missing", "those of the model");
  }

  bool isLeftOut(const std::string& picture) const
  {
    return (", " + this->Judge.source().convention("textures_left_out") + ',').find(", " + picture + ',') !=
           std::string::npos;
  }

  void judgeColor(const std::string& where, const Eigen::Vector3d& found, const std::array<std::uint8_t, 3>& expected)
  {
    for (Eigen::Index c = 0; c < 3; ++c)
    {
      const double v = found[c] <= 0.0031308 ? 12.92 * found[c] : 1.055 * std::pow(found[c], 1 / 2.4) - 0.055;
      this->Judge.number("colors", "levels", this->File, where, 255 * v, expected[std::size_t(c)], 1e-3);
    }
  }

  void judgeAttributes(const std::string& where, const Json& attributes, const PlyFile& model, bool mirrored)
  {
    bool unit = true;
    for (std::size_t i = 0; i < model.vertices(); ++i)
    {
      unit = unit && model.vertex(i).normal.cast<double>().norm() > 1e-6;
    }
    this->Judge.holds("normals", this->File, where, attributes.contains("NORMAL") == unit, "another", "as the model");
    if (attributes.contains("NORMAL"))
    {
      const Eigen::MatrixXd normals = this->Numbers.read(attributes["NORMAL"], model.vertices(), 3);
      for (std::size_t i = 0; i < model.vertices(); ++i)
      {
        Eigen::Vector3d expected = model.vertex(i).normal.cast<double>().normalized();
        expected.x() *= mirrored ? -1 : 1;
        const double apart = (normals.row(Eigen::Index(i)).transpose() - expected).norm();
        this->Judge.number("normals", "1", this->File, where, apart, 0, single);
      }
    }
    this->Judge.holds("texture coordinates", this->File, where, attributes.contains("TEXCOORD_0") == model.hasUvs(),
      "another", "as the model");
    if (attributes.contains("TEXCOORD_0"))
    {
      const Eigen::MatrixXd uvs = this->Numbers.read(attributes["TEXCOORD_0"], model.vertices(), 2);
      for (std::size_t i = 0; i < model.vertices(); ++i)
      {
        const Eigen::Vector2d expected(model.vertex(i).uv.x(), 1 - model.vertex(i).uv.y());
        const double off = apart(uvs.row(Eigen::Index(i)).transpose(), expected);
        this->Judge.number(
          "texture coordinates", "1", this->File, where, off / std::max(1.0, expected.norm()), 0, single);
      }
    }
  }

  /// Lights that do not move. Their intensity is pi times the scene's, as candela and lux.
  void judgeLight(std::size_t index, const Json& node)
  {
    const std::size_t number = node.at("extensions").at("KHR_lights_punctual").at("light");
    const Json& light = this->Document.at("extensions").at("KHR_lights_punctual").at("lights").at(number);
    const auto found = std::find_if(this->Lights.begin(), this->Lights.end(),
      [&](const Json& one) { return one.value("name", "") == light.at("name"); });
    const bool known = found != this->Lights.end() && found->value("kind", "point") == light.at("type");
    this->Judge.holds("lights", this->File, light.at("name"), known, light.at("type"), "a light of the scene");
    const bool still = known && (!found->contains("position") || found->at("position").is_array()) &&
                       (!found->contains("target") || found->at("target").is_array());
    if (!still)
    {
      return;
    }
    const auto vector = [&](const char* key, double usual) {
      return Eigen::Vector3d(found->contains(key) ? gltfList(found->at(key), 3) : Eigen::VectorXd::Constant(3, usual));
    };
    const Eigen::Vector3d place = vector("position", 0);
    const Eigen::Vector3d target = vector("target", 0);
    const Eigen::Affine3d world = this->affine(index, *this->Frames.begin());
    const Eigen::Vector3d along = (target - place).normalized();
    const double apart =
      ((world.translation() + this->Origin) / this->Metres - place).norm() / std::max(1.0, place.norm());
    const double turn = light.at("type") == "point" ? 0 : (world.linear() * Eigen::Vector3d(0, 0, -1) - along).norm();
    this->Judge.number("lights", "1", this->File, light.at("name"), apart + turn, 0, 1e-9);
    this->holds("light", node.at("name") == light.at("name"));
    const auto moves = [&](const char* key) { return found->contains(key) && found->at(key).is_object(); };
    if (!moves("diffuse") && !moves("intensity") && !moves("attenuation"))
    {
      const Eigen::Vector3d diffuse = vector("diffuse", 1);
      const double most = diffuse.maxCoeff();
      const Eigen::Vector3d k = found->contains("attenuation") ? vector("attenuation", 0) : Eigen::Vector3d(1, 0, 0);
      const Eigen::Vector3d metre(1, 1 / this->Metres, 1 / (this->Metres * this->Metres)); // in scene units
      const double fall = light.at("type") == "directional" ? 1 : k.dot(metre);
      const double expected = found->value("intensity", 1.0) * most * std::acos(-1.0) / fall;
      this->Judge.number(
        "brightness", "1", this->File, light.at("name"), light.at("intensity"), expected, 1e-9 * expected);
      const Eigen::Vector3d color = gltfList(light.at("color"), 3);
      this->Judge.number(
        "brightness", "1", this->File, light.at("name"), (color * most - diffuse).norm(), 0, 1e-9 * most);
    }
  }

  /// Pictures are the dataset's.
  void judgeTextures()
  {
    for (const ExportedFile& one : this->Judge.source().record().files)
    {
      if (one.file.path.rfind("textures/", 0) == 0)
      {
        const std::string expected = "models/" + one.file.path.substr(std::string("textures/").size());
        const std::optional<DatasetFile> own = this->Judge.source().listed(expected);
        const bool same = own && own->sha256 == one.file.sha256;
        this->Judge.holds("textures", one.file.path, expected, same, "other bytes", "the dataset's file");
      }
    }
  }

  ExportJudge& Judge;
  std::string File;
  const Json& Document;
  GltfNumbers Numbers;
  double Metres;
  Eigen::Matrix3d Up;
  Eigen::Vector3d Origin{ 0, 0, 0 }; ///< of the world's children, metres of the scene's axes
  Json Lights;
  std::map<std::pair<int, std::uint32_t>, PoseRecord> Poses;
  std::map<std::size_t, std::map<std::string, GltfChannel>> Channels;
  std::set<int> Frames;
  std::set<std::uint32_t> Ids;
  std::size_t Pictures = 0;
};
} // namespace

void readGltf(ExportJudge& judge)
{
  const std::string file = "scene.gltf";
  const std::string path = judge.source().path(file);
  const Json document = readJsonFile(path);
  useJson(path, [&] { Asset(judge, file, document).judge(); });
}

} // namespace dgtk
