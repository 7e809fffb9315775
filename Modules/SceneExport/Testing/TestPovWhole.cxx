// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPovExport.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>

namespace dgtk
{
namespace
{

// Whole scenes, word for word: all numbers follow by hand from those below.

/// A camera at the origin that looks along z, y down: 8 x 4 pixels, 45 degrees to either side.
View straightView()
{
  Eigen::Matrix3d K;
  K << 4, 0, 4, 0, 4, 2, 0, 0, 1;
  View view;
  view.name = "c";
  view.model = makePinhole(8, 4, K);
  view.near = 1;
  view.far = 64;
  return view;
}

/// The unit square in the plane z = 0, cut from (0, 0) to (1, 1), that faces -z; a texture of its own.
std::shared_ptr<Model> makeSquare()
{
  auto square = test::makeQuad({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 } });
  auto geometry = std::make_shared<Geometry>(*square->rest);
  geometry->normals.assign(4, Eigen::Vector3f(0, 0, -1));
  square->rest = geometry;
  square->uvs.clear();
  return square;
}

const char* const head = R"(
#version 3.7;
global_settings {
  assumed_gamma srgb
  max_trace_level 256
  ambient_light rgb <0.2, 0.2, 0.2>
}
)";

const char* const camera = R"(camera {
  perspective
  location <0, 0, 0>
  direction <0, 0, 1>
  right <-2, 0, 0>
  up <0, 1, 0>
  matrix <-1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0>)";

const char* const vertices = R"( = mesh2 {
  vertex_vectors { 4,
    <0, 0, 0>,
    <0, 1, 0>,
    <1, 0, 0>,
    <1, 1, 0>
  }
)";

/// The materials of makeColored(), `highlight` in the first, and its triangles.
std::string textures(const std::string& highlight)
{
  return R"(  texture_list { 2,
    texture { pigment { rgbt <1, 1, 1, 0.25> } finish { ambient rgb <0, 0, 0> diffuse 0.25 emission rgb <0.5, 0, 1> )" +
         highlight + R"( } },
    texture { pigment { rgb <1, 0.5, 0.0009765625> } finish { ambient rgb <0.5, 0.5, 0> diffuse 0.5 } }
  }
  face_indices { 2,
    <0, 1, 3>, 0,
    <0, 3, 2>, 1
  }
}
)";
}

/// The objects of threeObjects(), with a mesh and what follows the matrix.
std::string objects(const std::string& mesh, const std::string& nearEnd, const std::string& farEnd)
{
  return "// object 1: 'near'\nobject {\n  " + mesh + "\n  matrix <6, 0, 0, 0, 8, 0, 0, 0, 1, -3, -4, 4>\n" + nearEnd +
         "}\n\n// object 3: 'far'\nobject {\n  " + mesh + "\n  matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 4>\n" + farEnd +
         "}\n\n";
}

class PovWhole : public testing::Test
{
protected:
  std::string write(const SceneState& state, const PovOptions& options)
  {
    this->Result = exportPov(state, straightView(), this->Folder.path("s.pov"), options);
    return readFile(this->Folder.path("s.pov"));
  }

  test::TemporaryFolder Folder;
  PovResult Result;
};

/// Two materials, of which the first half of the square has the second, and a third that nothing has.
std::shared_ptr<Model> makeColored()
{
  auto square = makeSquare();
  square->materials.resize(3);
  square->materials[0].diffuse = { 0.5, 0.25, 0 };
  square->materials[0].ambient = { 0.5, 0.25, 0 };
  square->materials[1].diffuse = { 0.25, 0.25, 0.25 };
  square->materials[1].ambient = { 0, 0, 0 };
  square->materials[1].emission = { 0.5, 0, 1 };
  square->materials[1].specular = { 0.25, 0.5, 0.75 };
  square->materials[1].shininess = 64;
  square->materials[1].opacity = 0.75;
  square->parts = { Part{ "none", 2, 0, 0 }, Part{ "first", 1, 0, 1 }, Part{ "second", 0, 1, 1 } };
  return square;
}

/// Near, none of a model without surfaces, far.
std::shared_ptr<SceneState> threeObjects(const std::shared_ptr<Model>& square)
{
  const auto empty = std::make_shared<Model>();
  empty->rest = std::make_shared<Geometry>();
  auto state = test::SceneBuilder()
                 .add(square, { Eigen::Vector3d(6, 8, 1).asDiagonal(), { -3, -4, 4 } }, "near")
                 .add(empty)
                 .add(square, { Eigen::Matrix3d::Identity(), { 0, 0, 4 } }, "far")
                 .state();
  state->frame = 7;
  state->background = { 0.25, 0.5, 0.75 };
  state->fog = { { 0.25, 0.5, 1 }, 0.125, 0 };
  return state;
}

