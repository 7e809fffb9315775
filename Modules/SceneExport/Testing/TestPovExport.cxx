// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovExport.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkModelReader.h"
#include "dgtkSyntheticScene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <regex>
#include <unistd.h>

namespace dgtk
{
namespace
{

using testing::HasSubstr;

/// A coordinate that went through text and a product with a matrix, of numbers up to 10.
constexpr double roundTrip = 1e-12;

class PovExport : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = std::filesystem::temp_directory_path() / ("dgtk-export-" + std::to_string(getpid()));
    std::filesystem::create_directories(this->Folder);
    this->V.name = "c";
    this->V.model = makePinholeFromFov(64, 48, 45, 0);
    this->V.camera_from_world = lookAtPose({ 1, 2, 8 }, { 0, 0, 0 }, { 0, 1, 0 });
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }
  std::string path(const std::string& name) const { return (this->Folder / name).string(); }

  std::filesystem::path Folder;
  View V;
};

std::size_t count(const std::string& text, const std::string& word)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    ++n;
  }
  return n;
}

/// Corners of all triangles, in order, times `scale`.
std::vector<Eigen::Vector3d> corners(const SceneState& state, double scale)
{
  std::vector<Eigen::Vector3d> all;
  for (const Instance& instance : state.instances)
  {
    for (const auto& triangle : instance.model->triangles)
    {
      for (const std::uint32_t vertex : triangle)
      {
        all.push_back(scale * (instance.world_from_object * instance.geometry->positions[vertex]));
      }
    }
  }
  return all;
}

std::vector<Eigen::Vector3d> corners(const Model& model)
{
  std::vector<Eigen::Vector3d> all;
  for (const auto& triangle : model.triangles)
  {
    for (const std::uint32_t vertex : triangle)
    {
      all.push_back(model.rest->positions[vertex]);
    }
  }
  return all;
}

/// Each triangle begins somewhere, and winding means nothing in the format: one of the six orders must agree.
void expectSameTriangles(
  const std::vector<Eigen::Vector3d>& expected, const std::vector<Eigen::Vector3d>& found, double scale = 1)
{
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); i += 3)
  {
    double least = HUGE_VAL;
    for (std::size_t turn = 0; turn < 6; ++turn)
    {
      double largest = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        largest =
          std::max(largest, (expected[i + k] - found[i + (turn < 3 ? k + turn : turn - k) % 3]).cwiseAbs().maxCoeff());
      }
      least = std::min(least, largest);
    }
    ASSERT_LE(least, roundTrip * scale) << "triangle " << i / 3;
  }
}

TEST_F(PovExport, ReadBackHasTheSameTriangles)
{
  const auto sphere = test::makeSphere();
  Affine3 mirrored = test::placement({ -3, 0.1, 0 }, 1.3, { 1, 2, 3 }, 0.7);
  mirrored.linear.col(1) *= -2;
  const auto state = test::SceneBuilder()
                       .add(sphere, test::placement({ 0.3, 1, -2 }, 0.5, { 0, 1, 1 }, 1))
                       .add(test::makeBox(), test::placement({ 2, 0, 0 }))
                       .add(sphere, mirrored)
                       .state();
  const PovResult result = exportPov(*state, this->V, this->path("s.pov"));
  EXPECT_EQ(result.files, std::vector<std::string>{ this->path("s.pov") });
  EXPECT_EQ(count(readFile(this->path("s.pov")), "mesh2"), 2u);
  EXPECT_GT(result.scale, 1);
  expectSameTriangles(corners(*state, result.scale), corners(*readModel(this->path("s.pov"))), result.scale);
}

TEST_F(PovExport, IncludedMeshesReadBack)
{
  const auto sphere = test::makeSphere();
  const auto state = test::SceneBuilder()
                       .add(sphere, test::placement({ 0.3, 1, -2 }, 0.5, { 0, 1, 1 }, 1))
                       .add(test::makeBox(), test::placement({ 2, 0, 0 }))
                       .add(sphere, test::placement({ -2, 0, 0 }))
                       .state();
  std::filesystem::create_directories(this->path("pov"));
  std::filesystem::create_directories(this->path("c/pov"));
  PovLibrary library(this->path("pov"), "../../pov/");
  const PovScene scene = makePovScene(*state, this->V, {}, library);
  const PovScene again = makePovScene(*state, this->V, {}, library);
  EXPECT_EQ(scene.text, again.text);
  ASSERT_EQ(scene.uses.size(), 2u); // two meshes, three objects
  EXPECT_EQ(count(scene.text, "#include"), 2u);
  writeFile(this->path("c/pov/0.pov"), scene.text);
  EXPECT_EQ(
    povSceneUses(this->path("c/pov/0.pov")), (std::vector<std::string>{ scene.uses[0].name, scene.uses[1].name }));
  for (const PovFile& file : scene.uses)
  {
    EXPECT_EQ(Sha256::ofFile(this->path("pov/" + file.name)), file.sha256);
    EXPECT_EQ(std::filesystem::file_size(this->path("pov/" + file.name)), file.bytes);
    EXPECT_THAT(file.name, HasSubstr('_' + Sha256::ofFile(this->path("pov/" + file.name)).substr(0, 16)));
  }
  expectSameTriangles(corners(*state, scene.scale), corners(*readModel(this->path("c/pov/0.pov"))), scene.scale);
}

