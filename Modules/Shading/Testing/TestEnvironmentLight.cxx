// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEnvironmentLight.h"

#include "dgtkPortableMath.h"
#include "dgtkSceneState.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace dgtk;

namespace
{
/// The direction of a point of an equirectangular picture: -z in its middle, +x to the right, +y at its top.
Eigen::Vector3d towards(double x, double y)
{
  const double around = (x - 0.5) * 2 * M_PI;
  return { std::sin(y * M_PI) * std::sin(around), std::cos(y * M_PI), -std::sin(y * M_PI) * std::cos(around) };
}

using Radiance = std::function<double(const Eigen::Vector3d&)>;

/// Red is the radiance, green half and blue a quarter of it.
RadianceImage pictureOf(const Radiance& radiance, int width, int height)
{
  RadianceImage image{ width, height, {} };
  for (int i = 0; i < width * height; ++i)
  {
    const double value = radiance(towards((i % width + 0.5) / width, (i / width + 0.5) / height));
    image.rgb.insert(image.rgb.end(), { float(value), float(value / 2), float(value / 4) });
  }
  return image;
}

void expectColor(const Eigen::Vector3d& found, double red, double tolerance)
{
  EXPECT_LE((found - red * Eigen::Vector3d(1, 0.5, 0.25)).norm(), tolerance) << found.transpose() << " for " << red;
}

std::vector<Eigen::Vector3d> someDirections()
{
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 40; ++i)
  {
    all.push_back(towards(std::fmod(0.618 * i, 1), (i + 0.5) / 40));
  }
  return all;
}

/// Of microfacets: what Karis's filter leaves of a radiance that grows linearly along the normal.
double linearPart(double roughness)
{
  const double a2 = std::pow(roughness, 4);
  double sum = 0;
  double weights = 0;
  constexpr int steps = 100000; // equal parts of the half vectors that D cos gives
  for (int i = 0; i < steps; ++i)
  {
    const double u = (i + 0.5) / steps;
    const double light = 2 * (1 - u) / (1 + (a2 - 1) * u) - 1;
    sum += light > 0 ? light * light : 0;
    weights += light > 0 ? light : 0;
  }
  return sum / weights;
}

/// Light that a surface without a colour of its own reflects: D G F / (4 n.l n.v), integrated over the hemisphere.
Eigen::Vector2d reflected(double nv, double roughness)
{
  const double a2 = std::pow(roughness, 4);
  const Eigen::Vector3d v(std::sqrt(1 - nv * nv), 0, nv);
  Eigen::Vector2d sum(0, 0);
  constexpr int steps = 400;
  for (int i = 0; i < steps * steps; ++i)
  {
    const double nl = (i / steps + 0.5) / steps; // NOLINT: of the row
    const double around = (i % steps + 0.5) / steps * M_PI;
    const double sine = std::sqrt(1 - nl * nl);
    const Eigen::Vector3d l(sine * std::cos(around), sine * std::sin(around), nl);
    const Eigen::Vector3d h = (l + v).normalized();
    const double below = h.z() * h.z() * (a2 - 1) + 1;
    const auto shadowed = [a2](double c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
    // separate masking and shadowing of Smith in the form that knows of each other
    const auto lambda = [&](double c) { return 1 / shadowed(c) - 0.5; };
    const double masking = 1 / (lambda(nl) + lambda(nv));
    const double value = a2 / (M_PI * below * below) * masking / (4 * nv) * (2 * M_PI / steps / steps);
    const double fresnel = std::pow(1 - v.dot(h), 5);
    sum += value * Eigen::Vector2d(1 - fresnel, fresnel);
  }
  return sum;
}
} // namespace

