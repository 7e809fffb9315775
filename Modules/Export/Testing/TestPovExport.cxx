// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovExport.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelReader.h"
#include "dgtkSyntheticScene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace dgtk
{
namespace
{

using testing::HasSubstr;

/// A coordinate that went through text and a product with a matrix, of numbers up to 10.
constexpr double RoundTrip = 1e-12;

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

/// Corners of all triangles, in order.
std::vector<Eigen::Vector3d> corners(const SceneState& state)
{
  std::vector<Eigen::Vector3d> all;
  for (const Instance& instance : state.instances)
  {
    for (const auto& triangle : instance.model->triangles)
    {
      for (const std::uint32_t vertex : triangle)
      {
        all.push_back(instance.world_from_object * instance.geometry->positions[vertex]);
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
void expectSameTriangles(const std::vector<Eigen::Vector3d>& expected, const std::vector<Eigen::Vector3d>& found)
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
    ASSERT_LE(least, RoundTrip) << "triangle " << i / 3;
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
  expectSameTriangles(corners(*state), corners(*readModel(this->path("s.pov"))));
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
    const std::string light = all.substr(all.find("light_source"), all.find('\n', all.find("light_source")));
    const double scale = after(light, "rgb <");
    for (const double d : { 0.1, 1.0, 7.0 })
    {
      const bool fades = k[1] > 0 || k[2] > 0;
      const double fade =
        fades ? 2 / (1 + std::pow(d / after(light, "fade_distance "), after(light, "fade_power "))) : 1;
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
