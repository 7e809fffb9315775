// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWarp.h"

#include "dgtkLayeredDepth.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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
/// The same at a splat's edges, with a normal that is off by half a cell of the splat index, 1/8, and slant.
constexpr double veilShare = 0.1;
/// Square pixels: a splat seen flatter than this has no slope.
constexpr double leastArea = 1e-3;

/// Whose left and right side are one, and whose upper and lower side are a point each.
bool isPanorama(const CameraModel& model) { return model.name() == "equirectangular"; }

/// A sample in the other view: the rectangle centre +- half on a plane.
struct Splat
{
  double x, y;
  double halfX, halfY;
  double farX;   ///< how far to the sides it is seen where nothing else is
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

/// What a pixel of the first view becomes at a place, of which a step to the right and one down are the columns of
/// `steps`, in pixels, and `depths`, and as long as `length` together, on the surface.
void write(const Eigen::Vector2d& place, double depth, const Eigen::Matrix2d& steps, const Eigen::Vector2d& depths,
  double length, const Eigen::Vector2d& largest, Splat& out)
{
  out.x = place.x();
  out.y = place.y();
  out.halfX = std::clamp(splatReach * steps.row(0).cwiseAbs().sum(), 0.5, largest.x());
  out.halfY = std::clamp(splatReach * steps.row(1).cwiseAbs().sum(), 0.5, largest.y());
  out.farX = out.halfX;
  out.depth = depth;
  out.reach = splatReach * (std::abs(depths[0]) + std::abs(depths[1]));
  out.slack = uncertainShare * length;
  const double area = steps(0, 0) * steps(1, 1) - steps(0, 1) * steps(1, 0);
  const bool flat = std::abs(area) < leastArea;
  out.slopeX = flat ? 0 : (depths[0] * steps(1, 1) - depths[1] * steps(1, 0)) / area;
  out.slopeY = flat ? 0 : (depths[1] * steps(0, 0) - depths[0] * steps(0, 1)) / area;
}

/// The same in a linear projection of a point and steps in the camera's frame; magnification: pixels that one of the
/// first view is as wide as, seen from the front.
void write(const LinearProjection& to, const Eigen::Vector3d& x, const Eigen::Vector3d& right,
  const Eigen::Vector3d& down, double magnification, Splat& out)
{
  const Eigen::Matrix3d& K = to.K;
  const double divisor = to.perspective ? x.z() : 1;
  const double u = x.x() / divisor;
  const double v = x.y() / divisor;
  Eigen::Matrix2d steps;
  int column = 0;
  for (const Eigen::Vector3d* d : { &right, &down })
  {
    const double du = (d->x() - (to.perspective ? u * d->z() : 0)) / divisor;
    const double dv = (d->y() - (to.perspective ? v * d->z() : 0)) / divisor;
    steps.col(column++) << K(0, 0) * du + K(0, 1) * dv, K(1, 1) * dv;
  }
  write({ K(0, 0) * u + K(0, 1) * v + K(0, 2), K(1, 1) * v + K(1, 2) }, x.z(), steps, { right.z(), down.z() },
    right.norm() + down.norm(), Eigen::Vector2d::Constant(largestSplat * std::max(1.0, magnification)), out);
}

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
    write(this->To, moved, R * (right - ray * (normal.dot(right) / facing)),
      R * (down - ray * (normal.dot(down) / facing)), this->magnification(scale, moved.z()), out);
    return true;
  }

