// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWarp.h"

#include "dgtkLayeredDepth.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
/// Splats reach a quarter farther than the pixel: the splat index knows the normal coarsely.
constexpr double splatReach = 0.5 * 1.25;
/// Sine of the flattest angle between ray and surface that is believed.
constexpr double flattestSine = 0.2;
/// Half of the largest splat of the paper, 7 x 7 pixels, for equal scales.
constexpr double largestSplat = 3.5;
constexpr double leastWeight = 1e-3;
/// Depth that a step of one pixel on the surface is uncertain by, as a part of its length.
constexpr double uncertainShare = 0.05;
/// Square pixels: a splat seen flatter than this has no slope.
constexpr double leastArea = 1e-3;

/// A sample in the other view: the rectangle centre +- half on a plane.
struct Splat
{
  double x, y;
  double halfX, halfY;
  double depth;  ///< at the centre
  double slopeX; ///< of depth, per pixel
  double slopeY;
  double reach; ///< no part is nearer or farther than that
  double slack; ///< what the depth may be wrong by, as the normal is known coarsely

  double depthAt(double px, double py) const
  {
    return this->depth +
           std::clamp(this->slopeX * (px - this->x) + this->slopeY * (py - this->y), -this->reach, this->reach);
  }
};

class Reprojection
{
public:
  Reprojection(const View& from, const View& to)
    : From(*from.model->linear())
    , To(*to.model->linear())
    , To_from_From(to.camera_from_world * from.camera_from_world.inverse())
    , Near(to.near)
    , Far(to.far)
  {
  }

  /// False when the sample is not within the other view's near and far.
  bool splat(int column, int row, const WarpSample& sample, Splat& out) const
  {
    const Eigen::Matrix3d& K = this->From.K;
    const double y = (row + 0.5 - K(1, 2)) / K(1, 1);
    const double x = (column + 0.5 - K(0, 2) - K(0, 1) * y) / K(0, 0);
    const bool perspective = this->From.perspective;
    const double scale = perspective ? sample.depth : 1;
    const Eigen::Vector3d point(x * scale, y * scale, sample.depth);
    const Eigen::Vector3d moved = this->To_from_From * point;
    if (!(moved.z() >= this->Near && moved.z() <= this->Far))
    {
      return false;
    }
    // steps of one pixel to the right and down, on the surface's plane
    const Eigen::Vector3d ray = perspective ? Eigen::Vector3d(x, y, 1) : Eigen::Vector3d(0, 0, 1);
    const Eigen::Vector3d right = Eigen::Vector3d(1 / K(0, 0), 0, 0) * scale;
    const Eigen::Vector3d down = Eigen::Vector3d(-K(0, 1) / (K(0, 0) * K(1, 1)), 1 / K(1, 1), 0) * scale;
    const Eigen::Vector3d normal = splatNormal(sample.splatIndex);
    const double facing = std::min(normal.dot(ray), -flattestSine * ray.norm());
    const Eigen::Matrix3d& R = this->To_from_From.rotation;
    this->place(moved, R * (right - ray * (normal.dot(right) / facing)), R * (down - ray * (normal.dot(down) / facing)),
      this->magnification(scale, moved.z()), out);
    return true;
  }

private:
  /// Pixels of the other view that one of this one is as wide as, seen from the front.
  double magnification(double scale, double depth) const
  {
    const double other = this->To.perspective ? 1 / depth : 1;
    return std::max(this->To.K(0, 0) / this->From.K(0, 0), this->To.K(1, 1) / this->From.K(1, 1)) * scale * other;
  }

