// SPDX-License-Identifier: BSD-3-Clause
// Phong's law: the light of the world and of lights, highlights and fog against closed forms.
#include "dgtkShadedGround.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

TEST(PhongLaw, IsTheSumOfItsTerms)
{
  QuadOptions floor;
  floor.corner = { -4, 0, 4 };
  floor.sideU = { 8, 0, 0 };
  floor.sideV = { 0, 0, -8 };
  const auto model = matte(makeQuad(floor));
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
  QuadOptions floor;
  floor.corner = { -4, 0, 4 };
  floor.sideU = { 8, 0, 0 };
  floor.sideV = { 0, 0, -8 };
  const auto model = matte(makeQuad(floor));
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
