// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDistortion.h"

#include "dgtkError.h"
#include "dgtkLensCamera.h"
#include "dgtkPortableMath.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
// Places of the numbers.
constexpr std::size_t k1 = 0;
constexpr std::size_t k2 = 1;
constexpr std::size_t p1 = 2;
constexpr std::size_t p2 = 3;
constexpr std::size_t k3 = 4;
constexpr std::size_t k4 = 5;
constexpr std::size_t k5 = 6;
constexpr std::size_t k6 = 7;
constexpr std::size_t s1 = 8;
constexpr std::size_t s2 = 9;
constexpr std::size_t s3 = 10;
constexpr std::size_t s4 = 11;
constexpr std::size_t tiltX = 12;
constexpr std::size_t tiltY = 13;

constexpr int directions = 48; // in which the domain of a distortion that is not radial is looked for
constexpr double firstStep = 1.0 / 256;
constexpr double stepRatio = 1.02;
constexpr int mostSteps = 50;
constexpr int mostHalves = 12;
// A step of Newton's method on the plane, as part of its distance, or of 1, that is the last: the next one would be of
// its square, times what the slope changes by, which the domain bounds.
constexpr double lastStep = 1e-9;
constexpr double solved = 1e-13; // what may be left where no step is, alike

std::vector<Eigen::Vector2d> allAround()
{
  std::vector<Eigen::Vector2d> ways;
  for (int i = 0; i < directions; ++i)
  {
    const portable::SineCosine way = portable::sinCos(2 * pi / directions * i);
    ways.emplace_back(way.cosine, way.sine);
  }
  return ways;
}

std::array<double, 14> filledUp(const std::vector<double>& numbers)
{
  std::array<double, 14> all{};
  std::copy(numbers.begin(), numbers.end(), all.begin());
  return all;
}

/// A sensor that is turned about x, then about y: its points, homogeneous, of those of the plane.
Eigen::Matrix3d tiltMatrix(double aboutX, double aboutY)
{
  const portable::SineCosine x = portable::sinCos(aboutX);
  const portable::SineCosine y = portable::sinCos(aboutY);
  Eigen::Matrix3d turnX;
  Eigen::Matrix3d turnY;
  turnX << 1, 0, 0, 0, x.cosine, x.sine, 0, -x.sine, x.cosine;
  turnY << y.cosine, 0, -y.sine, 0, 1, 0, y.sine, 0, y.cosine;
  const Eigen::Matrix3d turn = turnY * turnX;
  Eigen::Matrix3d onto;
  onto << turn(2, 2), 0, -turn(0, 2), 0, turn(2, 2), -turn(1, 2), 0, 0, 1;
  return onto * turn;
}

bool perspective(const Eigen::Matrix3d& map, const Eigen::Vector2d& point, Eigen::Vector2d& mapped)
{
  const Eigen::Vector3d h = map * Eigen::Vector3d(point.x(), point.y(), 1);
  mapped = h.head<2>() / h.z();
  return h.z() > leastStretch;
}
} // namespace

ValueSlope Distortion::Radial::factor(double s) const
{
  const std::array<double, 14>& k = this->K;
  const double above = 1 + s * (k[k1] + s * (k[k2] + s * k[k3]));
  const double below = 1 + s * (k[k4] + s * (k[k5] + s * k[k6]));
  const double aboveSlope = k[k1] + s * (2 * k[k2] + s * 3 * k[k3]);
  const double belowSlope = k[k4] + s * (2 * k[k5] + s * 3 * k[k6]);
  if (!this->HasPoles)
  {
    return { above, aboveSlope };
  }
  const double value = below > 0 ? above / below : 0; // nothing beyond a pole
  return { value, below > 0 ? (aboveSlope - value * belowSlope) / below : 0 };
}

ValueSlope Distortion::Radial::operator()(double radius) const
{
  const double square = radius * radius;
  const ValueSlope factor = this->factor(square);
  return { radius * factor.value, factor.value + 2 * square * factor.slope };
}

Distortion::Distortion(const std::vector<double>& numbers, double usual)
  : K(filledUp(numbers))
  , Rule(K)
{
  const auto isZero = [this](std::size_t i) { return this->K[i] == 0; };
  this->OnlyRadial = isZero(p1) && isZero(p2) && isZero(s1) && isZero(s2) && isZero(s3) && isZero(s4);
  this->Tilted = !isZero(tiltX) || !isZero(tiltY);
  if (this->Tilted)
  {
    if (!(std::abs(this->K[tiltX]) < pi / 2 && std::abs(this->K[tiltY]) < pi / 2))
    {
      throw UsageError("tilt of the sensor out of range (expected angles within pi / 2)");
    }
    this->Tilt = tiltMatrix(this->K[tiltX], this->K[tiltY]);
    this->Untilt = this->Tilt.inverse();
    this->Untilt /= this->Untilt(2, 2); // the middle of the plane stays
  }
  this->Radius = std::make_unique<Growing<Radial>>(this->Rule, this->domainRadius(), usual);
}

bool Distortion::isNone(const std::vector<double>& numbers)
{
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; });
}