TEST_F(PovWhole, LitScene)
{
  SceneState state = *threeObjects(makeColored());
  PovOptions options;
  options.ownScale = 2;
  options.reflections = true;
  options.antialias = 3;
  state.lights.resize(4);
  state.lights[0].name = "sun";
  state.lights[0].kind = LightKind::Directional;
  state.lights[0].position = { 0, 0, 0 };
  state.lights[0].target = { 0, 9, 0 };
  state.lights[0].diffuse = { 1, 0.5, 0.25 };
  state.lights[0].intensity = 0.5;
  state.lights[1].name = "lamp";
  state.lights[1].position = { 1, 2, 3 };
  state.lights[1].diffuse = { 1, 1, 0 };
  state.lights[1].attenuation = { 2, 0, 0 };
  state.lights[1].shadows = true;
  state.lights[2].name = "cone";
  state.lights[2].kind = LightKind::Spot;
  state.lights[2].position = { 0, -4, 4 };
  state.lights[2].target = { 0, 0, 4 };
  state.lights[2].attenuation = { 1, 0.5, 0 };
  state.lights[2].coneAngle = 30;
  state.lights[2].exponent = 5;
  state.lights[2].shadows = true;
  state.lights[3].name = "camera";
  state.lights[3].kind = LightKind::Head;
  // The objects fill a ball of radius 5 around (0, 0, 4); lights of one direction stand 4 radii away.
  EXPECT_EQ(this->write(state, options), "// Camera 'c', frame 7.\n"
                                         "// povray +W8 +H4 +A0.0 +AM1 +R3 -J +FN8 File_Gamma=sRGB Dither=off FILE\n"
                                         "// Everything is 2 times as large as in the scene.\n" +
                                           std::string(head) + "background { color rgb <0.25, 0.5, 0.75> }\n" + camera +
                                           R"( scale 2
}
light_source { <0, -20, 4> rgb <0.5, 0.25, 0.125> parallel point_at <0, 0, 4> shadowless scale 2 }
light_source { <1, 2, 3> rgb <0.5, 0.5, 0> scale 2 }
light_source { <0, -4, 4> rgb <0.5, 0.5, 0.5> spotlight point_at <0, 0, 4> radius 30 falloff 30 tightness 5 fade_distance 4 fade_power 1 scale 2 }
light_source { <0, 0, -16> rgb <1, 1, 1> parallel point_at <0, 0, 4> shadowless scale 2 }
fog { distance 16 color rgb <0.25, 0.5, 1> }

#declare Mesh1)" + vertices + textures("phong 0.5 phong_size 64 reflection { 0.25 }") +
                                           '\n' + objects("Mesh1", "  scale 2\n", "  scale 2\n"));
  const std::string text = ": without shadows among others that have them, it has no highlights";
  EXPECT_THAT(this->Result.warnings,
    testing::ElementsAre("light 'sun'" + text, "light 'camera'" + text, "fog hides the background"));
}

TEST_F(PovWhole, Ids)
{
  PovOptions options;
  options.ownScale = 1;
  options.flatIds = true;
  SceneState state = *threeObjects(makeColored());
  state.lights.resize(1);
  const auto flat = [](const char* blue)
  {
    return std::string("  texture { pigment { rgb <0, 0, ") + blue +
           "> } finish { ambient 0 diffuse 0 emission 1 } }\n  no_shadow\n";
  };
  EXPECT_EQ(this->write(state, options),
    "// Camera 'c', frame 7.\n// povray +W8 +H4 -A +FN8 File_Gamma=sRGB Dither=off FILE\n" + std::string(head) +
      "background { color rgb <0, 0, 0> }\n" + camera + "\n}\n\n#declare Mesh1" + vertices +
      "  face_indices { 2,\n    <0, 1, 3>,\n    <0, 3, 2>\n  }\n}\n\n" +
      objects("Mesh1", flat("0.00392156862745098"), flat("0.011764705882352941")));
  EXPECT_THAT(this->Result.warnings, testing::IsEmpty());
}