TEST(EnvironmentLight, LooksAlongDirectionsOfItsImage)
{
  // texels of a quarter by a half, from the top left
  RadianceImage image{ 4, 2, {} };
  for (int i = 0; i < 8; ++i)
  {
    image.rgb.insert(image.rgb.end(), { float(1 << i), float(i), 1 });
  }
  const auto at = [&](double x, double y) { return radianceFrom(image, 3 * towards(x, y)); };
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3d found = at((i % 4 + 0.5) / 4, (i / 4 + 0.5) / 2); // NOLINT: of the row
    EXPECT_LE((found - Eigen::Vector3d(1 << i, i, 1)).norm(), 1e-4) << i;
  }
  EXPECT_NEAR(at(0.5, 0.25).x(), 3, 1e-5) << "between the second and the third";
  EXPECT_NEAR(at(0.4375, 0.25).x(), 0.75 * 2 + 0.25 * 4, 1e-5);
  EXPECT_NEAR(at(1e-9, 0.25).x(), 4.5, 1e-5) << "between the last and the first";
  EXPECT_NEAR(at(0.125, 0.5).x(), 8.5, 1e-5) << "between the rows";
  EXPECT_NEAR(at(0.125, 0.375).x(), 0.75 + 0.25 * 16, 1e-5);
  EXPECT_NEAR(at(0.125, 0.01).x(), 1, 1e-5) << "nothing is above the first row";
  EXPECT_NEAR(at(0.125, 0.99).x(), 16, 1e-5);
}

// Diffuse surfaces leave of harmonics of degree 0, 1 and 2 the whole, 2/3 and 1/4 (Ramamoorthi and Hanrahan 2001).
TEST(EnvironmentLight, IrradianceIsThatOfTheHarmonics)
{
  const auto sum = [](const Eigen::Vector3d& d, double first, double second)
  {
    return 3 + first * (0.1 * d.x() + 0.3 * d.y() - 0.2 * d.z()) +
           second * (0.4 * d.x() * d.y() - 0.5 * d.y() * d.z() + 0.6 * d.x() * d.z() + 0.25 * (3 * d.z() * d.z() - 1) +
                      0.35 * (d.x() * d.x() - d.y() * d.y()));
  };
  const EnvironmentLight light =
    environmentLight(pictureOf([&](const Eigen::Vector3d& d) { return sum(d, 1, 1); }, 512, 256), 2);
  for (const Eigen::Vector3d& n : someDirections())
  {
    expectColor(light.irradianceOn(n), 2 * sum(n, 2.0 / 3, 0.25), 2e-4);
    expectColor(light.reflectedFrom(n, 0), 2 * sum(n, 1, 1), 2e-3); // a mirror
  }
}

TEST(EnvironmentLight, IrradianceIsNeverNegative)
{
  EnvironmentLight light;
  light.irradiance.fill(Eigen::Vector3d(0, 0, 0));
  light.irradiance[0] = { 0.25, 0.5, 1 };
  light.irradiance[1] = { 1, 1, 1 }; // times y
  EXPECT_EQ(light.irradianceOn({ 0, -0.5, 0 }), Eigen::Vector3d(0, 0, 0.5));
}

TEST(EnvironmentLight, EachTexelIsTheMeanOfItsPart)
{
  RadianceImage image{ 1024, 512, std::vector<float>(std::size_t(1024) * 512 * 3) };
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
  {
    const std::size_t x = i / 3 % 1024;
    const std::size_t y = i / 3 / 1024;
    image.rgb[i] = float(1 + x % 2 + 4 * (y % 2)); // 1 2 / 5 6
  }
  const EnvironmentLight light = environmentLight(image, 2);
  EXPECT_EQ(light.radiance[0], std::vector<float>(std::size_t(512) * 256 * 3, 7.0F));
  for (std::size_t level = 1; level < EnvironmentLight::levels; ++level)
  {
    EXPECT_EQ(light.radiance[level].size(), light.radiance[level - 1].size() / 4);
    for (const float value : light.radiance[level])
    {
      ASSERT_NEAR(double(value), 7, 1e-5);
    }
  }
}

// Texel i has red 1 and green i: between the middles of the outer ones green grows evenly along rows and columns.
TEST(EnvironmentLight, SmallPicturesAreInterpolated)
{
  RadianceImage image{ 4, 2, {} };
  for (int i = 0; i < 8; ++i)
  {
    image.rgb.insert(image.rgb.end(), { 1, float(i), 0 });
  }
  const EnvironmentLight light = environmentLight(image, 0.5);
  for (int x = 70; x < 440; x += 37)
  {
    for (int y = 3; y < 256; y += 23)
    {
      const double across = (x + 0.5) / 128 - 0.5;
      const double down = std::clamp((y + 0.5) / 128 - 0.5, 0.0, 1.0);
      const Eigen::Vector3d found = light.reflectedFrom(towards((x + 0.5) / 512, (y + 0.5) / 256), 0);
      EXPECT_NEAR(found.x(), 0.5, 1e-6);
      EXPECT_NEAR(found.y(), 0.5 * (across + 4 * down), 1e-4) << x << ' ' << y;
    }
  }
}

