// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelObject.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dgtk
{

namespace
{
using Surface = ModelObject::Surface;

/// The surfaces around each vertex, in file order.
class SurfacesAround
{
public:
  explicit SurfacesAround(const ModelObject& object)
    : Object(object)
    , Place(placesOf(object))
    , First(object.positions.size() + 1, 0)
    , List(object.corners.size())
  {
    for (const Corner& corner : object.corners)
    {
      ++this->First[this->placeOf(corner) + 1];
    }
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    std::vector<std::uint32_t> next(this->First.begin(), this->First.end() - 1);
    for (std::uint32_t s = 0; s < object.surfaces.size(); ++s)
    {
      const Surface& surface = object.surfaces[s];
      for (std::uint32_t c = 0; c < surface.corners; ++c)
      {
        this->List[next[this->placeOf(object.corners[surface.firstCorner + c])]++] = s;
      }
    }
  }

  /// The vertex that stands for all at its place.
  std::uint32_t placeOf(const Corner& corner) const { return this->Place[this->Object.local(corner)]; }
  std::uint32_t count(std::uint32_t place) const { return this->First[place + 1] - this->First[place]; }

  /// Sum of what `term` gives for each surface; one that meets the vertex twice counts once.
  template <typename Term>
  Eigen::Vector3d sum(std::uint32_t place, Term term) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::uint32_t i = this->First[place]; i < this->First[place + 1]; ++i)
    {
      if (i == this->First[place] || this->List[i] != this->List[i - 1])
      {
        sum += term(this->Object.surfaces[this->List[i]]);
      }
    }
    return sum;
  }

  /// Area-weighted sums of normals, of each vertex.
  std::vector<Eigen::Vector3d> areaSums() const
  {
    std::vector<Eigen::Vector3d> sums;
    for (std::uint32_t v = 0; v < this->Place.size(); ++v)
    {
      sums.push_back(this->sum(v, [](const Surface& s) -> Eigen::Vector3d { return s.area * s.normal; }));
    }
    return sums;
  }

private:
  /// Smoothing groups join vertices at the same place: files split vertices along seams of the texture.
  static std::vector<std::uint32_t> placesOf(const ModelObject& object)
  {
    std::vector<std::uint32_t> place(object.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    if (std::none_of(object.surfaces.begin(), object.surfaces.end(),
          [](const Surface& s) { return s.style.shading == Shading::Groups; }))
    {
      return place;
    }
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
    return place;
  }

  const ModelObject& Object;
  std::vector<std::uint32_t> Place;
  std::vector<std::uint32_t> First; ///< of each place in List
  std::vector<std::uint32_t> List;
};

/// Sum over the surfaces around a place that are smooth with `surface`: Shading::Crease or Shading::Groups.
Eigen::Vector3d smoothSum(const SurfacesAround& around, std::uint32_t place, const Surface& surface, double cosine)
{
  const bool byCrease = surface.style.shading == Shading::Crease;
  return around.sum(place,
    [&](const Surface& other) -> Eigen::Vector3d
    {
      const bool joins = byCrease ? other.style.shading == Shading::Crease && other.normal.dot(surface.normal) >= cosine
                                  : (other.style.groups & surface.style.groups) != 0;
      const double weight = !joins && &other != &surface ? 0 : byCrease ? 1 : other.area;
      return weight * other.normal;
    });
}
} // namespace

std::vector<Eigen::Vector3f> ModelBuilder::smooth()
{
  const ModelObject& object = *this->Current;
  const SurfacesAround around(object);
  const std::uint64_t splits = this->Rest->positions.size() + object.corners.size();
  const std::uint64_t triangles = this->model().triangles.size() + object.triangles.size();
  const bool neverFlat = 110 * splits + 20 * triangles + 64 * object.corners.size() > this->MemoryLimit;
  const double cosine = portable::cos(object.crease * pi / 180) - 1e-9;
  std::vector<Eigen::Vector3d> areas; ///< of each vertex, for Shading::Area
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(object.corners.size());
  for (const Surface& surface : object.surfaces)
  {
    const bool raised = neverFlat && surface.style.shading == Shading::Flat;
    const Shading shading = raised ? Shading::Area : surface.style.shading;
    this->GaveUpFlat = this->GaveUpFlat || raised;
    if (shading == Shading::Area && areas.empty())
    {
      areas = around.areaSums();
    }
    for (std::uint32_t c = 0; c < surface.corners; ++c)
    {
      const Corner& corner = object.corners[surface.firstCorner + c];
      if (corner.normal >= 0)
      {
        normals.push_back(object.normals[static_cast<std::size_t>(corner.normal)]);
        continue;
      }
      const std::uint32_t place = around.placeOf(corner);
      const bool searched = shading == Shading::Crease || shading == Shading::Groups;
      const bool affordable = this->Work + around.count(place) <= this->WorkLimit;
      this->Work += searched && affordable ? around.count(place) : 0;
      this->GaveUpShape = this->GaveUpShape || (searched && !affordable);
      const Eigen::Vector3d sum = shading == Shading::Area ? areas[place]
                                  : searched && affordable ? smoothSum(around, place, surface, cosine)
                                                           : Eigen::Vector3d(0, 0, 0);
      const double length = sum.stableNorm();
      const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(sum / length) : surface.normal;
      normals.push_back(unit.isZero(0) ? Eigen::Vector3f(0, 0, 1) : Eigen::Vector3f(unit.cast<float>()));
    }
  }
  return normals;
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
