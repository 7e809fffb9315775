// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkRayDifferentials.h"

#include <gtest/gtest.h>

using namespace dgtk;

namespace
{
constexpr int width = 24;
constexpr int height = 18;

std::shared_ptr<const CameraModel> camera(const std::string& model, double focal)
{
  Eigen::Matrix3d K;
  K << focal, 0, 11, 0, 1.25 * focal, 10, 0, 0, 1;
  return makeCamera(model, { width, height, K, { { "distortion", { 0.1, 0.02, 0, 0 } } } });
}

/// How far a difference is from the change of the ray from one pixel to another, of which each is there.
double error(const CameraRay& found, const CameraRay& to, const CameraRay& from, double steps)
{
  return ((to.direction - from.direction) / steps - found.direction).norm() +
         ((to.origin - from.origin) / steps - found.origin).norm();
}

/// Each row of `columns`, one after another as they are named, against single rays.
void judge(const CameraModel& model, int first, int count, const std::vector<int>& rows)
{
  const auto ray = [&model](int x, int y) { return model.rayThrough({ x + 0.5, y + 0.5 }); };
  const auto exists = [&](int x, int y) { return x >= 0 && x < width && ray(x, y).exists(); };
  RayDifferentials differentials(model);
  for (const int y : rows)
  {
    const std::vector<PixelRay>& row = differentials.row(y, first, count);
    ASSERT_EQ(row.size(), std::size_t(count));
    for (int i = 0; i < count; ++i)
    {
      const int x = first + i;
      SCOPED_TRACE(model.name() + " " + std::to_string(x) + " " + std::to_string(y));
      EXPECT_EQ(row[std::size_t(i)].own->direction, ray(x, y).direction);
      if (!exists(x, y))
      {
        continue;
      }
      const int before = exists(x - 1, y) ? x - 1 : x;
      const int after = exists(x + 1, y) ? x + 1 : x;
      EXPECT_LT(error(*row[std::size_t(i)].right, ray(after, y), ray(before, y), std::max(after - before, 1)), 1e-15);
      const int next = y == height - 1 ? y - 1 : y + 1;
      const CameraRay down = exists(x, next) ? ray(x, next) : ray(x, y);
      EXPECT_LT(error(*row[std::size_t(i)].down, down, ray(x, y), next - y), 1e-15);
    }
  }
}
} // namespace

TEST(RayDifferentials, AreThoseToTheNeighboursAlsoAtBorders)
{
  const std::vector<int> all{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17 };
  const std::vector<int> jumps{ 5, 6, 17, 16, 17, 0, 2, 1 };
  for (const auto& model : { camera("fisheye", 9), camera("fisheye", 0.7), camera("pinhole", 20) })
  {
    ASSERT_FALSE(model->linear());
    for (const auto& rows : { all, jumps })
    {
      judge(*model, 0, width, rows);
      judge(*model, 0, 7, rows);
      judge(*model, 7, 9, rows);
      judge(*model, 16, 8, rows);
    }
  }
  EXPECT_FALSE(camera("fisheye", 0.7)->rayThrough({ 0.5, 0.5 }).exists()) << "an image circle within the picture";
}

TEST(RayDifferentials, OfALinearCameraAreTheSameEverywhere)
{
  Eigen::Matrix3d K;
  K << 20, 0, 11, 0, 25, 10, 0, 0, 1;
  for (const char* name : { "pinhole", "orthographic" })
  {
    const auto model = makeCamera(name, { width, height, K });
    RayDifferentials differentials(*model);
    for (const auto& [y, first, count] :
      { std::tuple(3, 0, width), { 4, 0, width }, { 5, 4, 8 }, { 17, 5, 8 }, { 2, 5, 19 } })
    {
      const std::vector<PixelRay>& row = differentials.row(y, first, count);
      ASSERT_EQ(row.size(), std::size_t(count));
      for (int i = 0; i < count; ++i)
      {
        const PixelRay& at = row[std::size_t(i)];
        const CameraRay expected = model->rayThrough({ first + i + 0.5, y + 0.5 });
        EXPECT_LT(error(*at.own, expected, { { 0, 0, 0 }, { 0, 0, 0 } }, 1), 1e-15)
          << name << " " << first + i << " " << y;
        const bool parallel = std::string(name) == "orthographic";
        const Eigen::Vector3d right(1 / 20.0, 0, 0);
        const Eigen::Vector3d down(0, 1 / 25.0, 0);
        EXPECT_LT(((parallel ? at.right->origin : at.right->direction) - right).norm(), 1e-15);
        EXPECT_LT(((parallel ? at.down->origin : at.down->direction) - down).norm(), 1e-15);
        EXPECT_TRUE((parallel ? at.right->direction : at.right->origin).isZero(0));
        EXPECT_TRUE((parallel ? at.down->direction : at.down->origin).isZero(0));
      }
    }
  }
}
