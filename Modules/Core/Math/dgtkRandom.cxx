// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRandom.h"

#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
double unit(std::uint32_t high, std::uint32_t low)
{
  return static_cast<double>((std::uint64_t(high) << 32 | low) >> 11) * 0x1p-53;
}

template <std::size_t N>
double polynomial(const double (&c)[N], double x)
{
  double sum = 0;
  for (std::size_t i = N; i-- > 0;)
  {
    sum = sum * x + c[i];
  }
  return sum;
}

// The quantile of a uniform in [0, 1): its cell's middle, so that 0 does not occur.
double normalOf(double u) { return normalQuantile(u + 0x1p-54); }

double poissonByInversion(double mean, double u)
{
  double p = portable::exp(-mean);
  double k = 0;
  for (double sum = p; u >= sum && k < 1000; sum += p)
  {
    k += 1;
    p *= mean / k;
  }
  return k;
}
} // namespace

double normalQuantile(double p)
{
  static constexpr double a[] = { 3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
    1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4,
    2.5090809287301226727e3 };
  static constexpr double b[] = { 1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
    2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4, 5.2264952788528545610e3 };
  static constexpr double c[] = { 1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0,
    3.64784832476320460504e0, 1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2,
    7.74545014278341407640e-4 };
  static constexpr double d[] = { 1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
    1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9 };
  static constexpr double e[] = { 6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0,
    2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5,
    2.01033439929228813265e-7 };
  static constexpr double f[] = { 1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
    7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15 };
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425)
  {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-portable::log(q < 0 ? p : 1 - p));
  const double z =
    r <= 5 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5) / polynomial(f, r - 5);
  return q < 0 ? -z : z;
}

CounterRandom::CounterRandom(std::uint64_t seed, std::uint32_t stream, std::uint32_t camera, std::int32_t frame)
{
  const PhiloxCounter mixed = philox({ stream, camera, static_cast<std::uint32_t>(frame), 0 },
    { static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32) });
  this->Key = { mixed[0], mixed[1] };
}

std::array<double, 2> CounterRandom::uniforms(
  std::uint32_t x, std::uint32_t y, std::uint32_t draw, std::uint32_t attempt) const
{
  const PhiloxCounter bits = this->block(x, y, draw, attempt);
  return { unit(bits[0], bits[1]), unit(bits[2], bits[3]) };
}

std::array<double, 2> CounterRandom::normals(std::uint32_t x, std::uint32_t y, std::uint32_t draw) const
{
  const std::array<double, 2> u = this->uniforms(x, y, draw);
  return { normalOf(u[0]), normalOf(u[1]) };
}

double CounterRandom::normal(std::uint32_t x, std::uint32_t y, std::uint32_t draw) const
{
  return normalOf(this->uniform(x, y, draw));
}

double CounterRandom::poisson(double mean, std::uint32_t x, std::uint32_t y, std::uint32_t draw) const
{
  if (!(mean > 0))
  {
    return 0;
  }
  if (mean < 10)
  {
    return poissonByInversion(mean, this->uniform(x, y, draw));
  }
  mean = std::min(mean, 1e12);
  const double b = 0.931 + 2.53 * std::sqrt(mean);
  const double a = -0.059 + 0.02483 * b;
  const double inverseAlpha = 1.1239 + 1.1328 / (b - 3.4);
  const double vr = 0.9277 - 3.6224 / (b - 2);
  for (std::uint32_t attempt = 0; attempt < 256; ++attempt) // each accepts with a probability above 0.7
  {
    const std::array<double, 2> uv = this->uniforms(x, y, draw, attempt);
    const double u = uv[0] - 0.5;
    const double v = uv[1];
    const double us = 0.5 - std::abs(u);
    const double k = std::floor((2 * a / us + b) * u + mean + 0.43);
    if (us >= 0.07 && v <= vr)
    {
      return k;
    }
    if (!(k >= 0) || !(us > 0) || !(v > 0) || (us < 0.013 && v > us))
    {
      continue;
    }
    if (portable::log(v * inverseAlpha / (a / (us * us) + b)) <=
        k * portable::log(mean) - mean - portable::logFactorial(k))
    {
      return k;
    }
  }
  return std::floor(mean);
}

} // namespace dgtk
