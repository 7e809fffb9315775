// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEnvironmentLight.h"

#include "dgtkPortableMath.h"
#include "dgtkSceneState.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <utility>

namespace dgtk
{
namespace
{

constexpr int samplesOfLobe = 128;
constexpr double ln2 = 0.693147180559945309417;

/// x may be as much as a width outside of the picture, which goes around.
Eigen::Vector3f texelAt(const float* rgb, int width, int height, int x, int y)
{
  x += x < 0 ? width : x < width ? 0 : -width;
  y = std::clamp(y, 0, height - 1);
  return Eigen::Vector3f(rgb + (std::size_t(y) * width + x) * 3);
}

/// Where a direction of unit length stands in an equirectangular picture, in parts of its width and height.
Eigen::Vector2d placeOf(const Eigen::Vector3d& d)
{
  return { 0.5 + portable::atan2(d.x(), -d.z()) / (2 * pi), portable::atan2(std::hypot(d.x(), d.z()), d.y()) / pi };
}

Eigen::Vector3f bilinear(const float* rgb, int width, int height, const Eigen::Vector2d& place)
{
  const double x = place.x() * width - 0.5;
  const double y = place.y() * height - 0.5;
  const int column = int(std::floor(x));
  const int row = int(std::floor(y));
  const auto right = float(x - column);
  const auto down = float(y - row);
  const auto texel = [&](int across, int below) { return texelAt(rgb, width, height, column + across, row + below); };
  return (texel(0, 0) * (1 - right) + texel(1, 0) * right) * (1 - down) +
         (texel(0, 1) * (1 - right) + texel(1, 1) * right) * down;
}

Eigen::Vector3f bilinear(const RadianceImage& image, const Eigen::Vector2d& place)
{
  return bilinear(image.rgb.data(), image.width, image.height, place);
}

Eigen::Vector3d encoded(const Eigen::Vector3d& linear) { return linear.unaryExpr(&portable::srgbFromLinear); }

/// Equirectangular radiance at several resolutions.
class Pyramid
{
public:
  Pyramid(const RadianceImage& image, double intensity)
  {
    this->Levels.push_back(resampled(image, intensity));
    while (this->Levels.back().width > 8)
    {
      this->Levels.push_back(halved(this->Levels.back()));
    }
  }
  const RadianceImage& level(std::size_t i) const { return this->Levels[i]; }

  /// The level, and a part of the next, whose texels have a solid angle.
  double levelOf(double solidAngle) const
  {
    const RadianceImage& finest = this->Levels[0];
    const double texel = 4 * pi / (double(finest.width) * finest.height);
    return std::clamp(
      0.5 / ln2 * portable::log(std::max(solidAngle / texel, 1.0)), 0.0, double(this->Levels.size() - 1));
  }

  /// Radiance along a direction of unit length.
  Eigen::Vector3f at(const Eigen::Vector3d& d, double level) const
  {
    const auto low = std::min(std::size_t(level), this->Levels.size() - 1);
    const std::size_t high = std::min(low + 1, this->Levels.size() - 1);
    const auto part = float(level - double(low));
    const Eigen::Vector2d place = placeOf(d);
    return bilinear(this->Levels[low], place) * (1 - part) + bilinear(this->Levels[high], place) * part;
  }

private:
  /// To the size of level 0, by area; small pictures are interpolated.
  static RadianceImage resampled(const RadianceImage& from, double intensity)
  {
    RadianceImage to;
    to.width = EnvironmentLight::width;
    to.height = EnvironmentLight::width / 2;
    to.rgb.resize(std::size_t(to.width) * to.height * 3);
    const auto factor = float(intensity);
    const bool enlarged = from.width < to.width && from.height <= to.height;
    for (int y = 0; y < to.height; ++y)
    {
      const int top = int(std::int64_t(y) * from.height / to.height);
      const int bottom = std::max(top + 1, int(std::int64_t(y + 1) * from.height / to.height));
      for (int x = 0; x < to.width; ++x)
      {
        float* const texel = to.rgb.data() + (std::size_t(y) * to.width + x) * 3;
        if (enlarged)
        {
          const Eigen::Vector3f between = bilinear(from, { (x + 0.5) / to.width, (y + 0.5) / to.height }) * factor;
          std::copy_n(between.data(), 3, texel);
          continue;
        }
        const int left = int(std::int64_t(x) * from.width / to.width);
        const int right = std::max(left + 1, int(std::int64_t(x + 1) * from.width / to.width));
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int v = top; v < bottom; ++v)
        {
          for (int u = left; u < right; ++u)
          {
            sum += texelAt(from.rgb.data(), from.width, from.height, u, v).cast<double>();
          }
        }
        const Eigen::Vector3f mean = (sum / (double(bottom - top) * (right - left))).cast<float>() * factor;
        std::copy_n(mean.data(), 3, texel);
      }
    }
    return to;
  }

