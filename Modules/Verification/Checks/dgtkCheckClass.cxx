// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"
#include "dgtkSeenPoint.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
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
    const int expected = classOf(*other, this->seen(*other, target, hit));
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
  SeenPoint seen(const Sight& other, const Target& target, const Hit& hit) const
  {
    // What a rolling shutter sees at no time has no time at which it might be visible.
    const bool never = !target.projects && this->ThePair.timed->rolls();
    const bool gone = !target.surface || (!never && !other.instance(hit.object).visible);
    return { hit, gone, target.projects, target.there, target.pixel };
  }

  /// Whether another class is as right: beside a silhouette, an edge, the border or the limits of depth.
  bool isOpen(const Sight& other, int x, int y, const Target& target, const Hit& hit, int found) const
  {
    if (!target.surface || !target.ok)
    {
      return !target.ok && target.surface;
    }
    if (std::abs(target.there.z()) <= seenSlack * target.here.norm() ||
        isOpenClass(other, this->seen(other, target, hit), found))
    {
      return true;
    }
    const bool hidden = target.projects && found != NothingSeen && found != OutsideSeen && found != BehindSeen;
    return hidden && this->isOtherSurface(other, x, y, hit, found);
  }

  /// Beside an edge the file may follow the neighbour of the same object and depth.
  bool isOtherSurface(const Sight& other, int x, int y, const Hit& hit, int found) const
  {
    const std::vector<Hit> nearby = this->Owner.nearby(x, y);
    return std::any_of(nearby.begin(), nearby.end(),
      [&](const Hit& near)
      {
        const Target target = near.object == hit.object ? this->Targets.at(x, y, near) : Target{};
        return target.ok && classOf(other, this->seen(other, target, near)) == found;
      });
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
