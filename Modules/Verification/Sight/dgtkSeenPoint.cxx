// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSeenPoint.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Whether a surface that the ray through a pixel meets at a range is met at its very edge.
bool isGrazed(const Sight& sight, const Hit& hit, const Eigen::Vector2d& pixel, double range)
{
  return sight.weights(hit, sight.eye().at(pixel, range)).minCoeff() < seenSlack;
}

/// By the ray through `pixel`, on which the point has the same depth as on its own. `narrow`: the ray passes what it
/// meets at its very edge.
int classBeside(
  const Sight& sight, const SeenPoint& point, const Eigen::Vector2d& pixel, double slack, bool narrow = false)
{
  if (point.gone)
  {
    return NothingSeen;
  }
  if (!point.projects)
  {
    return BehindSeen;
  }
  if (!sight.eye().sees(point.pixel, point.x_in_camera))
  {
    return OutsideSeen;
  }
  std::vector<Hit> hits;
  std::vector<double> ranges;
  sight.surfaces(pixel, hits, ranges);
  const double own = sight.eye().range(point.pixel, point.x_in_camera);
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    if (hits[i] != point.hit && ranges[i] / own < 1 - slack && !(narrow && isGrazed(sight, hits[i], pixel, ranges[i])))
    {
      return hits[i].object == point.hit.object ? OwnObjectSeen : OtherObjectSeen;
    }
  }
  return VisibleSeen;
}

bool isAtLimit(const Eye& eye, const SeenPoint& point)
{
  const auto near = [](double a, double b, double slack) { return std::abs(a - b) <= slack; };
  const double z = eye.range(point.pixel, point.x_in_camera);
  return near(point.pixel.x(), 0, borderSlack) || near(point.pixel.x(), eye.width(), borderSlack) ||
         near(point.pixel.y(), 0, borderSlack) || near(point.pixel.y(), eye.height(), borderSlack) ||
         near(z, eye.record().near, seenSlack * z) || near(z, eye.record().far, seenSlack * z);
}
} // namespace

int classOf(const Sight& sight, const SeenPoint& point) { return classBeside(sight, point, point.pixel, seenSlack); }

bool isOpenClass(const Sight& sight, const SeenPoint& point, int found)
{
  if (point.projects && isAtLimit(sight.eye(), point))
  {
    return true;
  }
  if (!point.projects || found == NothingSeen || found == OutsideSeen || found == BehindSeen)
  {
    return false;
  }
  // Between two surfaces that end in one plane with the camera, there is a way that has no width.
  if (classBeside(sight, point, point.pixel, silhouetteReach) == found ||
      classBeside(sight, point, point.pixel, seenSlack, true) == found)
  {
    return true;
  }
  const Eigen::Vector2d reach = sight.eye().reach(silhouetteReach, point.x_in_camera);
  for (int i = 0; i < 32; ++i)
  {
    const Eigen::Vector2d direction(std::cos(i * pi / 8), std::sin(i * pi / 8));
    const Eigen::Vector2d pixel = point.pixel + (i < 16 ? 1.0 : 0.25) * reach.cwiseProduct(direction);
    if (classBeside(sight, point, pixel, seenSlack) == found ||
        classBeside(sight, point, pixel, silhouetteReach) == found)
    {
      return true;
    }
  }
  return false;
}

} // namespace dgtk