  static RadianceImage halved(const RadianceImage& from)
  {
    RadianceImage to;
    to.width = from.width / 2;
    to.height = from.height / 2;
    for (int y = 0; y < to.height; ++y)
    {
      for (int x = 0; x < to.width; ++x)
      {
        const auto texel = [&](int column, int row)
        { return texelAt(from.rgb.data(), from.width, from.height, column, row); };
        const Eigen::Vector3f mean =
          (texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y) + texel(2 * x, 2 * y + 1) + texel(2 * x + 1, 2 * y + 1)) / 4;
        to.rgb.insert(to.rgb.end(), mean.data(), mean.data() + 3);
      }
    }
    return to;
  }

  std::vector<RadianceImage> Levels;
};

/// Direction of a point of an equirectangular picture; x and y in [0, 1], y down.
Eigen::Vector3d directionOf(double x, double y)
{
  const double around = (x - 0.5) * 2 * pi;
  const double down = y * pi;
  const portable::SineCosine above = portable::sinCos(down);
  const portable::SineCosine turned = portable::sinCos(around);
  return { above.sine * turned.sine, above.cosine, -above.sine * turned.cosine };
}

/// The terms of EnvironmentLight::irradiance.
std::array<double, 9> termsOf(const Eigen::Vector3d& d)
{
  return { 1, d.y(), d.z(), d.x(), d.x() * d.y(), d.y() * d.z(), 3 * d.z() * d.z() - 1, d.x() * d.z(),
    d.x() * d.x() - d.y() * d.y() };
}

std::array<Eigen::Vector3d, 9> irradianceOf(const RadianceImage& image)
{
  // Of each: the harmonic's constant squared times the cosine lobe's coefficient over pi (1, 2/3, 1/4).
  constexpr double weights[9] = { 0.25 / pi, 0.75 / pi * 2 / 3, 0.75 / pi * 2 / 3, 0.75 / pi * 2 / 3, 3.75 / pi / 4,
    3.75 / pi / 4, 0.3125 / pi / 4, 3.75 / pi / 4, 0.9375 / pi / 4 };
  std::array<Eigen::Vector3d, 9> sums;
  sums.fill(Eigen::Vector3d::Zero());
  for (int row = 0; row < image.height; ++row)
  {
    const double solidAngle =
      (portable::cos(row * pi / image.height) - portable::cos((row + 1) * pi / image.height)) * 2 * pi / image.width;
    for (int column = 0; column < image.width; ++column)
    {
      const Eigen::Vector3d d = directionOf((column + 0.5) / image.width, (row + 0.5) / image.height);
      const Eigen::Vector3d light =
        Eigen::Vector3f(image.rgb.data() + (std::size_t(row) * image.width + column) * 3).cast<double>() * solidAngle;
      const std::array<double, 9> terms = termsOf(d);
      for (std::size_t i = 0; i < 9; ++i)
      {
        sums[i] += light * (terms[i] * weights[i]);
      }
    }
  }
  return sums;
}

/// Point i of Hammersley's set: van der Corput's sequence in base 2 is the second coordinate.
Eigen::Vector2d hammersley(std::uint32_t i, std::uint32_t count)
{
  double inverse = 0;
  double digit = 0.5;
  for (std::uint32_t n = i; n != 0; n >>= 1, digit /= 2)
  {
    inverse += (n & 1u) != 0 ? digit : 0.0;
  }
  return { (i + 0.5) / count, inverse };
}