private:
  /// Pixels of the other view that one of this one is as wide as, seen from the front.
  double magnification(double scale, double depth) const
  {
    const double other = this->To.perspective ? 1 / depth : 1;
    return std::max(this->To.K(0, 0) / this->From.K(0, 0), this->To.K(1, 1) / this->From.K(1, 1)) * scale * other;
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
    , Linear(to.model->linear())
    , To_from_From(to.camera_from_world * from.camera_from_world.inverse())
  {
  }

  /// False when the sample is not seen in the other view.
  bool splat(int column, int row, const WarpSample& sample, Splat& out) const
  {
    const Eigen::Vector2d centre(column + 0.5, row + 0.5);
    const CameraRay ray = this->From.rayThrough(centre);
    const Eigen::Vector3d point = ray.origin + sample.depth * ray.direction;
    const Eigen::Vector3d moved = this->To_from_From * point;
    Place place;
    if (!ray.exists() || !this->place(moved, place) || !(place.range >= this->To.near && place.range <= this->To.far))
    {
      return false;
    }
    const Eigen::Vector3d normal = towards(splatNormal(sample.splatIndex), ray.direction);
    const Step right = this->step(centre, 0, sample.depth, point, normal);
    const Step down = this->step(centre, 1, sample.depth, point, normal);
    if (this->Linear)
    {
      const Eigen::Matrix3d& K = this->Linear->K;
      const double size = std::max(right.front.norm(), down.front.norm()) / (this->Linear->perspective ? moved.z() : 1);
      write(*this->Linear, moved, right.along, down.along, size * std::max(K(0, 0), K(1, 1)), out);
      return true;
    }
    const Place moves[2] = { this->change(moved, right.along, place), this->change(moved, down.along, place) };
    Eigen::Matrix2d steps;
    steps << moves[0].pixel, moves[1].pixel;
    const bool large = splatReach * steps.cwiseAbs().rowwise().sum().maxCoeff() > largestSplat;
    const double front = large ? std::max(this->change(moved, right.front, place).pixel.norm(),
                                   this->change(moved, down.front, place).pixel.norm())
                               : 1;
    const Eigen::Vector2d half(0.5 * this->To.model->width(), 0.5 * this->To.model->height());
    write(place.pixel, place.range, steps, { moves[0].range, moves[1].range }, right.along.norm() + down.along.norm(),
      half.cwiseMin(largestSplat * std::max(1.0, front)), out);
    if (isPanorama(*this->To.model) && half.y() - std::abs(out.y - half.y()) < out.halfY)
    {
      out.farX = half.x(); // over a pole
    }
    return true;
  }

private:
  struct Place
  {
    Eigen::Vector2d pixel{ 0, 0 };
    double range = 0;
  };
  /// One pixel of the first view, in the frame of the other.
  struct Step
  {
    Eigen::Vector3d along{ 0, 0, 0 }; ///< on the surface
    Eigen::Vector3d front{ 0, 0, 0 }; ///< on one across the ray
  };

  /// The normal's z is known but for its sign.
  static Eigen::Vector3d towards(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction)
  {
    const Eigen::Vector3d other(normal.x(), normal.y(), -normal.z());
    return other.dot(direction) < normal.dot(direction) ? other : normal;
  }

  bool place(const Eigen::Vector3d& x, Place& place) const
  {
    const CameraModel& model = *this->To.model;
    if (!model.project(x, place.pixel))
    {
      return false;
    }
    const CameraRay ray = model.rayThrough(place.pixel);
    place.range = (x - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
    return std::isfinite(place.range);
  }

  /// To the next pixel, or from the last one where no ray is beyond.
  Step step(const Eigen::Vector2d& centre, int axis, double t, const Eigen::Vector3d& point,
    const Eigen::Vector3d& normal) const
  {
    for (const int sign : { 1, -1 })
    {
      Eigen::Vector2d beside = centre;
      beside[axis] += sign;
      const CameraRay ray = this->From.rayThrough(beside);
      if (ray.exists())
      {
        const Eigen::Vector3d front = sign * (ray.origin + t * ray.direction - point);
        const double facing = std::min(normal.dot(ray.direction), -flattestSine * ray.direction.norm());
        const Eigen::Matrix3d& R = this->To_from_From.rotation;
        return { R * (front - ray.direction * (normal.dot(front) / facing)), R * front };
      }
    }
    return {};
  }

  /// How the place moves with x, by the shorter of the steps to and fro; not at all where they differ by more than
  /// that, as around the end of a fisheye. In a panorama, whose pixels are wide at its poles, it is the derivative.
  Place change(const Eigen::Vector3d& x, const Eigen::Vector3d& step, const Place& place) const
  {
    const bool panorama = isPanorama(*this->To.model);
    const double length = panorama ? 1e-3 : 1;
    Place ways[2];
    int count = 0;
    for (const double part : { length, -length })
    {
      Place there;
      if (this->place(x + part * step, there))
      {
        Eigen::Vector2d moved = there.pixel - place.pixel;
        moved.x() = panorama ? std::remainder(moved.x(), this->To.model->width()) : moved.x();
        ways[count++] = { moved / part, (there.range - place.range) / part };
      }
    }
    const double to = ways[0].pixel.norm();
    const double fro = ways[1].pixel.norm();
    if (count < 2 || (ways[0].pixel - ways[1].pixel).norm() > std::min(to, fro))
    {
      return count < 2 ? ways[0] : Place();
    }
    return to <= fro ? ways[0] : ways[1];
  }

  const CameraModel& From;
  const View& To;
  std::optional<LinearProjection> Linear;
  Rigid3 To_from_From;
};

/// A sample that is not opaque, at a pixel.
struct Fragment
{
  std::size_t pixel;
  std::array<int, 2> from; ///< pixel of the first view
  double depth;
  double slack;
  double weight;
  std::array<std::uint8_t, 4> rgba;
};

class Picture
{
public:
  explicit Picture(const CameraModel& model)
    : Width(model.width())
    , Height(model.height())
    , Wraps(isPanorama(model))
    , Back(std::size_t(Width) * Height, std::numeric_limits<double>::infinity())
    , Sums(Back.size() * 3, 0.0)
    , Weights(Back.size(), 0.0)
  {
    for (std::size_t i = 0; i < this->Back.size() && !model.linear(); ++i)
    {
      if (!model.rayThrough({ double(i % this->Width) + 0.5, double(i / this->Width) + 0.5 }).exists())
      {
        this->Back[i] = -this->Back[i]; // nothing is seen there
      }
    }
  }

  void cover(const Splat& splat, const WarpSample& sample)
  {
    if (sample.rgba[3] == 255)
    {
      this->forPixels(splat, splat.halfX,
        [&](std::size_t i, double, double depth) { this->Back[i] = std::min(this->Back[i], depth + splat.slack); });
    }
  }

  void colour(const Splat& splat, const WarpSample& sample, const std::array<int, 2>& from)
  {
    const double veilSlack = veilShare / uncertainShare * splat.slack;
    this->forPixels(splat, sample.rgba[3] < 255 ? splat.halfX : splat.farX,
      [&](std::size_t i, double weight, double depth)
      {
        if (depth - splat.slack > this->Back[i])
        {
          return;
        }
        if (sample.rgba[3] < 255)
        {
          this->Veils.push_back({ i, from, depth, veilSlack, weight, sample.rgba });
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
    for (std::size_t c = 0; c < this->Sums.size(); ++c)
    {
      const double weight = this->Weights[c / 3];
      this->Sums[c] = weight == 0 ? 0 : this->Sums[c] / weight;
    }
    this->blendVeils();
    for (std::size_t i = 0; i < this->Weights.size(); ++i)
    {
      const bool hole = this->Weights[i] == 0;
      image.holes[i] = hole ? 255 : 0;
      image.holeCount += hole;
    }
    std::transform(this->Sums.begin(), this->Sums.end(), image.rgb.begin(),
      [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0) + 0.5); });
    return image;
  }

private:
  /// The pixels whose centre lies in a splat that is so wide, with the weight and the depth of the splat there.
  template <typename Body>
  void forPixels(const Splat& s, double halfX, const Body& body) const
  {
    if (!(s.x + halfX > 0 && s.x - halfX < this->Width && s.y + s.halfY > 0 && s.y - s.halfY < this->Height))
    {
      return;
    }
    const double first = std::ceil(s.x - halfX - 0.5);
    const double end = std::ceil(s.x + halfX - 0.5);
    const int left = static_cast<int>(this->Wraps ? first : std::max(0.0, first));
    const int right = static_cast<int>(this->Wraps ? end : std::min<double>(this->Width, end));
    const int top = std::max(0, static_cast<int>(std::ceil(s.y - s.halfY - 0.5)));
    const int bottom = std::min(this->Height, static_cast<int>(std::ceil(s.y + s.halfY - 0.5)));
    for (int y = top; y < bottom; ++y)
    {
      const double vertical = std::max(leastWeight, 1 - std::abs(y + 0.5 - s.y) / s.halfY);
      for (int x = left; x < right; ++x)
      {
        const double horizontal = std::max(leastWeight, 1 - std::abs(x + 0.5 - s.x) / s.halfX);
        const int column = this->Wraps ? (x + this->Width) % this->Width : x;
        body(std::size_t(y) * this->Width + column, vertical * horizontal, s.depthAt(x + 0.5, y + 0.5));
      }
    }
  }

  /// Lays what is not opaque over the rest, far to near. Samples whose depths may be the same are of one surface, and
  /// the one nearest to the centre is laid; but those of one pixel of the first view are of as many surfaces.
  void blendVeils()
  {
    std::stable_sort(this->Veils.begin(), this->Veils.end(),
      [](const Fragment& a, const Fragment& b)
      { return a.pixel < b.pixel || (a.pixel == b.pixel && a.depth > b.depth); });
    std::vector<const Fragment*> surfaces; // of each the sample that is laid, far to near
    for (auto first = this->Veils.begin(); first != this->Veils.end();)
    {
      surfaces.clear();
      auto next = first;
      do
      {
        const auto rank =
          std::size_t(std::count_if(first, next, [&](const Fragment& farther) { return farther.from == next->from; }));
        if (rank == surfaces.size())
        {
          surfaces.push_back(&*next);
        }
        else if (next->weight > surfaces[rank]->weight)
        {
          surfaces[rank] = &*next;
        }
        ++next;
      } while (next != this->Veils.end() && next->pixel == first->pixel &&
               next->depth + next->slack >= (next - 1)->depth - (next - 1)->slack);
      for (const Fragment* veil : surfaces)
      {
        this->lay(*veil);
      }
      first = next;
    }
  }

  void lay(const Fragment& veil)
  {
    const double opacity = veil.rgba[3] / 255.0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      double& value = this->Sums[3 * veil.pixel + c];
      value += opacity * (veil.rgba[c] - value);
    }
    this->Weights[veil.pixel] = 1; // no hole
  }

  int Width;
  int Height;
  bool Wraps;               ///< left and right side are one
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
  Picture picture(to);
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
        picture.colour(splat, sample, { x, y });
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
