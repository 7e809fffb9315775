// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFrameSource.h"
#include "dgtkKeptSource.h"
#include "dgtkSceneFromText.h"
#include "dgtkStage.h"
#include "dgtkSyntheticScene.h"
#include "dgtkSystem.h"
#include "dgtkTestSupport.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include <pthread.h>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// A picture of two tiles beside one another.
View wideView(const Eigen::Vector3d& eye = { 0, 0, 5 })
{
  ViewOptions options;
  options.width = 4200;
  options.height = 8;
  options.fovY = 0.4;
  options.eye = eye;
  return makeView(options);
}

std::shared_ptr<SceneState> twoBodies()
{
  const auto state =
    SceneBuilder().add(makeSphere({ { 0, 0, 0 }, 0.4, 12, 20 })).add(makeBox(), placement({ 0.8, 0, -3 })).state();
  state->background = { 0.1, 0.2, 0.3 };
  state->lights.emplace_back();
  state->lights.back().kind = LightKind::Head;
  return state;
}

/// The picture's only row of tiles.
std::shared_ptr<DrawnBand> drawn(FrameSource& source)
{
  std::shared_ptr<DrawnBand> band;
  EXPECT_EQ(source.bands(), 1);
  source.draw(0, [&band](const std::shared_ptr<DrawnBand>& row) { band = row; });
  source.finish();
  return band;
}

/// Threads that are started meanwhile find no room for their stacks.
class NoRoomForThreads
{
public:
  NoRoomForThreads()
  {
    ::pthread_getattr_default_np(&this->Before);
    pthread_attr_t large = this->Before;
    ::pthread_attr_setstacksize(&large, std::size_t(1) << 48);
    ::pthread_setattr_default_np(&large);
  }
  ~NoRoomForThreads() { ::pthread_setattr_default_np(&this->Before); }
  NoRoomForThreads(const NoRoomForThreads&) = delete;
  NoRoomForThreads& operator=(const NoRoomForThreads&) = delete;

private:
  pthread_attr_t Before{};
};
} // namespace

TEST(FrameSource, TilesOfASharpPictureAreThoseOfTheStillOne)
{
  ThreadPool pool(2);
  FrameSourceOptions options;
  options.needs.color = true;
  options.needs.sharp = true;
  FrameSource source(options, pool);
  const auto state = twoBodies();
  source.setScene(state, wideView());
  const std::vector<float> still = drawn(source)->whole().rgb;
  source.expose({ { 0, wideView({ -0.2, 0, 5 }) }, { 0, wideView({ 0.2, 0, 5 }) } }, [&](double) { return state; });
  const auto band = drawn(source);
  EXPECT_EQ(band->whole().sharp, still);
  EXPECT_NE(band->whole().rgb, still);
}

TEST(FrameSource, TilesOfABackgroundAreThePictureBesideTheObject)
{
  ThreadPool pool(2);
  FrameSourceOptions options;
  options.needs.color = true;
  options.needs.mattes = { 1 };
  FrameSource source(options, pool);
  source.setScene(twoBodies(), wideView());
  const auto band = drawn(source);
  const Band& whole = band->whole();
  ASSERT_EQ(whole.mattes.size(), 1u);
  const MattePixels& matte = whole.mattes[0];
  int inside = 0;
  int other = 0;
  for (std::size_t i = 0; i < matte.count.size(); ++i)
  {
    inside += matte.count[i] > 0;
    for (std::size_t c = 3 * i; matte.count[i] == 0 && c < 3 * i + 3; ++c)
    {
      other += matte.background[c] != whole.rgb[c];
    }
  }
  EXPECT_EQ(other, 0);
  EXPECT_GT(inside, 1000);
}

TEST(KeptSource, TriesAgainToStartItsThreads)
{
  if (machineThreads() < 2)
  {
    GTEST_SKIP() << "it starts none";
  }
  const auto stage = Stage::load(readSceneText("{}", "."));
  KeptSource kept;
  {
    const NoRoomForThreads none;
    for (int i = 0; i < 2; ++i)
    {
      ASSERT_THROW(kept.use({}, stage, [](FrameSource&, SceneQueries&, ThreadPool&) {}), MachineError) << i;
    }
  }
  int threads = 0;
  kept.use({}, stage, [&threads](FrameSource&, SceneQueries&, ThreadPool& pool) { threads = pool.threads(); });
  EXPECT_EQ(threads, machineThreads());
}

TEST(KeptSource, StartsNothingUntilItIsUsed)
{
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
    {
      const NoRoomForThreads none;
      {
        const KeptSource unused;
      }
      std::_Exit(0);
    },
    testing::ExitedWithCode(0), "");
}
