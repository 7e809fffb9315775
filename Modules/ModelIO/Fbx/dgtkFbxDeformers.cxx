// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxDeformers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace dgtk::import
{

namespace
{
/// The file has matrices column by column.
std::optional<Transform> transformOf(const FbxElement& element, const char* name)
{
  const std::vector<double> m = element.numbers(name);
  if (m.size() < 16 || !std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); }))
  {
    return std::nullopt;
  }
  return Transform({ m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14], 0, 0, 0, 1 });
}

/// The vertices of a part that are at each control point: [First[i], First[i + 1]) of List.
class PlacesOf
{
public:
  PlacesOf(const FbxPart& part, std::size_t controlPoints)
    : First(controlPoints + 1, 0)
    , List(part.controlPoints.size())
  {
    for (const std::uint32_t point : part.controlPoints)
    {
      ++this->First[point + 1];
    }
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    std::vector<std::uint32_t> next = this->First;
    for (std::uint32_t v = 0; v < part.controlPoints.size(); ++v)
    {
      this->List[next[part.controlPoints[v]]++] = v;
    }
  }

  /// Calls with each vertex at one of `points` and the index of that one among them.
  template <class Call>
  void visit(const std::vector<std::int64_t>& points, Call call) const
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (points[i] >= 0 && points[i] < static_cast<std::int64_t>(this->First.size()) - 1)
      {
        const auto point = static_cast<std::size_t>(points[i]);
        std::for_each(this->List.begin() + this->First[point], this->List.begin() + this->First[point + 1],
          [&](std::uint32_t vertex) { call(vertex, i); });
      }
    }
  }

private:
  std::vector<std::uint32_t> First;
  std::vector<std::uint32_t> List;
};
} // namespace

FbxDeformers::Shape FbxDeformers::shapeOf(const FbxElement& element)
{
  Shape shape{ element.integers("Indexes"), element.numbers("Vertices") };
  shape.offsets.resize(3 * shape.points.size());
  return shape;
}

FbxDeformers::FbxDeformers(
  const FbxScene& scene, std::size_t geometry, const Transform& node_from_geometry, FbxTargets& targets)
{
  for (const FbxElement& child : scene.object(geometry).element->children)
  {
    if (child.name == "Shape") // so until FBX 2012
    {
      Blend& blend = this->addBlend(scene, geometry, child.text(0), 0, targets);
      blend.targets = { static_cast<std::uint32_t>(this->Shapes.size()) };
      blend.full = { 100 };
      this->Shapes.push_back(shapeOf(child));
    }
  }
  for (const std::size_t index : scene.childrenOf(geometry, "Deformer"))
  {
    const FbxObject& deformer = scene.object(index);
    if (deformer.kind == "Skin" && this->Clusters.empty())
    {
      this->readSkin(scene, index, node_from_geometry, targets);
    }
    else if (deformer.kind == "BlendShape")
    {
      for (const std::size_t channel : scene.childrenOf(index, "Deformer"))
      {
        this->readChannel(scene, channel, targets);
      }
    }
  }
}

void FbxDeformers::readSkin(
  const FbxScene& scene, std::size_t skin, const Transform& node_from_geometry, const FbxTargets& targets)
{
  const FbxElement& element = *scene.object(skin).element;
  const FbxElement* type = element.find("SkinningType");
  const std::string kind = type != nullptr ? type->text(0) : std::string();
  this->IsDual = kind == "DualQuaternion";
  if (kind == "Blend")
  {
    this->DualPoints = element.integers("Indexes");
    this->DualShares = element.numbers("BlendWeights");
    this->DualShares.resize(this->DualPoints.size());
  }
  for (const std::size_t index : scene.childrenOf(skin, "Deformer"))
  {
    const FbxElement& from = *scene.object(index).element;
    Cluster cluster;
    const std::vector<std::size_t> bones = scene.childrenOf(index, "Model");
    cluster.node = bones.empty() ? noIndex : targets.nodes[bones.front()];
    cluster.bone_from_mesh = (transformOf(from, "Transform").value_or(Transform()) * node_from_geometry).matrix();
    cluster.points = from.integers("Indexes");
    cluster.weights = from.numbers("Weights");
    cluster.weights.resize(cluster.points.size());
    const bool isFinite =
      std::all_of(cluster.weights.begin(), cluster.weights.end(), [](double w) { return std::isfinite(w); });
    if (cluster.node != noIndex && isFinite)
    {
      this->Clusters.push_back(std::move(cluster));
    }
  }
}

