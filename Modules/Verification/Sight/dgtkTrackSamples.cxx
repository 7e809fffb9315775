// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTrackSamples.h"

#include "dgtkPicture.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Pixels: a point is at the centre of the pixel that it was sampled at.
constexpr double centreSlack = 1e-8;
/// Pixels: as close to half a step, a point takes a pixel or does not.
constexpr double reachSlack = 1e-6;
/// Part of the depth within which a surface coincides with the nearest one.
constexpr double coincident = 1e-9;
constexpr int directions = 16;
constexpr double mostPixels = 1e9;

class TrackSampleCheck
{
public:
  TrackSampleCheck(const TrackView& view, const std::vector<TrackOrigin>& points, int step)
    : TheView(view)
    , Points(points)
    , Step(step)
  {
    const Eye& eye = view.sight->middle()->eye();
    for (int x = step / 2; x < eye.width(); x += step)
    {
      ++this->Columns;
    }
    for (int y = step / 2; y < eye.height(); y += step)
    {
      ++this->Rows;
    }
    const std::size_t cells = std::size_t(this->Columns) * std::size_t(this->Rows);
    this->Own.assign(cells, -1);
    this->Nearest.assign(cells, infinite);
  }

  int rows() const { return this->Rows; }

  /// Where the view's own points and the earlier ones are.
  void place(Meter& meter)
  {
    int last = -1;
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      const TrackPlace& place = this->TheView.places[i];
      if (this->Points[i].view == this->TheView.index)
      {
        const int cell = this->cellOf(place);
        meter.equal(cell > last && place.visibility == trackVisible,
          [&]
          {
            return this->offender(i,
              cell < 0 ? "not at a pixel of the grid" : "out of order, twice at a pixel, or not visible",
              "visible at the next of the grid's pixels that show a new surface");
          });
        last = cell;
        if (cell >= 0)
        {
          this->Own[std::size_t(cell)] = static_cast<std::ptrdiff_t>(i);
        }
      }
      else if (this->Points[i].view < this->TheView.index && place.visibility == trackVisible)
      {
        this->take(place);
      }
    }
  }

  void row(int row, Meter& meter) const
  {
    for (int column = 0; column < this->Columns; ++column)
    {
      if (!this->TheView.sight->rolls() || (column + 3 * row) % trackInstantStep == 0)
      {
        this->pixel(column, row, meter);
      }
    }
  }

