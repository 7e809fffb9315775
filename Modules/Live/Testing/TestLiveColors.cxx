// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveTruth.h"

#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr int width = 120;
constexpr int height = 90;

/// The picture of the scene's first camera that the renderer writes.
ImageData rendered(const std::string& scene, int frame, const std::string& folder)
{
  GeneratorRequest request;
  request.scene = scene;
  request.folder = folder;
  request.layers = { "color" };
  request.frames = FrameRange{ frame, frame, 1 };
  request.cameras = { readScene(scene).cameras.front().name };
  request.width = width;
  request.height = height;
  request.options["threads"] = "1";
  generate(request);
  const std::string number = std::to_string(frame);
  return readLayerFile(
    folder + "/" + request.cameras.front() + "/color/" + std::string(6 - number.size(), '0') + number + ".png");
}

LayerPicture drafted(const std::string& file, int frame)
{
  const SceneDescription scene = readScene(file);
  ModelLibrary models;
  models.load(scene);
  LiveQuestion question;
  question.scene = std::make_shared<LiveScene>(scene, models);
  question.frame = frame;
  question.camera = scene.cameras.front();
  question.width = width;
  question.height = height;
  ThreadPool pool(1);
  return livePicture(question, draftLayer, 1, pool).picture;
}

/// Pixels of the live picture that are not the file's.
int differing(const std::string& scene, int frame = 0)
{
  const test::TemporaryFolder folder;
  const LayerPicture live = drafted(scene, frame);
  const ImageData file = rendered(scene, frame, folder.path("out"));
  int count = 0;
  for (int i = 0; i < width * height; ++i)
  {
    const std::uint8_t* const expected = file.pixels.row<std::uint8_t>(i / width) + 3 * std::size_t(i % width);
    const auto& found = live.pixels[std::size_t(i)];
    count += std::equal(expected, expected + 3, found.begin()) ? 0 : 1;
  }
  return count;
}

class LiveColors : public ::testing::TestWithParam<const char*>
{
};

TEST_P(LiveColors, AreThoseOfTheFile) { EXPECT_EQ(differing(sourceFile(std::string("Data/Scenes/") + GetParam())), 0); }

// Emission and head lights, every kind of light, environment and metal, what is seen through, bumps, shadows.
INSTANTIATE_TEST_SUITE_P(Of, LiveColors,
  ::testing::Values("appendix_b3.scene", "demo.json", "lights_many.json", "materials_environment.json",
    "fig_b2_outdoor.json", "fig_4_5_bump_mapping.json", "fig_4_6_ray_traced.json"));

} // namespace
