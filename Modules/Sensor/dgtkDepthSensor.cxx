// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDepthSensor.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkRowWindow.h"

#include <cmath>
#include <limits>

namespace dgtk
{

using namespace sensor;

namespace
{
constexpr double none = std::numeric_limits<double>::infinity();
constexpr double degree = 0.0174532925199432957692;
constexpr double halfPi = 1.57079632679489661923;
constexpr double steepest = 85 * degree;
constexpr double widest = 4; // standard deviations that a lateral shift may have

struct Sample
{
  double depth = none;
  double angle = 0;    ///< radians between normal and ray
  bool hidden = false; ///< from the second viewpoint
};

// x - disparity grows along a row as long as the second viewpoint, on the right, sees the surfaces one beside the
// other; what is overtaken from the right lies behind something there.
void markHidden(std::vector<Sample>& row, double disparityTimesDepth)
{
  double leftmost = none;
  for (std::size_t x = row.size(); x-- > 0;)
  {
    const double seenAt = double(x) - disparityTimesDepth / row[x].depth;
    row[x].hidden = row[x].depth < none && leftmost <= seenAt;
    leftmost = row[x].depth < none ? std::min(leftmost, seenAt) : leftmost;
  }
}

int haloOf(const DepthSensorParameters& p)
{
  const double shift = widest * p.kinect.lateral * kinectLateralSigma(halfPi);
  return std::max(static_cast<int>(std::ceil(shift)), p.dropout.edge > 0 ? p.dropout.edgeRadius : 0);
}
} // namespace

double kinectAxialSigma(double z, double angle)
{
  const double sigma = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
  if (angle < 60 * degree)
  {
    return sigma;
  }
  const double steep = std::min(angle, steepest);
  const double rest = halfPi - steep;
  return sigma + 0.0001 / std::sqrt(z) * steep * steep / (rest * rest);
}

double kinectLateralSigma(double angle)
{
  const double steep = std::min(angle, steepest);
  return 0.8 + 0.035 * steep / (halfPi - steep);
}

struct DepthSensor::Impl
{
  Impl(const DepthSensorSetup& setup, Sink sink, ThreadPool* pool)
    : Setup(setup)
    , Out(std::move(sink))
    , Pool(pool)
    , Halo(haloOf(setup.parameters))
    , Lateral(setup.key.random(NoiseKey::DepthLateral))
    , Axial(setup.key.random(NoiseKey::DepthAxial))
    , Disparity(setup.key.random(NoiseKey::DepthDisparity))
    , Dropout(setup.key.random(NoiseKey::DepthDropout))
    , Rows(setup.height, this->Halo)
  {
    if (setup.parameters.stereo.baseline > 0 && !(setup.focalLength > 0))
    {
      throw UsageError("a depth sensor with a stereo baseline needs a camera with a focal length");
    }
  }

  const Sample& sampleAt(int x, int y) const
  {
    return this->Rows.clamped(y)[static_cast<std::size_t>(std::min(std::max(x, 0), this->Setup.width - 1))];
  }
  std::vector<double> measure(int y) const;
  double measure(int x, int y) const;
  const Sample& seenFrom(int x, int y, const Sample& own) const;
  double blurred(const Sample& seen, int x, int y) const;
  double triangulated(double z, int x, int y) const;
  bool drops(const Sample& own, int x, int y) const;
  bool besideJump(const Sample& own, int x, int y) const;

