// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorMap.h"
#include "dgtkCutOutColors.h"
#include "dgtkLightLaw.h"
#include "dgtkSurfaceMaterial.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <memory>

using namespace dgtk;

namespace
{
/// A picture whose red is `values`, with green one and blue two more; -1: a hole.
Image holed(int width, const std::vector<int>& values, int alphaOfHoles = 0, int alphaOfOthers = 255)
{
  Image image;
  image.width = width;
  image.height = int(values.size()) / width;
  for (const int value : values)
  {
    const int alpha = value < 0 ? alphaOfHoles : alphaOfOthers;
    for (const int channel : { value < 0 ? 7 : value, value < 0 ? 7 : value + 1, value < 0 ? 7 : value + 2, alpha })
    {
      image.rgba.push_back(std::uint8_t(channel));
    }
  }
  return image;
}

void expectFilled(const Image& image, const std::vector<int>& expected)
{
  const std::vector<std::uint8_t> filled = withoutHoles(image);
  ASSERT_EQ(filled.size(), expected.size() * 4);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(int(filled[4 * i + std::size_t(c)]), expected[i] + c) << "texel " << i;
    }
    EXPECT_EQ(filled[4 * i + 3], image.rgba[4 * i + 3]) << "texel " << i;
  }
}
} // namespace

TEST(CutOutColors, HolesAreFilledRingByRing)
{
  // around a row that repeats: beside 0 and 90 first, the one between two rings has the mean of both
  const std::vector<int> row{ 0, -1, -1, 90, -1, -1, -1 };
  const std::vector<int> filled{ 0, 0, 90, 90, 90, 45, 0 };
  expectFilled(holed(7, row), filled);
  expectFilled(holed(1, row), filled);                    // a column
  expectFilled(holed(3, { 10, -1, 21 }), { 10, 16, 21 }); // 15.5 is rounded up
  // from the right, the left, below and above
  expectFilled(holed(3, { 100, 60, 100, 20, -1, 30, 100, 90, 100 }), { 100, 60, 100, 20, 50, 30, 100, 90, 100 });
}

TEST(CutOutColors, TexelsAreThereFromTheMiddleOn)
{
  expectFilled(holed(3, { 10, -1, 20 }, 127, 128), { 10, 15, 20 });
  const Image whole = holed(3, { 10, -1, 20 }, 128, 128);
  EXPECT_EQ(withoutHoles(whole), whole.rgba);
  const Image none = holed(2, { -1, -1, -1, -1 });
  EXPECT_EQ(withoutHoles(none), none.rgba);
}

TEST(VertexColor, IsTheVertexsOwnBeforeThatOfAMap)
{
  using Bytes = std::array<std::uint8_t, 4>;
  Model model;
  EXPECT_EQ(vertexColor(model, 1), (Bytes{ 255, 255, 255, 255 }));
  const Image map = holed(2, { 10, 20, 30, 40 });
  model.colorMap = std::make_shared<Image>(map);
  model.colorMapAt = { { 0.25, 0.25 }, { 0.75, 0.25 }, { 0.5, 0.5 }, { -3, 9 } };
  EXPECT_EQ(vertexColor(model, 0), (Bytes{ 30, 31, 32, 255 })) << "the lower row is the first";
  EXPECT_EQ(vertexColor(model, 1), (Bytes{ 40, 41, 42, 255 }));
  EXPECT_EQ(vertexColor(model, 2), (Bytes{ 20, 21, 22, 255 })) << "texels begin at their lower left";
  EXPECT_EQ(vertexColor(model, 3), (Bytes{ 10, 11, 12, 255 })) << "beyond a border it goes on";
  model.colors.assign(4, Bytes{ 1, 2, 3, 4 });
  EXPECT_EQ(vertexColor(model, 1), (Bytes{ 1, 2, 3, 4 }));
}

