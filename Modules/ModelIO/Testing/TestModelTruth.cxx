// SPDX-License-Identifier: BSD-3-Clause
// Real files against counts and bounds that independent parsers found, where the folder of models is; and damaged ones.
#include "dgtkError.h"
#include "dgtkModelChecks.h"
#include "dgtkModelReader.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>

namespace
{
/// Four significant digits, as the reference has them: half a unit of the last digit and a little for its rounding.
void expectFourDigits(double expected, double found, const std::string& what)
{
  const double unit = expected == 0 ? 0 : std::pow(10.0, std::floor(std::log10(std::abs(expected))) - 3);
  EXPECT_NEAR(expected, found, 0.51 * unit + 1e-9) << what;
}

std::string sequencesText(const dgtk::Model& model)
{
  std::string text;
  int next = 0;
  for (const dgtk::Animation& a : model.animations)
  {
    if (a.first != next)
    {
      break; // animations of a text file beside the model follow the frames' own
    }
    text += (text.empty() ? "" : ",") + a.name + ":" + std::to_string(a.last - a.first + 1);
    next = a.last + 1;
    if (next == model.frames)
    {
      break;
    }
  }
  return text;
}

void expectBounds(const dgtk::Model& model, const nlohmann::json& bounds, const std::string& name)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    expectFourDigits(bounds[0][static_cast<std::size_t>(axis)], model.boundsMin[axis], name);
    expectFourDigits(bounds[1][static_cast<std::size_t>(axis)], model.boundsMax[axis], name);
  }
}
} // namespace

namespace
{
std::string lowerStem(const std::filesystem::path& path)
{
  std::string stem = path.stem().string();
  for (char& c : stem)
  {
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  }
  return stem;
}

/// What a listing of the model's folder has under the texture's name, whatever its case and extension.
std::string pictureBeside(const std::string& model, std::string name)
{
  name = name.substr(name.find_last_of("/\\") + 1);
  const std::string wanted = lowerStem(name[0] == '.' ? name.substr(1) : name);
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(model).parent_path()))
  {
    const std::string extension = entry.path().extension().string();
    if (lowerStem(entry.path()) == wanted && extension != ".md2" && extension != ".anm" && extension != ".txt")
    {
      return entry.path().filename().string();
    }
  }
  return {};
}
} // namespace

TEST(ModelTruth, TexturesThatAreThereAreFoundAndDecoded)
{
  int found = 0;
  for (const std::string extension : { "ac", "acc", "md2", "3ds", "3DS" })
  {
    for (const std::string& path : dgtk::test::extraPaths(extension))
    {
      const std::shared_ptr<const dgtk::Model> model = dgtk::readModel(path);
      for (const dgtk::Texture& texture : model->textures)
      {
        EXPECT_EQ(texture.path.empty(), texture.image == nullptr) << path << ": " << texture.name;
        EXPECT_TRUE(!texture.path.empty() || pictureBeside(path, texture.name).empty())
          << path << ": " << texture.name << " not found, but " << pictureBeside(path, texture.name) << " is there";
        found += texture.path.empty() ? 0 : 1;
      }
    }
  }
  if (dgtk::test::extraModels().empty())
  {
    GTEST_SKIP() << dgtk::test::withoutExtraModels;
  }
  EXPECT_GE(found, 28);
}

TEST(ModelTruth, CountsAndBounds)
{
  const std::string folder = dgtk::test::extraModels();
  if (folder.empty() || !std::filesystem::exists(folder + "/TRUTH.json"))
  {
    GTEST_SKIP() << dgtk::test::withoutExtraModels;
  }
  const nlohmann::json truth = nlohmann::json::parse(dgtk::test::contentsOf(folder + "/TRUTH.json"));
  int compared = 0;
  for (const auto& [name, t] : truth.items())
  {
    const std::string format = t["format"];
    const std::string path = folder + "/" + name;
    if (format != "ac3d" && format != "md2" && format != "3ds")
    {
      continue;
    }
    ++compared;
    if (std::filesystem::file_size(path) == 0)
    {
      EXPECT_THROW(dgtk::readModel(path), dgtk::InputError) << name;
      continue;
    }
    const std::shared_ptr<const dgtk::Model> model = dgtk::readModel(path);
    EXPECT_EQ(model->format, format);
    EXPECT_EQ(model->triangles.size(), t["triangles"]) << name;
    EXPECT_EQ(dgtk::test::brokenPromise(*model), "") << name;
    if (t.contains("materials"))
    {
      EXPECT_EQ(model->declaredMaterials, t["materials"]) << name;
    }
    if (t.contains("lines"))
    {
      EXPECT_EQ(model->lines, t["lines"]) << name;
      EXPECT_EQ(model->twoSidedSurfaces, t["surfaces_two_sided"]) << name;
    }
    if (t.contains("frames"))
    {
      EXPECT_EQ(model->frames, t["frames"]) << name;
      EXPECT_EQ(sequencesText(*model), t["sequences"]) << name;
    }
    const char* key = t.contains("bounds_frame0") ? "bounds_frame0" : "bounds";
    if (t.contains(key))
    {
      expectBounds(*model, t[key], name);
    }
    else
    {
      EXPECT_GT(model->boundsMin[0], model->boundsMax[0]) << name;
    }
    if (std::getenv("DGTK_TEST_VERBOSE"))
    {
      for (const dgtk::Texture& x : model->textures)
      {
        std::cout << name << ": " << x.name << " -> " << x.path << (x.image ? "" : " (no picture)") << '\n';
      }
      for (const std::string& warning : model->warnings)
      {
        std::cout << name << ": warning: " << warning << '\n';
      }
    }
  }
  EXPECT_GE(compared, 30);
}

namespace
{
/// Small real files; without them there is nothing that the made ones do not try.
void fuzzReal(const std::string& extension)
{
  const std::vector<std::string> seeds = dgtk::test::extraSeeds(extension);
  if (seeds.empty())
  {
    GTEST_SKIP() << dgtk::test::withoutExtraModels;
  }
  dgtk::test::fuzzReader(extension, seeds);
}
} // namespace

TEST(ModelFuzz, Ac3d) { dgtk::test::fuzzReader("ac", { dgtk::test::ac3dSeed() }); }
TEST(ModelFuzz, Md2) { dgtk::test::fuzzReader("md2", { dgtk::test::md2Seed().bytes() }); }
TEST(ModelFuzz, Studio3ds) { dgtk::test::fuzzReader("3ds", { dgtk::test::seed3ds() }); }

TEST(ModelFuzz, RealAc3d) { fuzzReal("ac"); }
TEST(ModelFuzz, RealMd2) { fuzzReal("md2"); }
TEST(ModelFuzz, Real3ds) { fuzzReal("3ds"); }