/// Smooth, and so coarse that interpolated normals face away from a viewer.
std::shared_ptr<Model> coarseSphere()
{
  test::SphereOptions options;
  options.rings = 4;
  options.segments = 6;
  return test::makeSphere(options);
}

TEST_F(PovExport, NormalsThatFaceAwayHaveTexturesOfTheView)
{
  const auto state =
    test::SceneBuilder().add(coarseSphere()).add(test::makeBox(), test::placement({ 2, 0, 0 })).state();
  this->V.model = makePinholeFromFov(320, 240, 45, 0);
  std::filesystem::create_directories(this->path("c/pov"));
  PovLibrary library(this->path("c/pov"), "");
  const PovScene scene = makePovScene(*state, this->V, {}, library);
  ASSERT_EQ(scene.uses.size(), 1u); // the box
  EXPECT_EQ(count(scene.text, "= mesh2"), 1u);
  EXPECT_EQ(count(scene.text, "texture_map"), 2u);
  EXPECT_EQ(count(scene.text, "diffuse 0, "), 1u);
  EXPECT_EQ(count(scene.text, "normal_indices"), 0u); // the model's own
  writeFile(this->path("c/pov/0.pov"), scene.text);
  const auto again = readModel(this->path("c/pov/0.pov"));
  expectSameTriangles(corners(*state, scene.scale), corners(*again), scene.scale);
  EXPECT_EQ(again->materials.size(), 2u);
}

TEST_F(PovExport, MeshesAreSharedUnlessNormalsFaceAwayInManyPixels)
{
  const auto sphere = coarseSphere();
  const auto state =
    test::SceneBuilder().add(sphere, test::placement({ -1, 0, 0 })).add(sphere, test::placement({ 1, 0, 0 })).state();
  const auto meshes = [&](int width, const PovOptions& options)
  {
    this->V.model = makePinholeFromFov(width, width * 3 / 4, 45, 0);
    exportPov(*state, this->V, this->path("s.pov"), options);
    return count(readFile(this->path("s.pov")), "mesh2");
  };
  EXPECT_EQ(meshes(64, {}), 1u);
  EXPECT_EQ(meshes(640, {}), 2u);
  PovOptions flat;
  flat.flatIds = true;
  EXPECT_EQ(meshes(640, flat), 1u);
  exportPov(sphere, this->path("m.pov")); // a model is not made for a view
  EXPECT_EQ(count(readFile(this->path("m.pov")), "texture_map"), 0u);
}

TEST_F(PovExport, LibraryNamesAreThoseOfTheContents)
{
  const auto quad = test::makeQuad();
  test::addCutOut(*quad, 4, 1);
  const auto state = test::SceneBuilder().add(quad).state();
  std::vector<std::string> texts;
  for (const char* folder : { "one", "two" })
  {
    std::filesystem::create_directories(this->path(folder));
    PovLibrary library(this->path(folder), "");
    const PovScene scene = makePovScene(*state, this->V, {}, library);
    texts.push_back(scene.text);
    EXPECT_EQ(scene.uses.size(), 3u); // mesh, colours, mask
  }
  EXPECT_EQ(texts[0], texts[1]);
}

/// The numbers of `<a, b, c>` after a word.
Eigen::Vector3d vectorAfter(const std::string& text, const std::string& word)
{
  Eigen::Vector3d v(NAN, NAN, NAN);
  const std::size_t at = text.find(word + " <");
  std::sscanf(text.c_str() + (at == std::string::npos ? text.size() : at + word.size() + 2), "%lf, %lf, %lf", &v[0],
    &v[1], &v[2]);
  return v;
}

