// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"

#include <Eigen/Geometry>

#include <opencv2/calib3d.hpp>

#include <cmath>

namespace dgtk
{

namespace
{
/// Pixels: the rounding of places, as the motion's.
constexpr double epipolarTolerance = 1e-9;
/// Of the scene's size: the rounding of places, divided by the angle between the rays.
constexpr double triangulationTolerance = 1e-10;
/// Radians between the rays. Rounding moves a point in inverse proportion to them, so that the tolerance grows below
/// the first; below the second, as of two cameras in one place, the rays meet nowhere in double precision.
constexpr double usualAngle = 1e-3;
constexpr double leastAngle = 1e-9;
constexpr int lastInside = 3; ///< visible, or hidden inside the image

/// Image of a homogeneous point of the first camera's frame in the second image.
Eigen::Vector3d imageOf(const Eye& first, const Eye& second, const Eigen::Vector3d& x, double w)
{
  const Rigid3 second_from_first = second.view().camera_from_world * first.view().camera_from_world.inverse();
  const Eigen::Vector3d y = second_from_first.rotation * x + w * second_from_first.translation;
  return second.record().K * (second.pinhole() ? y : Eigen::Vector3d(y.x(), y.y(), w));
}

/// Distance from F x of both calibrations, the line through the epipole and the image of the ray's direction. Measured
/// from the nearer of these two: where they come close, as of cameras in one place but for a rounding, the line's own
/// equation has no digits left.
double epipolarDistance(const Eye& first, const Eye& second, const Eigen::Vector2d& pixel, const Eigen::Vector2d& place)
{
  const CameraRay ray = first.ray(pixel);
  const Eigen::Vector3d ends[] = { imageOf(first, second, ray.origin, 1).normalized(),
    imageOf(first, second, ray.direction, 0).normalized() };
  const Eigen::Vector3d line = ends[0].cross(ends[1]);
  const Eigen::Vector2d normal = line.head<2>().normalized();
  Eigen::Vector2d nearest(infinite, infinite);
  for (const Eigen::Vector3d& end : ends)
  {
    const Eigen::Vector2d apart = place - end.hnormalized();
    nearest = end.z() != 0 && apart.norm() < nearest.norm() ? apart : nearest;
  }
  return nearest.allFinite() ? normal.dot(nearest) : line.dot(place.homogeneous()) / line.head<2>().norm();
}

/// Pixels whose correspondence holds an inside point; only between cameras of one frame, apart from each other.
struct PairImages
{
  PicturePointer values;
  PicturePointer classes;
  bool usable(int x, int y) const
  {
    const double kind = this->classes ? this->classes->at(x, y) : 1;
    return kind >= 1 && kind <= lastInside && std::isfinite(this->values->at(x, y, 0));
  }
};

bool isApart(const Eye& a, const Eye& b)
{
  return a.linear() && b.linear() &&
         (a.toCamera(b.toWorld(Eigen::Vector3d::Zero())).norm() > 0 || a.pinhole() != b.pinhole());
}

PairImages imagesOf(Picture& picture, const Pair& pair)
{
  if (pair.kind != PairKind::Place || !pair.sameFrame || !isApart(picture.eye(), pair.other->eye()) ||
      picture.time().rolls() || pair.timed->rolls())
  {
    return {};
  }
  return { pairValues(picture, pair), picture.quietly([&] { return pairClasses(picture, pair); }) };
}

double sizeOf(const SceneState& state)
{
  Eigen::Vector3d least(infinite, infinite, infinite);
  Eigen::Vector3d most = -least;
  for (const Instance& instance : state.instances)
  {
    for (const Eigen::Vector3d& p : instance.geometry->positions)
    {
      const Eigen::Vector3d world = instance.world_from_object * p;
      least = least.cwiseMin(world);
      most = most.cwiseMax(world);
    }
  }
  return (most - least).norm();
}

cv::Matx34d projectionOf(const Rigid3& pose)
{
  cv::Matx34d P;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      P(i, j) = pose.rotation(i, j);
    }
    P(i, 3) = pose.translation[i];
  }
  return P;
}

/// cv::triangulatePoints for the pixels of a row, in the first camera's frame and in units of depth 1.
class Triangulation
{
public:
  Triangulation(Picture& picture, const Pair& pair, const PairImages& images)
    : Owner(picture)
    , Other(pair.other->eye())
    , Images(images)
    , Targets(picture, pair)
    , Second_from_first(this->Other.view().camera_from_world * picture.eye().view().camera_from_world.inverse())
    , Size(sizeOf(picture.sight().state()))
  {
  }

