// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkPovExport.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <regex>

namespace dgtk
{
namespace
{

using testing::HasSubstr;
using testing::Not;

/// Numbers of a few products.
constexpr double rounding = 1e-14;

/// What scenes are written with: camera, lights, materials and pictures.
class PovLook : public testing::Test
{
protected:
  void SetUp() override
  {
    this->V.name = "c";
    this->V.model = makePinholeFromFov(64, 48, 45, 0);
    this->V.camera_from_world = lookAtPose({ 1, 2, 8 }, { 0, 0, 0 }, { 0, 1, 0 });
    this->State = *test::SceneBuilder().add(test::makeBox()).state();
  }
  std::string path(const std::string& name) const { return this->Folder.path(name); }
  std::string write(const PovOptions& options = {})
  {
    this->Result = exportPov(this->State, this->V, this->path("s.pov"), options);
    return readFile(this->path("s.pov"));
  }
  /// The box, with its material changed.
  template <class Edit>
  void change(const Edit& edit)
  {
    Instance& box = this->State.instances[0];
    auto materials = std::make_shared<std::vector<Material>>(*box.materials);
    edit((*materials)[0]);
    box.materials = materials;
  }

  test::TemporaryFolder Folder;
  View V;
  SceneState State;
  PovResult Result;
};

/// The number after a word.
double lookAfter(const std::string& text, const std::string& word)
{
  const std::size_t at = text.find(word);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + word.size()));
}

/// The colour after a word.
Eigen::Vector3d colorAfter(const std::string& text, const std::string& word)
{
  Eigen::Vector3d v(NAN, NAN, NAN);
  const std::size_t at = text.find(word + " rgb <");
  std::sscanf(text.c_str() + (at == std::string::npos ? text.size() : at + word.size() + 6), "%lf, %lf, %lf", &v[0],
    &v[1], &v[2]);
  return v;
}

TEST_F(PovLook, TheLargestDistanceIsNotReachedButNearly)
{
  for (const double size : { 1e-3, 1.0, 1e5 })
  {
    this->State.instances[0].world_from_object = test::placement({ 0, 0, 0 }, size);
    this->write();
    const double reach = std::sqrt(1 + 4 + 64.0) + size * std::sqrt(3.0);
    EXPECT_EQ(this->Result.scale, std::exp2(std::floor(std::log2(this->Result.scale)))) << size;
    EXPECT_LE(this->Result.scale * reach, 1 << 17) << size;
    EXPECT_GT(this->Result.scale * reach, 1 << 16) << size;
  }
}

TEST_F(PovLook, LensIsAsLargeAsTheScene)
{
  PovOptions options;
  options.lens = PovLens{ 0.25, 7 };
  const std::string text = this->write(options);
  EXPECT_EQ(lookAfter(text, "aperture "), 0.25 * this->Result.scale);
  EXPECT_THAT(text, HasSubstr("focal_point <0, 0, 7> blur_samples 128 variance 0\n"));
}

TEST_F(PovLook, AmbientLightIsTheWorldsAndThatOfTheLights)
{
  this->State.lights.resize(2);
  this->State.lights[0].ambient = { 0.1, 0.2, 0.3 };
  this->State.lights[1].ambient = { 0.05, 0, 0 };
  this->State.lights[1].intensity = 4;
  EXPECT_LE((colorAfter(this->write(), "ambient_light") - Eigen::Vector3d(0.5, 0.4, 0.5)).norm(), rounding);
  PovOptions options;
  options.radiosity = true;
  const std::string text = this->write(options);
  EXPECT_EQ(colorAfter(text, "ambient_light"), Eigen::Vector3d(0, 0, 0));
  EXPECT_THAT(text, HasSubstr("radiosity { count 150 nearest_count 10 "));
}

TEST_F(PovLook, OnlyAmbientLightThatShouldFallOffIsNoted)
{
  this->State.lights.resize(1);
  this->State.lights[0].ambient = { 0.1, 0.1, 0.1 };
  this->write();
  EXPECT_THAT(this->Result.warnings, testing::IsEmpty());
  this->State.lights[0].attenuation = { 1, 0.5, 0 };
  this->write();
  EXPECT_THAT(this->Result.warnings, testing::ElementsAre(HasSubstr("its ambient light does not fall off")));
}

