// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPicture.h"

#include "dgtkPortableMath.h"
#include "dgtkRaySource.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int chunkRows = 16;
/// Part of the depth by which two computations of one point in double precision may differ; a neighbouring triangle
/// that is closer to a file's value is the one it shows.
constexpr double closeDepth = 1e-10;
} // namespace

/// What the files say about the surface of a pixel; null where there is no file.
struct Picture::Claims
{
  PicturePointer depth;
  PicturePointer objects;
  PicturePointer parts;
  PicturePointer triangles;
  double tolerance = wideDepthTolerance; ///< part of the depth
};

Picture::Picture(Dataset& dataset, const CameraRecord& record)
  : Owner(dataset)
  , Record(record)
  , Time(dataset.timedSight(Eye(record, dataset.sceneView(record).model), record.frame))
{
  std::map<double, std::shared_ptr<const Sight>> known;
  for (int y = 0; this->Time->rolls() && y < this->height(); ++y)
  {
    for (int x = 0; x < this->width(); ++x)
    {
      const double time = this->Time->timeAt(centreOf(x, y));
      std::shared_ptr<const Sight>& sight = known[time];
      sight = sight ? sight : this->Time->at(time);
      this->Sights.push_back(sight);
    }
  }
}

PicturePointer Picture::image(const std::string& layer, const std::vector<std::string>& suffixes)
{
  const std::string file = this->Owner.find(this->camera(), layer, this->frame(), suffixes);
  if (file.empty())
  {
    return nullptr;
  }
  PicturePointer& known = this->Images[file];
  if (!known)
  {
    known = std::make_shared<PictureFile>(this->Owner.folder(), file, this->width(), this->height());
  }
  return known;
}

PicturePointer Picture::values(const std::string& layer)
{
  return this->image(layer, { ".npy", ".dgd", ".exr", ".pfm", ".flo" });
}

PicturePointer Picture::ids(const std::string& layer) { return this->image(layer, { ".npy", ".png", ".ppm" }); }

bool Picture::has(const std::string& layer) const
{
  return !this->Owner.suffixes(this->camera(), layer, this->frame()).empty();
}

bool Picture::agrees(const Claims& claims, const Hit& hit, int x, int y) const
{
  if (claims.objects && claims.objects->id(x, y) != hit.object)
  {
    return false;
  }
  if (claims.depth)
  {
    const double expected = this->sight(x, y).depthOf(hit, centreOf(x, y));
    const double found = claims.depth->at(x, y);
    if (found != expected &&
        !(std::isfinite(expected) &&
          std::abs(found - expected) <= claims.tolerance * this->eye().farness(expected) * std::abs(expected)))
    {
      return false;
    }
  }
  return (!claims.parts || claims.parts->id(x, y) == this->partId(hit)) &&
         (!claims.triangles || claims.triangles->id(x, y) == this->triangleId(hit));
}

std::uint32_t Picture::partId(const Hit& hit) const
{
  return hit.object == 0 ? noId : this->sight().instance(hit.object).model->partOf(hit.triangle);
}

std::uint32_t Picture::triangleId(const Hit& hit) const
{
  const std::uint32_t part = this->partId(hit);
  return part == noId ? noId : hit.triangle - this->sight().instance(hit.object).model->parts[part].firstTriangle;
}

std::vector<Hit> Picture::nearby(int x, int y) const
{
  constexpr int probes = 33;
  std::vector<Hit> hits[probes];
  std::vector<double> depths[probes];
  for (int i = 0; i < probes; ++i)
  {
    const double radius = i == 0 ? 0 : i <= 16 ? edgeReach : edgeReach / 4;
    const Eigen::Vector2d offset(std::cos(i * pi / 8), std::sin(i * pi / 8));
    this->sight(x, y).surfaces(centreOf(x, y) + radius * offset, hits[i], depths[i]);
  }
  // A surface that some probe misses has an edge here, and may or may not hide what is behind.
  const auto hasEdge = [&](const Hit& hit)
  {
    return std::any_of(std::begin(hits), std::end(hits),
      [&](const std::vector<Hit>& probe) { return std::find(probe.begin(), probe.end(), hit) == probe.end(); });
  };
  std::vector<Hit> found;
  const auto add = [&](const Hit& hit)
  {
    if (std::find(found.begin(), found.end(), hit) == found.end())
    {
      found.push_back(hit);
    }
  };
  for (int i = 0; i < probes; ++i)
  {
    double solid = infinite; // depth of the first surface without an edge
    for (std::size_t k = 0; k < hits[i].size() && depths[i][k] <= solid * (1 + wideDepthTolerance); ++k)
    {
      add(hits[i][k]);
      solid = std::isinf(solid) && !hasEdge(hits[i][k]) ? depths[i][k] : solid;
    }
    if (std::isinf(solid))
    {
      add({});
    }
  }
  return found;
}

