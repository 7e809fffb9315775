// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWideCanvas.h"

#include "dgtkSurfaceRows.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int bandRows = 16;
/// Part of a depth at near or far that is open.
constexpr double closeRange = 1e-6;
constexpr double eighth = 0.78539816339744831;
} // namespace

/// A triangle as functions of (x, y, 1) in pixels.
struct WideCanvas::Face
{
  std::uint32_t triangle = 0;
  Eigen::Vector3d sides[3]; ///< of one sign inside; the weights of the corners but for a factor
  Eigen::Vector3d above;    ///< above / below is the depth
  Eigen::Vector3d below;
  bool cutOut = false;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0; ///< pixels that it may cover, borders
};

/// Rows of the canvas.
struct WideCanvas::Band
{
  int y = 0;
  int rows = 0;
  int width = 0;             ///< of the picture
  std::vector<char> covered; ///< at the pixel's centre; 3 widths a row
  std::vector<char> close;   ///< an edge, near or far is close to the centre
  std::size_t at(int x, int row) const
  {
    return std::size_t(row - this->y) * std::size_t(3 * this->width) + std::size_t(x + this->width);
  }
};

template <typename Body>
void WideCanvas::forPixels(int y, int rows, const Body& body) const
{
  const int width = this->Owner.width();
  for (int row = y; row < y + rows; ++row)
  {
    const bool beside = row >= 0 && row < this->Owner.height();
    for (int x = -width; x < 2 * width; ++x)
    {
      if (beside && x == 0)
      {
        x = width;
      }
      body(x, row);
    }
  }
}

template <typename Find>
auto WideCanvas::ofBands(const Find& find) const
{
  const int height = 3 * this->Owner.height();
  std::vector<decltype(find(0, 0))> found(std::size_t((height + bandRows - 1) / bandRows));
  this->Owner.pool().parallelFor(int(found.size()),
    [&](int i)
    {
      const int y = i * bandRows;
      found[std::size_t(i)] = find(y - this->Owner.height(), std::min(bandRows, height - y));
    });
  return found;
}

WideCanvas::WideCanvas(Picture& picture)
  : Owner(picture)
  , Drawn(picture.eye().linear() && !picture.time().rolls())
{
  if (!this->Drawn)
  {
    this->findAlongRays();
  }
}

std::vector<WideCanvas::Face> WideCanvas::faces(std::uint32_t object) const
{
  const Eye& eye = this->Owner.eye();
  const double near = eye.record().near;
  const Eigen::Matrix3d pixelToRay = eye.record().K.inverse().transpose();
  const Instance& instance = this->Owner.sight().instance(object);
  std::vector<Face> faces;
  for (std::uint32_t t = 0; instance.visible && t < instance.model->triangles.size(); ++t)
  {
    Eigen::Vector3d corner[3];
    this->Owner.sight().corners({ object, t }, corner);
    const Eigen::Vector3d n = this->Owner.sight().normal({ object, t });
    Extent bounds;
    const auto bound = [&](const Eigen::Vector3d& x)
    {
      Eigen::Vector2d p;
      if (eye.project(x, p))
      {
        bounds.add(p.x(), p.y(), p.x(), p.y());
      }
    };
    Face face;
    face.triangle = t;
    face.cutOut = (*instance.materials)[instance.model->parts[instance.model->partOf(t)].material].cutOut;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d& a = corner[(i + 1) % 3];
      const Eigen::Vector3d& b = corner[(i + 2) % 3];
      const auto flat = [&](const Eigen::Vector3d& x) { return eye.pinhole() ? x : Eigen::Vector3d(x.x(), x.y(), 1); };
      face.sides[i] = pixelToRay * flat(a).cross(flat(b));
      if (a.z() >= near)
      {
        bound(a);
      }
      if ((a.z() >= near) != (b.z() >= near))
      {
        bound(a + (near - a.z()) / (b.z() - a.z()) * (b - a));
      }
    }
    const double plane = n.dot(corner[0]);
    face.above = eye.pinhole() ? Eigen::Vector3d(0, 0, plane) : pixelToRay * Eigen::Vector3d(-n.x(), -n.y(), plane);
    face.below = eye.pinhole() ? pixelToRay * n : Eigen::Vector3d(0, 0, n.z());
    const auto border = [](double at, int least, int most) { return int(std::clamp(at, double(least), double(most))); };
    face.x0 = border(std::floor(bounds.box[0]) - 1, -this->Owner.width(), 2 * this->Owner.width());
    face.x1 = border(std::ceil(bounds.box[2]) + 1, -this->Owner.width(), 2 * this->Owner.width());
    face.y0 = border(std::floor(bounds.box[1]) - 1, -this->Owner.height(), 2 * this->Owner.height());
    face.y1 = border(std::ceil(bounds.box[3]) + 1, -this->Owner.height(), 2 * this->Owner.height());
    if (!bounds.empty() && face.x0 < face.x1 && face.y0 < face.y1 && n.squaredNorm() > 0)
    {
      faces.push_back(face);
    }
  }
  return faces;
}