  void place(const Eigen::Vector3d& x, const Eigen::Vector3d& right, const Eigen::Vector3d& down, double magnification,
    Splat& out) const
  {
    const Eigen::Matrix3d& K = this->To.K;
    const double divisor = this->To.perspective ? x.z() : 1;
    const double u = x.x() / divisor;
    const double v = x.y() / divisor;
    out.x = K(0, 0) * u + K(0, 1) * v + K(0, 2);
    out.y = K(1, 1) * v + K(1, 2);
    const double largest = largestSplat * std::max(1.0, magnification);
    Eigen::Matrix2d steps; // columns: to the right, down
    int column = 0;
    for (const Eigen::Vector3d* d : { &right, &down })
    {
      const double du = (d->x() - (this->To.perspective ? u * d->z() : 0)) / divisor;
      const double dv = (d->y() - (this->To.perspective ? v * d->z() : 0)) / divisor;
      steps.col(column++) << K(0, 0) * du + K(0, 1) * dv, K(1, 1) * dv;
    }
    out.halfX = std::clamp(splatReach * steps.row(0).cwiseAbs().sum(), 0.5, largest);
    out.halfY = std::clamp(splatReach * steps.row(1).cwiseAbs().sum(), 0.5, largest);
    out.depth = x.z();
    out.reach = splatReach * (std::abs(right.z()) + std::abs(down.z()));
    out.slack = uncertainShare * (right.norm() + down.norm());
    const double area = steps(0, 0) * steps(1, 1) - steps(0, 1) * steps(1, 0);
    const bool flat = std::abs(area) < leastArea;
    out.slopeX = flat ? 0 : (right.z() * steps(1, 1) - down.z() * steps(1, 0)) / area;
    out.slopeY = flat ? 0 : (down.z() * steps(0, 0) - right.z() * steps(0, 1)) / area;
  }

  LinearProjection From;
  LinearProjection To;
  Rigid3 To_from_From;
  double Near;
  double Far;
};

/// The same where one of the cameras is a lens: samples have the parameter of their ray, pictures are by rays and
/// projections, depth is what near and far bound.
class LensReprojection
{
public:
  LensReprojection(const View& from, const View& to)
    : From(*from.model)
    , To(to)
    , To_from_From(to.camera_from_world * from.camera_from_world.inverse())
  {
  }

  /// False when the sample is not seen in the other view.
  bool splat(int column, int row, const WarpSample& sample, Splat& out) const
  {
    const Eigen::Vector2d centre(column + 0.5, row + 0.5);
    const CameraRay ray = this->From.rayThrough(centre);
    const Eigen::Vector3d point = ray.origin + sample.depth * ray.direction;
    Place place;
    if (!ray.exists() || !this->place(point, place) || !(place.range >= this->To.near && place.range <= this->To.far))
    {
      return false;
    }
    const Eigen::Vector3d normal = towards(splatNormal(sample.splatIndex), ray.direction);
    Footprint prints[2]; // to the right, down
    for (int axis = 0; axis < 2; ++axis)
    {
      if (!this->footprint(centre, axis, sample.depth, point, normal, place, prints[axis]))
      {
        return false;
      }
    }
    this->write(place, prints, out);
    return true;
  }

private:
  struct Place
  {
    Eigen::Vector2d pixel;
    double range;
  };
  /// What a step of a pixel on the surface is in the other view.
  struct Footprint
  {
    double length = 0; ///< scene units
    Eigen::Vector2d pixels{ 0, 0 };
    double range = 0;
    double front = 0; ///< pixels, of a surface across the ray
  };

  /// The normal's z is known but for its sign.
  static Eigen::Vector3d towards(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction)
  {
    const Eigen::Vector3d other(normal.x(), normal.y(), -normal.z());
    return other.dot(direction) < normal.dot(direction) ? other : normal;
  }