  void row(int y, Meter& meter) const
  {
    std::vector<Seen> row;
    std::vector<cv::Point2d> first;
    std::vector<cv::Point2d> second;
    for (int x = 0; x < this->Owner.width(); ++x)
    {
      if (!this->Images.usable(x, y) || this->Targets.hit(x, y).object == 0)
      {
        continue;
      }
      const Eigen::Vector3d point = this->Owner.point(x, y);
      const Eigen::Vector3d turned = this->Second_from_first.rotation * point;
      const Eigen::Vector3d other = turned + this->Second_from_first.translation;
      const double angle = std::atan2(turned.cross(other).norm(), turned.dot(other));
      if (angle < leastAngle)
      {
        continue;
      }
      row.push_back({ x, point, std::min(1.0, angle / usualAngle) });
      const Eigen::Vector3d a = this->Owner.eye().ray(centreOf(x, y)).direction;
      const Eigen::Vector3d b = this->Other.ray(this->Images.values->at2(x, y)).direction;
      first.emplace_back(a.x(), a.y());
      second.emplace_back(b.x(), b.y());
    }
    if (!row.empty())
    {
      this->compare(y, row, first, second, meter);
    }
  }

private:
  struct Seen
  {
    int x;
    Eigen::Vector3d point;
    double weight; ///< of its error
  };

  void compare(int y, const std::vector<Seen>& row, const std::vector<cv::Point2d>& first,
    const std::vector<cv::Point2d>& second, Meter& meter) const
  {
    cv::Mat points;
    cv::triangulatePoints(projectionOf({}), projectionOf(this->Second_from_first), first, second, points);
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const int column = static_cast<int>(i);
      const double w = points.at<double>(3, column);
      const Eigen::Vector3d found(
        points.at<double>(0, column) / w, points.at<double>(1, column) / w, points.at<double>(2, column) / w);
      const auto& [x, expected, weight] = row[i];
      meter.add(weight * (found - expected).norm() / this->Size / this->Owner.eye().farness(expected),
        [&, x = x, expected = expected]
        {
          const Eigen::Vector3d from = this->Owner.eye().toWorld(found);
          const Eigen::Vector3d to = this->Owner.eye().toWorld(expected);
          return this->Images.values->offender(
            x, y, "the point " + numbersText(from.data(), 3), numbersText(to.data(), 3));
        });
    }
  }

  Picture& Owner;
  const Eye& Other;
  const PairImages& Images;
  PairTargets Targets;
  Rigid3 Second_from_first;
  double Size;
};
} // namespace

void checkEpipolar(Picture& picture, Results& results)
{
  for (const Pair& pair : pairsOf(picture))
  {
    const PairImages images = imagesOf(picture, pair);
    if (!images.values)
    {
      continue;
    }
    const PairTargets targets(picture, pair);
    const Meter meter = meterRows(picture.pool(), picture.height(), epipolarTolerance,
      [&](int y, Meter& row)
      {
        for (int x = 0; x < picture.width(); ++x)
        {
          if (!images.usable(x, y))
          {
            continue;
          }
          const Eigen::Vector2d p = images.values->at2(x, y);
          const double distance = epipolarDistance(picture.eye(), pair.other->eye(), centreOf(x, y), p);
          const Target target = targets.at(x, y);
          row.add(distance / (target.surface ? picture.eye().farness(target.here) : 1),
            [&] { return images.values->offender(x, y, numbersText(p.data(), 2), "a point of the epipolar line"); });
        }
      });
    results.add({ pair.layer, "pixel", { images.values->file() } }, meter);
  }
}

void checkTriangulation(Picture& picture, Results& results)
{
  for (const Pair& pair : pairsOf(picture))
  {
    const PairImages images = imagesOf(picture, pair);
    if (!images.values || !picture.eye().pinhole() || !pair.other->eye().pinhole() || picture.time().rolls() ||
        pair.timed->rolls())
    {
      continue;
    }
    const Triangulation triangulation(picture, pair, images);
    results.add({ pair.layer, "scene size", { images.values->file() } },
      meterRows(picture.pool(), picture.height(), triangulationTolerance,
        [&](int y, Meter& row) { triangulation.row(y, row); }));
  }
}

} // namespace dgtk
