// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEdgeMarks_h
#define dgtkEdgeMarks_h

// Private to Visibility.

#include "dgtkTriangleSolver.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace dgtk
{

/// Image points in pixels.
struct ImagePoint
{
  double x, y;
};

/// A convex polygon: a triangle between two planes has at most five corners.
template <typename Point>
struct SmallPolygon
{
  std::array<Point, 6> corners;
  int count = 0;
  void add(const Point& point) { this->corners[std::size_t(this->count++)] = point; }
  const Point& operator[](int i) const { return this->corners[std::size_t(i)]; }
};

/// What is left of a polygon in the camera frame where side * z >= side * limit; side 1 or -1.
SmallPolygon<Vector3> clipped(const SmallPolygon<Vector3>& polygon, double side, double limit);

/// Set of pixels of a rectangle of an image.
class PixelMarks
{
public:
  explicit PixelMarks(const PixelRect& rect);

  /// Marks the pixels whose centres lie within `reach` of a segment, and perhaps some a little farther away.
  void markSegment(ImagePoint a, ImagePoint b, double reach);
  /// Calls body(x, y) with the pixels, in the image, whose centres lie in a polygon or within `reach` of it, and
  /// perhaps some a little farther away.
  template <typename Body>
  void forPixels(const SmallPolygon<ImagePoint>& polygon, double reach, const Body& body) const
  {
    const Rows rows = this->rowsOf(polygon, reach);
    for (int y = rows.first; y <= rows.last; ++y)
    {
      const Columns columns = this->columnsOf(polygon, y, reach);
      for (int x = columns.first; x <= columns.last; ++x)
      {
        body(x, y);
      }
    }
  }
  /// The same of marked pixels only, by way of the lists of pack().
  template <typename Body>
  void forMarked(const SmallPolygon<ImagePoint>& polygon, double reach, const Body& body) const
  {
    const Rows rows = this->rowsOf(polygon, reach);
    for (int y = rows.first; y <= rows.last; ++y)
    {
      const std::vector<int>& list = this->Lists[std::size_t(y - this->Rect.y)];
      if (list.empty())
      {
        continue;
      }
      const Columns columns = this->columnsOf(polygon, y, reach);
      for (auto x = std::lower_bound(list.begin(), list.end(), columns.first); x != list.end() && *x <= columns.last;
           ++x)
      {
        body(*x, y);
      }
    }
  }
  void mark(int x, int y) { this->Marks[this->index(x, y)] = 1; }
  bool isMarked(int x, int y) const { return this->Marks[this->index(x, y)] != 0; }
  std::size_t index(int x, int y) const
  {
    return std::size_t(y - this->Rect.y) * std::size_t(this->Rect.width) + std::size_t(x - this->Rect.x);
  }
  /// Makes the lists of marked pixels.
  void pack();

private:
  /// Both ends included; none when first > last.
  struct Range
  {
    int first, last;
  };
  using Rows = Range;
  using Columns = Range;
  Rows rowsOf(const SmallPolygon<ImagePoint>& polygon, double reach) const;
  Columns columnsOf(const SmallPolygon<ImagePoint>& polygon, int row, double reach) const;
  /// Pixels of a row or column whose centres lie between two image coordinates.
  static Range centresBetween(double low, double high, int first, int count);

  PixelRect Rect;
  std::vector<std::uint8_t> Marks;
  std::vector<std::vector<int>> Lists; ///< columns of the marked pixels of each row
};

} // namespace dgtk

#endif
