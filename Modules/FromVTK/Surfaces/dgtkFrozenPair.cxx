// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrozenPair.h"

#include "dgtkCorrespondence.h"
#include "dgtkError.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkTracedView.h"

#include <Eigen/Geometry>
#include <vtkActor.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace dgtk
{

namespace
{
constexpr int blockRows = 16;
constexpr double roundingOfPlaces = 1e-9; ///< barycentric, of points on the edge of a cut

/// Barycentric coordinates of the second and third corner of a point in the plane of a triangle.
Eigen::Vector2d placeIn(const Model& model, std::uint32_t triangle, const Eigen::Vector3d& point)
{
  const auto& corners = model.triangles[triangle];
  const std::vector<Eigen::Vector3d>& p = model.rest->positions;
  const Eigen::Vector3d ab = p[corners[1]] - p[corners[0]];
  const Eigen::Vector3d ac = p[corners[2]] - p[corners[0]];
  const Eigen::Vector3d normal = ab.cross(ac);
  const Eigen::Vector3d inside = point - p[corners[0]];
  const double area = normal.squaredNorm();
  return { inside.cross(ac).dot(normal) / area, ab.cross(inside).dot(normal) / area };
}

Eigen::Vector3d pointOf(const Model& model, std::uint32_t triangle, const Eigen::Vector2d& place)
{
  const auto& corners = model.triangles[triangle];
  const std::vector<Eigen::Vector3d>& p = model.rest->positions;
  const Eigen::Vector3d& first = p[corners[0]];
  return first + place.x() * (p[corners[1]] - first) + place.y() * (p[corners[2]] - first);
}

/// A triangle's number among all of a surface, also those that were left out.
std::uint32_t numberOf(const SurfaceModel& one, std::uint32_t triangle)
{
  std::size_t before = 0; // how many of one's left out come before it
  for (std::size_t end = one.leftOut.size(); before < end;)
  {
    const std::size_t middle = (before + end) / 2;
    if (one.leftOut[middle] - middle <= triangle) // so many triangles are before that one
    {
      before = middle + 1;
    }
    else
    {
      end = middle;
    }
  }
  return std::uint32_t(triangle + before);
}

/// The triangle of another surface of the same cells: points that move may meet, and the triangle is left out.
std::optional<std::uint32_t> triangleOf(const SurfaceModel& other, std::uint32_t number)
{
  const auto after = std::lower_bound(other.leftOut.begin(), other.leftOut.end(), number);
  return after != other.leftOut.end() && *after == number
           ? std::nullopt
           : std::optional(number - std::uint32_t(after - other.leftOut.begin()));
}

/// How the polygon of a triangle was cut; null: as a fan.
const PolygonCut* cutOf(const SurfaceModel& surface, std::uint32_t number)
{
  const auto after = std::upper_bound(surface.cuts.begin(), surface.cuts.end(), number,
    [](std::uint32_t wanted, const PolygonCut& cut) { return wanted < cut.first; });
  const bool found =
    after != surface.cuts.begin() && number - std::prev(after)->first < std::prev(after)->triangles.size();
  return found ? &*std::prev(after) : nullptr;
}

struct Surface
{
  std::uint32_t triangle;
  Eigen::Vector2d place; ///< barycentric coordinates of the second and third corner
};

std::optional<Surface> placed(const std::optional<std::uint32_t>& triangle, const Eigen::Vector2d& place)
{
  return triangle ? std::optional(Surface{ *triangle, place }) : std::nullopt;
}

/// Which of some triangles has a point.
class PlaceFinder
{
public:
  PlaceFinder(const Model& model, const Eigen::Vector3d& wanted)
    : In(model)
    , Wanted(wanted)
  {
  }

  void look(std::uint32_t triangle)
  {
    const Eigen::Vector2d place = placeIn(this->In, triangle, this->Wanted);
    const double inside = std::min(place.minCoeff(), 1 - place.sum());
    if (inside >= this->Best)
    {
      this->Best = inside;
      this->Found = { triangle, place };
    }
  }

  std::optional<Surface> Found;

private:
  const Model& In;
  Eigen::Vector3d Wanted;
  double Best = -roundingOfPlaces;
};

/// A point of a polygon in another surface of the same cells, which may have cut it otherwise: it keeps its place among
/// the corners of its own triangle.
class Polygon
{
public:
  Polygon(const SurfaceModel& one, const SurfaceModel& other, std::uint32_t number)
    : One(one)
    , Other(other)
    , Number(number)
  {
    const PolygonCut* const mine = cutOf(one, number);
    const PolygonCut* const others = cutOf(other, number);
    this->IsSame = mine == others || (mine && others && mine->triangles == others->triangles);
    const PolygonCut* const any = mine != nullptr ? mine : others;
    this->First = any != nullptr ? any->first : number;
    this->End = any != nullptr ? any->first + std::uint32_t(any->triangles.size()) : number + 1;
  }

  std::optional<Surface> follow(const Eigen::Vector2d& place) const
  {
    if (this->IsSame)
    {
      return placed(triangleOf(this->Other, this->Number), place);
    }
    const Model& model = *this->Other.model;
    std::optional<Eigen::Vector3d> moved[3];
    this->forOthers(
      [&](std::uint32_t number, std::uint32_t triangle)
      {
        const auto mine = this->corners(this->One, this->Number);
        const auto others = this->corners(this->Other, number);
        for (int i = 0; i < 9; ++i)
        {
          if (mine[std::size_t(i / 3)] == others[std::size_t(i % 3)])
          {
            moved[i / 3] = model.rest->positions[model.triangles[triangle][std::size_t(i % 3)]];
          }
        }
      });
    if (!moved[0] || !moved[1] || !moved[2])
    {
      return std::nullopt;
    }
    PlaceFinder finder(model, *moved[0] + place.x() * (*moved[1] - *moved[0]) + place.y() * (*moved[2] - *moved[0]));
    this->forOthers([&](std::uint32_t, std::uint32_t triangle) { finder.look(triangle); });
    return finder.Found;
  }

private:
  template <class Look>
  void forOthers(const Look& look) const
  {
    for (std::uint32_t number = this->First; number < this->End; ++number)
    {
      if (const std::optional<std::uint32_t> triangle = triangleOf(this->Other, number))
      {
        look(number, *triangle);
      }
    }
  }

  std::array<std::uint32_t, 3> corners(const SurfaceModel& surface, std::uint32_t number) const
  {
    const PolygonCut* const cut = cutOf(surface, number);
    const std::uint32_t k = number - this->First;
    return cut != nullptr ? cut->triangles[number - cut->first] : std::array<std::uint32_t, 3>{ 0, k + 1, k + 2 };
  }

  const SurfaceModel& One;
  const SurfaceModel& Other;
  std::uint32_t Number;
  bool IsSame;
  std::uint32_t First; ///< number of the polygon's first triangle
  std::uint32_t End;
};

/// Whether the triangles of two surfaces are of the same cells; glyphs may be copies in one of them.
bool haveSameCells(const SurfaceModel& one, const SurfaceModel& other)
{
  if (!one.copies && !other.copies)
  {
    if (one.leftOut == other.leftOut)
    {
      return one.cells == other.cells;
    }
    bool same = one.cells.size() + one.leftOut.size() == other.cells.size() + other.leftOut.size();
    for (std::uint32_t triangle = 0; same && triangle < one.cells.size(); ++triangle)
    {
      const std::optional<std::uint32_t> there = triangleOf(other, numberOf(one, triangle));
      same = !there || one.cells[triangle] == other.cells[*there];
    }
    return same;
  }
  if (one.copies && other.copies)
  {
    return one.cells == other.cells &&
           std::equal(one.copies->begin(), one.copies->end(), other.copies->begin(),
             [](const ModelCopy& a, const ModelCopy& b) { return a.firstTriangle == b.firstTriangle; });
  }
  bool same = one.triangles() == other.triangles();
  for (std::uint64_t triangle = 0; same && triangle < one.triangles(); ++triangle)
  {
    same = one.cellOf(std::uint32_t(triangle)) == other.cellOf(std::uint32_t(triangle));
  }
  return same;
}

class Pair
{
public:
  Pair(const FrozenView& from, const FrozenView& to)
    : From(from)
    , To(to)
    , FromState(from.stage->at(0))
    , ToState(to.stage->at(0))
    , FromView(from.stage->view(0, 0))
    , ToView(to.stage->view(0, 0))
    , Hits(traceView(*from.stage, FromView))
  {
    this->match();
    this->Other = { this->ToState.get(), this->ToView, to.trees.get() };
  }

  void row(int y, double* pixels, std::uint8_t* classes) const
  {
    const int width = this->FromView.model->width();
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      const Correspondence found = this->follow({ x + 0.5, y + 0.5 }, this->Hits[i]);
      pixels[2 * i] = found.pixel.x();
      pixels[2 * i + 1] = found.pixel.y();
      classes[i] = static_cast<std::uint8_t>(found.visibility);
    }
  }

private:
  /// Which actor of the other view each of this one is.
  void match()
  {
    for (const FrozenActor& actor : this->From.actors)
    {
      const auto same = std::find_if(this->To.actors.begin(), this->To.actors.end(),
        [&actor](const FrozenActor& one)
        { return one.actor.Get() == actor.actor.Get() && one.occurrence == actor.occurrence; });
      const bool there = same != this->To.actors.end();
      if (there && same->whole != actor.whole && !haveSameCells(*same->whole, *actor.whole))
      {
        throw InputError("VTK scene", actor.name + " has other cells in the second view",
          "the same cells, whose points may move",
          std::to_string(same->whole->triangles()) + " triangles, not " + std::to_string(actor.whole->triangles()));
      }
      this->ObjectOf.push_back(there ? std::uint32_t(same - this->To.actors.begin()) + 1 : 0);
      this->HasSameCuts.push_back(there && same->whole->cuts == actor.whole->cuts);
    }
  }

  Correspondence follow(const Eigen::Vector2d& pixel, const Hit& hit) const
  {
    const std::uint32_t object = hit.object == 0 ? 0 : this->ObjectOf[this->From.actorOf(hit)];
    if (object == 0)
    {
      return {};
    }
    const FrozenActor& actor = this->From.actors[this->From.actorOf(hit)];
    const SurfacePoint at = surfacePointAt(*this->FromState, this->FromView, pixel, hit);
    Surface point{ actor.wholeTriangle(hit), at.barycentrics };
    if (!actor.parents.empty())
    {
      point.place = placeIn(*actor.whole->model, point.triangle, pointOf(*actor.model, hit.triangle, at.barycentrics));
    }
    const FrozenActor& other = this->To.actors[object - 1];
    if (!other.whole->copies && !actor.whole->copies)
    {
      const std::uint32_t number = numberOf(*actor.whole, point.triangle);
      const std::optional<Surface> there = this->HasSameCuts[this->From.actorOf(hit)]
                                             ? placed(triangleOf(*other.whole, number), point.place)
                                             : Polygon(*actor.whole, *other.whole, number).follow(point.place);
      if (!there)
      {
        return {};
      }
      point = *there;
    }
    if (!other.parents.empty() && !findShown(other, point))
    {
      return {};
    }
    Hit there{ object, point.triangle };
    if (other.whole->copies)
    {
      const std::size_t copy = other.whole->copyOf(point.triangle);
      there.object = other.firstCopy + std::uint32_t(copy);
      there.triangle -= (*other.whole->copies)[copy].firstTriangle;
    }
    return correspond(this->Other, there, point.place);
  }

  /// The piece of a triangle of the whole that has its point; false where that is not shown.
  static bool findShown(const FrozenActor& actor, Surface& point)
  {
    PlaceFinder finder(*actor.model, pointOf(*actor.whole->model, point.triangle, point.place));
    const auto pieces = std::equal_range(actor.parents.begin(), actor.parents.end(), point.triangle);
    for (auto piece = pieces.first; piece != pieces.second; ++piece)
    {
      finder.look(std::uint32_t(piece - actor.parents.begin()));
    }
    point = finder.Found.value_or(point);
    return finder.Found.has_value();
  }

  const FrozenView& From;
  const FrozenView& To;
  std::shared_ptr<const SceneState> FromState;
  std::shared_ptr<const SceneState> ToState;
  View FromView;
  View ToView;
  std::vector<Hit> Hits;
  std::vector<std::uint32_t> ObjectOf; ///< in the other view, by actor; 0: it is not there
  std::vector<bool> HasSameCuts;       ///< of polygons, by actor
  OtherView Other;
};
} // namespace

void correspondViews(const FrozenView& from, const FrozenView& to, double* pixels, std::uint8_t* classes)
{
  const Pair pair(from, to);
  const int height = from.stage->view(0, 0).model->height();
  ThreadPool pool(machineThreads());
  pool.parallelFor((height + blockRows - 1) / blockRows,
    [&](int block)
    {
      for (int y = block * blockRows; y < std::min(height, (block + 1) * blockRows); ++y)
      {
        pair.row(y, pixels, classes);
      }
    });
}

} // namespace dgtk