/// What a triangle covers of a band; the picture's own pixels, too.
void WideCanvas::draw(std::uint32_t object, const Face& face, Band& band) const
{
  const Instance& instance = this->Owner.sight().instance(object);
  const CameraRecord& record = this->Owner.eye().record();
  Eigen::Vector3d reach; // of the sides' functions
  for (int i = 0; i < 3; ++i)
  {
    reach[i] = edgeReach * face.sides[i].head<2>().norm();
  }
  for (int y = std::max(face.y0, band.y); y < std::min(face.y1, band.y + band.rows); ++y)
  {
    for (int x = face.x0; x < face.x1; ++x)
    {
      const Eigen::Vector3d p(x + 0.5, y + 0.5, 1);
      Eigen::Vector3d s(face.sides[0].dot(p), face.sides[1].dot(p), face.sides[2].dot(p));
      s *= s.sum() < 0 ? -1 : 1;
      if ((s + reach).minCoeff() < 0)
      {
        continue;
      }
      const double depth = face.above.dot(p) / face.below.dot(p);
      const bool ranged = depth >= record.near && depth <= record.far;
      const bool deep = depth >= record.near * (1 + closeRange) && depth <= record.far * (1 - closeRange);
      const std::size_t at = band.at(x, y);
      if (s.minCoeff() >= 0 && ranged &&
          !(face.cutOut && isCutOut(instance, face.triangle, Eigen::Vector2d(s[1], s[2]) / s.sum())))
      {
        band.covered[at] = 1;
      }
      if (face.cutOut || !((s - reach).minCoeff() > 0 && deep))
      {
        band.close[at] = 1;
      }
    }
  }
}

WideCanvas::Band WideCanvas::drawn(std::uint32_t object, const std::vector<Face>& faces, int y, int rows) const
{
  Band band;
  band.y = y;
  band.rows = rows;
  band.width = this->Owner.width();
  const auto pixels = static_cast<std::size_t>(band.rows) * static_cast<std::size_t>(3 * this->Owner.width());
  band.covered.assign(pixels, 0);
  band.close.assign(pixels, 0);
  for (const Face& face : faces)
  {
    this->draw(object, face, band);
  }
  return band;
}

bool WideCanvas::isMet(std::uint32_t object, const Eigen::Vector2d& pixel) const
{
  std::vector<Hit> hits;
  std::vector<double> ranges;
  this->sightAt(pixel).surfaces(pixel, hits, ranges);
  return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.object == object; });
}

Extent WideCanvas::around(std::uint32_t object) const
{
  if (!this->Drawn)
  {
    return this->Along[object - 1];
  }
  const std::vector<Face> faces = this->faces(object);
  Extent all;
  for (const Extent& part : this->ofBands(
         [&](int y, int rows)
         {
           Extent extent;
           if (std::none_of(
                 faces.begin(), faces.end(), [&](const Face& face) { return face.y0 < y + rows && face.y1 > y; }))
           {
             return extent;
           }
           const Band band = this->drawn(object, faces, y, rows);
           this->forPixels(y, rows,
             [&](int x, int row)
             {
               if (band.covered[band.at(x, row)] != 0)
               {
                 extent.addPixel(x, row);
               }
             });
           return extent;
         }))
  {
    all.add(part);
  }
  return all;
}

WideCanvas::Bounds WideCanvas::boundsAround(std::uint32_t object) const
{
  const std::vector<Face> faces = this->Drawn ? this->faces(object) : std::vector<Face>();
  Bounds all;
  for (const Bounds& part : this->ofBands(
         [&](int y, int rows)
         {
           const Band band = this->drawn(object, faces, y, rows);
           Bounds bounds;
           this->forPixels(y, rows,
             [&](int x, int row)
             {
               const Eigen::Vector2d centre = centreOf(x, row);
               const bool met = this->Drawn ? band.covered[band.at(x, row)] != 0 : this->isMet(object, centre);
               bool open = false;
               for (int i = 0; i < 8 && !open && (!this->Drawn || band.close[band.at(x, row)] != 0); ++i)
               {
                 const Eigen::Vector2d offset(std::cos(i * eighth), std::sin(i * eighth));
                 open = this->isMet(object, centre + edgeReach * offset) != met;
               }
               if (met && !open)
               {
                 bounds.least.addPixel(x, row);
               }
               if (met || open)
               {
                 bounds.most.addPixel(x, row);
               }
             });
           return bounds;
         }))
  {
    all.least.add(part.least);
    all.most.add(part.most);
  }
  return all;
}

const Sight& WideCanvas::sightAt(const Eigen::Vector2d& pixel) const
{
  const auto found = this->Sights.find(this->Owner.time().timeAt(pixel));
  return found == this->Sights.end() ? this->Owner.sight() : *found->second;
}

/// Of all objects at once. Pixels beyond a lens's domain have no ray, a table's end with the picture.
void WideCanvas::findAlongRays()
{
  const TimedSight& time = this->Owner.time();
  this->Along.resize(this->Owner.sight().state().instances.size());
  this->forPixels(-this->Owner.height(), time.rolls() ? 3 * this->Owner.height() : 0,
    [&](int x, int y)
    {
      if (this->Owner.eye().ray(centreOf(x, y)).exists())
      {
        const double at = time.timeAt(centreOf(x, y));
        std::shared_ptr<const Sight>& sight = this->Sights[at];
        sight = sight ? sight : time.at(at);
      }
    });
  const auto find = [&](int y, int rows)
  {
    std::vector<Extent> extents(this->Along.size());
    std::vector<std::uint64_t> seen(this->Along.size(), 0); // the pixel at which an object was met last
    std::uint64_t number = 0;
    std::vector<Hit> hits;
    std::vector<double> ranges;
    this->forPixels(y, rows,
      [&](int x, int row)
      {
        ++number;
        if (!this->Owner.eye().ray(centreOf(x, row)).exists())
        {
          return;
        }
        this->sightAt(centreOf(x, row)).surfaces(centreOf(x, row), hits, ranges);
        for (const Hit& hit : hits)
        {
          if (std::exchange(seen[hit.object - 1], number) != number)
          {
            extents[hit.object - 1].addPixel(x, row);
          }
        }
      });
    return extents;
  };
  for (const std::vector<Extent>& part : this->ofBands(find))
  {
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      this->Along[i].add(part[i]);
    }
  }
}

} // namespace dgtk