TEST_F(PovWhole, Places)
{
  PovOptions options;
  options.ownScale = 1;
  options.positionColors = PovBox{ { -1, -2, -3 }, { 4, 5, 6 } };
  SceneState state = *threeObjects(makeColored());
  state.lights.resize(1);
  const std::string shines = "  texture { pigment { average pigment_map {"
                             " [1 gradient x color_map { [0 rgb 0] [1 rgb <3, 0, 0>] } scale 5 translate -1 * x]"
                             " [1 gradient y color_map { [0 rgb 0] [1 rgb <0, 3, 0>] } scale 7 translate -2 * y]"
                             " [1 gradient z color_map { [0 rgb 0] [1 rgb <0, 0, 3>] } scale 9 translate -3 * z] } }"
                             " finish { ambient 0 diffuse 0 emission 1 } }\n  no_shadow\n";
  EXPECT_EQ(this->write(state, options),
    "// Camera 'c', frame 7.\n// povray +W8 +H4 -A +FN8 File_Gamma=sRGB Dither=off FILE\n" + std::string(head) +
      "background { color rgb <0, 0, 0> }\n" + camera + "\n}\n\n#declare Mesh1" + vertices +
      "  face_indices { 2,\n    <0, 1, 3>,\n    <0, 3, 2>\n  }\n}\n\n" + objects("Mesh1", shines, shines));
}

TEST_F(PovWhole, RowsOfALibrary)
{
  SceneState state = *threeObjects(makeColored());
  state.environment = std::make_shared<EnvironmentState>();
  PovOptions options;
  options.ownScale = 1;
  PovLibrary library(this->Folder.path(), "../lib/");
  const PovScene scene = makePovScene(state, straightView(), options, library, { 1, 2 }, "x.pov");
  ASSERT_EQ(scene.uses.size(), 1u);
  const std::string file = scene.uses[0].name;
  const std::string mesh = readFile(this->Folder.path(file));
  const std::string name = mesh.substr(9, 21); // behind #declare
  EXPECT_THAT(name, testing::MatchesRegex("Mesh_[0-9a-f]{16}"));
  EXPECT_EQ(mesh, "#declare " + name + vertices + textures("specular 0.5 roughness 0.015625"));
  std::string half = camera;
  half.replace(half.find("up <0, 1, 0>"), 12, "up <0, 0.5, 0>");
  EXPECT_EQ(
    scene.text, "// Camera 'c', frame 7.\n// povray +W8 +H2 -A +FN8 File_Gamma=sRGB Dither=off x.pov\n// uses ../lib/" +
                  file + "\n// Note: fog hides the background\n// Note: the environment is not written\n" + head +
                  "background { color rgb <0.25, 0.5, 0.75> }\n" + half +
                  "\n}\nfog { distance 8 color rgb <0.25, 0.5, 1> }\n\n#include \"../lib/" + file + "\"\n\n" +
                  objects(name, "  no_shadow\n", "  no_shadow\n"));
}

// A light and a camera of 45 degrees in front, at 2.8 radii of the ball around it.
TEST_F(PovWhole, Model)
{
  const auto model = makeColored();
  auto geometry = std::make_shared<Geometry>(*model->rest);
  for (Eigen::Vector3d& position : geometry->positions)
  {
    position = position.cwiseProduct(Eigen::Vector3d(6, 8, 1));
  }
  model->rest = geometry;
  model->path = "/somewhere/square.ac";
  exportPov(model, this->Folder.path("m.pov"));
  const std::string text = readFile(this->Folder.path("m.pov"));
  EXPECT_THAT(text, testing::StartsWith("// Camera 'front', frame 0.\n// povray +W640 +H480 -A "));
  EXPECT_THAT(text, testing::HasSubstr("background { color rgb <1, 1, 1> }\n"));
  EXPECT_THAT(text, testing::HasSubstr("matrix <-1, 0, 0, 0, 1, 0, 0, 0, -1, 3, 4, 14>\n}\n"));
  EXPECT_THAT(
    text, testing::HasSubstr("light_source { <3, 4, 20> rgb <1, 1, 1> parallel point_at <3, 4, 0> }\n\n#declare "));
  EXPECT_THAT(text,
    testing::EndsWith(textures("specular 0.5 roughness 0.015625") +
                      "\n// object 1: 'square.ac'\nobject {\n  Mesh1\n  matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0>\n"
                      "  no_shadow\n}\n\n"));
}

// The high byte of an id is red.
TEST_F(PovWhole, ColoursOfManyObjects)
{
  const auto empty = std::make_shared<Model>();
  empty->rest = std::make_shared<Geometry>();
  SceneState state;
  Instance nothing;
  nothing.model = empty;
  nothing.geometry = empty->rest;
  state.instances.assign(0x010203 - 1, nothing);
  state.instances.push_back(threeObjects(makeSquare())->instances[0]);
  PovOptions options;
  options.flatIds = true;
  EXPECT_THAT(this->write(state, options),
    testing::HasSubstr("pigment { rgb <0.00392156862745098, 0.00784313725490196, 0.011764705882352941> }"));
}

