// SPDX-License-Identifier: BSD-3-Clause
// The laws of surfaces: the light of the world and of lights, highlights, pictures and fog against closed forms.
#include "dgtkShadedGround.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace dgtk;
using namespace dgtk::test;

TEST(PhongLaw, IsTheSumOfItsTerms)
{
  const auto model = groundModel();
  Material& material = model->materials[0];
  material.ambient = { 0.3, 0.2, 0.1 };
  material.diffuse = { 0.5, 0.7, 0.6 };
  material.specular = { 0.4, 0.2, 0.3 };
  material.emission = { 0.01, 0.02, 0.05 };
  material.shininess = 7;
  const auto state = SceneBuilder().add(model).state();
  LightState near = lightAt(LightKind::Point, { 1, 2, 0.5 });
  near.attenuation = { 0.5, 0.2, 0.1 };
  near.intensity = 0.8;
  near.ambient = { 0.1, 0.2, 0.3 };
  near.diffuse = { 0.4, 0.3, 0.2 };
  near.specular = { 0.2, 0.5, 0.4 };
  LightState far = lightAt(LightKind::Directional, { 3, 4, -1 });
  far.intensity = 0.6;
  far.ambient = { 0.3, 0.1, 0.2 };
  far.diffuse = { 0.2, 0.4, 0.3 };
  far.specular = { 0.5, 0.3, 0.6 };
  state->lights = { near, far };
  const View view = fromAbove();
  const Eigen::Vector3d eye = view.camera_from_world.inverse().translation;
  for (const double density : { 0.0, 0.2 })
  {
    state->fog.color = { 0.9, 0.1, 0.4 };
    state->fog.density = density;
    state->fog.start = 6;
    const Picture picture = draw(state, view);
    const int seen = forGround(view, picture,
      [&](int x, int y, const Eigen::Vector3d& p)
      {
        Eigen::Array3d color = material.emission.array() + 0.2 * material.ambient.array(); // the light of the world
        const Eigen::Vector3d toEye = (eye - p).normalized();
        for (const LightState& light : state->lights)
        {
          const double d = (light.position - p).norm();
          const bool fades = light.kind == LightKind::Point;
          const double strength = light.intensity / (fades ? 0.5 + 0.2 * d + 0.1 * d * d : 1);
          const Eigen::Vector3d toLight = (fades ? light.position - p : light.position).normalized();
          const Eigen::Vector3d mirrored(-toLight.x(), toLight.y(), -toLight.z());
          color += strength * (light.ambient.array() * material.ambient.array() +
                                toLight.y() * light.diffuse.array() * material.diffuse.array() +
                                std::pow(std::max(0.0, mirrored.dot(toEye)), 7) * light.specular.array() *
                                  material.specular.array());
        }
        const double clear = std::exp(-density * std::max(0.0, (eye - p).norm() - 6));
        color = state->fog.color.array() + (color - state->fog.color.array()) * clear;
        for (int c = 0; c < 3; ++c)
        {
          ASSERT_NEAR(picture.at(x, y, c), color[c], 0.02 * step) << x << ' ' << y << " channel " << c;
        }
      });
    EXPECT_GT(seen, 10000);
  }
}

/// Alone, it takes the viewer to be where it is; among others, its highlight is that of Phong.
TEST(PhongLaw, HighlightOfAHeadLight)
{
  const auto model = groundModel();
  model->materials[0].diffuse.setZero();
  model->materials[0].specular.setOnes();
  model->materials[0].shininess = 5;
  const View view = fromAbove();
  const Eigen::Vector3d eye = view.camera_from_world.inverse().translation;
  const Eigen::Vector3d toLight = -view.camera_from_world.rotation.row(2);
  const Eigen::Vector3d mirrored(-toLight.x(), toLight.y(), -toLight.z());
  for (const bool alone : { true, false })
  {
    const auto state = SceneBuilder().add(model).state();
    state->lights.push_back(lightAt(LightKind::Head, { 0, 0, 0 }));
    if (!alone)
    {
      state->lights.push_back(lightAt(LightKind::Directional, { 0, -1, 0 })); // from below
    }
    const Picture picture = draw(state, view);
    forGround(view, picture,
      [&](int x, int y, const Eigen::Vector3d& p)
      {
        const double cosine = alone ? toLight.y() : std::max(0.0, mirrored.dot((eye - p).normalized()));
        ASSERT_NEAR(picture.at(x, y), std::pow(cosine, 5), 0.02 * step) << x << ' ' << y;
      });
  }
}

