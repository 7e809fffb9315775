// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDrawOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{

dgtk::ViewBox cube(double x, double y, double z, double half)
{
  const Eigen::Vector3d center(x, y, z);
  return { center.array() - half, center.array() + half };
}

bool meet(const dgtk::ViewBox& a, const dgtk::ViewBox& b)
{
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

TEST(DrawOrder, BoxesApartComeNearestFirst)
{
  EXPECT_EQ(dgtk::drawOrder({ cube(0, 0, -9, 1), cube(5, 0, -3, 1), cube(0, 5, -6, 1) }),
    (std::vector<std::size_t>{ 1, 2, 0 }));
  EXPECT_TRUE(dgtk::drawOrder({}).empty());
}

TEST(DrawOrder, EqualDistancesKeepTheirOrder)
{
  EXPECT_EQ(dgtk::drawOrder({ cube(0, 0, -5, 1), cube(9, 0, -5, 1), cube(-9, 0, -5, 1) }),
    (std::vector<std::size_t>{ 0, 1, 2 }));
}

TEST(DrawOrder, BoxesThatMeetKeepTheirOrder)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-20, 20);
  std::uniform_real_distribution<double> half(0.1, 4);
  int meetings = 0;
  int turned = 0;
  for (int round = 0; round < 20; ++round)
  {
    std::vector<dgtk::ViewBox> boxes;
    boxes.reserve(80);
    for (int i = 0; i < 80; ++i)
    {
      boxes.push_back(cube(place(random), place(random), place(random), half(random)));
    }
    const std::vector<std::size_t> order = dgtk::drawOrder(boxes);
    ASSERT_EQ(order.size(), boxes.size());
    std::vector<std::size_t> rank(boxes.size(), boxes.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      rank[order[i]] = i;
    }
    ASSERT_EQ(std::count(rank.begin(), rank.end(), boxes.size()), 0);
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
      {
        if (meet(boxes[i], boxes[j]))
        {
          EXPECT_LT(rank[i], rank[j]);
          ++meetings;
        }
        turned += rank[i] > rank[j];
      }
    }
  }
  EXPECT_GT(meetings, 500);
  EXPECT_GT(turned, 5000);
}

TEST(DrawOrder, EmptyBoxesHoldNobodyUp)
{
  const dgtk::ViewBox empty{ Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, -1, -1) };
  EXPECT_EQ(dgtk::drawOrder({ empty, cube(0, 0, 3, 1) }), (std::vector<std::size_t>{ 1, 0 }));
}

} // namespace
