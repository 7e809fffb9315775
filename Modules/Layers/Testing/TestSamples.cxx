// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkRaySource.h"
#include "dgtkSamples.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{

/// Area of the part of the unit square around `centre` where normal . (p - point) < 0, by clipping its outline.
double areaBeside(const Eigen::Vector2d& centre, const Eigen::Vector2d& point, const Eigen::Vector2d& normal)
{
  std::vector<Eigen::Vector2d> outline;
  const Eigen::Vector2d corners[4] = { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } };
  for (int i = 0; i < 4; ++i)
  {
    const Eigen::Vector2d a = centre + corners[i];
    const Eigen::Vector2d b = centre + corners[(i + 1) % 4];
    const double da = normal.dot(a - point);
    const double db = normal.dot(b - point);
    if (da < 0)
    {
      outline.push_back(a);
    }
    if ((da < 0) != (db < 0))
    {
      outline.push_back(a + (b - a) * (da / (da - db)));
    }
  }
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::abs(area);
}

SampledRows sampled(const std::shared_ptr<const SceneState>& state, const View& view, int side, ThreadPool& pool)
{
  const PixelRect rect{ 0, 0, view.model->width(), view.model->height() };
  VisibilityBuffer own;
  const auto source = makeRaySource(pool);
  source->setScene(state, view);
  source->render(rect, own);
  PixelSampler sampler(state, view, side, makeRaySource(pool), pool);
  SampledRows rows;
  sampler.sample(rect, own.hits.data(), rows);
  return rows;
}
} // namespace

TEST(PixelSampler, CoverageOfAHalfPlaneIsWithinOneSampleOfItsArea)
{
  ThreadPool pool(2);
  ViewOptions options;
  options.width = 14;
  options.height = 14;
  const View view = makeView(options);
  for (const int side : { 1, 2, 3, 4, 8 })
  {
    const int samples = side * side;
    double error = 0;
    int pixels = 0;
    for (int step = 0; step < 40; ++step)
    {
      const double angle = 2 * pi * step / 40 + 0.037 * step;
      const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
      const Eigen::Vector3d across(-along.y(), along.x(), 0);
      const Eigen::Vector3d through = across * (0.013 * step - 0.21);
      QuadOptions quad;
      quad.corner = through - 50 * along;
      quad.sideU = 100 * along;
      quad.sideV = 100 * across;
      const auto state = SceneBuilder().add(makeQuad(quad)).state();
      const SampledRows rows = sampled(state, view, side, pool);
      Eigen::Vector2d a, b, inside;
      ASSERT_TRUE(view.model->project(view.camera_from_world * through, a));
      ASSERT_TRUE(view.model->project(view.camera_from_world * Eigen::Vector3d(through + along), b));
      ASSERT_TRUE(view.model->project(view.camera_from_world * Eigen::Vector3d(through + across), inside));
      Eigen::Vector2d normal((b - a).y(), -(b - a).x());
      normal *= normal.dot(inside - a) > 0 ? -1 : 1;
      for (std::size_t i = 0; i < rows.mixed.size(); ++i)
      {
        const Eigen::Vector2d centre(double(i % 14) + 0.5, double(i / 14) + 0.5);
        const double area = areaBeside(centre, a, normal);
        std::vector<std::uint32_t> ids;
        for (const VisibilityBuffer& buffer : rows.hits)
        {
          ids.push_back(buffer.hits[i].object);
        }
        std::vector<SampleCount> ranks;
        rankCoverages(ids.data(), samples, ranks);
        double covered = 0;
        std::uint32_t sum = 0;
        for (const SampleCount& rank : ranks)
        {
          sum += rank.count;
          covered += rank.id == 1 ? double(rank.count) / samples : 0;
        }
        EXPECT_EQ(sum, std::uint32_t(samples));
        EXPECT_EQ(rows.mixed[i] != 0, ranks.size() > 1);
        if (area > 1e-9 && area < 1 - 1e-9)
        {
          error += std::abs(covered - area);
          ++pixels;
        }
        else
        {
          EXPECT_NEAR(covered, area, 1e-9);
        }
      }
    }
    ASSERT_GT(pixels, 300);
    EXPECT_LT(error / pixels, 1.0 / samples) << side << " samples a side";
  }
}