TEST_F(PovLook, AttenuationThatIsMatchedOrBounded)
{
  const auto at = [this](const Eigen::Vector3d& attenuation, double d)
  {
    this->State.lights.resize(1);
    this->State.lights[0].position = { 0, 3, 4 };
    this->State.lights[0].attenuation = attenuation;
    std::string text = this->write();
    text = text.substr(text.find("light_source"));
    const double fade =
      std::pow(d * this->Result.scale / lookAfter(text, "fade_distance "), lookAfter(text, "fade_power "));
    return lookAfter(text, "rgb <") * 2 / (1 + fade);
  };
  // Linear and quadratic together: at the middle of the scene, 5 away.
  EXPECT_NEAR(at({ 1, 0.5, 0.25 }, 5), 1 / (1 + 2.5 + 6.25), rounding);
  EXPECT_THAT(this->Result.warnings, testing::ElementsAre(HasSubstr("at the middle of the scene only")));
  // Nothing but the distance: as if there were a thousandth of the scene's radius more of it, or of its square.
  const double least = 1e-3 * std::sqrt(3.0);
  EXPECT_NEAR(at({ 0, 2, 0 }, 5), 1 / (2 * (5 + least)), rounding);
  EXPECT_NEAR(at({ 0, 0, 2 }, 5), 1 / (2 * (25 + least * least)), rounding);
}

TEST_F(PovLook, WhatIsNotWrittenIsNoted)
{
  this->change([](Material& material) { material.normalMap = 0; });
  this->State.fog = { { 0.1, 0.2, 0.3 }, 0.5, 0 };
  this->State.environment = std::make_shared<EnvironmentState>();
  this->write();
  EXPECT_THAT(this->Result.warnings,
    testing::ElementsAre("fog hides the background", "the environment is not written", "normal maps are not written"));
  EXPECT_EQ(povNotes(this->State, this->V, {}), this->Result.warnings);
}

TEST_F(PovLook, LightsStandWhereTheyShould)
{
  this->State.lights.resize(1);
  LightState& light = this->State.lights[0];
  light.shadows = true;
  light.position = { 0, 9, 0 };
  PovOptions options;
  options.areaLights = 3;
  const auto written = [&]
  {
    const std::string text = this->write(options);
    return text.substr(text.find("light_source"));
  };
  const double radius = std::sqrt(3.0);
  EXPECT_NEAR(lookAfter(written(), "area_light "), 0.1 * radius, rounding);
  light.kind = LightKind::Directional;
  EXPECT_NEAR(lookAfter(written(), "light_source { <0, "), 4 * radius, rounding);
  light.kind = LightKind::Spot;
  light.coneAngle = 89;
  light.exponent = 8;
  EXPECT_EQ(lookAfter(written(), "spotlight point_at <0, 0, 0> radius "), 89);
  EXPECT_EQ(lookAfter(written(), "tightness "), 8);
  light.coneAngle = 90; // a half space
  EXPECT_THAT(written(), Not(HasSubstr("spotlight")));
}

TEST_F(PovLook, AntialiasIsAGridWithoutNoise)
{
  EXPECT_THAT(povAntialias(1), testing::ElementsAre("-A"));
  EXPECT_THAT(povAntialias(2), testing::ElementsAre("+A0.0", "+AM1", "+R2", "-J"));
}

// A finish's ambient light and emission are multiplied with the pigment.
TEST_F(PovLook, ColoursOfPartsThatThePigmentLacks)
{
  this->change(
    [](Material& material)
    {
      material.diffuse = { 0.5, 0.25, 0 };
      material.ambient = { 0.1, 0.2, 0.3 };
      material.emission = { 0.4, 0.5, 0.6 };
    });
  const std::string text = this->write();
  const Eigen::Vector3d pigment = colorAfter(text, "pigment {");
  EXPECT_EQ(lookAfter(text, " diffuse "), 0.5);
  EXPECT_LE((0.5 * pigment - Eigen::Vector3d(0.5, 0.25, 0)).norm(), 1e-3);
  EXPECT_LE(
    (colorAfter(text, "finish { ambient").cwiseProduct(pigment) - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), rounding);
  EXPECT_LE((colorAfter(text, "emission").cwiseProduct(pigment) - Eigen::Vector3d(0.4, 0.5, 0.6)).norm(), rounding);
}

TEST_F(PovLook, MissingTexelsHaveNoHighlights)
{
  const auto quad = test::makeQuad();
  test::addCutOut(*quad, 4, 1);
  quad->materials[0].specular = { 1, 1, 1 };
  quad->materials[0].shininess = 20;
  for (const bool cutOut : { false, true })
  {
    quad->materials[0].cutOut = cutOut;
    this->State = *test::SceneBuilder().add(quad).state();
    this->State.lights.resize(1);
    this->State.lights[0].kind = LightKind::Directional;
    this->State.lights[0].target = { 0, 0, -1 };
    EXPECT_EQ(this->write().find("phong 1 phong_size 20") == std::string::npos, cutOut);
  }
}