bool Picture::findNearby(const Claims& claims, int x, int y, Hit& hit) const
{
  const std::vector<Hit> candidates = this->nearby(x, y);
  const auto found = std::find_if(
    candidates.begin(), candidates.end(), [&](const Hit& candidate) { return this->agrees(claims, candidate, x, y); });
  if (found != candidates.end())
  {
    hit = *found;
  }
  return found != candidates.end() || this->findCutOut(claims, x, y, hit);
}

bool Picture::findCutOut(const Claims& claims, int x, int y, Hit& hit) const
{
  const std::size_t objects = this->sight().state().instances.size();
  const std::size_t claimed = claims.objects ? claims.objects->id(x, y) : 0;
  for (std::size_t object = 1; object <= objects; ++object)
  {
    const Instance& instance = this->sight(x, y).instance(static_cast<std::uint32_t>(object));
    for (const Part& part : instance.model->parts)
    {
      const bool mayBe =
        (!claims.objects || object == claimed) && instance.visible && (*instance.materials)[part.material].cutOut;
      for (std::uint32_t i = 0; i < (mayBe ? part.triangles : 0); ++i)
      {
        const Hit candidate{ static_cast<std::uint32_t>(object), part.firstTriangle + i };
        if (this->isOnEdge(candidate, x, y) && this->agrees(claims, candidate, x, y))
        {
          hit = candidate;
          return true;
        }
      }
    }
  }
  return false;
}

bool Picture::isEdgeAt(int x, int y, double range) const
{
  const std::vector<Instance>& instances = this->sight(x, y).state().instances;
  for (std::uint32_t object = 1; object <= instances.size(); ++object)
  {
    const std::size_t triangles = instances[object - 1].visible ? instances[object - 1].model->triangles.size() : 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle)
    {
      const Hit hit{ object, triangle };
      if (std::abs(this->sight(x, y).rangeOf(hit, centreOf(x, y)) - range) <=
            wideDepthTolerance * this->eye().farness(range) * std::abs(range) &&
          this->endsAt(hit, x, y))
      {
        return true;
      }
    }
  }
  return false;
}

bool Picture::endsAt(const Hit& hit, int x, int y) const
{
  Eigen::Vector3d corner[3];
  Eigen::Vector2d p[3];
  this->sight(x, y).corners(hit, corner);
  for (int i = 0; i < 3; ++i)
  {
    if (!this->eye().project(corner[i], p[i]))
    {
      return false;
    }
  }
  double nearest = infinite;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector2d edge = p[(i + 1) % 3] - p[i];
    const Eigen::Vector2d from = centreOf(x, y) - p[i];
    const double along = std::clamp(from.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (from - along * edge).norm());
  }
  return nearest <= edgeReach;
}

bool Picture::isOnEdge(const Hit& hit, int x, int y) const
{
  if (!this->endsAt(hit, x, y))
  {
    return false;
  }
  std::vector<Hit> hits;
  std::vector<double> depths;
  this->sight(x, y).surfaces(centreOf(x, y), hits, depths);
  const double before = depths.empty() ? infinite : depths.front();
  return this->sight(x, y).rangeOf(hit, centreOf(x, y)) <= before * (1 + wideDepthTolerance);
}

