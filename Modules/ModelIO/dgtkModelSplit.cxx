// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelObject.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr std::uint32_t none = 0xffffffffu;
/// Split vertices of a file vertex that are looked through for one to share; further ones are not shared.
constexpr int longestChain = 32;

/// Makes room for `more` elements: exactly, when there is one object, and geometrically for many.
template <typename T>
void makeRoom(std::vector<T>& v, std::size_t more)
{
  if (v.capacity() - v.size() < more)
  {
    v.reserve(std::max(v.size() + more, v.capacity() + v.capacity() / 2));
  }
}
} // namespace

void ModelBuilder::emit(const std::vector<Eigen::Vector3f>& normals)
{
  const Object& object = *this->Current;
  Model& model = *this->Result;
  const std::size_t base = this->Rest->positions.size();

  // corner -> split vertex, found through a chain of the split vertices of each file vertex
  std::vector<std::uint32_t> head(object.positions.size(), none);
  std::vector<std::uint32_t> chain;
  std::vector<std::uint32_t> cornerOf;
  std::vector<std::uint32_t> splitOf(object.corners.size());
  for (std::uint32_t c = 0; c < object.corners.size(); ++c)
  {
    const Corner& corner = object.corners[c];
    std::uint32_t& start = head[object.local(corner)];
    std::uint32_t found = start;
    int steps = 0;
    for (; found != none && steps < longestChain; found = chain[found], ++steps)
    {
      const Corner& other = object.corners[cornerOf[found]];
      if (other.u == corner.u && other.v == corner.v && normals[cornerOf[found]] == normals[c])
      {
        break;
      }
    }
    if (found == none || steps == longestChain)
    {
      found = static_cast<std::uint32_t>(cornerOf.size());
      cornerOf.push_back(c);
      chain.push_back(start);
      start = found;
    }
    splitOf[c] = found;
  }
  if (base + cornerOf.size() >= none || model.triangles.size() + object.triangles.size() >= none)
  {
    throw InputError(model.path, 0, "has too many triangles", "fewer than 4294967295 vertices");
  }

  makeRoom(this->Rest->positions, cornerOf.size());
  makeRoom(this->Rest->normals, cornerOf.size());
  makeRoom(model.sourceVertex, cornerOf.size());
  if (this->HasUvs)
  {
    model.uvs.resize(base, Eigen::Vector2d(0, 0));
    makeRoom(model.uvs, cornerOf.size());
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
  }

  // parts: materials in the order in which the object uses them
  std::map<int, std::uint32_t> rank;
  for (const Object::Surface& surface : object.surfaces)
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
    const Object::Surface& surface = object.surfaces[s];
    if (surface.style.material != previous)
    {
      previous = surface.style.material;
      model.parts.push_back({ object.name, previous, static_cast<std::uint32_t>(model.triangles.size()), 0 });
    }
    model.parts.back().triangles += surface.triangles;
    for (std::uint32_t t = 0; t < surface.triangles; ++t)
    {
      const std::array<std::uint32_t, 3>& cut = object.triangles[surface.firstTriangle + t];
      std::array<std::uint32_t, 3> out;
      for (std::size_t i = 0; i < 3; ++i)
      {
        out[i] = static_cast<std::uint32_t>(base) + splitOf[cut[i]];
      }
      model.triangles.push_back(out);
    }
  }
}

} // namespace dgtk