TEST_F(PovLook, MirrorsAndVeils)
{
  this->change(
    [](Material& material)
    {
      material.specular = { 0.5, 0.5, 0.5 };
      material.shininess = 32;
      material.opacity = 0.75;
    });
  PovOptions options;
  options.reflections = true;
  const std::string text = this->write(options);
  EXPECT_EQ(lookAfter(text, "reflection { "), 0.5 * 32 / 128);
  EXPECT_THAT(text, HasSubstr("pigment { rgbt <1, 1, 1, 0.25> }"));
}

TEST_F(PovLook, PlacesHaveColoursThatAreAveraged)
{
  PovOptions options;
  options.positionColors = PovBox{ { -1, -2, -3 }, { 4, 5, 6 } };
  const std::string text = this->write(options);
  EXPECT_THAT(text, HasSubstr("gradient x color_map { [0 rgb 0] [1 rgb <3, 0, 0>] } scale 5 translate -1 * x"));
  EXPECT_THAT(text, HasSubstr("gradient z color_map { [0 rgb 0] [1 rgb <0, 0, 3>] } scale 9 translate -3 * z"));
}

TEST_F(PovLook, TexelsAreThereFromTheMiddleOn)
{
  auto quad = test::makeQuad();
  test::addCutOut(*quad, 2, 1);
  auto image = std::make_shared<Image>(*quad->textures[0].image);
  for (std::size_t i = 0; i < 4; ++i)
  {
    image->rgba[4 * i + 3] = std::uint8_t(126 + i);
  }
  quad->textures[0].image = image;
  exportPov(quad, this->path("q.pov"));
  EXPECT_EQ(readFile(this->path("q_0_mask.pgm")), std::string("P5\n2 2\n255\n\0\0\xff\xff", 15));
}

TEST_F(PovLook, NormalsOfTheOtherSideAndThoseALittleTiltedAreWritten)
{
  for (const bool tilted : { false, true })
  {
    auto quad = test::makeQuad();
    auto geometry = std::make_shared<Geometry>(*quad->rest);
    for (Eigen::Vector3f& normal : geometry->normals)
    {
      normal = tilted ? normal : -normal;
    }
    geometry->normals[0] = tilted ? Eigen::Vector3f(0.001f, 0, 1).normalized() : geometry->normals[0];
    quad->rest = geometry;
    exportPov(quad, this->path("q.pov"));
    EXPECT_THAT(readFile(this->path("q.pov")), HasSubstr("normal_vectors")) << tilted;
  }
}

/// A quad with an opaque texture of one file, of which only the header counts.
std::shared_ptr<Model> textured(const std::string& path, char kind, bool hasAlpha)
{
  writeFile(path, "\x89PNG\r\n\x1a\n" + std::string(17, '\1') + kind);
  auto quad = test::makeQuad();
  test::addCutOut(*quad, 2, 1);
  auto image = std::make_shared<Image>(*quad->textures[0].image);
  image->rgba = { 3, 3, 3, 255, 0, 1, 2, 255, 255, 254, 253, 255, 7, 5, 9, 255 };
  image->hasAlpha = hasAlpha;
  quad->textures[0].image = image;
  quad->textures[0].path = path;
  quad->materials[0].cutOut = false;
  return quad;
}

TEST_F(PovLook, PicturesThatArePlainAreUsedAsTheyAre)
{
  for (const char kind : { 0, 2, 3, 4, 6 }) // grey, colours, palette; with alpha
  {
    for (const bool hasAlpha : { false, true })
    {
      exportPov(textured(this->path("t.png"), kind, hasAlpha), this->path("q.pov"));
      const bool whole = kind < 4 && !hasAlpha;
      EXPECT_THAT(
        readFile(this->path("q.pov")), HasSubstr(whole ? "image_map { png \"t.png\"" : "image_map { ppm \"q_0.ppm\""))
        << int(kind) << hasAlpha;
    }
  }
}