// A picture of half the size: a texel more or less is 2 pi / 256.
TEST(EnvironmentLight, RougherSurfacesSeeWiderLobes)
{
  const auto slope = [](const Eigen::Vector3d& d) { return 0.6 * d.x() + 0.48 * d.y() + 0.64 * d.z(); };
  const EnvironmentLight light =
    environmentLight(pictureOf([&](const Eigen::Vector3d& d) { return 2 + slope(d); }, 256, 128), 0.5);
  for (int level = 0; level < EnvironmentLight::levels; ++level)
  {
    const double roughness = level / 5.0;
    for (const Eigen::Vector3d& d : someDirections())
    {
      const double expected = 2 + (level == 0 ? 1 : linearPart(roughness)) * slope(d);
      expectColor(light.reflectedFrom(d, roughness), 0.5 * expected, 0.5 * 0.06);
    }
  }
}

// The lobe of the facets seen along the normal, D (n h) / (4 (v h)), times the light's cosine. It is made of few looks,
// each at a picture as coarse as the part of the lobe that it stands for: what is left is even to a quarter.
TEST(EnvironmentLight, OneBrightTexelIsSpreadOverTheLobe)
{
  constexpr int width = EnvironmentLight::width;
  RadianceImage image{ width, width / 2, std::vector<float>(std::size_t(width) * width / 2 * 3) };
  image.rgb[(std::size_t(width / 4) * width + width / 2) * 3] = 1e5F;
  const Eigen::Vector3d sun = towards(0.5 + 0.5 / width, 0.5 + 1.0 / width);
  const double power = 1e5 * 2 * M_PI / width * 2 * M_PI / width; // near the equator
  const EnvironmentLight light = environmentLight(image, 1);
  for (int level = 1; level < EnvironmentLight::levels; ++level)
  {
    const double a2 = std::pow(level / 5.0, 4);
    const auto lobe = [a2](double cosine)
    {
      const double spread = (1 + cosine) / 2 * (a2 - 1) + 1;
      return cosine > 0 ? cosine * a2 / (4 * M_PI * spread * spread) : 0;
    };
    double whole = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i)
    {
      whole += lobe((i + 0.5) / steps) * 2 * M_PI / steps;
    }
    double sum = 0;
    double expectedSum = 0;
    double differences = 0;
    const int columns = width >> level;
    for (int i = 0; i < columns * columns / 2; ++i)
    {
      const double down = (i / columns + 0.5) / (columns / 2); // NOLINT: of the row
      const Eigen::Vector3d d = towards((i % columns + 0.5) / columns, down);
      const double expected = power * lobe(d.dot(sun)) / whole;
      const double found = light.reflectedFrom(d, level / 5.0).x();
      const double area = std::sin(down * M_PI);
      sum += area * found;
      expectedSum += area * expected;
      differences += area * std::abs(found - expected);
    }
    EXPECT_NEAR(sum / expectedSum, 1, 0.1) << level;
    EXPECT_LE(differences / expectedSum, 0.35) << level;
  }
}

TEST(EnvironmentLight, RoughnessIsInterpolatedBetweenTheLevels)
{
  EnvironmentLight light;
  for (int level = 0; level < EnvironmentLight::levels; ++level)
  {
    const std::size_t texels = std::size_t(EnvironmentLight::width >> level) * (EnvironmentLight::width / 2 >> level);
    light.radiance[std::size_t(level)].assign(texels * 3, float(1 << level));
  }
  const auto at = [&](double roughness) { return light.reflectedFrom({ 0.36, 0.48, 0.8 }, roughness).y(); };
  for (int level = 0; level < EnvironmentLight::levels; ++level)
  {
    EXPECT_NEAR(at(level / 5.0), 1 << level, 1e-12);
  }
  EXPECT_NEAR(at(0.1), 1.5, 1e-12);
  EXPECT_NEAR(at(0.85), 16 + 0.25 * 16, 1e-12);
  EXPECT_EQ(at(-0.5), 1);
  EXPECT_EQ(at(1.5), 32);
}