TEST(PixelSampler, TheMiddleSampleIsThePixelsOwnAndDepthsAreThoseOfTheSamples)
{
  ThreadPool pool(1);
  const auto state =
    SceneBuilder().add(makeSphere(), placement({ 0, 0, 0 })).add(makeQuad(), placement({ 0.3, 0.2, -2 }, 2)).state();
  const View view = makeView();
  const SampledRows rows = sampled(state, view, 3, pool);
  const VisibilityBuffer expected = bruteForce(*state, view);
  int differing = 0;
  int mixed = 0;
  for (std::size_t i = 0; i < rows.mixed.size(); ++i)
  {
    differing += rows.hits[4].hits[i] != expected.hits[i];
    if (!rows.mixed[i])
    {
      continue;
    }
    ++mixed;
    std::uint32_t ids[9];
    double depths[9];
    rows.gather(i, ids, depths);
    for (int k = 0; k < 9; ++k)
    {
      EXPECT_EQ(ids[k] == 0, std::isinf(depths[k]));
      if (ids[k] == 2)
      {
        EXPECT_NEAR(depths[k], 7, 1e-12); // the quad is parallel to the image
      }
      const double x = double(i % 64) + (k % 3 + 0.5) / 3;
      const double y = double(i / 64) + (k / 3 + 0.5) / 3;
      if (ids[k] != 0)
      {
        EXPECT_NEAR(depths[k], surfacePointAt(*state, view, { x, y }, rows.hits[k].hits[i]).t, 1e-9);
      }
    }
  }
  EXPECT_LE(differing, 2); // pixels whose centre lies on an edge between two triangles
  EXPECT_GT(mixed, 50);
}

TEST(PixelSampler, ThreadsAndStripsDoNotMatter)
{
  SoupOptions soup;
  soup.triangles = 400;
  soup.size = 0.3;
  const auto state =
    SceneBuilder().add(makeSoup(soup)).add(makeSphere(), placement({ 0.5, 0, 0 })).add(makeBox()).state();
  const View view = makeView();
  ThreadPool one(1);
  ThreadPool three(3);
  const SampledRows whole = sampled(state, view, 4, one);
  PixelSampler sampler(state, view, 4, makeRaySource(three), three);
  SampledRows strip;
  for (int y = 0; y < 48; y += 16)
  {
    sampler.sample({ 0, y, 64, 16 }, nullptr, strip);
    for (std::size_t k = 0; k < 16; ++k)
    {
      for (std::size_t i = 0; i < 64 * 16; ++i)
      {
        const std::size_t at = std::size_t(y) * 64 + i;
        ASSERT_EQ(strip.hits[k].hits[i], whole.hits[k].hits[at]);
        ASSERT_EQ(strip.mixed[i], whole.mixed[at]);
        if (strip.mixed[i])
        {
          ASSERT_EQ(strip.depth[k][i], whole.depth[k][at]);
        }
      }
    }
  }
}

TEST(ResampledCamera, IsTheSameLensOnAnotherGrid)
{
  const View view = makeView();
  for (const bool linear : { true, false })
  {
    const auto model = linear ? view.model : hideLinear(view.model);
    const auto sparse = resampledCamera(model, 16, 12, 4, { 0.5, -0.25 });
    EXPECT_EQ(sparse->width(), 16);
    EXPECT_EQ(sparse->linear().has_value(), linear);
    const Eigen::Vector2d pixel(3.5, 7.5);
    const CameraRay ray = sparse->rayThrough(pixel);
    EXPECT_TRUE(ray.direction.isApprox(view.model->rayThrough({ 14.5, 29.75 }).direction, 1e-14));
    Eigen::Vector2d back;
    ASSERT_TRUE(sparse->project(ray.direction * 3, back));
    EXPECT_TRUE(back.isApprox(pixel, 1e-12));
    EXPECT_FALSE(sparse->project({ 0, 0, -1 }, back));
    if (linear)
    {
      const Eigen::Vector3d projected = sparse->linear()->K * ray.direction;
      EXPECT_NEAR(projected.x(), 3.5, 1e-12);
      EXPECT_NEAR(projected.y(), 7.5, 1e-12);
    }
  }
}
