// SPDX-License-Identifier: BSD-3-Clause
// The light that views give to VTK, without drawing it.
#include "dgtkViewChecks.h"
#include "dgtkViewLights.h"

#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkSkybox.h>
#include <vtkTexture.h>

#include <cmath>
#include <memory>
#include <vector>

namespace
{
using namespace dgtk;
using test::actorsOf;
using test::expectVector;
using V = Eigen::Vector3d;

std::vector<vtkLight*> lightsOf(vtkRenderer* renderer)
{
  std::vector<vtkLight*> lights;
  vtkLightCollection* const all = renderer->GetLights();
  all->InitTraversal();
  while (vtkLight* const light = all->GetNextItem())
  {
    lights.push_back(light);
  }
  return lights;
}

class ViewLightsTable : public testing::Test
{
protected:
  vtkNew<vtkRenderer> Renderer;
  ViewLights Lights{ Renderer };
  SceneState Surroundings;
  ViewCamera Front{ ViewKind::Front };
};

TEST_F(ViewLightsTable, EveryKindOfLight)
{
  LightState light;
  light.position = V(1, 2, 3);
  light.target = V(4, 5, 6);
  light.attenuation = V(0.5, 0.25, 0.125);
  light.diffuse = V(0.1, 0.2, 0.3);
  light.specular = V(0.4, 0.5, 0.6);
  light.coneAngle = 35;
  light.exponent = 7;
  light.intensity = 0.75;
  struct Row
  {
    LightKind kind;
    bool head, positional;
    double cone;
  };
  const Row rows[] = { { LightKind::Point, false, true, 180 }, { LightKind::Head, true, false, 180 },
    { LightKind::Directional, false, false, 180 }, { LightKind::Spot, false, true, 35 } };
  for (const Row& row : rows)
  {
    light.kind = row.kind;
    this->Surroundings.lights.push_back(light);
  }
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  EXPECT_FALSE(this->Lights.show(this->Surroundings, nullptr, this->Front)) << "nothing looks otherwise";
  const std::vector<vtkLight*> lights = lightsOf(this->Renderer);
  ASSERT_EQ(lights.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(bool(lights[i]->LightTypeIsHeadlight()), rows[i].head) << i;
    EXPECT_EQ(bool(lights[i]->LightTypeIsSceneLight()), !rows[i].head) << i;
    EXPECT_EQ(bool(lights[i]->GetPositional()), rows[i].positional) << i;
    EXPECT_EQ(lights[i]->GetConeAngle(), rows[i].cone) << i;
    EXPECT_EQ(lights[i]->GetExponent(), 7);
    EXPECT_EQ(lights[i]->GetIntensity(), 0.75);
    expectVector(lights[i]->GetAttenuationValues(), V(0.5, 0.25, 0.125));
    expectVector(lights[i]->GetDiffuseColor(), V(0.1, 0.2, 0.3));
    expectVector(lights[i]->GetSpecularColor(), V(0.4, 0.5, 0.6));
    if (!rows[i].head)
    {
      expectVector(lights[i]->GetPosition(), V(1, 2, 3));
      expectVector(lights[i]->GetFocalPoint(), V(4, 5, 6));
    }
  }
  // Dark ones fill up to a power of two.
  for (const auto& [added, shown] : { std::pair(1, 8u), std::pair(4, 8u), std::pair(5, 16u) })
  {
    this->Surroundings.lights.assign(std::size_t(4 + added), light);
    this->Lights.show(this->Surroundings, nullptr, this->Front);
    ASSERT_EQ(lightsOf(this->Renderer).size(), shown) << added;
    if (added != 4)
    {
      expectVector(lightsOf(this->Renderer).back()->GetDiffuseColor(), V(0, 0, 0));
    }
  }
  this->Lights.setSceneLights(false);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  ASSERT_EQ(lightsOf(this->Renderer).size(), 1u);
  EXPECT_TRUE(lightsOf(this->Renderer)[0]->LightTypeIsHeadlight());
}

TEST_F(ViewLightsTable, MaterialsOfEachLight)
{
  Material material;
  material.ambient = V(0.1, 0.2, 0.4);
  material.diffuse = V(0.5, 0.6, 0.8);
  material.specular = V(0.3, 0.2, 0.1);
  material.emission = V(0.05, 0.9, 0);
  material.shininess = 0.25;
  material.opacity = 0.75;
  LightState light;
  light.diffuse = V(1, 0.5, 0.5);
  light.specular = V(0.25, 0.25, 0);
  light.ambient = V(0.5, 0, 1);
  light.intensity = 2;
  this->Surroundings.lights = { light };
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  vtkNew<vtkProperty> property;
  this->Lights.fill(material, *property);
  // The world's ambient light of 0.2 and the lights' own.
  expectVector(property->GetAmbientColor(), V(0.05 + 1.2 * 0.1, 0.9 + 0.2 * 0.2, 2.2 * 0.4), "ambient");
  expectVector(property->GetDiffuseColor(), material.diffuse, "diffuse");
  expectVector(property->GetSpecularColor(), material.specular, "specular");
  EXPECT_EQ(property->GetAmbient(), 1);
  EXPECT_EQ(property->GetDiffuse(), 1);
  EXPECT_DOUBLE_EQ(property->GetSpecular(), 0.25) << "the part of the lights' specular light";
  EXPECT_EQ(property->GetSpecularPower(), 1);
  EXPECT_EQ(property->GetOpacity(), 0.75);
  material.shininess = 20;
  material.emission = V(1, 1, 1);
  this->Surroundings.lights[0].specular = V(1, 1, 1);
  this->Surroundings.lights[0].diffuse = V(0, 0, 1);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  this->Lights.fill(material, *property);
  expectVector(property->GetAmbientColor(), V(1, 1, 1), "no more than white");
  EXPECT_EQ(property->GetSpecular(), 1) << "no more than all";
  EXPECT_EQ(property->GetSpecularPower(), 20);
  this->Surroundings.lights[0].diffuse = V(0, 0, 0);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  this->Lights.fill(material, *property);
  EXPECT_EQ(property->GetSpecular(), 1) << "nothing to compare with";
  material.emission = V(0.05, 0.1, 0);
  this->Lights.setSceneLights(false);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  this->Lights.fill(material, *property);
  expectVector(property->GetAmbientColor(), V(0.05 + 0.125, 0.1 + 0.15, 0.2), "head");
  EXPECT_EQ(property->GetDiffuse(), 0.85);
  EXPECT_EQ(property->GetSpecular(), 0.5);
}

TEST_F(ViewLightsTable, Backgrounds)
{
  this->Surroundings.background = V(0.25, 0.5, 0.75);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  expectVector(this->Renderer->GetBackground(), V(0.25, 0.5, 0.75));
  EXPECT_FALSE(this->Renderer->GetGradientBackground());
  this->Lights.setSceneLights(false);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  expectVector(this->Renderer->GetBackground(), V(0, 0, 0), "the renderer's own");
  EXPECT_TRUE(this->Renderer->GetGradientBackground());
}

/// An image of light with one value.
std::shared_ptr<EnvironmentState> evenLight(float value)
{
  auto image = std::make_shared<RadianceImage>();
  image->width = 4;
  image->height = 2;
  image->rgb.assign(24, value);
  auto state = std::make_shared<EnvironmentState>();
  state->image = image;
  return state;
}

vtkSkybox* skyOf(vtkRenderer* renderer)
{
  for (vtkActor* const actor : actorsOf(renderer))
  {
    if (auto* const sky = vtkSkybox::SafeDownCast(actor))
    {
      return sky;
    }
  }
  return nullptr;
}

TEST_F(ViewLightsTable, Environments)
{
  const auto light = std::make_shared<EnvironmentLight>();
  this->Surroundings.environment = evenLight(0.25f);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, light, this->Front));
  EXPECT_FALSE(this->Lights.show(this->Surroundings, light, this->Front));
  const double shown = 1.055 * std::pow(0.25, 1 / 2.4) - 0.055;
  EXPECT_NEAR(this->Renderer->GetBackground()[1], shown, 1e-6) << "a parallel view looks one way";
  EXPECT_EQ(skyOf(this->Renderer), nullptr);
  Material material;
  material.ambient = V(0.1, 0.2, 0.4);
  material.diffuse = V(0.5, 0.6, 0.8);
  material.emission = V(0.05, 0.1, 0.15);
  const std::vector<float> table = reflectanceTable();
  const auto expectFilled = [&](double metal, double rough, const V& glass, double power)
  {
    vtkNew<vtkProperty> property;
    this->Lights.fill(material, *property);
    expectVector(property->GetAmbientColor(), material.emission, "no light of the world beside it");
    expectVector(property->GetDiffuseColor(), (1 - metal) * material.diffuse, "diffuse");
    const std::size_t cell = 2 * (std::size_t(rough * 64) * 64 + 44); // 44.8 of 64: a cosine of 0.7
    for (int c = 0; c < 3; ++c)
    {
      const double straight = (1 - metal) * glass[c] + metal * std::pow(material.diffuse[c], 2.2);
      EXPECT_NEAR(property->GetSpecularColor()[c],
        std::pow(straight * double(table[cell]) + double(table[cell + 1]), 1 / 2.2), 1e-9);
    }
    EXPECT_NEAR(property->GetSpecularPower(), power, 1e-9);
  };
  material.physical = Material::Physical{ 0.25, 0.5, true };
  expectFilled(0.25, 0.5, V(0.04, 0.04, 0.04), 30);
  material.physical = Material::Physical{ 1, 0.1, true };
  expectFilled(1, 0.1, V(0.04, 0.04, 0.04), 128);
  material.physical = Material::Physical{ 0, 0.99, true };
  expectFilled(0, 0.99, V(0.04, 0.04, 0.04), 1);
  material.physical.reset();
  material.specular = V(0.5, 0.25, 1);
  material.shininess = 30;
  expectFilled(0, 0.5, V(0.02, 0.01, 0.04), 30);
  this->Lights.setSceneLights(false);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, light, this->Front));
  expectVector(this->Renderer->GetBackground(), V(0, 0, 0));
}