TEST(EnvironmentLight, ReflectanceIsTheIntegralOfTheFacets)
{
  const auto cell = [](int i) { return (i + 0.5) / EnvironmentLight::reflectanceSize; };
  for (const int column : { 1, 5, 20, 40, 63 })
  {
    // as good as a mirror: Schlick's formula
    const double fresnel = std::pow(1 - cell(column), 5);
    const Eigen::Vector2d mirror = reflectanceOf(cell(column), 0);
    EXPECT_NEAR(mirror.x(), 1 - fresnel, 1e-3) << column;
    EXPECT_NEAR(mirror.y(), fresnel, 1e-3) << column;
    for (const int row : { 25, 31, 50, 63 })
    {
      const Eigen::Vector2d expected = reflected(cell(column), cell(row));
      const Eigen::Vector2d found = reflectanceOf(cell(column), cell(row));
      EXPECT_LE((found - expected).norm(), 0.004)
        << column << ' ' << row << ": " << found.transpose() << " for " << expected.transpose();
    }
  }
}

TEST(EnvironmentLight, ReflectanceIsThatOfTheNearestCell)
{
  const std::vector<float> table = reflectanceTable();
  constexpr int size = EnvironmentLight::reflectanceSize;
  ASSERT_EQ(table.size(), std::size_t(2 * size * size));
  const auto expectCell = [&](double cosine, double roughness, int column, int row)
  {
    const std::size_t at = 2 * std::size_t(row * size + column);
    EXPECT_EQ(reflectanceOf(cosine, roughness), Eigen::Vector2d(double(table[at]), double(table[at + 1])));
  };
  expectCell(0, 0, 0, 0);
  expectCell(10.01 / size, 40.99 / size, 10, 40);
  expectCell(10.99 / size, 40.01 / size, 10, 40);
  expectCell(1, 1, size - 1, size - 1);
  expectCell(-0.5, 0.5, 0, size / 2);
}

TEST(EnvironmentLight, IsMadeOnceWhileItsSceneIsThere)
{
  EXPECT_EQ(environmentLight(std::shared_ptr<const EnvironmentState>()), nullptr);
  const auto image = std::make_shared<RadianceImage>(RadianceImage{ 1, 1, { 1, 1, 1 } });
  auto one = std::make_shared<EnvironmentState>();
  one->image = image;
  one->intensity = 3;
  const auto light = environmentLight(std::shared_ptr<const EnvironmentState>(one));
  EXPECT_EQ(environmentLight(std::shared_ptr<const EnvironmentState>(one)), light);
  EXPECT_EQ(light->radiance[0][0], 3);
  auto other = std::make_shared<EnvironmentState>(*one);
  EXPECT_NE(environmentLight(std::shared_ptr<const EnvironmentState>(other)), light);
  const std::weak_ptr<const EnvironmentLight> known = environmentLight(std::shared_ptr<const EnvironmentState>(other));
  other.reset();
  environmentLight(std::shared_ptr<const EnvironmentState>(one));
  EXPECT_TRUE(known.expired()) << "nothing is kept for scenes that are gone";
}

TEST(EnvironmentLight, IsSeenWhereNothingIs)
{
  SceneState state;
  state.background = { 0.1, 0.2, 0.3 };
  EXPECT_EQ(backgroundOf(state, { 1, 0, 0 }), state.background);
  auto environment = std::make_shared<EnvironmentState>();
  environment->image =
    std::make_shared<RadianceImage>(pictureOf([](const Eigen::Vector3d& d) { return d.x() > 0 ? 0.8 : 0.2; }, 8, 4));
  environment->intensity = 0.5;
  environment->image_from_world = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  state.environment = environment;
  // the world's -y is the image's +x
  const Eigen::Vector3d bright(
    portable::srgbFromLinear(0.4), portable::srgbFromLinear(0.2), portable::srgbFromLinear(0.1));
  EXPECT_LE((backgroundOf(state, { 0, -2, 0 }) - bright).norm(), 1e-6);
  EXPECT_NEAR(backgroundOf(state, { 0, 2, 0 }).x(), portable::srgbFromLinear(0.1), 1e-6);
  environment->background = false;
  EXPECT_EQ(backgroundOf(state, { 0, -2, 0 }), state.background);
}
