// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdgeMarks.h"

#include <algorithm>

namespace dgtk
{

SmallPolygon<Vector3> clipped(const SmallPolygon<Vector3>& polygon, double side, double limit)
{
  SmallPolygon<Vector3> kept;
  for (int i = 0; i < polygon.count; ++i)
  {
    const Vector3& a = polygon[i];
    const Vector3& b = polygon[(i + 1) % polygon.count];
    const double da = side * (a.z - limit);
    const double db = side * (b.z - limit);
    if (da >= 0)
    {
      kept.add(a);
    }
    if ((da >= 0) != (db >= 0))
    {
      const double t = da / (da - db);
      kept.add({ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), limit });
    }
  }
  return kept;
}

PixelMarks::PixelMarks(const PixelRect& rect)
  : Rect(rect)
  , Marks(std::size_t(rect.width) * std::size_t(rect.height))
{
}

PixelMarks::Range PixelMarks::centresBetween(double low, double high, int first, int count)
{
  const double least = std::max(std::ceil(low - 0.5), double(first));
  const double most = std::min(std::floor(high - 0.5), double(first) + count - 1);
  return least <= most ? Range{ int(least), int(most) } : Range{ 0, -1 };
}

void PixelMarks::markSegment(ImagePoint a, ImagePoint b, double reach)
{
  // Steps go along the axis that changes more, so that a centre near the segment is near it across that axis, too.
  const bool steep = std::abs(b.y - a.y) >= std::abs(b.x - a.x);
  const auto along = [steep](const ImagePoint& p) { return steep ? p.y : p.x; };
  const auto across = [steep](const ImagePoint& p) { return steep ? p.x : p.y; };
  if (along(a) > along(b))
  {
    std::swap(a, b);
  }
  const double length = along(b) - along(a);
  const Range steps = steep ? centresBetween(along(a) - reach, along(b) + reach, this->Rect.y, this->Rect.height)
                            : centresBetween(along(a) - reach, along(b) + reach, this->Rect.x, this->Rect.width);
  for (int step = steps.first; step <= steps.last; ++step)
  {
    const double t = length > 0 ? std::clamp((step + 0.5 - along(a)) / length, 0.0, 1.0) : 0.0;
    const double at = across(a) + t * (across(b) - across(a));
    const double wide = 1.5 * reach; // more than sqrt(2): slopes are at most 1
    const Range sides = steep ? centresBetween(at - wide, at + wide, this->Rect.x, this->Rect.width)
                              : centresBetween(at - wide, at + wide, this->Rect.y, this->Rect.height);
    for (int side = sides.first; side <= sides.last; ++side)
    {
      steep ? this->mark(side, step) : this->mark(step, side);
    }
  }
}

PixelMarks::Rows PixelMarks::rowsOf(const SmallPolygon<ImagePoint>& polygon, double reach) const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < polygon.count; ++i)
  {
    low = std::min(low, polygon[i].y);
    high = std::max(high, polygon[i].y);
  }
  return centresBetween(low - reach, high + reach, this->Rect.y, this->Rect.height);
}

PixelMarks::Columns PixelMarks::columnsOf(const SmallPolygon<ImagePoint>& polygon, int row, double reach) const
{
  const double top = row + 0.5 - reach;
  const double bottom = row + 0.5 + reach;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto add = [&](double x)
  {
    low = std::min(low, x);
    high = std::max(high, x);
  };
  for (int i = 0; i < polygon.count; ++i)
  {
    const ImagePoint& a = polygon[i];
    const ImagePoint& b = polygon[(i + 1) % polygon.count];
    if (a.y >= top && a.y <= bottom)
    {
      add(a.x);
    }
    for (const double y : { top, bottom })
    {
      if ((a.y < y) != (b.y < y))
      {
        add(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
  }
  return centresBetween(low - reach, high + reach, this->Rect.x, this->Rect.width);
}

void PixelMarks::pack()
{
  this->Lists.assign(std::size_t(this->Rect.height), {});
  for (std::size_t i = 0; i < this->Marks.size(); ++i)
  {
    if (this->Marks[i])
    {
      this->Lists[i / std::size_t(this->Rect.width)].push_back(this->Rect.x + int(i % std::size_t(this->Rect.width)));
    }
  }
}

} // namespace dgtk