TEST_F(PovExport, RowsHaveTheRaysOfTheWhole)
{
  Eigen::Matrix3d K;
  K << 70, 3, 20, 0, 55, 31, 0, 0, 1;
  this->V.model = makePinhole(64, 48, K);
  const auto state = test::SceneBuilder().add(test::makeBox()).state();
  PovLibrary library(this->Folder.string(), "");
  const auto rayAt = [&](const PovRows& rows, int height, double x, double y) -> Eigen::Vector3d
  {
    const std::string text = makePovScene(*state, this->V, {}, library, rows).text;
    return vectorAfter(text, "direction") + (x / 64 - 0.5) * vectorAfter(text, "right") +
           (0.5 - y / height) * vectorAfter(text, "up");
  };
  for (const double y : { 0.5, 7.5 })
  {
    EXPECT_LE((rayAt({ 16, 8 }, 8, 10.5, y) - rayAt({}, 48, 10.5, y + 16)).norm(), 1e-14);
  }
}

TEST_F(PovExport, WhatTheImageDoesNotShowIsNotCut)
{
  // the second box crosses the camera's plane far to its side, the third the far plane behind the image's corner
  this->V.camera_from_world = Rigid3();
  this->V.far = 50;
  const auto state = test::SceneBuilder()
                       .add(test::makeBox(), test::placement({ 0, 0, 10 }))
                       .add(test::makeBox(), test::placement({ 20, 0, 0 }))
                       .add(test::makeBox(), test::placement({ 40, 40, 50 }))
                       .state();
  exportPov(*state, this->V, this->path("n.pov"));
  EXPECT_EQ(count(readFile(this->path("n.pov")), "clipped_by"), 0u);
  this->V.far = 10;
  exportPov(*state, this->V, this->path("n.pov"));
  EXPECT_EQ(count(readFile(this->path("n.pov")), "clipped_by"), 1u);
  this->V.model = makeOrthographic(64, 48, 2, 0);
  exportPov(*state, this->V, this->path("n.pov"));
  EXPECT_EQ(count(readFile(this->path("n.pov")), "clipped_by"), 1u);
  this->V.model = makeOrthographic(64, 48, 60, 0);
  exportPov(*state, this->V, this->path("n.pov"));
  EXPECT_EQ(count(readFile(this->path("n.pov")), "clipped_by"), 2u);
}

TEST_F(PovExport, WhatCrossesTheNearPlaneIsCut)
{
  const auto state = test::SceneBuilder()
                       .add(test::makeBox(), test::placement({ 0, 0, -10 }))
                       .add(test::makeBox(), test::placement({ 0, 0, 0 }))
                       .state();
  this->V.near = std::sqrt(1 + 4 + 64.0);
  exportPov(*state, this->V, this->path("n.pov"));
  const std::string text = readFile(this->path("n.pov"));
  EXPECT_EQ(count(text, "clipped_by"), 1u);
  EXPECT_GT(text.find("clipped_by"), text.find("object 2"));
}

// What POV-Ray keeps, the inside of a plane, is where normal . x is below its distance.
TEST_F(PovExport, WhatIsCutLiesBeyondNearAndFar)
{
  const auto state =
    test::SceneBuilder().add(test::makeQuad({ { -50, 0, -50 }, { 100, 0, 0 }, { 0, 0, 100 } })).state();
  this->V.near = 5;
  this->V.far = 12;
  exportPov(*state, this->V, this->path("n.pov"));
  const std::string text = readFile(this->path("n.pov"));
  const std::regex form(R"(plane \{ <([^,]+), ([^,]+), ([^>]+)>, ([^ ]+) \})");
  std::vector<std::pair<Eigen::Vector3d, double>> planes;
  for (std::sregex_iterator at(text.begin() + long(text.find("clipped_by")), text.end(), form), end; at != end; ++at)
  {
    planes.push_back({ { std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3]) }, std::stod((*at)[4]) });
  }
  ASSERT_EQ(planes.size(), 2u);
  const Rigid3 world_from_camera = this->V.camera_from_world.inverse();
  for (const double depth : { -4.0, 4.999, 5.001, 8.0, 11.999, 12.001, 30.0 })
  {
    const Eigen::Vector3d x = world_from_camera * Eigen::Vector3d(0.3 * depth, -0.2 * depth, depth);
    const bool kept =
      std::all_of(planes.begin(), planes.end(), [&](const auto& plane) { return plane.first.dot(x) <= plane.second; });
    EXPECT_EQ(kept, depth > 5 && depth < 12) << depth;
  }
}

TEST_F(PovExport, ModelKeepsItsAxes)
{
  const auto box = test::makeBox({ { -1, 0.25, -3 }, { 2, 1, 5 } });
  exportPov(box, this->path("m.pov"));
  expectSameTriangles(corners(*box), corners(*readModel(this->path("m.pov"))));
}

