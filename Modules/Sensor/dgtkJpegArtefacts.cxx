// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJpegArtefacts.h"

#include <algorithm>
#include <cmath>

namespace dgtk::sensor
{

namespace
{
// T.81, tables K.1 and K.2.
constexpr std::array<int, 64> luminance{ 16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24,
  40, 57, 69, 56, 14, 17, 22, 29, 51, 87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92,
  49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99 };
constexpr std::array<int, 64> chrominance{ 17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99, 24, 26, 56,
  99, 99, 99, 99, 99, 47, 66, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
  99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99 };

std::array<int, 64> scaled(const std::array<int, 64>& table, int quality)
{
  const int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  std::array<int, 64> out{};
  for (std::size_t i = 0; i < 64; ++i)
  {
    out[i] = std::min(std::max((table[i] * percent + 50) / 100, 1), 255);
  }
  return out;
}

// cos(k pi / 16), k = 0 ... 8
constexpr double cosines[9] = { 1.0, 0.980785280403230449, 0.923879532511286756, 0.831469612302545237,
  0.707106781186547524, 0.555570233019602225, 0.382683432365089772, 0.195090322016128268, 0.0 };

double cosine(int k) // cos(k pi / 16)
{
  k %= 32;
  k = k > 16 ? 32 - k : k;
  return k > 8 ? -cosines[16 - k] : cosines[k];
}

struct Basis
{
  double of[8][8]; ///< [frequency][sample], orthonormal
  Basis()
  {
    for (int u = 0; u < 8; ++u)
    {
      for (int x = 0; x < 8; ++x)
      {
        this->of[u][x] = (u == 0 ? 0.5 * cosines[4] : 0.5) * cosine((2 * x + 1) * u);
      }
    }
  }
};

const Basis& basis()
{
  static const Basis instance;
  return instance;
}

// to = M from M^T with M = basis, or its transpose when inverse.
void transform(const double (&from)[64], double (&to)[64], bool inverse)
{
  const Basis& b = basis();
  double half[64];
  for (int i = 0; i < 8; ++i)
  {
    for (int j = 0; j < 8; ++j)
    {
      double sum = 0;
      for (int k = 0; k < 8; ++k)
      {
        sum += from[i * 8 + k] * (inverse ? b.of[k][j] : b.of[j][k]);
      }
      half[i * 8 + j] = sum;
    }
  }
  for (int i = 0; i < 8; ++i)
  {
    for (int j = 0; j < 8; ++j)
    {
      double sum = 0;
      for (int k = 0; k < 8; ++k)
      {
        sum += half[k * 8 + j] * (inverse ? b.of[k][i] : b.of[i][k]);
      }
      to[i * 8 + j] = sum;
    }
  }
}

std::int16_t rounded(double v)
{
  return static_cast<std::int16_t>(std::floor(std::min(std::max(v, 0.0), 255.0) + 0.5));
}
} // namespace

JpegArtefacts::JpegArtefacts(int quality, bool subsampled)
  : Subsampled(subsampled)
  , Luminance(scaled(luminance, quality))
  , Chrominance(scaled(chrominance, quality))
{
}

JpegArtefacts::Plane JpegArtefacts::halved(const Plane& plane)
{
  Plane half;
  half.width = plane.width / 2;
  half.height = plane.height / 2;
  half.samples.resize(std::size_t(half.width) * half.height);
  for (int y = 0; y < half.height; ++y)
  {
    for (int x = 0; x < half.width; ++x)
    {
      const int sum = plane.at(2 * x, 2 * y) + plane.at(2 * x + 1, 2 * y) + plane.at(2 * x, 2 * y + 1) +
                      plane.at(2 * x + 1, 2 * y + 1);
      half.at(x, y) = static_cast<std::int16_t>((sum + (x % 2 == 0 ? 1 : 2)) / 4); // halves go up and down in turn
    }
  }
  return half;
}

void JpegArtefacts::codePlane(Plane& plane, const std::array<int, 64>& table) const
{
  double samples[64];
  double frequencies[64];
  for (int top = 0; top < plane.height; top += 8)
  {
    for (int left = 0; left < plane.width; left += 8)
    {
      for (int i = 0; i < 64; ++i)
      {
        samples[i] = plane.at(left + i % 8, top + i / 8) - 128;
      }
      transform(samples, frequencies, false);
      for (std::size_t i = 0; i < 64; ++i)
      {
        const double level = std::floor(std::abs(frequencies[i]) / table[i] + 0.5) * table[i];
        frequencies[i] = frequencies[i] < 0 ? -level : level;
      }
      transform(frequencies, samples, true);
      for (int i = 0; i < 64; ++i)
      {
        plane.at(left + i % 8, top + i / 8) = rounded(samples[i] + 128);
      }
    }
  }
}

void JpegArtefacts::apply(std::vector<std::vector<float>>& rows) const
{
  const int block = this->blockRows();
  const int width = static_cast<int>(rows.front().size() / 3);
  const int height = static_cast<int>(rows.size());
  Plane planes[3];
  for (Plane& plane : planes)
  {
    plane.width = (width + block - 1) / block * block;
    plane.height = block;
    plane.samples.resize(std::size_t(plane.width) * block);
  }
  for (int y = 0; y < block; ++y)
  {
    const std::vector<float>& row = rows[static_cast<std::size_t>(std::min(y, height - 1))];
    for (int x = 0; x < planes[0].width; ++x)
    {
      const float* rgb = row.data() + std::size_t(std::min(x, width - 1)) * 3;
      const double r = rounded(rgb[0] * 255.0);
      const double g = rounded(rgb[1] * 255.0);
      const double b = rounded(rgb[2] * 255.0);
      planes[0].at(x, y) = rounded(0.299 * r + 0.587 * g + 0.114 * b);
      planes[1].at(x, y) = rounded(128 - 0.168735892 * r - 0.331264108 * g + 0.5 * b);
      planes[2].at(x, y) = rounded(128 + 0.5 * r - 0.418687589 * g - 0.081312411 * b);
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    planes[i] = i > 0 && this->Subsampled ? halved(planes[i]) : planes[i];
    this->codePlane(planes[i], i == 0 ? this->Luminance : this->Chrominance);
  }
  const int shift = this->Subsampled ? 1 : 0;
  for (int y = 0; y < height; ++y)
  {
    float* rgb = rows[static_cast<std::size_t>(y)].data();
    for (int x = 0; x < width; ++x, rgb += 3)
    {
      const double luma = planes[0].at(x, y);
      const double cb = planes[1].at(x >> shift, y >> shift) - 128;
      const double cr = planes[2].at(x >> shift, y >> shift) - 128;
      rgb[0] = rounded(luma + 1.402 * cr) / 255.0f;
      rgb[1] = rounded(luma - 0.344136286 * cb - 0.714136286 * cr) / 255.0f;
      rgb[2] = rounded(luma + 1.772 * cb) / 255.0f;
    }
  }
}

} // namespace dgtk::sensor