namespace
{
/// A ground of a material that may use pictures of one colour each.
std::shared_ptr<Model> mappedGround(const std::vector<std::array<std::uint8_t, 3>>& colors)
{
  const auto model = groundModel();
  model->textures.clear();
  for (const auto& color : colors)
  {
    auto image = std::make_shared<Image>();
    image->width = image->height = 1;
    image->rgba = { color[0], color[1], color[2], 255 };
    model->textures.push_back({ "", "", image });
  }
  return model;
}

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double display(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
} // namespace

/// A picture of emissions is its only one; without it they are seen through that of the surface.
TEST(PhongLaw, PicturesOfEmissions)
{
  for (const bool mapped : { false, true })
  {
    const auto model = mappedGround({ { 51, 102, 204 }, { 153, 51, 255 } });
    Material& material = model->materials[0];
    material.ambient = { 1, 0.5, 0.25 };
    material.emission = { 0.25, 0.5, 0.125 };
    material.texture = 0;
    material.emissionMap = mapped ? 1 : -1;
    const Picture picture = draw(SceneBuilder().add(model).state(), fromAbove());
    const Eigen::Array3d texture(0.2, 0.4, 0.8);
    const Eigen::Array3d glow = mapped ? Eigen::Array3d(0.6, 0.2, 1) : texture;
    for (int c = 0; c < 3; ++c)
    {
      const double expected = 0.2 * material.ambient[c] * texture[c] + material.emission[c] * glow[c];
      EXPECT_NEAR(picture.at(80, 60, c), expected, 0.02 * step) << mapped << " channel " << c;
    }
  }
}

TEST(PhongLaw, WhereALostPictureOfEmissionsWouldGlowNothingDoes)
{
  const auto model = mappedGround({ { 51, 102, 204 } });
  model->textures.push_back({ "lost", "lost.png", nullptr });
  Material& material = model->materials[0];
  material.ambient = { 1, 0.5, 0.25 };
  material.emission = { 0.25, 0.5, 0.125 };
  material.emissionMap = 1;
  const Picture picture = draw(SceneBuilder().add(model).state(), fromAbove());
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(picture.at(80, 60, c), 0.2 * material.ambient[c], 0.02 * step) << c; // the light of the world
  }
}