/// The smallest eigenvalue of the symmetric part of the slope, on a circle.
double Distortion::leastStretchAt(double radius) const
{
  static const std::vector<Eigen::Vector2d> ways = allAround();
  double least = std::min(this->Rule(radius).slope, this->Rule.factor(radius * radius).value);
  for (int i = 0; i < directions && !this->OnlyRadial && least > leastStretch; ++i)
  {
    const Eigen::Matrix2d slope = this->map(radius * ways[std::size_t(i)]).slope;
    const double half = 0.5 * (slope(0, 0) - slope(1, 1));
    const double cross = 0.5 * (slope(0, 1) + slope(1, 0));
    least = std::min(least, 0.5 * slope.trace() - std::sqrt(half * half + cross * cross));
  }
  return least;
}

double Distortion::domainRadius() const
{
  return growsUpTo(
    [this](double radius) { return this->leastStretchAt(radius); }, leastStretch, largestRadius, firstStep, stepRatio);
}

Distortion::Mapped Distortion::map(const Eigen::Vector2d& point) const
{
  const std::array<double, 14>& k = this->K;
  const double x = point.x();
  const double y = point.y();
  const double s = x * x + y * y;
  const ValueSlope radial = this->Rule.factor(s);
  const double both = 2 * (x * y * radial.slope + k[p1] * x + k[p2] * y); // of x by y, and of y by x
  const double prismX = 2 * (k[s1] + 2 * k[s2] * s);                      // slope by r^2, twice
  const double prismY = 2 * (k[s3] + 2 * k[s4] * s);
  Mapped mapped;
  mapped.point << x * radial.value + 2 * k[p1] * x * y + k[p2] * (s + 2 * x * x) + s * (k[s1] + s * k[s2]),
    y * radial.value + k[p1] * (s + 2 * y * y) + 2 * k[p2] * x * y + s * (k[s3] + s * k[s4]);
  mapped.slope << radial.value + 2 * x * x * radial.slope + 2 * k[p1] * y + 6 * k[p2] * x + prismX * x,
    both + prismX * y, both + prismY * x,
    radial.value + 2 * y * y * radial.slope + 6 * k[p1] * y + 2 * k[p2] * x + prismY * y;
  return mapped;
}

bool Distortion::apply(const Eigen::Vector2d& point, Eigen::Vector2d& distorted) const
{
  if (!(point.squaredNorm() <= this->Radius->last() * this->Radius->last() * (1 + edgeSlack)))
  {
    return false;
  }
  const Eigen::Vector2d mapped =
    this->OnlyRadial ? Eigen::Vector2d(point * this->Rule.factor(point.squaredNorm()).value) : this->map(point).point;
  if (this->Tilted)
  {
    return perspective(this->Tilt, mapped, distorted);
  }
  distorted = mapped;
  return true;
}

bool Distortion::undo(const Eigen::Vector2d& distorted, Eigen::Vector2d& point) const
{
  Eigen::Vector2d wanted = distorted;
  if (this->Tilted && !perspective(this->Untilt, distorted, wanted))
  {
    return false;
  }
  const double radius = std::sqrt(wanted.squaredNorm());
  if (this->OnlyRadial && !(radius <= this->Radius->most()))
  {
    return false;
  }
  const double reached = std::min(radius, this->Radius->most());
  const double start = this->OnlyRadial ? this->Radius->inverse(reached) : this->Radius->nearInverse(reached);
  point = radius > 0 ? Eigen::Vector2d(wanted * (start / radius)) : Eigen::Vector2d(wanted);
  return this->OnlyRadial || this->descend(wanted, point);
}

/// Newton's method; steps are cut so that points stay in the domain and what is left becomes less.
bool Distortion::descend(const Eigen::Vector2d& wanted, Eigen::Vector2d& point) const
{
  const double last = this->Radius->last();
  Mapped here = this->map(point);
  Eigen::Vector2d left = wanted - here.point;
  for (int tries = 0; tries < mostSteps; ++tries)
  {
    const Eigen::Matrix2d& slope = here.slope;
    const double determinant = slope(0, 0) * slope(1, 1) - slope(0, 1) * slope(1, 0);
    Eigen::Vector2d step(
      slope(1, 1) * left.x() - slope(0, 1) * left.y(), slope(0, 0) * left.y() - slope(1, 0) * left.x());
    step /= determinant;
    if (step.squaredNorm() <= lastStep * lastStep * (1 + point.squaredNorm()) &&
        (point + step).squaredNorm() <= last * last)
    {
      point += step;
      return true;
    }
    bool better = false;
    for (int halves = 0; halves < mostHalves && !better; ++halves, step *= 0.5)
    {
      Eigen::Vector2d next = point + step;
      const double square = next.squaredNorm();
      next = square > last * last ? Eigen::Vector2d(next * (last / std::sqrt(square))) : next;
      const Mapped there = this->map(next);
      const Eigen::Vector2d still = wanted - there.point;
      better = still.squaredNorm() < left.squaredNorm();
      if (better)
      {
        point = next;
        here = there;
        left = still;
      }
    }
    if (!better)
    {
      break;
    }
  }
  return left.norm() <= solved * (1 + wanted.norm());
}

} // namespace dgtk