/// A square with a picture of 2 x 2 texels, 10 apart, of a file that may serve as it is.
std::shared_ptr<Model> makePictured(const std::string& path)
{
  auto square = test::makeQuad();
  test::addCutOut(*square, 2, 1);
  auto image = std::make_shared<Image>(*square->textures[0].image);
  for (std::size_t i = 0; i < image->rgba.size(); ++i)
  {
    image->rgba[i] = i % 4 == 3 ? 255 : std::uint8_t(10 * i);
  }
  image->hasAlpha = false;
  square->textures[0].image = image;
  square->textures[0].path = path;
  square->materials[0].cutOut = false;
  writeFile(path, "\x89PNG\r\n\x1a\n" + std::string(17, '\1') + '\2');
  return square;
}

/// Contents of what a scene with one object uses, by the beginning and the ending of the names.
std::map<std::string, std::string> usesOf(const std::shared_ptr<Model>& model, const std::string& folder)
{
  PovLibrary library(folder, "");
  std::map<std::string, std::string> found;
  for (const PovFile& file : makePovScene(*test::SceneBuilder().add(model).state(), straightView(), {}, library).uses)
  {
    found[file.name.substr(0, file.name.rfind('_')) + file.name.substr(file.name.rfind('.'))] =
      readFile(folder + '/' + file.name);
  }
  return found;
}

TEST_F(PovWhole, PicturesOfALibrary)
{
  const std::string path = this->Folder.path("wood panel.png");
  const auto square = makePictured(path);
  auto files = usesOf(square, this->Folder.path());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files["wood panel.png"], readFile(path));
  EXPECT_THAT(files["mesh.inc"], testing::HasSubstr("image_map { png \"wood panel_"));
  square->materials[0].diffuse = { 1, 0.5, 0.1 };
  files = usesOf(square, this->Folder.path());
  ASSERT_EQ(files.size(), 2u);
  // Rounded products: 0 5 2, 40 25 6, 80 45 10, 120 65 14
  EXPECT_EQ(files["wood panel.ppm"], "P6\n2 2\n255\n" + std::string("\0\5\2\x28\x19\6\x50\x2d\xa\x78\x41\xe", 12));
  square->materials[0].diffuse = { 1, 1, 1 };
  square->materials[0].cutOut = true;
  files = usesOf(square, this->Folder.path());
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files["wood panel_mask.pgm"], "P5\n2 2\n255\n\xff\xff\xff\xff");
}

TEST_F(PovWhole, NamesOfPicturesThatPovRayIsGiven)
{
  const auto written = [this](const std::string& picture, const std::string& scene)
  {
    exportPov(makePictured(this->Folder.path(picture)), this->Folder.path(scene));
    return readFile(this->Folder.path(scene));
  };
  const std::string plain = "AZaz09-_.,+ ().png";
  EXPECT_THAT(written(plain, "q.pov"), testing::HasSubstr("image_map { png \"" + plain + '"'));
  for (const char c : { '@', '[', '`', '{', ':', '"', '\xe9' }) // beside those, and what ends a string
  {
    EXPECT_THAT(written(std::string("x") + c + ".png", std::string("AZ") + c + ".pov"),
      testing::HasSubstr("image_map { ppm \"AZ__0.ppm\""))
      << c;
  }
}

// A mesh is known by addresses; another may come to stand there.
TEST_F(PovWhole, MeshesOfALibraryThatAreGoneAreForgotten)
{
  Geometry here = *makeSquare()->rest;
  const auto model = std::make_shared<Model>(*makeSquare());
  PovLibrary library(this->Folder.path(), "");
  SceneState state;
  state.instances.resize(1);
  state.instances[0].model = model;
  const auto first = [&]
  {
    state.instances[0].geometry = std::shared_ptr<const Geometry>(&here, [](const Geometry*) {});
    const PovScene scene = makePovScene(state, straightView(), {}, library);
    state.instances[0].geometry.reset();
    return readFile(this->Folder.path(scene.uses.at(0).name));
  };
  EXPECT_THAT(first(), testing::HasSubstr("<1, 1, 0>"));
  here.positions[3] = { 1, 1.5, 0 };
  EXPECT_THAT(first(), testing::HasSubstr("<1, 1.5, 0>"));
}

/// Number after a word.
double wholeAfter(const std::string& text, const std::string& word)
{
  const std::size_t at = text.find(word);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + word.size()));
}