void Picture::resolveRow(const Claims& claims, int y, int& patience)
{
  Surfaces& s = *this->TheSurfaces;
  Claims close = claims;
  close.tolerance = claims.tolerance == wideDepthTolerance ? closeDepth : claims.tolerance;
  for (int x = 0; x < s.width; ++x)
  {
    const std::size_t i = s.index(x, y);
    if (this->agrees(close, s.own[i], x, y))
    {
      continue;
    }
    const bool own = this->agrees(claims, s.own[i], x, y);
    if (patience > 0 &&
        (this->findNearby(close, x, y, s.hits[i]) || (!own && this->findNearby(claims, x, y, s.hits[i]))))
    {
      s.marks[i] = Mark::Edge;
      continue;
    }
    s.marks[i] = own ? Mark::Same : Mark::Wrong;
    --patience;
  }
}

std::vector<Hit> Picture::ownHits() const
{
  VisibilityBuffer buffer;
  const std::unique_ptr<VisibilitySource> rays = makeRaySource(this->pool(), false);
  if (!this->Time->rolls())
  {
    rays->setScene(this->sight().statePointer(), this->eye().view());
    rays->render({ 0, 0, this->width(), this->height() }, buffer);
    return std::move(buffer.hits);
  }
  std::vector<Hit> hits(this->Sights.size());
  std::map<const Sight*, std::vector<std::size_t>> pixels;
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    pixels[this->Sights[i].get()].push_back(i);
  }
  const auto width = static_cast<std::size_t>(this->width());
  for (const auto& [sight, of] : pixels)
  {
    rays->setScene(sight->statePointer(), sight->eye().view());
    for (std::size_t first = 0; first < of.size();)
    {
      std::size_t end = first + 1;
      while (end < of.size() && of[end] == of[end - 1] + 1 && of[end] % width != 0)
      {
        ++end;
      }
      const int x = static_cast<int>(of[first] % width);
      const int y = static_cast<int>(of[first] / width);
      rays->render({ x, y, static_cast<int>(end - first), 1 }, buffer);
      std::copy(buffer.hits.begin(), buffer.hits.end(), hits.begin() + static_cast<std::ptrdiff_t>(of[first]));
      first = end;
    }
  }
  return hits;
}

const Surfaces& Picture::surfaces()
{
  if (this->TheSurfaces)
  {
    return *this->TheSurfaces;
  }
  this->TheSurfaces = std::make_unique<Surfaces>();
  Surfaces& s = *this->TheSurfaces;
  s.width = this->width();
  s.own = this->ownHits();
  s.hits = s.own;
  s.marks.assign(s.own.size(), Mark::Same);
  Claims claims;
  claims.depth = this->quietly([&] { return this->values("depth"); });
  claims.tolerance = claims.depth ? depthTolerance(*claims.depth) : wideDepthTolerance;
  claims.objects = this->quietly([&] { return this->ids("objects"); });
  claims.parts = this->quietly([&] { return this->ids("parts"); });
  claims.triangles = this->quietly([&] { return this->ids("triangles"); });
  this->pool().parallelFor((this->height() + chunkRows - 1) / chunkRows,
    [&](int chunk)
    {
      int patience = static_cast<int>(usualPatience);
      for (int y = chunk * chunkRows; y < std::min(this->height(), (chunk + 1) * chunkRows); ++y)
      {
        this->resolveRow(claims, y, patience);
      }
    });
  return s;
}

void Picture::preparePoints()
{
  this->surfaces();
  this->Depth = this->quietly([&] { return this->values("depth"); });
  if (this->Depth && this->Depth->type() != PixelType::Float64)
  {
    this->Depth = nullptr;
  }
}

Eigen::Vector3d Picture::point(int x, int y) const
{
  const std::size_t i = this->TheSurfaces->index(x, y);
  const double depth = this->Depth && this->TheSurfaces->marks[i] != Mark::Wrong
                         ? this->Depth->at(x, y)
                         : this->sight(x, y).depthOf(this->TheSurfaces->hits[i], centreOf(x, y));
  return this->sight(x, y).eye().at(centreOf(x, y), depth);
}

} // namespace dgtk