Blend& FbxDeformers::addBlend(
  const FbxScene& scene, std::size_t object, const std::string& property, double percent, FbxTargets& targets)
{
  Blend blend;
  blend.number = targets.blends.try_emplace({ object, property }, std::int32_t(targets.blends.size())).first->second;
  blend.percent = scene.object(object).number(property, percent);
  blend.percent = std::isfinite(blend.percent) ? blend.percent : 0;
  return this->Blends.emplace_back(std::move(blend));
}

void FbxDeformers::readChannel(const FbxScene& scene, std::size_t channel, FbxTargets& targets)
{
  const FbxElement& element = *scene.object(channel).element;
  std::vector<double> full = element.numbers("FullWeights");
  const FbxElement* percent = element.find("DeformPercent");
  Blend& blend =
    this->addBlend(scene, channel, "DeformPercent", percent != nullptr ? percent->number(0, 0) : 0, targets);
  std::vector<std::size_t> shapes;
  const std::vector<std::size_t> geometries = scene.childrenOf(channel, "Geometry");
  for (const std::size_t geometry : geometries)
  {
    Shape shape = shapeOf(*scene.object(geometry).element);
    if (full.size() == shape.points.size() && full.size() > 1 && geometries.size() == 1)
    {
      // Blender writes the vertices' own shares here
      for (std::size_t i = 0; i < shape.offsets.size(); ++i)
      {
        shape.offsets[i] *= full[i / 3] / 100;
      }
      full = { 100 };
    }
    shapes.push_back(this->Shapes.size());
    this->Shapes.push_back(std::move(shape));
  }
  full.resize(shapes.size(), 100);
  std::replace_if(
    full.begin(), full.end(), [](double percentage) { return !std::isfinite(percentage); }, 100.0);
  std::vector<std::size_t> order(shapes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&full](std::size_t a, std::size_t b) { return full[a] < full[b]; });
  for (const std::size_t i : order)
  {
    blend.targets.push_back(static_cast<std::uint32_t>(shapes[i]));
    blend.full.push_back(full[i]);
  }
}

void FbxDeformers::addTo(const FbxPart& part, std::size_t controlPoints, Mesh& mesh) const
{
  const PlacesOf places(part, controlPoints);
  for (const Cluster& cluster : this->Clusters)
  {
    Bone bone;
    bone.node = cluster.node;
    bone.bone_from_mesh = cluster.bone_from_mesh;
    places.visit(cluster.points,
      [&](std::uint32_t vertex, std::size_t place)
      {
        bone.vertices.push_back(vertex);
        bone.weights.push_back(float(cluster.weights[place]));
      });
    if (!bone.vertices.empty())
    {
      mesh.bones.push_back(std::move(bone));
    }
  }
  if (!mesh.bones.empty() && (this->IsDual || !this->DualPoints.empty()))
  {
    mesh.dualQuaternions.assign(mesh.positions.size(), this->IsDual ? 1 : 0);
    places.visit(this->DualPoints, [&](std::uint32_t vertex, std::size_t place)
      { mesh.dualQuaternions[vertex] = std::clamp(this->DualShares[place], 0.0, 1.0); });
  }
  for (const Shape& shape : this->Shapes)
  {
    Target& target = mesh.targets.emplace_back();
    target.positions = mesh.positions;
    places.visit(shape.points,
      [&](std::uint32_t vertex, std::size_t place)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          target.positions[vertex][c] += float(shape.offsets[3 * place + c]);
        }
      });
  }
  mesh.blends = this->Blends;
}

} // namespace dgtk::import