  bool place(const Eigen::Vector3d& x_in_from, Place& place) const
  {
    const CameraModel& model = *this->To.model;
    const Eigen::Vector3d x = this->To_from_From * x_in_from;
    if (!model.project(x, place.pixel))
    {
      return false;
    }
    const CameraRay ray = model.rayThrough(place.pixel);
    place.range = (x - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
    return std::isfinite(place.range);
  }

  /// Where a step leads to, or where the opposite one comes from: not across the end of a picture or the seam of a
  /// panorama.
  bool step(const Eigen::Vector3d& from, const Eigen::Vector3d& step, const Place& place, Place& difference) const
  {
    for (const int sign : { 1, -1 })
    {
      Place there;
      if (this->place(from + sign * step, there))
      {
        difference = { sign * (there.pixel - place.pixel), sign * (there.range - place.range) };
        if (std::abs(difference.pixel.x()) < 0.5 * this->To.model->width())
        {
          return true;
        }
      }
    }
    return false;
  }

  bool footprint(const Eigen::Vector2d& centre, int axis, double t, const Eigen::Vector3d& point,
    const Eigen::Vector3d& normal, const Place& place, Footprint& out) const
  {
    for (const int sign : { 1, -1 })
    {
      Eigen::Vector2d beside = centre;
      beside[axis] += sign;
      const CameraRay ray = this->From.rayThrough(beside);
      if (!ray.exists())
      {
        continue;
      }
      const Eigen::Vector3d front = sign * (ray.origin + t * ray.direction - point);
      const double facing = std::min(normal.dot(ray.direction), -flattestSine * ray.direction.norm());
      const Eigen::Vector3d along = front - ray.direction * (normal.dot(front) / facing);
      Place moved;
      Place acrossRay;
      if (this->step(point, along, place, moved) && this->step(point, front, place, acrossRay))
      {
        out = { along.norm(), moved.pixel, moved.range, acrossRay.pixel.norm() };
        return true;
      }
    }
    return false;
  }

  static void write(const Place& place, const Footprint (&prints)[2], Splat& out)
  {
    Eigen::Matrix2d steps; // columns: to the right, down
    steps << prints[0].pixels, prints[1].pixels;
    const double largest = largestSplat * std::max({ 1.0, prints[0].front, prints[1].front });
    out.x = place.pixel.x();
    out.y = place.pixel.y();
    out.halfX = std::clamp(splatReach * steps.row(0).cwiseAbs().sum(), 0.5, largest);
    out.halfY = std::clamp(splatReach * steps.row(1).cwiseAbs().sum(), 0.5, largest);
    out.depth = place.range;
    out.reach = splatReach * (std::abs(prints[0].range) + std::abs(prints[1].range));
    out.slack = uncertainShare * (prints[0].length + prints[1].length);
    const double area = steps.determinant();
    const bool flat = std::abs(area) < leastArea;
    out.slopeX = flat ? 0 : (prints[0].range * steps(1, 1) - prints[1].range * steps(1, 0)) / area;
    out.slopeY = flat ? 0 : (prints[1].range * steps(0, 0) - prints[0].range * steps(0, 1)) / area;
  }

  const CameraModel& From;
  const View& To;
  Rigid3 To_from_From;
};

/// A sample that is not opaque, at a pixel.
struct Fragment
{
  std::size_t pixel;
  double depth;
  double slack;
  double weight;
  std::array<std::uint8_t, 4> rgba;
};

class Picture
{
public:
  Picture(int width, int height)
    : Width(width)
    , Height(height)
    , Back(std::size_t(width) * height, std::numeric_limits<double>::infinity())
    , Sums(Back.size() * 3, 0.0)
    , Weights(Back.size(), 0.0)
  {
  }

  void cover(const Splat& splat, const WarpSample& sample)
  {
    if (sample.rgba[3] == 255)
    {
      this->forPixels(splat,
        [&](std::size_t i, double, double depth) { this->Back[i] = std::min(this->Back[i], depth + splat.slack); });
    }
  }

  void colour(const Splat& splat, const WarpSample& sample)
  {
    this->forPixels(splat,
      [&](std::size_t i, double weight, double depth)
      {
        if (depth - splat.slack > this->Back[i])
        {
          return;
        }
        if (sample.rgba[3] < 255)
        {
          this->Veils.push_back({ i, depth, splat.slack, weight, sample.rgba });
          return;
        }
        for (int c = 0; c < 3; ++c)
        {
          this->Sums[3 * i + c] += weight * sample.rgba[c];
        }
        this->Weights[i] += weight;
      });
  }

