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
}

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

  const std::uint64_t finalBytes = std::uint64_t(100) * (this->Rest->positions.size() + corners);
  const bool neverFlat = finalBytes > this->MemoryLimit;
  const double cosine = std::cos(object.crease * pi / 180) - 1e-9;
  normals.reserve(corners);
  for (const Object::Surface& surface : object.surfaces)
  {
    const Shading shading = neverFlat && surface.style.shading == Shading::Flat ? Shading::Area : surface.style.shading;
    const Eigen::Vector3d own = surface.normal.stableNormalized();
    for (std::uint32_t c = 0; c < surface.corners; ++c)
    {
      const Corner& corner = object.corners[surface.firstCorner + c];
      if (corner.normal >= 0)
      {
        normals.push_back(object.normals[static_cast<std::size_t>(corner.normal)]);
        continue;
      }
      const std::uint32_t v = place[object.local(corner)];
      Eigen::Vector3d sum = own;
      if (shading != Shading::Flat && this->Work < this->WorkLimit)
      {
        this->GaveUpFlat = this->GaveUpFlat || shading != surface.style.shading;
        sum.setZero();
        this->Work += first[v + 1] - first[v];
        for (std::uint32_t i = first[v]; i < first[v + 1]; ++i)
        {
          const Object::Surface& other = object.surfaces[around[i]];
          if (i > first[v] && around[i] == around[i - 1])
          {
            continue; // a surface that meets the vertex twice counts once
          }
          const bool same = &other == &surface;
          if (shading == Shading::Crease)
          {
            const Eigen::Vector3d n = other.normal.stableNormalized();
            if (same || (other.style.shading == Shading::Crease && n.dot(own) >= cosine))
            {
              sum += n;
            }
          }
          else if (same || shading == Shading::Area || (other.style.groups & surface.style.groups) != 0)
          {
            sum += other.normal;
          }
        }
      }
      else if (shading != Shading::Flat)
      {
        this->GaveUpShape = true;
      }
      const double length = sum.stableNorm();
      const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(sum / length) : own;
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
