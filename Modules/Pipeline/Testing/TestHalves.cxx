// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPacking.h"
#include "dgtkRenderer.h"
#include "dgtkScene.h"
#include "dgtkSurfaceResolution.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

using namespace dgtk;

// A wall at depth 5 on the left, up to a quarter of a pixel beyond the image's middle, before one at depth 8.

namespace
{
constexpr int halvesWidth = 32;
constexpr int halvesHeight = 24;

class Halves : public testing::Test
{
protected:
  void SetUp() override
  {
    writeFile(this->path("wall.ac"),
      "AC3Db\nMATERIAL \"\" rgb 1 0.4 0.2 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT poly\n"
      "texture \"none.png\"\nnumvert 4\n-20 -20 0\n20 -20 0\n20 20 0\n-20 20 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 4\n"
      "0 0 0\n1 0 0\n2 0 0\n3 0 0\nkids 0\n");
    writeFile(this->path("classes.json"), R"({"wall": 3})");
    writeFile(this->path("scene.json"), R"({"version": 1, "classes": "classes.json", "objects": [
      {"model": "wall.ac", "name": "near", "class": "wall", "position": [-19.96875, 0, 0]},
      {"model": "wall.ac", "name": "far", "class": "wall", "position": [0, 0, -3],
       "materials": {"*": {"ambient": [0, 0, 1], "diffuse": [0, 0, 1]}}}], "cameras": [
      {"name": "pinhole", "width": 32, "height": 24, "near": 1, "far": 100,
       "K": [[40, 0, 16], [0, 40, 12], [0, 0, 1]], "orientation": [0, 1, 0, 0], "position": [0, 0, 5]},
      {"name": "parallel", "model": "orthographic", "viewHeight": 0.6, "width": 32, "height": 24, "near": 1,
       "far": 100, "orientation": [0, 1, 0, 0], "position": [0, 0, 5]}]})");
  }
  std::string path(const std::string& name) const { return this->Folder.path(name); }
  std::shared_ptr<const Stage> stage() const { return Stage::load(readScene(this->path("scene.json"))); }

  test::TemporaryFolder Folder;
};

/// A picture after options were set one after another on one renderer, or on a new one for each.
std::vector<double> colors(dgtkRenderer& renderer, const std::vector<std::pair<std::string, std::string>>& options)
{
  renderer.ClearOptions();
  for (const auto& [name, value] : options)
  {
    renderer.SetOption(name, value);
  }
  vtkDataArray* const array = renderer.Render("color");
  EXPECT_TRUE(array) << renderer.GetErrorMessage();
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.insert(values.end(), array->GetTuple3(i), array->GetTuple3(i) + 3);
  }
  return values;
}
} // namespace

TEST_F(Halves, WorldUnitsOfAPixel)
{
  const SurfaceResolution pinhole = surfaceResolution(*this->stage(), 0, 0);
  EXPECT_EQ(pinhole.pixels, std::size_t(halvesWidth * halvesHeight));
  EXPECT_DOUBLE_EQ(pinhole.smallest, 5 / 40.0);
  EXPECT_DOUBLE_EQ(pinhole.median, 5 / 40.0); // of the two in the middle the lower one
  EXPECT_DOUBLE_EQ(pinhole.largest, 8 / 40.0);
  const SurfaceResolution parallel = surfaceResolution(*this->stage(), 1, 0);
  EXPECT_DOUBLE_EQ(parallel.smallest, 1 / 40.0);
  EXPECT_DOUBLE_EQ(parallel.median, 1 / 40.0);
  EXPECT_DOUBLE_EQ(parallel.largest, 1 / 40.0);
  const SurfaceResolution twice = surfaceResolution(*this->stage(), 0, 0, 2 * halvesWidth, 2 * halvesHeight);
  EXPECT_EQ(twice.pixels, std::size_t(4 * halvesWidth * halvesHeight));
  EXPECT_DOUBLE_EQ(twice.smallest, 5 / 80.0);
  // 13 of 32 columns show the near one, or 19
  for (const auto& [cx, median] : { std::pair(13, 8), { 19, 5 } })
  {
    std::string text = readFile(this->path("scene.json"));
    text.replace(text.find("40, 0, 16"), 9, "40, 0, " + std::to_string(cx));
    writeFile(this->path("aside.json"), text);
    EXPECT_DOUBLE_EQ(surfaceResolution(*Stage::load(readScene(this->path("aside.json"))), 0, 0).median, median / 40.0);
  }
}