  WarpedImage finish()
  {
    WarpedImage image;
    image.width = this->Width;
    image.height = this->Height;
    image.holes.resize(this->Weights.size());
    image.rgb.resize(this->Sums.size());
    for (std::size_t i = 0; i < this->Weights.size(); ++i)
    {
      const bool hole = this->Weights[i] == 0;
      image.holes[i] = hole ? 255 : 0;
      image.holeCount += hole;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      {
        this->Sums[c] = hole ? 0 : this->Sums[c] / this->Weights[i];
      }
    }
    this->blendVeils();
    std::transform(this->Sums.begin(), this->Sums.end(), image.rgb.begin(),
      [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0) + 0.5); });
    return image;
  }

private:
  /// The pixels whose centre lies in a splat, with the weight and the depth of the splat there.
  template <typename Body>
  void forPixels(const Splat& s, const Body& body) const
  {
    if (!(s.x + s.halfX > 0 && s.x - s.halfX < this->Width && s.y + s.halfY > 0 && s.y - s.halfY < this->Height))
    {
      return;
    }
    const int left = std::max(0, static_cast<int>(std::ceil(s.x - s.halfX - 0.5)));
    const int right = std::min(this->Width, static_cast<int>(std::ceil(s.x + s.halfX - 0.5)));
    const int top = std::max(0, static_cast<int>(std::ceil(s.y - s.halfY - 0.5)));
    const int bottom = std::min(this->Height, static_cast<int>(std::ceil(s.y + s.halfY - 0.5)));
    for (int y = top; y < bottom; ++y)
    {
      const double vertical = std::max(leastWeight, 1 - std::abs(y + 0.5 - s.y) / s.halfY);
      for (int x = left; x < right; ++x)
      {
        const double horizontal = std::max(leastWeight, 1 - std::abs(x + 0.5 - s.x) / s.halfX);
        body(std::size_t(y) * this->Width + x, vertical * horizontal, s.depthAt(x + 0.5, y + 0.5));
      }
    }
  }

  /// Lays what is not opaque over the rest, far to near; of the samples of one surface the one nearest to the centre.
  void blendVeils()
  {
    std::stable_sort(this->Veils.begin(), this->Veils.end(),
      [](const Fragment& a, const Fragment& b)
      { return a.pixel < b.pixel || (a.pixel == b.pixel && a.depth > b.depth); });
    for (std::size_t first = 0; first < this->Veils.size();)
    {
      std::size_t best = first;
      std::size_t next = first + 1;
      for (; next < this->Veils.size() && this->Veils[next].pixel == this->Veils[first].pixel &&
             this->Veils[next].depth + this->Veils[next].slack >= this->Veils[first].depth - this->Veils[first].slack;
           ++next)
      {
        best = this->Veils[next].weight > this->Veils[best].weight ? next : best;
      }
      const Fragment& veil = this->Veils[best];
      const double opacity = veil.rgba[3] / 255.0;
      for (std::size_t c = 0; c < 3; ++c)
      {
        double& value = this->Sums[3 * veil.pixel + c];
        value += opacity * (veil.rgba[c] - value);
      }
      first = next;
    }
  }

  int Width;
  int Height;
  std::vector<double> Back; ///< farthest depth of the nearest opaque surface
  std::vector<double> Sums; ///< 3 per pixel
  std::vector<double> Weights;
  std::vector<Fragment> Veils;
};
} // namespace

namespace
{
template <class Reprojected>
WarpedImage warp(const WarpSource& source, const Reprojected& reprojection, const CameraModel& to)
{
  Picture picture(to.width(), to.height());
  Splat splat{};
  source(
    [&](int x, int y, const WarpSample& sample)
    {
      if (sample.rgba[3] == 255 && reprojection.splat(x, y, sample, splat))
      {
        picture.cover(splat, sample);
      }
    });
  source(
    [&](int x, int y, const WarpSample& sample)
    {
      if (reprojection.splat(x, y, sample, splat))
      {
        picture.colour(splat, sample);
      }
    });
  return picture.finish();
}
} // namespace

WarpedImage warpLayeredDepth(const WarpSource& source, const View& from, const View& to)
{
  return from.model->linear() && to.model->linear() ? warp(source, Reprojection(from, to), *to.model)
                                                    : warp(source, LensReprojection(from, to), *to.model);
}

} // namespace dgtk