private:
  Eigen::Vector2d centre(int column, int row) const
  {
    return { this->Step / 2 + column * this->Step + 0.5, this->Step / 2 + row * this->Step + 0.5 };
  }

  /// -1 for a place that is not the centre of a pixel of the grid.
  int cellOf(const TrackPlace& place) const
  {
    const double column = std::round((place.u - 0.5 - this->Step / 2) / this->Step);
    const double row = std::round((place.v - 0.5 - this->Step / 2) / this->Step);
    if (!(column >= 0 && row >= 0 && column < this->Columns && row < this->Rows))
    {
      return -1;
    }
    const Eigen::Vector2d centre = this->centre(int(column), int(row));
    const bool there = (centre - Eigen::Vector2d(place.u, place.v)).cwiseAbs().maxCoeff() <= centreSlack;
    return there ? int(row) * this->Columns + int(column) : -1;
  }

  void take(const TrackPlace& place)
  {
    if (!(std::abs(place.u) < mostPixels && std::abs(place.v) < mostPixels)) // wrong numbers are far from all
    {
      return;
    }
    const int column = int(std::floor(place.u / this->Step));
    const int row = int(std::floor(place.v / this->Step));
    for (int y = std::max(0, row - 1); y <= std::min(row + 1, this->Rows - 1); ++y)
    {
      for (int x = std::max(0, column - 1); x <= std::min(column + 1, this->Columns - 1); ++x)
      {
        double& nearest = this->Nearest[std::size_t(y) * std::size_t(this->Columns) + std::size_t(x)];
        nearest = std::min(nearest, (this->centre(x, y) - Eigen::Vector2d(place.u, place.v)).norm());
      }
    }
  }

  void pixel(int column, int row, Meter& meter) const
  {
    const std::size_t cell = std::size_t(row) * std::size_t(this->Columns) + std::size_t(column);
    const std::ptrdiff_t own = this->Own[cell];
    const double beyond = this->Nearest[cell] - 0.5 * this->Step;
    if (std::abs(beyond) <= reachSlack)
    {
      meter.skip();
      return;
    }
    const auto measure = [&](bool right, const char* found, const char* expected)
    {
      meter.equal(right,
        [&]
        {
          const Eigen::Vector2d at = this->centre(column, row);
          return Offender{ this->TheView.file, int(at.x()), int(at.y()), found, expected };
        });
    };
    if (beyond < 0)
    {
      measure(own < 0, "a new point", "none: an earlier one is visible beside it");
      return;
    }
    const Hit claimed = own < 0 ? Hit{} : this->Points[std::size_t(own)].hit;
    const bool right = this->shows(this->centre(column, row), claimed);
    if (!right && this->isOpen(this->centre(column, row), claimed))
    {
      meter.skip();
      return;
    }
    measure(right, own < 0 ? "no point" : "a point of another triangle", "one of the surface that the pixel shows");
  }

  /// Whether the first surface at an image point is this one, or coincides with it; object 0 for none.
  bool shows(const Eigen::Vector2d& pixel, const Hit& claimed) const
  {
    const TimedSight& timed = *this->TheView.sight;
    const std::shared_ptr<const Sight> sight = timed.rolls() ? timed.at(timed.timeAt(pixel)) : timed.middle();
    std::vector<Hit> hits;
    std::vector<double> ranges;
    sight->surfaces(pixel, hits, ranges);
    if (hits.empty() || claimed.object == 0)
    {
      return hits.empty() == (claimed.object == 0);
    }
    const double nearest = *std::min_element(ranges.begin(), ranges.end());
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      if (hits[i] == claimed && ranges[i] <= nearest * (1 + coincident))
      {
        return true;
      }
    }
    return false;
  }

  bool isOpen(const Eigen::Vector2d& pixel, const Hit& claimed) const
  {
    for (int i = 0; i < directions; ++i)
    {
      const double angle = 2 * pi * i / directions;
      if (this->shows(pixel + edgeReach * Eigen::Vector2d(std::cos(angle), std::sin(angle)), claimed))
      {
        return true;
      }
    }
    return false;
  }

  Offender offender(std::size_t index, const std::string& found, const std::string& expected) const
  {
    return { this->TheView.file, -1, -1, "point " + std::to_string(index) + ' ' + found, expected };
  }

  const TrackView& TheView;
  const std::vector<TrackOrigin>& Points;
  int Step;
  int Columns = 0;
  int Rows = 0;
  std::vector<std::ptrdiff_t> Own; ///< the view's own point at a pixel of the grid; -1: none
  std::vector<double> Nearest;     ///< distance of the earlier visible points, where it may be within half a step
};
} // namespace

Meter meterTrackSamples(Dataset& dataset, const TrackView& view, const std::vector<TrackOrigin>& points, int step)
{
  TrackSampleCheck check(view, points, step);
  Meter meter(0);
  check.place(meter);
  if (view.sampled)
  {
    meter.merge(meterRows(dataset.pool(), check.rows(), 0, [&](int row, Meter& part) { check.row(row, part); }));
    return meter;
  }
  const auto own =
    std::find_if(points.begin(), points.end(), [&](const TrackOrigin& point) { return point.view == view.index; });
  meter.equal(own == points.end(),
    [&]
    {
      return Offender{ view.file, -1, -1, "point " + std::to_string(own - points.begin()) + " sampled here",
        "none: the frame is not sampled" };
    });
  return meter;
}

} // namespace dgtk