/// A pinhole's pixel, seen along its own ray: the solid angle falls with the cube of the ray's length at depth 1.
TEST_F(Halves, WorldUnitsOfALensesPixel)
{
  std::string text = readFile(this->path("scene.json"));
  const std::string mark = R"("name": "pinhole",)";
  text.insert(text.find(mark), R"("distortion": [1e-12, 0, 0, 0], )");
  writeFile(this->path("lens.json"), text);
  const SurfaceResolution lens = surfaceResolution(*Stage::load(readScene(this->path("lens.json"))), 0, 0);
  EXPECT_EQ(lens.pixels, std::size_t(halvesWidth * halvesHeight));
  EXPECT_NEAR(lens.smallest, 5 / 40.0 / std::sqrt(Eigen::Vector3d(15.5 / 40, 11.5 / 40, 1).norm()), 1e-4);
  EXPECT_NEAR(lens.largest, 8 / 40.0 / std::sqrt(Eigen::Vector3d(0.5 / 40, 0.5 / 40, 1).norm()), 1e-4);
}

TEST_F(Halves, WhatIsThereIsPackedAndNamedByTheScene)
{
  const Packing packing = planPacking(*this->stage(), this->path("d"));
  std::vector<std::string> copies;
  for (const auto& [from, to] : packing.copies)
  {
    copies.push_back(to);
  }
  EXPECT_THAT(copies, testing::UnorderedElementsAre("inputs/scene/classes.json", "inputs/scene/scene.json",
                        "inputs/scene/wall.ac")) // no picture: it is missing
    << testing::PrintToString(copies);
  EXPECT_EQ(packing.scene.classFile, "inputs/scene/classes.json");
  EXPECT_EQ(packing.scene.objects.at(1).model, "inputs/scene/wall.ac");
}

TEST_F(Halves, FoldersOfOneNameAreNumberedFromTwoOn)
{
  std::string objects;
  for (const char* folder : { "a/parts", "b/parts", "c/parts" })
  {
    makeFolders(this->path(folder));
    writeFile(this->path(std::string(folder) + "/wall.ac"), readFile(this->path("wall.ac")));
    objects += std::string(objects.empty() ? "" : ", ") + "{\"model\": \"" + folder + "/wall.ac\"}";
  }
  writeFile(this->path("many.json"), "{\"objects\": [" + objects + "]}");
  const Packing packing = planPacking(*Stage::load(readScene(this->path("many.json"))), this->path("d"));
  std::vector<std::string> models;
  for (const ObjectDescription& object : packing.scene.objects)
  {
    models.push_back(object.model);
  }
  EXPECT_THAT(models, testing::ElementsAre("inputs/parts/wall.ac", "inputs/parts-2/wall.ac", "inputs/parts-3/wall.ac"));
}

TEST_F(Halves, ARendererThatIsKeptDrawsWhatANewOneDraws)
{
  const auto scene = vtkSmartPointer<dgtkScene>::New();
  ASSERT_TRUE(scene->Load(this->path("scene.json"))) << scene->GetErrorMessage();
  const auto made = [&scene]
  {
    auto renderer = vtkSmartPointer<dgtkRenderer>::New();
    renderer->SetScene(scene);
    return renderer;
  };
  const auto kept = made();
  const std::vector<std::pair<std::string, std::string>> table[] = { {}, { { "samples", "4" } },
    { { "samples", "4" }, { "filter", "gaussian" } }, { { "samples", "4" }, { "filter", "lanczos" } },
    { { "samples", "2" }, { "filter", "lanczos" } }, { { "samples", "2" } }, { { "color_bits", "16" } }, {} };
  std::vector<std::vector<double>> pictures;
  for (const auto& options : table)
  {
    pictures.push_back(colors(*kept, options));
    EXPECT_EQ(pictures.back(), colors(*made(), options)) << pictures.size();
  }
  for (std::size_t i = 1; i + 1 < pictures.size(); ++i)
  {
    EXPECT_NE(pictures[i], pictures[i - 1]) << i;
  }
}