TEST_F(PovLook, PicturesAreTintedInTheirTexels)
{
  const auto quad = textured(this->path("t.png"), 2, false);
  quad->materials[0].diffuse = { 0.8, 0.4, 0.2 };
  exportPov(quad, this->path("q.pov"));
  const std::string text = readFile(this->path("q.pov"));
  EXPECT_EQ(lookAfter(text, " diffuse "), 0.8);
  EXPECT_THAT(text, Not(HasSubstr("transmit")));
  // Rounded: 1.5, 0.75; 0.5, 0.5; 127, 63.25; 2.5, 2.25
  EXPECT_EQ(readFile(this->path("q_0.ppm")), std::string("P6\n2 2\n255\n\3\2\1\0\1\1\xff\x7f\x3f\7\3\2", 23));
}

TEST_F(PovLook, PicturesAreSeenThroughAsTheirMaterialsAre)
{
  const auto quad = textured(this->path("t.png"), 2, false);
  quad->materials[0].opacity = 0.75;
  exportPov(quad, this->path("q.pov"));
  EXPECT_THAT(readFile(this->path("q.pov")), HasSubstr("interpolate 2 transmit all 0.25 }"));
}

TEST_F(PovLook, MeshesAreSharedByWhatLooksTheSame)
{
  const auto holes = test::makeQuad();
  test::addCutOut(*holes, 4, 1);
  this->State = *test::SceneBuilder().add(holes).add(holes, test::placement({ 1, 0, 0 }, 2)).state();
  const auto meshes = [this](const PovOptions& options)
  {
    const std::string text = this->write(options);
    const std::string word = "= mesh2";
    int n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    {
      ++n;
    }
    return n;
  };
  PovOptions flat;
  flat.flatIds = true;
  EXPECT_EQ(meshes({}), 1);
  EXPECT_EQ(meshes(flat), 2) << "each in its own colour";
  holes->materials[0].bumpMap = 0;
  EXPECT_EQ(meshes({}), 2) << "bumps are as high as the object is large";
}

TEST_F(PovLook, FirstLinesSayHowTheSceneIsDrawn)
{
  PovLibrary library(this->Folder.path(), "");
  PovOptions options;
  EXPECT_THAT(makePovScene(this->State, this->V, options, library, { 16, 8 }).text, HasSubstr("+W64 +H8 "));
  EXPECT_THAT(makePovScene(this->State, this->V, options, library).text,
    testing::AllOf(HasSubstr("+W64 +H48 "), HasSubstr("times as large as in the scene")));
  options.ownScale = 1;
  EXPECT_THAT(makePovScene(this->State, this->V, options, library).text, Not(HasSubstr("times as large")));
}

TEST_F(PovLook, NamesOfALibraryAreNotLong)
{
  const auto box = std::make_shared<Model>(*this->State.instances[0].model);
  box->path = std::string(240, 'm') + ".ac";
  this->State.instances[0].model = box;
  PovLibrary library(this->Folder.path(), "");
  EXPECT_EQ(
    makePovScene(this->State, this->V, {}, library).uses.at(0).name.size(), 100 + 1 + 16 + std::string(".inc").size());
}

TEST_F(PovLook, MaterialsOfALibraryAreThoseOfTheLight)
{
  this->change(
    [](Material& material)
    {
      material.specular = { 1, 1, 1 };
      material.shininess = 20;
    });
  PovLibrary library(this->Folder.path(), "");
  const auto finishIn = [&](LightKind kind)
  {
    this->State.lights.resize(1);
    this->State.lights[0].kind = kind;
    this->State.lights[0].target = { 0, 0, -1 };
    return readFile(this->path(makePovScene(this->State, this->V, {}, library).uses.at(0).name));
  };
  EXPECT_THAT(finishIn(LightKind::Head), HasSubstr("specular 1 roughness 0.05"));
  EXPECT_THAT(finishIn(LightKind::Directional), HasSubstr("phong 1 phong_size 20"));
}

// As those of one frame may be taken for those of another, with the same geometry.
TEST_F(PovLook, ALibraryTakesNoMaterialsForOthersThatStoodAtTheirAddress)
{
  PovLibrary library(this->Folder.path(), "");
  std::vector<Material> place = *this->State.instances[0].materials;
  const auto fileOf = [&](const Eigen::Vector3d& diffuse)
  {
    place[0].diffuse = diffuse;
    this->State.instances[0].materials = std::shared_ptr<const std::vector<Material>>(&place, [](const auto*) {});
    return makePovScene(this->State, this->V, {}, library).uses.at(0).name;
  };
  const std::string red = fileOf({ 1, 0, 0 });
  EXPECT_NE(fileOf({ 0, 1, 0 }), red);
  EXPECT_EQ(fileOf({ 1, 0, 0 }), red);
}

