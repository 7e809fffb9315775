// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBopModels.h"

#include "dgtkError.h"
#include "dgtkExportChecks.h"
#include "dgtkModelPly.h"
#include "dgtkText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <queue>
#include <utility>

namespace dgtk::bop
{

namespace
{
constexpr double millimetres = 1000; ///< of a metre
constexpr double sameScale = 1e-9;

[[noreturn]] void refuse(const ObjectRecord& object, const std::string& what)
{
  throw UsageError(
    "bop: object " + quoted(object.name) + ' ' + what + ", which a rigid model cannot say; leave it out with objects");
}

/// The one scale of each object at all frames.
std::map<std::uint32_t, Eigen::Vector3d> scalesOf(const DatasetView& dataset, const std::vector<std::uint32_t>& objects)
{
  std::map<std::uint32_t, Eigen::Vector3d> scales;
  for (const int frame : dataset.frames())
  {
    for (const PoseRecord& pose : dataset.poses(frame))
    {
      if (std::find(objects.begin(), objects.end(), pose.id) == objects.end())
      {
        continue;
      }
      const ObjectRecord& object = *dataset.object(pose.id);
      if (!pose.rigid)
      {
        refuse(object, "is sheared");
      }
      if (pose.scale.minCoeff() <= 0)
      {
        refuse(object, "is mirrored");
      }
      const Eigen::Vector3d& scale = scales.emplace(pose.id, pose.scale).first->second;
      if ((pose.scale - scale).norm() > sameScale * scale.norm())
      {
        refuse(object, "changes its size");
      }
    }
  }
  return scales;
}

Eigen::Vector3d scaled(const std::array<double, 3>& x, const Eigen::Vector3d& scale)
{
  return scale.cwiseProduct(Eigen::Vector3d(x[0], x[1], x[2]));
}

/// A group of points in a tree.
struct Node
{
  std::size_t begin = 0;
  std::size_t end = 0;
  Eigen::Vector3d least{ 0, 0, 0 };
  Eigen::Vector3d most{ 0, 0, 0 };
};

Node nodeOf(const std::vector<Eigen::Vector3d>& points, std::size_t begin, std::size_t end)
{
  Node node{ begin, end, points[begin], points[begin] };
  for (std::size_t i = begin; i < end; ++i)
  {
    node.least = node.least.cwiseMin(points[i]);
    node.most = node.most.cwiseMax(points[i]);
  }
  return node;
}

/// Both halves of a group, which are made when they are asked for.
std::pair<Node, Node> halves(std::vector<Eigen::Vector3d>& points, const Node& node)
{
  Eigen::Index axis = 0;
  (node.most - node.least).maxCoeff(&axis);
  const std::size_t middle = node.begin + (node.end - node.begin) / 2;
  const auto at = [&](std::size_t i) { return points.begin() + std::ptrdiff_t(i); };
  std::nth_element(at(node.begin), at(middle), at(node.end),
    [axis](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[axis] < b[axis]; });
  return { nodeOf(points, node.begin, middle), nodeOf(points, middle, node.end) };
}

/// Groups as a binary tree: the children of i are 2 i + 1 and 2 i + 2.
std::vector<Node> treeOf(std::vector<Eigen::Vector3d>& points)
{
  constexpr std::size_t few = 16;
  std::vector<Node> tree{ nodeOf(points, 0, points.size()) };
  for (std::size_t i = 0; 2 * i + 1 < 2 * points.size() / few + 1; ++i)
  {
    if (i < tree.size() && tree[i].end - tree[i].begin > few)
    {
      const auto [first, second] = halves(points, tree[i]);
      tree.resize(std::max(tree.size(), 2 * i + 3));
      tree[2 * i + 1] = first;
      tree[2 * i + 2] = second;
    }
  }
  return tree;
}

/// No point of one group is farther from one of the other.
double bound(const Node& a, const Node& b)
{
  return (a.most - b.least).cwiseAbs().cwiseMax((b.most - a.least).cwiseAbs()).norm();
}

std::string modelName(const Model& model) { return "obj_" + padded(model.id, 6); }

/// The picture of a model that has one alone, on all of its faces.
std::string pictureOf(const ModelPly& model)
{
  const bool isEverywhere =
    std::all_of(model.textures.begin(), model.textures.end(), [](std::int32_t number) { return number == 0; });
  return model.pictures.size() == 1 && !model.uvs.empty() && isEverywhere ? model.pictures.front() : "";
}

std::string plyText(const ModelPly& ply, const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& scale,
  const std::string& picture)
{
  std::string text = "ply\nformat ascii 1.0\n";
  text += picture.empty() ? "" : "comment TextureFile " + picture + '\n';
  text += "element vertex " + std::to_string(points.size()) + '\n';
  for (const char* name : { "x", "y", "z", "nx", "ny", "nz" })
  {
    text += std::string("property double ") + name + '\n';
  }
  if (!picture.empty())
  {
    text += "property double texture_u\nproperty double texture_v\n";
  }
  text += "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " +
          std::to_string(ply.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::array<float, 3>& n = ply.normals[i];
    const Eigen::Vector3d normal =
      Eigen::Vector3d(double(n[0]), double(n[1]), double(n[2])).cwiseQuotient(scale).stableNormalized();
    std::vector<double> numbers{ points[i][0], points[i][1], points[i][2], normal[0], normal[1], normal[2] };
    if (!picture.empty())
    {
      numbers.insert(numbers.end(), ply.uvs[i].begin(), ply.uvs[i].end());
    }
    numbers.insert(numbers.end(), ply.colors[i].begin(), ply.colors[i].end());
    text += numbersLine(numbers) + '\n';
  }
  for (const auto& triangle : ply.triangles)
  {
    text +=
      "3 " + std::to_string(triangle[0]) + ' ' + std::to_string(triangle[1]) + ' ' + std::to_string(triangle[2]) + '\n';
  }
  return text;
}
} // namespace

double diameterOf(const std::vector<Eigen::Vector3d>& points)
{
  if (points.empty())
  {
    return 0;
  }
  std::vector<Eigen::Vector3d> sorted = points;
  const std::vector<Node> tree = treeOf(sorted);
  const auto isLeaf = [&](std::size_t i) { return 2 * i + 2 >= tree.size() || tree[2 * i + 1].end == 0; };
  using Pair = std::pair<double, std::pair<std::size_t, std::size_t>>;
  std::priority_queue<Pair> pairs;
  const auto push = [&](std::size_t a, std::size_t b) { pairs.push({ bound(tree[a], tree[b]), { a, b } }); };
  push(0, 0);
  double best = 0;
  while (!pairs.empty() && pairs.top().first > best)
  {
    const auto [a, b] = pairs.top().second;
    pairs.pop();
    const bool first = !isLeaf(a) && (isLeaf(b) || tree[a].end - tree[a].begin >= tree[b].end - tree[b].begin);
    if (first || !isLeaf(b))
    {
      const std::size_t split = first ? a : b;
      const std::size_t other = first ? b : a;
      push(2 * split + 1, other);
      push(2 * split + 2, other);
      continue;
    }
    for (std::size_t i = tree[a].begin; i < tree[a].end; ++i)
    {
      for (std::size_t k = tree[b].begin; k < tree[b].end; ++k)
      {
        best = std::max(best, (sorted[i] - sorted[k]).norm());
      }
    }
  }
  return best;
}

std::map<std::uint32_t, int> addModels(
  const DatasetView& dataset, const std::vector<std::uint32_t>& objects, std::vector<Model>& models)
{
  std::map<std::uint32_t, int> idOf;
  for (const std::uint32_t id : objects)
  {
    const ObjectRecord& object = *dataset.object(id);
    if (object.deforming)
    {
      refuse(object, "deforms");
    }
    if (object.geometryFile.empty())
    {
      throw UsageError(
        "bop: the dataset has no file of the model of " + quoted(object.name) + "; render it for bop, or with models");
    }
  }
  const std::map<std::uint32_t, Eigen::Vector3d> scales = scalesOf(dataset, objects);
  for (const std::uint32_t id : objects)
  {
    const ObjectRecord& object = *dataset.object(id);
    if (scales.count(id) == 0)
    {
      throw UsageError("bop: the dataset does not say where objects are (poses.json); render it again");
    }
    const Eigen::Vector3d& scale = scales.at(id);
    auto found = std::find_if(models.begin(), models.end(),
      [&](const Model& one)
      { return one.file == object.geometryFile && (one.scale - scale).norm() <= sameScale * scale.norm(); });
    if (found == models.end())
    {
      models.push_back({ int(models.size()) + 1, object.geometryFile, scale, &dataset });
      found = models.end() - 1;
    }
    idOf[id] = found->id;
  }
  return idOf;
}

Eigen::Vector3d originOf(const Model& model)
{
  const ModelPly ply = readModelPly(model.dataset->pathOf(model.file));
  Eigen::Vector3d least = scaled(ply.positions.at(0), model.scale);
  Eigen::Vector3d most = least;
  for (const auto& x : ply.positions)
  {
    least = least.cwiseMin(scaled(x, model.scale));
    most = most.cwiseMax(scaled(x, model.scale));
  }
  return (least + most) / 2;
}

ExportItem modelItem(const Model& model)
{
  const DatasetView& dataset = *model.dataset;
  const std::string picture = pictureOf(readModelPly(model.dataset->pathOf(model.file)));
  const std::string texture = picture.empty() ? "" : modelName(model) + '.' + extensionOf(picture);
  ExportItem item;
  for (const char* folder : { "models/", "models_eval/" })
  {
    item.files.push_back(folder + modelName(model) + ".ply");
    if (!texture.empty())
    {
      item.files.push_back(folder + texture);
    }
  }
  item.write = [&dataset, model, picture, texture](ExportSink& sink)
  {
    const ModelPly ply = readModelPly(model.dataset->pathOf(model.file));
    const Eigen::Vector3d origin = originOf(model);
    std::vector<Eigen::Vector3d> points;
    for (const auto& x : ply.positions)
    {
      points.emplace_back((scaled(x, model.scale) - origin) * (millimetres * dataset.metres()));
    }
    const std::string text = plyText(ply, points, model.scale, texture);
    const std::string beside = model.file.substr(0, model.file.rfind('/') + 1);
    for (const char* folder : { "models/", "models_eval/" })
    {
      sink.write(folder + modelName(model) + ".ply", text);
      if (!texture.empty())
      {
        sink.copy(folder + texture, beside + picture);
      }
    }
    const Node box = nodeOf(points, 0, points.size());
    const Eigen::Vector3d size = box.most - box.least;
    const nlohmann::ordered_json info{ { "diameter", diameterOf(points) }, { "min_x", box.least[0] },
      { "min_y", box.least[1] }, { "min_z", box.least[2] }, { "size_x", size[0] }, { "size_y", size[1] },
      { "size_z", size[2] } };
    sink.note("models", '"' + std::to_string(model.id) + "\": " + info.dump());
  };
  return item;
}

} // namespace dgtk::bop