// Slopes are differences between texels, of which the material says how many units wide they are.
TEST_F(PovWhole, BumpsFollowTheTexelsOnTheSurface)
{
  const auto square = makePictured(this->Folder.path("t.png"));
  square->materials[0].texture = -1;
  square->materials[0].bumpMap = 0;
  square->materials[0].bumpScale = 0.5;
  for (Eigen::Vector2d& uv : square->uvs)
  {
    uv = { 3 * uv.x() - uv.y(), uv.x() + 2 * uv.y() }; // 7 times the picture on a square of side 2
  }
  const std::string text = this->write(*test::SceneBuilder().add(square).state(), {});
  EXPECT_NEAR(wholeAfter(text, "bump_size "), 0.5 / std::sqrt(4 / (7.0 * 2 * 2)), 1e-14);
  EXPECT_THAT(text, testing::HasSubstr("normal { uv_mapping bump_map { png \"t.png\" interpolate 2 bump_size "));
  EXPECT_THAT(text, testing::HasSubstr(" } scale <1, 1, -1> } finish {"));
}

TEST_F(PovWhole, MissingTexelsMirrorNothing)
{
  const auto square = makePictured(this->Folder.path("t.png"));
  square->materials[0].specular = { 1, 1, 1 };
  square->materials[0].shininess = 128;
  PovOptions options;
  options.reflections = true;
  EXPECT_THAT(this->write(*test::SceneBuilder().add(square).state(), options), testing::HasSubstr("reflection { 1 }"));
  square->materials[0].cutOut = true;
  EXPECT_THAT(
    this->write(*test::SceneBuilder().add(square).state(), options), testing::Not(testing::HasSubstr("reflection")));
}

TEST_F(PovWhole, NothingIsWrittenOverWhatIsRead)
{
  const auto at = [this](const std::string& name) { return this->Folder.path(name); };
  const auto square = makePictured(at("s_1.ppm"));
  square->materials[0].diffuse = { 1, 0.5, 0.1 };
  square->path = at("model.pov");
  square->companions = { at("s_2_mask.pgm") };
  for (const char* name : { "model.pov", "s_2_mask.pgm", "s_0.ppm" })
  {
    writeFile(at(name), "mine");
  }
  std::filesystem::create_hard_link(at("s_0.ppm"), at("sky.ppm"));
  std::filesystem::create_symlink("model.pov", at("link.pov"));
  const auto state = test::SceneBuilder().add(square).state();
  PovOptions options;
  options.inputs = { at("sky.ppm"), at("missing") };
  EXPECT_THAT(this->write(*state, options), testing::HasSubstr("image_map { ppm \"s_3.ppm\""));
  EXPECT_EQ(this->Result.files, (std::vector<std::string>{ at("s_3.ppm"), at("s.pov") }));
  for (const char* name : { "model.pov", "link.pov" })
  {
    const std::string refusal = at(name) + ": is one of the files that are read for it; name another file";
    EXPECT_EQ(test::thrownBy<UsageError>([&] { exportPov(*state, straightView(), at(name)); }), refusal);
    EXPECT_EQ(test::thrownBy<UsageError>([&] { exportPov(square, at(name)); }), refusal);
  }
  EXPECT_FALSE(std::filesystem::exists(at("model_0.ppm")));
  for (const char* name : { "model.pov", "link.pov", "s_2_mask.pgm", "s_0.ppm" })
  {
    EXPECT_EQ(readFile(at(name)), "mine") << name;
  }
}

// What stands at near or far is drawn or not by a rounding: it is left to POV-Ray's planes.
TEST_F(PovWhole, WhatStandsAtTheLimitsIsCut)
{
  const auto cuts = [this](double depth)
  {
    const auto square = makeSquare();
    const std::string text =
      this->write(*test::SceneBuilder().add(square, test::placement({ 0, 0, depth })).state(), {});
    return std::make_pair(text.find("plane { <0, 0, -1>, -1 }") != std::string::npos,
      text.find("plane { <0, 0, 1>, 64 }") != std::string::npos);
  };
  EXPECT_EQ(cuts(0.5), std::make_pair(true, false));
  EXPECT_EQ(cuts(1 + 1e-7), std::make_pair(true, false));
  EXPECT_EQ(cuts(1 + 1e-5), std::make_pair(false, false));
  EXPECT_EQ(cuts(64 - 1e-3), std::make_pair(false, false));
  EXPECT_EQ(cuts(64 - 1e-5), std::make_pair(false, true));
  EXPECT_EQ(cuts(65), std::make_pair(false, true));
}

} // namespace
} // namespace dgtk
