// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFloat4_h
#define dgtkFloat4_h

// Private to Shading: colours and vectors in single precision, and functions of them that give the same bits on every
// machine (those of the C library depend on the processor).

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <emmintrin.h>

namespace dgtk
{

/// Red, green, blue, or x, y, z; the fourth is free. Operators work on each.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using UInt4 = std::uint32_t __attribute__((vector_size(16)));

inline Float4 float4(float x, float y, float z, float w = 0) { return Float4{ x, y, z, w }; }
inline Float4 float4(float all) { return Float4{ all, all, all, all }; }
template <typename Vector>
inline Float4 toFloat4(const Vector& v)
{
  return Float4{ float(v[0]), float(v[1]), float(v[2]), 0 };
}

inline Eigen::Vector3d toVector3d(Float4 v) { return { double(v[0]), double(v[1]), double(v[2]) }; }
inline Float4 loadFloat4(const float* values)
{
  Float4 v;
  std::memcpy(&v, values, sizeof v);
  return v;
}

inline float dot(Float4 a, Float4 b)
{
  const Float4 product = a * b;
  return product[0] + product[1] + product[2];
}
inline Float4 cross(Float4 a, Float4 b)
{
  return float4(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline Float4 normalized(Float4 v, float least = 1e-30F) { return v / std::sqrt(std::max(dot(v, v), least)); }
/// The larger one of each.
inline Float4 atLeast(Float4 v, float least) { return v > least ? v : float4(least); }

/// Columns.
struct Matrix3
{
  Matrix3() = default;
  explicit Matrix3(const Eigen::Matrix3d& m)
    : x(toFloat4(m.col(0)))
    , y(toFloat4(m.col(1)))
    , z(toFloat4(m.col(2)))
  {
  }
  Float4 operator*(Float4 v) const { return this->x * v[0] + this->y * v[1] + this->z * v[2]; }
  Float4 x{ 1, 0, 0, 0 };
  Float4 y{ 0, 1, 0, 0 };
  Float4 z{ 0, 0, 1, 0 };
};

namespace portable
{

/// Logarithm to base 2 of positive normal numbers; absolute error below 2e-7 beside that of rounding the result.
inline Float4 log2(Float4 x)
{
  // to [sqrt(1/2), sqrt(2)): 0x3F3504F3 are the bits of the lower end
  const UInt4 shifted = reinterpret_cast<UInt4>(x) - 0x3F3504F3U;
  const Float4 exponent = __builtin_convertvector(reinterpret_cast<Int4>(shifted) >> 23, Float4);
  const Float4 m = reinterpret_cast<Float4>((shifted & 0x007FFFFFU) + 0x3F3504F3U);
  const Float4 s = (m - 1) / (m + 1);
  const Float4 ss = s * s;
  // 2 artanh(s) / ln 2
  const Float4 series =
    2.885390082F + ss * (0.961796694F + ss * (0.577078016F + ss * (0.412198583F + ss * 0.3205988F)));
  return exponent + s * series;
}

/// 2^x, relative error below 3e-7; 0 below -126, and infinitely large from 128 on.
inline Float4 exp2(Float4 x)
{
  const Int4 known = (x >= -126) & (x < 128);
  const Float4 within = known ? x : float4(0);
  const Int4 whole = __builtin_convertvector(within + (within < 0 ? float4(-0.5F) : float4(0.5F)), Int4);
  const Float4 f = (within - __builtin_convertvector(whole, Float4)) * 0.693147181F;
  const Float4 e =
    1 + f * (1 + f * (0.5F + f * (0.166666667F + f * (0.0416666667F + f * (0.00833333333F + f * 0.00138888889F)))));
  const Float4 half = reinterpret_cast<Float4>((whole + 126) << 23);
  return known ? e * half * 2 : x >= 128 ? float4(INFINITY) : float4(0);
}

/// x^y for x >= 0; 0^0 is 1.
inline Float4 pow(Float4 x, Float4 y)
{
  const Float4 power = exp2(y * log2(x));
  return x > 1e-37F ? power : y == 0 ? float4(1) : float4(0);
}

inline float log2(float x) { return log2(float4(x))[0]; }
/// e^x
inline float exp(float x) { return exp2(float4(x * 1.442695041F))[0]; }

inline float atan2(float y, float x)
{
  constexpr float half = 1.57079633F;
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float large = std::max(ax, ay);
  float r = large > 0 ? std::min(ax, ay) / large : 0.0F; // [0, 1]
  float angle = 0;
  if (r > 0.414213562F) // tan(pi / 8)
  {
    r = (r - 1) / (r + 1);
    angle = half / 2;
  }
  const float s = r * r;
  angle += r * (1 - s * (1.0F / 3 - s * (1.0F / 5 - s * (1.0F / 7 - s * (1.0F / 9 - s * (1.0F / 11 - s / 13))))));
  angle = ay > ax ? half - angle : angle;
  angle = x < 0 ? 2 * half - angle : angle;
  return y < 0 ? -angle : angle;
}

} // namespace portable

/// IEC 61966-2-1, of each of three channels, >= 0; both go on above 1.
inline Float4 toLinear(Float4 c)
{
  return c < 0.04045F ? c * (1 / 12.92F) : portable::exp2(2.4F * portable::log2((c + 0.055F) * (1 / 1.055F)));
}
inline Float4 toDisplay(Float4 c)
{
  c = atLeast(c, 0);
  return c < 0.0031308F ? c * 12.92F : 1.055F * portable::exp2(portable::log2(c) * (1 / 2.4F)) - 0.055F;
}

/// Of coordinates in which pictures repeat: their places u, v, u, v in [0, 1); 0 for what is no number.
inline Float4 repeated(double u, double v)
{
  const __m128d at = _mm_set_pd(v, u);
  const __m128d whole = _mm_cvtepi32_pd(_mm_cvttpd_epi32(at));
  const __m128d below = _mm_sub_pd(whole, _mm_and_pd(_mm_cmplt_pd(at, whole), _mm_set1_pd(1)));
  const __m128 parts = _mm_cvtpd_ps(_mm_sub_pd(at, below));
  const __m128 both = _mm_movelh_ps(parts, parts);
  const __m128 known = _mm_castpd_ps(_mm_cmplt_pd(_mm_andnot_pd(_mm_set1_pd(-0.0), at), _mm_set1_pd(1e9)));
  return _mm_and_ps(
    both, _mm_and_ps(_mm_cmplt_ps(both, _mm_set1_ps(1)), _mm_shuffle_ps(known, known, _MM_SHUFFLE(2, 0, 2, 0))));
}

} // namespace dgtk

#endif