/// Walter et al. 2007, in linear light, with all pictures, two lights and fog.
TEST(PhysicalLaw, IsTheSumOfItsTerms)
{
  const auto model = mappedGround({ { 9, 102, 153 }, { 51, 9, 9 }, { 204, 102, 51 } });
  Material& material = model->materials[0];
  material.diffuse = { 0.8, 0.5, 0.2 };
  material.emission = { 0.1, 0.3, 0.5 };
  material.physical = Material::Physical{ 0.5, 0.75, true };
  material.metallicRoughnessMap = 0;
  material.occlusionMap = 1;
  material.occlusionStrength = 0.5;
  material.emissionMap = 2;
  const double metallic = 0.5 * 0.6;
  const double a2 = std::pow(0.75 * 0.4, 4);
  const double occlusion = 1 + 0.5 * (0.2 - 1);
  const auto state = SceneBuilder().add(model).state();
  LightState near = lightAt(LightKind::Point, { 1, 2, 0.5 });
  near.attenuation = { 1, 0.2, 0.1 };
  near.ambient = { 0.1, 0.2, 0.3 };
  near.diffuse = { 0.4, 0.3, 0.2 };
  near.specular = { 0.2, 0.5, 0.4 };
  LightState far = lightAt(LightKind::Directional, { 3, 4, -1 });
  far.diffuse = { 0.2, 0.4, 0.3 };
  far.specular = { 0.3, 0.2, 0.1 };
  state->lights = { near, far };
  state->fog.color = { 0.7, 0.1, 0.4 };
  state->fog.density = 0.1;
  state->fog.start = 6;
  const View view = fromAbove();
  const Eigen::Vector3d eye = view.camera_from_world.inverse().translation;
  const Picture picture = draw(state, view);
  forGround(view, picture,
    [&](int x, int y, const Eigen::Vector3d& p)
    {
      const Eigen::Vector3d v = (eye - p).normalized();
      for (int c = 0; c < 3; ++c)
      {
        const double base = linear(material.diffuse[c]);
        const double f0 = 0.04 * (1 - metallic) + base * metallic;
        const double albedo = base * (1 - metallic);
        double sum = linear(material.emission[c] * std::array<double, 3>{ 0.8, 0.4, 0.2 }[std::size_t(c)]);
        double ambient = 0.2; // the light of the world
        for (const LightState& light : state->lights)
        {
          const double d = (light.position - p).norm();
          const bool fades = light.kind == LightKind::Point;
          const double strength = fades ? 1 / (1 + 0.2 * d + 0.1 * d * d) : 1;
          const Eigen::Vector3d l = (fades ? light.position - p : light.position).normalized();
          const Eigen::Vector3d h = (l + v).normalized();
          const double spread = h.y() * h.y() * (a2 - 1) + 1;
          const double masking =
            l.y() * std::sqrt(v.y() * v.y() * (1 - a2) + a2) + v.y() * std::sqrt(l.y() * l.y() * (1 - a2) + a2);
          const double f = f0 + (1 - f0) * std::pow(1 - v.dot(h), 5);
          sum += strength * l.y() *
                 (albedo * (1 - f) * light.diffuse[c] + f * a2 / (spread * spread) / (2 * masking) * light.specular[c]);
          ambient += light.ambient[c] * strength;
        }
        sum += linear(ambient) * occlusion * (albedo + f0);
        const double clear = std::exp(-0.1 * std::max(0.0, (eye - p).norm() - 6));
        const double fog = linear(state->fog.color[c]);
        ASSERT_NEAR(picture.at(x, y, c), display(fog + (sum - fog) * clear), 0.05 * step) << x << ' ' << y << ' ' << c;
      }
    });
}

/// Under a sky of one colour a smooth metal has it times Schlick's reflectance.
TEST(PhysicalLaw, SmoothMetalUnderAnEvenSky)
{
  const auto model = groundModel(20);
  Material& material = model->materials[0];
  material.diffuse = { 0.3, 0.5, 0.8 };
  material.physical = Material::Physical{ 1, 0, true };
  const auto state = SceneBuilder().add(model).state();
  auto sky = std::make_shared<EnvironmentState>();
  sky->image = std::make_shared<RadianceImage>(RadianceImage{ 1, 1, { 0.5F, 0.5F, 0.5F } });
  state->environment = sky;
  ViewOptions options;
  options.width = 160;
  options.height = 120;
  options.eye = { 0, 2, 6 };
  const View view = makeView(options);
  const Eigen::Vector3d eye = view.camera_from_world.inverse().translation;
  const Picture picture = draw(state, view);
  double least = 1;
  forGround(view, picture,
    [&](int x, int y, const Eigen::Vector3d& p)
    {
      const double cosine = (eye - p).normalized().y();
      least = std::min(least, cosine);
      for (int c = 0; c < 3; ++c)
      {
        const double f0 = linear(material.diffuse[c]);
        const double expected = 0.5 * (f0 + (1 - f0) * std::pow(1 - cosine, 5));
        ASSERT_NEAR(linear(picture.at(x, y, c)), expected, 0.0015) << cosine << " channel " << c; // of a table
      }
    });
  EXPECT_LT(least, 0.15);
}