TEST_F(PovLook, ObjectsThatAreNotVisibleAreNotWritten)
{
  this->State = *test::SceneBuilder().add(test::makeBox(), {}, "a").add(test::makeBox(), {}, "b").state();
  const auto objects = [this]
  {
    const std::string text = this->write();
    const std::regex object("\\bobject \\{");
    return std::distance(std::sregex_iterator(text.begin(), text.end(), object), std::sregex_iterator());
  };
  const auto both = objects();
  this->State.instances[0].visible = false;
  EXPECT_EQ(objects(), both - 1);
}

TEST_F(PovLook, WhatLightDoesNotReachNeedsNoTextureOfTheView)
{
  test::SphereOptions options;
  options.rings = 4;
  options.segments = 6;
  this->V.model = makePinholeFromFov(320, 240, 45, 0);
  this->State = *test::SceneBuilder().add(test::makeSphere(options)).state();
  EXPECT_THAT(this->write(), HasSubstr("texture_map"));
  this->change([](Material& material) { material.diffuse.setZero(); });
  EXPECT_THAT(this->write(), Not(HasSubstr("texture_map")));
}

/// A triangle whose normals, but for that of the first corner, are its own.
std::shared_ptr<Model> turnedAtItsFirstCorner(const std::vector<Eigen::Vector3d>& p)
{
  auto model = test::makeSoup({ 1, 1, 1, 1 });
  auto geometry = std::make_shared<Geometry>(*model->rest);
  geometry->positions = p;
  const Eigen::Vector3f normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized().cast<float>();
  geometry->normals = { -normal, normal, normal };
  model->rest = geometry;
  return model;
}

TEST_F(PovLook, NormalsFaceAwayFromTheRaysOfParallelCameras)
{
  test::SphereOptions options;
  options.rings = 4;
  options.segments = 6;
  this->V.model = makeOrthographic(320, 240, 3, 0);
  this->State = *test::SceneBuilder().add(test::makeSphere(options)).state();
  const std::string text = this->write();
  const std::regex form(
    R"(\* \((-?[0-9.e-]+)\) \+ \([^()]*\) \* \((-?[0-9.e-]+)\) \+ \([^()]*\) \* \((-?[0-9.e-]+)\))");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(text, found, form));
  const Eigen::Vector3d way(std::stod(found[1]), std::stod(found[2]), std::stod(found[3]));
  EXPECT_LE((way - this->V.camera_from_world.rotation.row(2).transpose()).norm(), rounding);
  this->change([](Material& material) { material.diffuse = { 0.25, 0.5, 0.125 }; });
  EXPECT_THAT(this->write(), HasSubstr("finish { diffuse 0, 0.5 phong 0 specular 0 }"));
}

TEST_F(PovLook, ModelsAreNotMadeForAView)
{
  const auto model = turnedAtItsFirstCorner({ { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } });
  this->State = *test::SceneBuilder().add(model).state();
  EXPECT_THAT(this->write(), HasSubstr("texture_map"));
  exportPov(model, this->path("m.pov"));
  EXPECT_THAT(readFile(this->path("m.pov")), Not(HasSubstr("texture_map")));
}

// Only where the triangle crosses the near plane does it have a width in the image: its far side is upright, on one
// line.
TEST_F(PovLook, TrianglesThatCrossTheNearPlaneAreLookedAtFromThereOn)
{
  this->V.camera_from_world = Rigid3();
  const auto model = turnedAtItsFirstCorner({ { 0.3, 0, 1 }, { -3, 3, 10 }, { -3, -3, 10 } });
  this->State = *test::SceneBuilder().add(model).state();
  this->V.near = 2;
  EXPECT_THAT(this->write(), HasSubstr("texture_map"));
}

// Half of the way, up to a depth of 5.5, normals face away.
TEST_F(PovLook, WhatIsNearerThanTheNearPlaneNeedsNoTextureOfTheView)
{
  this->V.camera_from_world = Rigid3();
  const auto model = turnedAtItsFirstCorner({ { -0.4, -0.3, 1 }, { -4, 3, 10 }, { 3, -3, 10 } });
  this->State = *test::SceneBuilder().add(model).state();
  this->V.near = 0.1;
  EXPECT_THAT(this->write(), HasSubstr("texture_map"));
  this->V.near = 6;
  EXPECT_THAT(this->write(), Not(HasSubstr("texture_map")));
}

} // namespace
} // namespace dgtk