TEST_F(PovExport, FlatModelsHaveNoNormals)
{
  exportPov(test::makeQuad(), this->path("flat.pov"));
  EXPECT_EQ(count(readFile(this->path("flat.pov")), "normal_vectors"), 0u);
  exportPov(test::makeSphere(), this->path("round.pov"));
  EXPECT_EQ(count(readFile(this->path("round.pov")), "normal_vectors"), 1u);
}

/// The number after a word.
double after(const std::string& text, const std::string& word)
{
  const std::size_t at = text.find(word);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + word.size()));
}

TEST_F(PovExport, AttenuationIsThatOfTheFormula)
{
  const Eigen::Vector3d cases[] = { { 2, 0, 0 }, { 2, 0.5, 0 }, { 0.5, 0, 3 } };
  for (const Eigen::Vector3d& k : cases)
  {
    SceneState state = *test::SceneBuilder().add(test::makeBox()).state();
    state.lights.resize(1);
    state.lights[0].attenuation = k;
    exportPov(state, this->V, this->path("a.pov"));
    const std::string all = readFile(this->path("a.pov"));
    const std::size_t begin = all.find("light_source");
    const std::string light = all.substr(begin, all.find('\n', begin) - begin);
    const double scale = after(light, "rgb <");
    const double size = after(light, " scale "); // of the scene as written
    for (const double d : { 0.1, 1.0, 7.0 })
    {
      const bool fades = k[1] > 0 || k[2] > 0;
      const double fade =
        fades ? 2 / (1 + std::pow(d * size / after(light, "fade_distance "), after(light, "fade_power "))) : 1;
      EXPECT_NEAR(scale * fade, 1 / (k[0] + k[1] * d + k[2] * d * d), 1e-12);
    }
  }
}

TEST_F(PovExport, RefusalsLeaveWhatWasThere)
{
  const auto state = test::SceneBuilder().add(test::makeBox()).state();
  writeFile(this->path("x.json"), "before");
  EXPECT_THROW(exportPov(*state, this->V, this->path("x.json")), InputError);
  EXPECT_EQ(readFile(this->path("x.json")), "before");
  EXPECT_THROW(exportPov(*state, this->V, this->path("nowhere/x.pov")), MachineError);
}

TEST_F(PovExport, BumpsAreInSceneUnits)
{
  const auto quad = test::makeQuad();
  test::addCutOut(*quad, 4, 1); // a texture of 4 x 4
  quad->materials[0].cutOut = false;
  quad->materials[0].bumpMap = quad->materials[0].texture;
  quad->materials[0].bumpScale = 0.3;
  double sizes[2] = {};
  for (const double scale : { 1.0, 2.0 })
  {
    const auto state = test::SceneBuilder().add(quad, test::placement({ 0, 0, 0 }, scale)).state();
    exportPov(*state, this->V, this->path("b.pov"));
    sizes[int(scale) - 1] = after(readFile(this->path("b.pov")), "bump_size ");
  }
  EXPECT_NEAR(sizes[0], 0.6, 1e-12);          // a texel is half a unit wide
  EXPECT_NEAR(sizes[1], sizes[0] / 2, 1e-12); // texels are twice as large
  // a picture that lies aslant, in as many texels
  for (Eigen::Vector2d& uv : quad->uvs)
  {
    uv = Eigen::Vector2d(uv.x() + 0.75 * uv.y(), 0.5 * uv.x() + 1.375 * uv.y());
  }
  exportPov(*test::SceneBuilder().add(quad).state(), this->V, this->path("b.pov"));
  EXPECT_NEAR(after(readFile(this->path("b.pov")), "bump_size "), 0.6, 1e-12);
  // also beside a material that is plain
  quad->materials.emplace_back();
  const auto state = test::SceneBuilder().add(quad, test::placement({ 0, 0, 0 }, 2)).state();
  exportPov(*state, this->V, this->path("b.pov"));
  EXPECT_NEAR(after(readFile(this->path("b.pov")), "bump_size "), sizes[1], 1e-12);
}

