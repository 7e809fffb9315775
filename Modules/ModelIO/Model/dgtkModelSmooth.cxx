// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelObject.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dgtk
{

namespace
{
constexpr double pi = 3.14159265358979323846;

/// Calls `function` for each of the surfaces around a vertex; one that meets the vertex twice counts once.
template <typename Object, typename Function>
void forEachSurface(const Object& object, const std::uint32_t* around, std::uint32_t count, Function function)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    if (i == 0 || around[i] != around[i - 1])
    {
      function(object.surfaces[around[i]]);
    }
  }
}
} // namespace

void ModelBuilder::smooth(std::vector<Eigen::Vector3f>& normals)
{
  const Object& object = *this->Current;
  const std::size_t corners = object.corners.size();

  // Smoothing groups join vertices at the same place: files split vertices along seams of the texture.
  const bool byPlace = std::any_of(object.surfaces.begin(), object.surfaces.end(),
    [](const Object::Surface& s) { return s.style.shading == Shading::Groups; });
  std::vector<std::uint32_t> place(object.positions.size());
  std::iota(place.begin(), place.end(), 0u);
  if (byPlace)
  {
    const auto key = [&object](std::uint32_t i)
    {
      const Eigen::Vector3d& p = object.positions[i];
      const bool usable = isDrawable(p);
      return std::make_tuple(usable ? p[0] : 0, usable ? p[1] : 0, usable ? p[2] : 0);
    };
    std::vector<std::uint32_t> order(place);
    std::sort(order.begin(), order.end(),
      [&key](std::uint32_t a, std::uint32_t b) { return std::make_tuple(key(a), a) < std::make_tuple(key(b), b); });
    for (std::size_t i = 1; i < order.size(); ++i)
    {
      place[order[i]] = key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    }
  }

  // surfaces around each vertex, in file order: around[first[v]] .. around[first[v + 1]]
  std::vector<std::uint32_t> first(object.positions.size() + 1, 0);
  for (const Corner& corner : object.corners)
  {
    ++first[place[object.local(corner)] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> around(corners);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t s = 0; s < object.surfaces.size(); ++s)
  {
    const Object::Surface& surface = object.surfaces[s];
    for (std::uint32_t c = 0; c < surface.corners; ++c)
    {
      around[next[place[object.local(object.corners[surface.firstCorner + c])]]++] = s;
    }
  }

  const std::uint64_t splits = this->Rest->positions.size() + corners;
  const std::uint64_t triangles = this->Result->triangles.size() + object.triangles.size();
  const bool neverFlat = 110 * splits + 20 * triangles + 64 * corners > this->MemoryLimit;
  const auto shadingOf = [neverFlat](const Object::Surface& s)
  { return neverFlat && s.style.shading == Shading::Flat ? Shading::Area : s.style.shading; };

  std::vector<Eigen::Vector3d> areas; ///< of each vertex, for Shading::Area
  if (std::any_of(object.surfaces.begin(), object.surfaces.end(),
        [&](const Object::Surface& s) { return shadingOf(s) == Shading::Area; }))
  {
    areas.assign(object.positions.size(), Eigen::Vector3d::Zero());
    for (std::size_t v = 0; v < areas.size(); ++v)
    {
      forEachSurface(object, around.data() + first[v], first[v + 1] - first[v],
        [&](const Object::Surface& s) { areas[v] += s.area * s.normal; });
    }
  }

  const double cosine = std::cos(object.crease * pi / 180) - 1e-9;
  normals.reserve(corners);
  for (const Object::Surface& surface : object.surfaces)
  {
    const Shading shading = shadingOf(surface);
    this->GaveUpFlat = this->GaveUpFlat || shading != surface.style.shading;
    for (std::uint32_t c = 0; c < surface.corners; ++c)
    {
      const Corner& corner = object.corners[surface.firstCorner + c];
      if (corner.normal >= 0)
      {
        normals.push_back(object.normals[static_cast<std::size_t>(corner.normal)]);
        continue;
      }
      const std::uint32_t v = place[object.local(corner)];
      const std::uint32_t count = first[v + 1] - first[v];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      if (shading == Shading::Area)
      {
        sum = areas[v];
      }
      else if (shading != Shading::Flat && this->Work + count <= this->WorkLimit)
      {
        this->Work += count;
        forEachSurface(object, around.data() + first[v], count,
          [&](const Object::Surface& other)
          {
            const bool joins = shading == Shading::Crease
                                 ? other.style.shading == Shading::Crease && other.normal.dot(surface.normal) >= cosine
                                 : (other.style.groups & surface.style.groups) != 0;
            if (joins || &other == &surface)
            {
              sum += shading == Shading::Crease ? other.normal : Eigen::Vector3d(other.area * other.normal);
            }
          });
      }
      else
      {
        this->GaveUpShape = this->GaveUpShape || shading != Shading::Flat;
      }
      const double length = sum.stableNorm();
      const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(sum / length) : surface.normal;
      normals.push_back(unit.isZero(0) ? Eigen::Vector3f(0, 0, 1) : Eigen::Vector3f(unit.cast<float>()));
    }
  }
}

void groupNormals(Model& model)
{
  // split vertices of one file vertex that have the same normal share a group
  const std::vector<Eigen::Vector3f>& normals = model.rest->normals;
  std::vector<std::uint32_t> order(model.sourceVertex.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i)
  { return std::make_tuple(model.sourceVertex[i], normals[i][0], normals[i][1], normals[i][2]); };
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return std::make_tuple(key(a), a) < std::make_tuple(key(b), b); });
  model.normalGroup.assign(order.size(), 0);
  std::uint32_t group = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    group += key(order[i]) == key(order[i - 1]) ? 0 : 1;
    model.normalGroup[order[i]] = group;
  }
}

} // namespace dgtk
