// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEqualItems.h"
#include "dgtkError.h"
#include "dgtkModelObject.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr std::uint32_t noVertex = 0xffffffffu;

/// The vertex of each corner, from `base`; `cornerOf` gets the first corner of each vertex.
std::vector<std::uint32_t> splitCorners(const std::vector<Corner>& corners, const std::vector<Eigen::Vector3f>& normals,
  std::size_t base, std::vector<std::uint32_t>& cornerOf)
{
  EqualItems known(corners.size());
  const auto equal = [&](std::uint32_t a, std::uint32_t b)
  {
    const Corner& x = corners[a];
    const Corner& y = corners[b];
    return x.vertex == y.vertex && x.u == y.u && x.v == y.v && x.color == y.color && normals[a] == normals[b];
  };
  std::vector<std::uint32_t> splitOf(corners.size());
  for (std::uint32_t c = 0; c < corners.size(); ++c)
  {
    std::uint64_t hash = corners[c].vertex;
    for (const std::uint8_t value : corners[c].color)
    {
      hash = hash * 31 + value;
    }
    for (const float value : { corners[c].u, corners[c].v, normals[c][0], normals[c][1], normals[c][2] })
    {
      hash = mixed(hash, value);
    }
    const std::uint32_t shared = known.find(c, hash, equal);
    splitOf[c] = shared == c ? static_cast<std::uint32_t>(base + cornerOf.size()) : splitOf[shared];
    if (shared == c)
    {
      cornerOf.push_back(c);
    }
  }
  return splitOf;
}
} // namespace

std::array<std::uint8_t, 4> colorBytes(const double* rgb, double alpha)
{
  const auto byte = [](double v) { return std::uint8_t(v > 0 ? std::min(v, 1.0) * 255 + 0.5 : 0.0); };
  return { byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), byte(alpha) };
}

/// Makes the vertices of the current object; returns the one of each corner.
std::vector<std::uint32_t> ModelBuilder::addSplitVertices(const std::vector<Eigen::Vector3f>& normals)
{
  const ModelObject& object = *this->Current;
  Model& model = this->model();
  const std::size_t base = this->Rest->positions.size();
  std::vector<std::uint32_t> cornerOf;
  std::vector<std::uint32_t> splitOf = splitCorners(object.corners, normals, base, cornerOf);
  if (base + cornerOf.size() >= noVertex || model.triangles.size() + object.triangles.size() >= noVertex)
  {
    throw InputError(model.path, "has too many triangles", "fewer than 4294967295 vertices");
  }
  makeRoom(this->Rest->positions, cornerOf.size());
  makeRoom(this->Rest->normals, cornerOf.size());
  makeRoom(model.sourceVertex, cornerOf.size());
  if (this->HasUvs)
  {
    model.uvs.resize(base, Eigen::Vector2d(0, 0));
    makeRoom(model.uvs, cornerOf.size());
  }
  if (this->HasColors)
  {
    makeRoom(model.colors, cornerOf.size());
  }
  for (const std::uint32_t c : cornerOf)
  {
    const Corner& corner = object.corners[c];
    const Eigen::Vector3d& position = object.positions[object.local(corner)];
    this->growBounds(position);
    this->Rest->positions.push_back(position);
    this->Rest->normals.push_back(normals[c]);
    model.sourceVertex.push_back(corner.vertex);
    if (this->HasUvs)
    {
      model.uvs.emplace_back(double(corner.u), double(corner.v));
    }
    if (this->HasColors)
    {
      model.colors.push_back(corner.color);
    }
  }
  return splitOf;
}

/// Makes parts and triangles of the current object: materials in the order in which it uses them.
void ModelBuilder::addParts(const std::vector<std::uint32_t>& splitOf)
{
  const ModelObject& object = *this->Current;
  Model& model = this->model();
  std::map<int, std::uint32_t> rank;
  for (const ModelObject::Surface& surface : object.surfaces)
  {
    rank.emplace(surface.style.material, static_cast<std::uint32_t>(rank.size()));
  }
  std::vector<std::uint32_t> order(object.surfaces.size());
  std::iota(order.begin(), order.end(), 0u);
  if (rank.size() > 1)
  {
    std::stable_sort(order.begin(), order.end(),
      [&](std::uint32_t a, std::uint32_t b)
      { return rank[object.surfaces[a].style.material] < rank[object.surfaces[b].style.material]; });
  }
  makeRoom(model.triangles, object.triangles.size());
  int previous = -1;
  for (const std::uint32_t s : order)
  {
    const ModelObject::Surface& surface = object.surfaces[s];
    if (surface.style.material != previous)
    {
      previous = surface.style.material;
      model.parts.push_back({ object.name, previous, static_cast<std::uint32_t>(model.triangles.size()), 0 });
    }
    model.parts.back().triangles += surface.triangles;
    if (!surface.isPlaced)
    {
      model.unplaced.resize(model.triangles.size());
      model.unplaced.resize(model.triangles.size() + surface.triangles, 1);
    }
    for (std::uint32_t t = 0; t < surface.triangles; ++t)
    {
      const std::array<std::uint32_t, 3>& cut = object.triangles[surface.firstTriangle + t];
      model.triangles.push_back({ splitOf[cut[0]], splitOf[cut[1]], splitOf[cut[2]] });
    }
  }
}

} // namespace dgtk
