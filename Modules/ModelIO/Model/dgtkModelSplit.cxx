// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelObject.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr std::uint32_t none = 0xffffffffu;

/// The split vertices of an object, found by what they consist of: open addressing with linear probing.
class SplitTable
{
public:
  SplitTable(const std::vector<Corner>& corners, const std::vector<Eigen::Vector3f>& normals)
    : Corners(corners)
    , Normals(normals)
  {
    std::size_t size = 16;
    while (size < corners.size() + corners.size() / 4)
    {
      size *= 2;
    }
    this->Slots.assign(size, none);
  }
  /// The corner whose split vertex corner `c` shares: an earlier one that is equal, or itself.
  std::uint32_t find(std::uint32_t c)
  {
    const std::size_t mask = this->Slots.size() - 1;
    std::size_t at = this->hash(c) & mask;
    // beyond this many steps a vertex is not shared
    for (int steps = 0; steps < 256 && this->Slots[at] != none; ++steps, at = (at + 1) & mask)
    {
      if (this->same(this->Slots[at], c))
      {
        return this->Slots[at];
      }
    }
    if (this->Slots[at] == none)
    {
      this->Slots[at] = c;
    }
    return c;
  }

private:
  bool same(std::uint32_t a, std::uint32_t b) const
  {
    const Corner& x = this->Corners[a];
    const Corner& y = this->Corners[b];
    return x.vertex == y.vertex && x.u == y.u && x.v == y.v && this->Normals[a] == this->Normals[b];
  }
  std::size_t hash(std::uint32_t c) const
  {
    const Corner& corner = this->Corners[c];
    const Eigen::Vector3f& n = this->Normals[c];
    std::uint64_t h = corner.vertex;
    for (const float value : { corner.u, corner.v, n[0], n[1], n[2] })
    {
      const float positive = value + 0.0f; // -0 equals 0
      std::uint32_t bits = 0;
      std::memcpy(&bits, &positive, sizeof bits);
      h = (h ^ bits) * 0x9e3779b97f4a7c15ull;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }

  const std::vector<Corner>& Corners;
  const std::vector<Eigen::Vector3f>& Normals;
  std::vector<std::uint32_t> Slots;
};
} // namespace

void ModelBuilder::emit(const std::vector<Eigen::Vector3f>& normals)
{
  const Object& object = *this->Current;
  Model& model = *this->Result;
  const std::size_t base = this->Rest->positions.size();

  // corner -> split vertex, and the first corner of each split vertex
  std::vector<std::uint32_t> cornerOf;
  std::vector<std::uint32_t> splitOf(object.corners.size());
  {
    SplitTable table(object.corners, normals);
    for (std::uint32_t c = 0; c < object.corners.size(); ++c)
    {
      const std::uint32_t shared = table.find(c);
      splitOf[c] = shared == c ? static_cast<std::uint32_t>(cornerOf.size()) : splitOf[shared];
      if (shared == c)
      {
        cornerOf.push_back(c);
      }
    }
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
