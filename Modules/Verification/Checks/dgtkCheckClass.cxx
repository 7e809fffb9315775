// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Visibility classes of CONVENTIONS.
enum Class
{
  Nothing,
  Visible,
  OtherObject,
  OwnObject,
  Outside,
  Behind
};

/// Directions, and parts of the depth, that a ray may pass by a silhouette.
constexpr double silhouetteReach = 1e-4;
/// Part of the depth within which a surface is the point's own: the rounding of its place.
constexpr double surfaceSlack = 1e-9;
/// Pixels: as near to the image's border, inside and outside are a matter of rounding.
constexpr double borderSlack = 1e-6;
/// Of a rolling shutter one of so many pixels is looked at.
constexpr int instantStep = 8;

class ClassCheck
{
public:
  ClassCheck(Picture& picture, const Pair& pair, const PictureFile& file)
    : Owner(picture)
    , ThePair(pair)
    , File(file)
    , Targets(picture, pair)
  {
  }

  void pixel(int x, int y, Meter& meter) const
  {
    // A scene of its own for each pixel takes its time.
    if (this->ThePair.timed->rolls() && (x + 3 * y) % instantStep != 0)
    {
      return;
    }
    const int found = static_cast<int>(this->File.at(x, y));
    const Hit& hit = this->Targets.hit(x, y);
    const Target target = this->Targets.at(x, y);
    const std::shared_ptr<const Sight> other =
      this->ThePair.timed->rolls() ? this->ThePair.timed->at(target.time) : this->ThePair.other;
    const int expected = classOf(*other, target, hit, target.pixel, surfaceSlack);
    if (found == expected)
    {
      meter.good();
      return;
    }
    if (meter.Bad < usualPatience && this->isOpen(*other, x, y, target, hit, found))
    {
      meter.skip();
      return;
    }
    meter.equal(false, [&] { return this->File.offender(x, y, std::to_string(found), std::to_string(expected)); });
  }

private:
  /// By the ray through `pixel`, on which the point has the same depth as on its own.
  int classOf(
    const Sight& other, const Target& target, const Hit& hit, const Eigen::Vector2d& pixel, double slack) const
  {
    // What a rolling shutter sees at no time has no time at which it might be visible.
    const bool never = !target.projects && this->ThePair.timed->rolls();
    if (!target.surface || (!never && !other.instance(hit.object).visible))
    {
      return Nothing;
    }
    if (!target.projects)
    {
      return Behind;
    }
    if (!other.eye().sees(target.pixel, target.there))
    {
      return Outside;
    }
    std::vector<Hit> hits;
    std::vector<double> ranges;
    other.surfaces(pixel, hits, ranges);
    const double own = other.eye().range(target.pixel, target.there);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      if (hits[i] != hit && ranges[i] / own < 1 - slack)
      {
        return hits[i].object == hit.object ? OwnObject : OtherObject;
      }
    }
    return Visible;
  }

  /// Whether another class is as right: beside a silhouette, an edge, the border or the limits of depth.
  bool isOpen(const Sight& other, int x, int y, const Target& target, const Hit& hit, int found) const
  {
    if (!target.surface || !target.ok)
    {
      return !target.ok && target.surface;
    }
    if (std::abs(target.there.z()) <= surfaceSlack * target.here.norm())
    {
      return true;
    }
    if (target.projects && isAtLimit(other.eye(), target))
    {
      return true;
    }
    if (!target.projects || found == Nothing || found == Outside || found == Behind)
    {
      return false;
    }
    if (classOf(other, target, hit, target.pixel, silhouetteReach) == found)
    {
      return true;
    }
    const Eigen::Vector2d reach = other.eye().reach(silhouetteReach, target.there);
    for (int i = 0; i < 32; ++i)
    {
      const Eigen::Vector2d direction(std::cos(i * pi / 8), std::sin(i * pi / 8));
      const Eigen::Vector2d pixel = target.pixel + (i < 16 ? 1.0 : 0.25) * reach.cwiseProduct(direction);
      if (classOf(other, target, hit, pixel, surfaceSlack) == found ||
          classOf(other, target, hit, pixel, silhouetteReach) == found)
      {
        return true;
      }
    }
    return this->isOtherSurface(other, x, y, hit, found);
  }

  /// Beside an edge the file may follow the neighbour of the same object and depth.
  bool isOtherSurface(const Sight& other, int x, int y, const Hit& hit, int found) const
  {
    const std::vector<Hit> nearby = this->Owner.nearby(x, y);
    return std::any_of(nearby.begin(), nearby.end(),
      [&](const Hit& near)
      {
        const Target target = near.object == hit.object ? this->Targets.at(x, y, near) : Target{};
        return target.ok && classOf(other, target, near, target.pixel, surfaceSlack) == found;
      });
  }

  static bool isAtLimit(const Eye& eye, const Target& target)
  {
    const auto near = [](double a, double b, double slack) { return std::abs(a - b) <= slack; };
    const double z = eye.range(target.pixel, target.there);
    return near(target.pixel.x(), 0, borderSlack) || near(target.pixel.x(), eye.width(), borderSlack) ||
           near(target.pixel.y(), 0, borderSlack) || near(target.pixel.y(), eye.height(), borderSlack) ||
           near(z, eye.record().near, surfaceSlack * z) || near(z, eye.record().far, surfaceSlack * z);
  }

  Picture& Owner;
  const Pair& ThePair;
  const PictureFile& File;
  PairTargets Targets;
};
} // namespace

void checkClass(Picture& picture, Results& results)
{
  for (const Pair& pair : pairsOf(picture))
  {
    const PicturePointer classes = pairClasses(picture, pair);
    if (!classes)
    {
      continue;
    }
    const ClassCheck check(picture, pair, *classes);
    const Meter meter = meterRows(picture.pool(), picture.height(), 0,
      [&](int y, Meter& row)
      {
        for (int x = 0; x < picture.width(); ++x)
        {
          check.pixel(x, y, row);
        }
      });
    results.add({ pair.layer, "", { classes->file() } }, meter);
  }
}

} // namespace dgtk