  DepthSensorSetup Setup;
  Sink Out;
  ThreadPool* Pool;
  int Halo;
  CounterRandom Lateral;
  CounterRandom Axial;
  CounterRandom Disparity;
  CounterRandom Dropout;
  RowWindow<Sample> Rows;
};

// The surface a lateral error away.
const Sample& DepthSensor::Impl::seenFrom(int x, int y, const Sample& own) const
{
  const double factor = this->Setup.parameters.kinect.lateral;
  if (!(factor > 0))
  {
    return own;
  }
  const double sigma = factor * kinectLateralSigma(own.angle);
  const auto n = this->Lateral.normals(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0);
  const auto shift = [sigma](double normal)
  { return static_cast<int>(std::floor(sigma * std::min(std::max(normal, -widest), widest) + 0.5)); };
  return this->sampleAt(x + shift(n[0]), y + shift(n[1])); // within the halo, which is that of the largest sigma
}

double DepthSensor::Impl::blurred(const Sample& seen, int x, int y) const
{
  const DepthSensorParameters& p = this->Setup.parameters;
  const double z = seen.depth;
  const double plain = p.gaussian[0] + z * (p.gaussian[1] + z * p.gaussian[2]);
  double kinect = 0;
  if (p.kinect.axial > 0)
  {
    kinect = p.kinect.axial * kinectAxialSigma(z * p.kinect.metres, seen.angle) / p.kinect.metres;
  }
  if (plain == 0 && kinect == 0)
  {
    return z;
  }
  const double sigma = std::sqrt(plain * plain + kinect * kinect);
  return z + sigma * this->Axial.normal(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0);
}

double DepthSensor::Impl::triangulated(double z, int x, int y) const
{
  const StereoParameters& s = this->Setup.parameters.stereo;
  if (!(s.baseline > 0) || !(z > 0))
  {
    return z;
  }
  const double scale = this->Setup.focalLength * s.baseline;
  double disparity = scale / z;
  if (s.sigma > 0)
  {
    disparity += s.sigma * this->Disparity.normal(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0);
  }
  if (s.subpixel > 0)
  {
    disparity = std::floor(disparity / s.subpixel + 0.5) * s.subpixel;
  }
  return disparity > 0 ? scale / disparity : none;
}

bool DepthSensor::Impl::besideJump(const Sample& own, int x, int y) const
{
  const DropoutParameters& d = this->Setup.parameters.dropout;
  for (int j = -d.edgeRadius; j <= d.edgeRadius; ++j)
  {
    for (int i = -d.edgeRadius; i <= d.edgeRadius; ++i)
    {
      const double other = this->sampleAt(x + i, y + j).depth;
      if (std::abs(other - own.depth) > d.edgeJump * std::min(other, own.depth))
      {
        return true;
      }
    }
  }
  return false;
}

bool DepthSensor::Impl::drops(const Sample& own, int x, int y) const
{
  const DropoutParameters& d = this->Setup.parameters.dropout;
  const auto px = static_cast<std::uint32_t>(x);
  const auto py = static_cast<std::uint32_t>(y);
  if (d.random > 0 && this->Dropout.uniform(px, py, 0) < d.random)
  {
    return true;
  }
  if (d.grazing > 0 && own.angle > d.grazingAngle * degree && this->Dropout.uniform(px, py, 1) < d.grazing)
  {
    return true;
  }
  if (d.occluded > 0 && own.hidden && this->Dropout.uniform(px, py, 3) < d.occluded)
  {
    return true;
  }
  return d.edge > 0 && this->Dropout.uniform(px, py, 2) < d.edge && this->besideJump(own, x, y);
}

double DepthSensor::Impl::measure(int x, int y) const
{
  const DepthSensorParameters& p = this->Setup.parameters;
  const Sample& own = this->Rows.at(y)[static_cast<std::size_t>(x)];
  if (!(own.depth < none) || this->drops(own, x, y))
  {
    return none;
  }
  const Sample& seen = this->seenFrom(x, y, own);
  if (!(seen.depth < none))
  {
    return none;
  }
  const double z = this->triangulated(this->blurred(seen, x, y), x, y);
  return z > 0 && z >= p.least && (p.most == 0 || z <= p.most) ? z : none;
}

std::vector<double> DepthSensor::Impl::measure(int y) const
{
  std::vector<double> row(static_cast<std::size_t>(this->Setup.width));
  for (int x = 0; x < this->Setup.width; ++x)
  {
    row[static_cast<std::size_t>(x)] = this->measure(x, y);
  }
  return row;
}

DepthSensor::DepthSensor(const DepthSensorSetup& setup, Sink sink, ThreadPool* pool)
  : Self(std::make_unique<Impl>(setup, std::move(sink), pool))
{
}

DepthSensor::~DepthSensor() = default;

void DepthSensor::write(int rows, const double* depth, const float* cosine)
{
  Impl& self = *this->Self;
  const auto width = static_cast<std::size_t>(self.Setup.width);
  for (int i = 0; i < rows; ++i)
  {
    std::vector<Sample> row(width);
    for (std::size_t x = 0; x < width; ++x)
    {
      const std::size_t index = std::size_t(i) * width + x;
      row[x] = { depth[index], depth[index] < none ? portable::acos(std::max(double(cosine[index]), 0.0)) : 0 };
    }
    if (self.Setup.parameters.dropout.occluded > 0 && self.Setup.parameters.stereo.baseline > 0)
    {
      markHidden(row, self.Setup.focalLength * self.Setup.parameters.stereo.baseline);
    }
    self.Rows.push(std::move(row));
  }
  const int first = self.Rows.done();
  const auto measured = computeReady(self.Rows, self.Pool, [&self](int y) { return self.measure(y); });
  for (std::size_t i = 0; i < measured.size(); ++i)
  {
    self.Out(first + static_cast<int>(i), measured[i].data());
  }
}

} // namespace dgtk
