// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int objectEdge = 255;
constexpr int depthEdge = 128;
/// Part of the smaller depth by which neighbours of one surface lie off each other's tangent planes.
constexpr double depthStep = 0.01;
/// Part of the depth: as close to the step, either side is right.
constexpr double stepSlack = 1e-9;

class EdgeCheck
{
public:
  EdgeCheck(Picture& picture, const PictureFile& file)
    : Owner(picture)
    , File(file)
    , Seen(picture.surfaces())
  {
  }

  void pixel(int x, int y, Meter& meter) const
  {
    int expected = 0;
    bool close = false;
    constexpr int step[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    for (const auto& [dx, dy] : step)
    {
      if (x + dx >= 0 && y + dy >= 0 && x + dx < this->File.width() && y + dy < this->File.height())
      {
        expected = std::max(expected, this->between(x, y, x + dx, y + dy, close));
      }
    }
    const int found = static_cast<int>(this->File.at(x, y));
    if (found != expected && (close || this->isOpen(x, y, meter)))
    {
      meter.skip();
      return;
    }
    meter.equal(
      found == expected, [&] { return this->File.offender(x, y, std::to_string(found), std::to_string(expected)); });
  }

private:
  const Hit& hit(int x, int y) const { return this->Seen.hits[this->Seen.index(x, y)]; }

  /// How far a point lies off the plane of the triangle that a pixel shows.
  double off(int x, int y, const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d normal = this->Owner.sight(x, y).normal(this->hit(x, y)).stableNormalized();
    return std::abs(normal.dot(point - this->Owner.point(x, y)));
  }

  int between(int x, int y, int i, int j, bool& close) const
  {
    if (this->hit(x, y).object != this->hit(i, j).object)
    {
      return objectEdge;
    }
    if (this->hit(x, y).object == 0)
    {
      return 0;
    }
    const Eigen::Vector3d a = this->Owner.point(x, y);
    const Eigen::Vector3d b = this->Owner.point(i, j);
    const Eye& eye = this->Owner.eye();
    const double depth = std::min(eye.range(centreOf(x, y), a), eye.range(centreOf(i, j), b)); // of a lens, distance
    const double least = std::min(this->off(x, y, b), this->off(i, j, a));
    close = close || std::abs(least - depthStep * depth) <= stepSlack * depth;
    return least > depthStep * depth ? depthEdge : 0;
  }

  /// Where no other file says which surface is meant, any within EdgeReach is right, of a neighbour, too.
  bool isOpen(int x, int y, const Meter& meter) const
  {
    if (meter.Bad >= usualPatience || this->Owner.has("triangles"))
    {
      return false;
    }
    for (const auto& [i, j] : { std::pair(x, y), { x + 1, y }, { x - 1, y }, { x, y + 1 }, { x, y - 1 } })
    {
      if (this->Owner.nearby(i, j).size() > 1)
      {
        return true;
      }
    }
    return false;
  }

  Picture& Owner;
  const PictureFile& File;
  const Surfaces& Seen;
};
} // namespace

void checkEdges(Picture& picture, Results& results)
{
  for (const char* suffix : { ".npy", ".png" })
  {
    const PicturePointer file = picture.image("edges", { suffix });
    if (!file)
    {
      continue;
    }
    picture.preparePoints();
    const EdgeCheck check(picture, *file);
    const Meter meter = meterRows(picture.pool(), picture.height(), 0,
      [&](int y, Meter& row)
      {
        for (int x = 0; x < picture.width(); ++x)
        {
          check.pixel(x, y, row);
        }
      });
    results.add({ "edges", "", { file->file() } }, meter);
  }
}

} // namespace dgtk