TEST_F(PovExport, NotesSayWhatIsNotWritten)
{
  const auto notesOf = [this](const std::function<void(Material&, SceneState&)>& change)
  {
    const auto box = test::makeBox();
    SceneState state = *test::SceneBuilder().add(box).state();
    change(box->materials.at(0), state);
    return exportPov(state, this->V, this->path("n.pov")).warnings;
  };
  EXPECT_THAT(notesOf([](Material&, SceneState&) {}), testing::IsEmpty());
  // what a model's file says counts in the light of an environment only
  EXPECT_THAT(notesOf(
                [](Material& material, SceneState&) {
                  material.physical = Material::Physical{ 1, 0.5, false };
                }),
    testing::IsEmpty());
  EXPECT_THAT(notesOf(
                [](Material& material, SceneState&) {
                  material.physical = Material::Physical{ 1, 0.5, true };
                }),
    testing::ElementsAre("metallic and roughness are not written"));
  EXPECT_THAT(notesOf([](Material& material, SceneState&) { material.normalMap = 0; }),
    testing::ElementsAre("normal maps are not written"));
  for (const double edge : { 1.0, 1.25, 1.5 })
  {
    const auto box = std::make_shared<Model>(*test::makeBox());
    box->uvs.assign(box->rest->positions.size(), { edge, 0.5 });
    box->textures.resize(1);
    box->textures[0].wrap[1] = TextureWrap::Mirror;
    (edge < 1.5 ? box->materials.at(0).texture : box->materials.at(0).bumpMap) = 0;
    EXPECT_EQ(exportPov(*test::SceneBuilder().add(box).state(), this->V, this->path("n.pov")).warnings,
      edge > 1 ? std::vector<std::string>{ "textures repeat where the model has a border that goes on, or a mirror" }
               : std::vector<std::string>{});
  }
  EXPECT_THAT(notesOf(
                [](Material&, SceneState& state)
                {
                  state.fog = { { 1, 1, 1 }, 0.5, 0 };
                  state.background = Eigen::Vector3d(0, 0, 0);
                }),
    testing::ElementsAre("fog hides the background"));
}

TEST_F(PovExport, NamesEndInPov)
{
  const auto state = test::SceneBuilder().add(test::makeBox()).state();
  for (const char* name : { "a.pov", "a.POV", "a.PoV" })
  {
    EXPECT_NO_THROW(exportPov(*state, this->V, this->path(name))) << name;
  }
  for (const char* name : { "a.inc", "a", "a.pov.txt", "pov" })
  {
    EXPECT_THROW(exportPov(*state, this->V, this->path(name)), InputError) << name;
  }
}

TEST_F(PovExport, FogIsScaledAndNoted)
{
  SceneState state = *test::SceneBuilder().add(test::makeBox()).state();
  state.fog = { { 0.1, 0.2, 0.3 }, 0.25, 0 };
  state.background = state.fog.color;
  PovResult result = exportPov(state, this->V, this->path("f.pov"));
  EXPECT_EQ(after(readFile(this->path("f.pov")), "fog { distance "), 4 * result.scale);
  EXPECT_TRUE(result.warnings.empty());
  state.fog.start = 1;
  result = exportPov(state, this->V, this->path("f.pov"));
  EXPECT_EQ(count(readFile(this->path("f.pov")), "fog"), 0u);
  EXPECT_EQ(result.warnings.size(), 1u);
}

TEST_F(PovExport, ShadowsOfSingleLights)
{
  SceneState state = *test::SceneBuilder().add(test::makeBox()).state();
  state.lights.resize(2);
  exportPov(state, this->V, this->path("l.pov"));
  EXPECT_EQ(count(readFile(this->path("l.pov")), "no_shadow"), 1u);
  state.lights[1].shadows = true;
  const PovResult result = exportPov(state, this->V, this->path("l.pov"));
  EXPECT_EQ(count(readFile(this->path("l.pov")), "no_shadow"), 0u);
  EXPECT_EQ(count(readFile(this->path("l.pov")), "shadowless"), 1u);
  EXPECT_EQ(result.warnings.size(), 1u);
}

TEST_F(PovExport, MissingTexelsGetAMask)
{
  const auto quad = test::makeQuad();
  test::addCutOut(*quad, 4, 1);
  const PovResult result = exportPov(quad, this->path("q.pov"));
  ASSERT_EQ(result.files.size(), 3u);
  const Image& image = *quad->textures[0].image;
  std::string mask = "P5\n4 4\n255\n";
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    mask += image.rgba[i] < 128 ? '\0' : '\xff';
  }
  EXPECT_THAT(result.files, testing::Contains(this->path("q_0_mask.pgm")));
  EXPECT_EQ(readFile(this->path("q_0_mask.pgm")), mask);
  EXPECT_THAT(readFile(this->path("q.pov")), HasSubstr("image_pattern { pgm \"q_0_mask.pgm\""));
}

} // namespace
} // namespace dgtk