TEST(SurfaceMaterial, FacetsAreAsWideAsPhongsLobe)
{
  Material material;
  material.shininess = 30; // alpha = sqrt(2 / (30 + 2)) = 1/4, roughness = sqrt(alpha)
  material.specular = { 0.5, 1, 0.25 };
  FacetedSurface surface = facetsOf(material);
  EXPECT_EQ(surface.metallic, 0);
  EXPECT_NEAR(surface.roughness, 0.5, 1e-15);
  EXPECT_LE((surface.f0 - Eigen::Vector3d(0.02, 0.04, 0.01)).norm(), 1e-15);
  material.physical = Material::Physical{ 0.75, 0.3, true };
  surface = facetsOf(material);
  EXPECT_EQ(surface.metallic, 0.75);
  EXPECT_EQ(surface.roughness, 0.3);
  EXPECT_EQ(surface.f0, Eigen::Vector3d(0.04, 0.04, 0.04));
}

TEST(SurfaceMaterial, NormalsStayUprightOnTheirSide)
{
  Eigen::Matrix3d m;
  m << 2, 1, 0, 0.5, -3, 1, 0, 0.25, 4;
  for (const double mirror : { 1.0, -1.0 })
  {
    m.col(0) *= mirror;
    const Eigen::Matrix3d expected = m.inverse().transpose();
    const Eigen::Matrix3d found = normalMatrix(m);
    EXPECT_NEAR(found.cwiseAbs().maxCoeff(), 1, 1e-15);
    EXPECT_LE((found / found.norm() - expected / expected.norm()).norm(), 1e-14);
  }
  // what is flattened along z still has normals along it, what is a point none
  EXPECT_EQ(
    normalMatrix(Eigen::Vector3d(2, 3, 0).asDiagonal()), Eigen::Matrix3d(Eigen::Vector3d(0, 0, 1).asDiagonal()));
  EXPECT_EQ(normalMatrix(Eigen::Matrix3d::Zero()), Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
}

TEST(LightLaw, ConesOfAHalfSpaceAreNone)
{
  LightState light;
  light.kind = LightKind::Spot;
  light.coneAngle = 89.9;
  EXPECT_EQ(lightLawOf(light), LightLaw::Cone);
  light.coneAngle = 90;
  EXPECT_EQ(lightLawOf(light), LightLaw::Point);
  light.kind = LightKind::Directional;
  EXPECT_EQ(lightLawOf(light), LightLaw::Parallel);
}

TEST(LightLaw, ConesFadeFromTheirAxisToTheirEdge)
{
  LightState light;
  light.kind = LightKind::Spot;
  light.position = { 1, 2, 3 };
  light.target = { 1, 2, -5 };
  light.attenuation = { 2, 0.5, 0.25 };
  light.coneAngle = 60;
  light.exponent = 3;
  Eigen::Matrix3d turn; // x to y, y to z, z to x
  turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const LightShape shape = lightShape(light, turn, { 10, 20, 30 }, { 0, 0, 1 });
  EXPECT_EQ(shape.position, Eigen::Vector3d(13, 21, 32));
  EXPECT_EQ(shape.axis, Eigen::Vector3d(-1, 0, 0));
  LightPoints points{};
  for (std::size_t i = 0; i < LightPoints::count; ++i)
  {
    const double angle = (4.0 * double(i) + 1) * M_PI / 180; // up to 61 degrees
    points.x[i] = 13 - 8 * std::cos(angle);
    points.y[i] = 21 + 8 * std::sin(angle);
    points.z[i] = 32;
  }
  points.x[15] = 13; // where the light is
  points.y[15] = 21;
  LightRays rays;
  lightLaw(LightLaw::Cone).rays(shape, points, rays);
  for (std::size_t i = 0; i < LightPoints::count - 1; ++i)
  {
    const double inside = std::cos((4.0 * double(i) + 1) * M_PI / 180);
    EXPECT_NEAR(rays.strength[i], std::pow(inside, 3) / (2 + 4 + 16), 1e-14) << i;
    EXPECT_NEAR(rays.x[i], inside, 1e-14);
    EXPECT_NEAR(rays.y[i], -std::sqrt(1 - inside * inside), 1e-14);
  }
  EXPECT_EQ(rays.x[15], 0) << "no direction, but a number";
  points.x[15] = 13 - 8 * std::cos(61 * M_PI / 180);
  points.y[15] = 21 + 8 * std::sin(61 * M_PI / 180);
  lightLaw(LightLaw::Cone).rays(shape, points, rays);
  EXPECT_EQ(rays.strength[15], 0) << "beyond the cone";
}
