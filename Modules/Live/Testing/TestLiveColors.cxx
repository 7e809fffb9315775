// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveTruth.h"

#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <string>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr int width = 120;
constexpr int height = 90;
constexpr int block = 30; // pixels a side

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

/// The largest difference between the mean colours of squares of both pictures, of 255.
double worstBlock(const LayerPicture& draft, const ImageData& picture)
{
  double worst = 0;
  for (int top = 0; top < height; top += block)
  {
    for (int left = 0; left < width; left += block)
    {
      Eigen::Vector3d sum(0, 0, 0);
      for (int y = top; y < top + block; ++y)
      {
        for (int x = left; x < left + block; ++x)
        {
          for (int c = 0; c < 3; ++c)
          {
            sum[c] += draft.pixels[std::size_t(y) * width + std::size_t(x)][std::size_t(c)] -
                      double(picture.pixels.row<std::uint8_t>(y)[3 * x + c]);
          }
        }
      }
      worst = std::max(worst, (sum / (block * block)).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

double worstOf(const std::string& scene, int frame = 0)
{
  const test::TemporaryFolder folder;
  return worstBlock(drafted(scene, frame), rendered(scene, frame, folder.path("out")));
}

TEST(LiveColors, EmissionAndTheHeadLightAreTheRenderers)
{
  EXPECT_LT(worstOf(sourceFile("Data/Scenes/appendix_b3.scene")), 4);
}

TEST(LiveColors, LightsAndBackgroundAreTheRenderers)
{
  EXPECT_LT(worstOf(sourceFile("Data/Scenes/demo.json")), 4);
  EXPECT_LT(worstOf(sourceFile("Data/Scenes/lights_many.json")), 4);
}

TEST(LiveColors, EnvironmentAndMetalAreTheRenderers)
{
  EXPECT_LT(worstOf(sourceFile("Data/Scenes/materials_environment.json")), 4);
}

TEST(LiveColors, WhatIsSeenThroughIsMixed) { EXPECT_LT(worstOf(sourceFile("Data/Scenes/fig_b2_outdoor.json")), 4); }

} // namespace