/// Half vector about +z distributed as the GGX microfacets times their cosine (Walter et al. 2007, eq. 35 and 36).
Eigen::Vector3d halfVector(const Eigen::Vector2d& u, double alpha)
{
  const double cos2 = (1 - u.x()) / (1 + (alpha * alpha - 1) * u.x());
  const double sine = std::sqrt(std::max(0.0, 1 - cos2));
  const portable::SineCosine around = portable::sinCos(2 * pi * u.y());
  return { sine * around.cosine, sine * around.sine, std::sqrt(cos2) };
}

/// Half vector about +z distributed as the GGX microfacets that are seen from `v` with y = 0 (Heitz 2018, listing 1).
Eigen::Vector3d seenHalfVector(const Eigen::Vector2d& u, const Eigen::Vector3d& v, double alpha)
{
  const Eigen::Vector3d stretched = Eigen::Vector3d(alpha * v.x(), 0, v.z()).normalized();
  const double radius = std::sqrt(u.x());
  const portable::SineCosine around = portable::sinCos(2 * pi * u.y());
  const double across = radius * around.cosine;
  const double visible = (1 + stretched.z()) / 2;
  const double up = (1 - visible) * std::sqrt(1 - across * across) + visible * radius * around.sine;
  const double out = std::sqrt(std::max(0.0, 1 - across * across - up * up));
  const double x = out * stretched.x() - up * stretched.z();
  const double z = out * stretched.z() + up * stretched.x();
  return Eigen::Vector3d(alpha * x, alpha * across, std::max(0.0, z)).normalized();
}

/// A light direction about +z seen from +z, its weight, and the solid angle that it stands for.
struct LobeSample
{
  Eigen::Vector3d direction;
  double weight;
  double solidAngle;
};

std::vector<LobeSample> lobe(double alpha)
{
  std::vector<LobeSample> samples;
  for (std::uint32_t i = 0; i < std::uint32_t(samplesOfLobe); ++i)
  {
    const Eigen::Vector3d h = halfVector(hammersley(i, std::uint32_t(samplesOfLobe)), alpha);
    const Eigen::Vector3d l(2 * h.z() * h.x(), 2 * h.z() * h.y(), 2 * h.z() * h.z() - 1);
    if (l.z() <= 0)
    {
      continue;
    }
    const double a2 = alpha * alpha;
    const double d = h.z() * h.z() * (a2 - 1) + 1;
    const double density = a2 / (pi * d * d) / 4; // of l: D (n h) / (4 (v h)), and v = n
    samples.push_back({ l, l.z(), 1 / (samplesOfLobe * density) });
  }
  return samples;
}

std::vector<float> filtered(const Pyramid& pyramid, int width, double roughness)
{
  const std::vector<LobeSample> samples = lobe(roughness * roughness);
  double total = 0;
  std::vector<double> levels;
  for (const LobeSample& sample : samples)
  {
    total += sample.weight;
    levels.push_back(pyramid.levelOf(sample.solidAngle));
  }
  std::vector<float> result;
  const int height = width / 2;
  result.reserve(std::size_t(width) * height * 3);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const Eigen::Vector3d n = directionOf((x + 0.5) / width, (y + 0.5) / height);
      const Eigen::Vector3d side =
        (std::abs(n.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX()).cross(n).normalized();
      const Eigen::Vector3d other = n.cross(side);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const LobeSample& s = samples[i];
        const Eigen::Vector3d d = side * s.direction.x() + other * s.direction.y() + n * s.direction.z();
        sum += pyramid.at(d, levels[i]).cast<double>() * s.weight;
      }
      const Eigen::Vector3f mean = (sum / total).cast<float>();
      result.insert(result.end(), mean.data(), mean.data() + 3);
    }
  }
  return result;
}

} // namespace

Eigen::Vector3d EnvironmentLight::irradianceOn(const Eigen::Vector3d& normal) const
{
  const std::array<double, 9> terms = termsOf(normal);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    sum += terms[i] * this->irradiance[i];
  }
  return sum.cwiseMax(0.0);
}