/// The centre column is towards -z, columns to the right towards +x, the top row upwards; VTK's rows are from below.
TEST_F(ViewLightsTable, TheSkyIsThePicture)
{
  const ViewCamera perspective(ViewKind::Perspective);
  auto state = evenLight(0);
  auto image = std::make_shared<RadianceImage>(*state->image);
  for (std::size_t texel = 0; texel < 8; ++texel)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      image->rgb[3 * texel + c] = (texel >> c) % 2 == 1 ? 1.0f : 0.0f;
    }
  }
  state->image = image;
  this->Surroundings.environment = state;
  this->Lights.show(this->Surroundings, nullptr, perspective);
  vtkSkybox* const sky = skyOf(this->Renderer);
  ASSERT_NE(sky, nullptr);
  EXPECT_TRUE(sky->GetVisibility());
  vtkImageData* const picture = sky->GetTexture()->GetInput();
  ASSERT_EQ(picture->GetDimensions()[0], 1024);
  ASSERT_EQ(picture->GetDimensions()[1], 512);
  for (int texel = 0; texel < 8; ++texel)
  {
    const int column = 128 + 256 * (texel % 4);
    const int row = texel < 4 ? 384 : 128;
    for (int c = 0; c < 3; ++c)
    {
      const double expected = (texel >> c) % 2 == 1 ? 255 : 0;
      EXPECT_NEAR(picture->GetScalarComponentAsDouble(column, row, 0, c), expected, 13) << texel << ' ' << c;
    }
  }
  // red is in every other texel: as much to the left of the second one's centre as to its right
  for (const int apart : { 200, 220, 240 })
  {
    EXPECT_NEAR(picture->GetScalarComponentAsDouble(383 - apart, 384, 0, 0),
      picture->GetScalarComponentAsDouble(384 + apart, 384, 0, 0), 1)
      << apart;
  }
  this->Lights.show(this->Surroundings, nullptr, perspective);
  EXPECT_EQ(sky->GetTexture()->GetInput(), picture) << "made once";
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  EXPECT_FALSE(sky->GetVisibility());
  this->Lights.show(this->Surroundings, nullptr, perspective);
  EXPECT_TRUE(sky->GetVisibility());
  state->background = false;
  this->Lights.show(this->Surroundings, nullptr, perspective);
  EXPECT_FALSE(sky->GetVisibility());
  expectVector(this->Renderer->GetBackground(), V(0, 0, 0));
}
} // namespace
