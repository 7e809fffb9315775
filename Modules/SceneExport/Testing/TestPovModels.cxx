// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelReader.h"
#include "dgtkPovExport.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <unistd.h>

namespace dgtk
{
namespace
{

namespace fs = std::filesystem;

std::vector<std::string> modelsBelow(const std::string& folder)
{
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    const std::string extension = entry.path().extension().string();
    const std::vector<std::string> known{ ".ac", ".acc", ".md2", ".3ds", ".3DS", ".pov", ".obj", ".gltf" };
    if (std::find(known.begin(), known.end(), extension) != known.end())
    {
      found.push_back(entry.path().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

using Corners = std::array<std::array<double, 3>, 3>;

/// All triangles, in an order that knows neither winding nor parts: the reader makes a part of each texture.
std::vector<Corners> trianglesOf(const Model& model)
{
  std::vector<Corners> all;
  for (const auto& triangle : model.triangles)
  {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d& p = model.rest->positions[triangle[k]];
      corners[k] = { p.x(), p.y(), p.z() };
    }
    std::sort(corners.begin(), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t expectAllReadBack(const std::string& folder)
{
  const fs::path out = fs::temp_directory_path() / ("dgtk-pov-models-" + std::to_string(getpid()));
  std::size_t compared = 0;
  for (const std::string& path : modelsBelow(folder))
  {
    std::shared_ptr<const Model> model;
    try
    {
      model = readModel(path);
    }
    catch (const Error&) // malformed on purpose
    {
      continue;
    }
    fs::create_directories(out);
    exportPov(model, (out / "m.pov").string());
    if (!model->triangles.empty())
    {
      EXPECT_TRUE(trianglesOf(*model) == trianglesOf(*readModel((out / "m.pov").string()))) << path;
      ++compared;
    }
    fs::remove_all(out);
  }
  return compared;
}

TEST(PovModels, OfTheSourceReadBackWithTheSameTriangles)
{
  EXPECT_GT(expectAllReadBack(test::sourceFile("Data/Models")), 15u);
}

TEST(PovModels, OfOthersReadBackWithTheSameTriangles)
{
  const std::string folder = test::extraModels();
  if (folder.empty())
  {
    GTEST_SKIP() << "further models are not part of the source: set DGTK_EXTRA_MODELS";
  }
  EXPECT_GT(expectAllReadBack(folder), 20u);
}

/// What is cut out has the colours beside it; bumps have the picture's own.
TEST(PovPictures, HolesAreFilledWhereTheyAreCutOut)
{
  const auto quad = test::makeQuad();
  test::addCutOut(*quad, 2, 1);
  auto image = std::make_shared<Image>(*quad->textures[0].image);
  image->height = 1;
  image->rgba = { 10, 20, 30, 255, 200, 100, 50, 0 };
  quad->textures[0].image = image;
  Material& leaf = quad->materials[0];
  leaf.diffuse = { 1, 1, 1 };
  leaf.bumpMap = 0;
  const std::vector<std::string> wanted{ std::string("P6\n2 1\n255\n\x0a\x14\x1e\x0a\x14\x1e"),
    std::string("P6\n2 1\n255\n\x0a\x14\x1e\xc8\x64\x32"), std::string("P5\n2 1\n255\n\xff\0", 13) };
  const test::TemporaryFolder folder;
  exportPov(quad, folder.path("q.pov"));
  EXPECT_EQ(readFile(folder.path("q_0.ppm")), wanted[0]);
  EXPECT_EQ(readFile(folder.path("q_1.ppm")), wanted[1]);
  EXPECT_EQ(readFile(folder.path("q_0_mask.pgm")), wanted[2]);
  View view;
  view.name = "c";
  view.model = makePinholeFromFov(64, 48, 45, 0);
  view.camera_from_world = lookAtPose({ 1, 2, 8 }, { 0, 0, 0 }, { 0, 1, 0 });
  fs::create_directories(folder.path("set"));
  PovLibrary library(folder.path("set"), "");
  std::vector<std::string> pictures;
  for (const PovFile& file : makePovScene(*test::SceneBuilder().add(quad).state(), view, {}, library).uses)
  {
    if (fs::path(file.name).extension() != ".inc")
    {
      pictures.push_back(readFile(folder.path("set/" + file.name)));
    }
  }
  EXPECT_THAT(pictures, testing::UnorderedElementsAreArray(wanted));
}
} // namespace
} // namespace dgtk