Eigen::Vector3d EnvironmentLight::reflectedFrom(const Eigen::Vector3d& direction, double roughness) const
{
  const double level = std::clamp(roughness, 0.0, 1.0) * (levels - 1);
  const int low = std::min(int(level), levels - 2);
  const Eigen::Vector2d place = placeOf(direction);
  const auto at = [&](int i) -> Eigen::Vector3d
  { return bilinear(this->radiance[std::size_t(i)].data(), width >> i, width / 2 >> i, place).cast<double>(); };
  return at(low) * (low + 1 - level) + at(low + 1) * (level - low);
}

Eigen::Vector3d radianceFrom(const RadianceImage& image, const Eigen::Vector3d& direction)
{
  return bilinear(image, placeOf(direction.normalized())).cast<double>();
}

EnvironmentLight environmentLight(const RadianceImage& image, double intensity)
{
  const Pyramid pyramid(image, intensity);
  EnvironmentLight light;
  light.irradiance = irradianceOf(pyramid.level(0));
  light.radiance[0] = pyramid.level(0).rgb;
  for (int i = 1; i < EnvironmentLight::levels; ++i)
  {
    light.radiance[std::size_t(i)] =
      filtered(pyramid, EnvironmentLight::width >> i, double(i) / (EnvironmentLight::levels - 1));
  }
  return light;
}

std::vector<float> reflectanceTable()
{
  constexpr int size = EnvironmentLight::reflectanceSize;
  constexpr std::uint32_t count = 256;
  std::vector<float> table;
  for (int row = 0; row < size; ++row)
  {
    const double rough = (row + 0.5) / size;
    const double alpha = rough * rough;
    const double a2 = alpha * alpha;
    for (int column = 0; column < size; ++column)
    {
      const double nv = (column + 0.5) / size;
      const Eigen::Vector3d v(std::sqrt(1 - nv * nv), 0, nv);
      const double viewer = std::sqrt(nv * nv * (1 - a2) + a2);
      double scale = 0;
      double bias = 0;
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const Eigen::Vector3d h = seenHalfVector(hammersley(i, count), v, alpha);
        const double vh = std::max(v.dot(h), 0.0);
        const double nl = 2 * vh * h.z() - nv;
        if (nl <= 0)
        {
          continue;
        }
        // what of the seen facets the light reaches, too (Heitz 2014, eq. 99)
        const double weight = nl * (nv + viewer) / (nl * viewer + nv * std::sqrt(nl * nl * (1 - a2) + a2));
        const double fresnel = (1 - vh) * (1 - vh) * ((1 - vh) * (1 - vh)) * (1 - vh);
        scale += weight * (1 - fresnel);
        bias += weight * fresnel;
      }
      table.push_back(float(scale / count));
      table.push_back(float(bias / count));
    }
  }
  return table;
}

/// Of the nearest cell.
Eigen::Vector2d reflectanceOf(double cosine, double roughness)
{
  static const std::vector<float> table = reflectanceTable();
  constexpr int size = EnvironmentLight::reflectanceSize;
  const int column = std::clamp(int(cosine * size), 0, size - 1);
  const int row = std::clamp(int(roughness * size), 0, size - 1);
  const float* const cell = &table[2 * (std::size_t(row) * size + std::size_t(column))];
  return { cell[0], cell[1] };
}

Eigen::Vector3d backgroundOf(const SceneState& state, const Eigen::Vector3d& direction)
{
  const EnvironmentState* const environment = state.environment.get();
  return environment != nullptr && environment->background
           ? encoded(
               environment->intensity * radianceFrom(*environment->image, environment->image_from_world * direction))
           : state.background;
}

std::shared_ptr<const EnvironmentLight> environmentLight(const std::shared_ptr<const EnvironmentState>& environment)
{
  using Known = std::pair<std::weak_ptr<const EnvironmentState>, std::shared_ptr<const EnvironmentLight>>;
  static std::mutex mutex;
  static std::vector<Known> all;
  if (environment == nullptr)
  {
    return nullptr;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  all.erase(
    std::remove_if(all.begin(), all.end(), [](const Known& known) { return known.first.expired(); }), all.end());
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const Known& known) { return known.first.lock() == environment; });
  if (found != all.end())
  {
    return found->second;
  }
  all.emplace_back(environment,
    std::make_shared<const EnvironmentLight>(environmentLight(*environment->image, environment->intensity)));
  return all.back().second;
}

} // namespace dgtk
