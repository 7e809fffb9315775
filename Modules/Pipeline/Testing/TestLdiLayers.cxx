// SPDX-License-Identifier: BSD-3-Clause
// Layered depth images of whole scenes, read back from disk, against all hits of Embree.
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkLayerReader.h"
#include "dgtkLdi.h"
#include "dgtkRaySource.h"
#include "dgtkStage.h"
#include "dgtkSurfaceRows.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
constexpr int ldiWidth = 200;
constexpr int ldiHeight = 150;
/// Pixels: how near to an edge the two engines may differ.
constexpr double edge = 1.0 / 128;
/// Relative: depths that drawing cannot tell apart.
constexpr double ldiCoincident = 2e-6;

struct SceneCase
{
  const char* scene;
  int frame;
};

std::ostream& operator<<(std::ostream& out, const SceneCase& c) { return out << c.scene << " frame " << c.frame; }

/// What Embree says of a scene.
class AllHits
{
public:
  AllHits(const std::string& scene, int frame)
    : Scene(Stage::load(readScene(scene)))
    , State(this->Scene->at(frame))
    , Query(makeOcclusionQuery())
  {
    this->Query->setScene(this->State);
    this->TheView = this->Scene->view(0, frame, ldiWidth, ldiHeight);
  }

  std::string camera() const { return this->Scene->cameraNames()[0]; }

  std::vector<Hit> at(double x, double y) const
  {
    std::vector<Hit> hits;
    this->Query->allHits(this->TheView, { x, y }, hits);
    return hits;
  }

  std::vector<double> depths(double x, double y) const
  {
    std::vector<double> depths;
    for (const Hit& hit : this->at(x, y))
    {
      depths.push_back(surfacePointAt(*this->State, this->TheView, { x, y }, hit).t);
    }
    return depths;
  }

  /// Whether the surfaces change within 1/128 pixel.
  bool isOnEdge(double x, double y) const
  {
    const std::vector<Hit> own = this->at(x, y);
    constexpr int directions = 32;
    constexpr double turn = 2 * 3.14159265358979323846 / directions;
    for (int i = 0; i < directions; ++i)
    {
      const double radius = i % 2 ? edge : edge / 2;
      if (this->at(x + radius * std::cos(i * turn), y + radius * std::sin(i * turn)) != own)
      {
        return true;
      }
    }
    return false;
  }

private:
  std::shared_ptr<const Stage> Scene;
  std::shared_ptr<const SceneState> State;
  std::unique_ptr<OcclusionQuery> Query;
  View TheView;
};

bool hasCoincident(const std::vector<double>& depths)
{
  return std::adjacent_find(
           depths.begin(), depths.end(), [](double a, double b) { return b - a <= ldiCoincident * b; }) != depths.end();
}

class LdiScenes : public testing::TestWithParam<SceneCase>
{
};
} // namespace

TEST_P(LdiScenes, HaveTheSurfacesThatEmbreeMeets)
{
  const TemporaryFolder folder;
  const AllHits expected(sourceFile(GetParam().scene), GetParam().frame);
  GeneratorRequest request;
  request.scene = sourceFile(GetParam().scene);
  request.folder = folder.path("d");
  request.layers = { "ldi" };
  request.cameras = { expected.camera() };
  request.frames = FrameRange{ GetParam().frame, GetParam().frame, 1 };
  request.width = ldiWidth;
  request.height = ldiHeight;
  generate(request);
  char name[32];
  std::snprintf(name, sizeof name, "/ldi/%06d.ldi", GetParam().frame);
  LdiReader reader(folder.path("d/" + expected.camera() + name));

  long layers = 0, deepest = 0, onEdge = 0, onCoincident = 0, wrong = 0;
  LdiRow row;
  for (int y = 0; reader.read(row); ++y)
  {
    const LdiRecord* record = row.records.data();
    for (int x = 0; x < ldiWidth; ++x)
    {
      const std::vector<double> depths = expected.depths(x + 0.5, y + 0.5);
      const std::uint32_t count = row.counts[x];
      layers += count;
      deepest = std::max<long>(deepest, count);
      bool same = count == depths.size();
      for (std::size_t i = 0; same && i < count; ++i)
      {
        same = std::abs(record[i].depth - depths[i]) <= ldiCoincident * depths[i];
      }
      if (!same)
      {
        const bool isEdge = expected.isOnEdge(x + 0.5, y + 0.5);
        const bool isCoincident = !isEdge && hasCoincident(depths);
        onEdge += isEdge;
        onCoincident += isCoincident;
        wrong += !isEdge && !isCoincident;
        if (!isEdge && !isCoincident && wrong <= 5)
        {
          ADD_FAILURE() << "pixel " << x << ", " << y << ": " << count << " surfaces, Embree meets " << depths.size();
        }
      }
      record += count;
    }
  }
  std::printf(
    "%s, frame %d: %d pixels, %ld surfaces, at most %ld in a pixel; unlike Embree's at %ld pixels on an edge, "
    "%ld with coincident surfaces, %ld others\n",
    GetParam().scene, GetParam().frame, ldiWidth * ldiHeight, layers, deepest, onEdge, onCoincident, wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(layers, ldiWidth * ldiHeight / 2);
  EXPECT_LT(onEdge + onCoincident, ldiWidth * ldiHeight / 100);
}

INSTANTIATE_TEST_SUITE_P(All, LdiScenes,
  testing::Values(SceneCase{ "Data/Scenes/fig_5_2_trees_grass.json", 0 }, // cut-out leaves
    SceneCase{ "Data/Scenes/demo.json", 1 },                              // MD2 and glTF in motion
    SceneCase{ "Data/Scenes/fig_4_7_stereo.json", 0 }));
