// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWarpSources_h
#define dgtkWarpSources_h

#include "dgtkLayeredDepth.h"
#include "dgtkWarp.h"

#include <cmath>

/// What the tests of warping look at.
namespace dgtk::test
{

constexpr int width = 40;
constexpr int height = 30;
constexpr double focal = 50;

inline View viewAt(const Eigen::Vector3d& centre, double angle = 0)
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = K(1, 1) = focal;
  K(0, 2) = width / 2.0;
  K(1, 2) = height / 2.0;
  View view;
  view.name = "camera";
  view.model = makePinhole(width, height, K);
  Eigen::Matrix3d& R = view.camera_from_world.rotation; // about the y axis
  R(0, 0) = R(2, 2) = std::cos(angle);
  R(2, 0) = std::sin(angle);
  R(0, 2) = -std::sin(angle);
  view.camera_from_world.translation = -(R * centre);
  return view;
}

inline const std::uint32_t facing = splatIndex(1, { 0, 0, -1 }, 0.1, 1000);

/// Calls with a colour of its own for each pixel of a wall at a depth.
inline WarpSource wall(double depth, std::uint8_t alpha = 255)
{
  return [depth, alpha](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        visit(x, y, { { std::uint8_t(x), std::uint8_t(y), 9, alpha }, depth, facing });
      }
    }
  };
}

inline WarpSource both(const WarpSource& a, const WarpSource& b)
{
  return [a, b](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    a(visit);
    b(visit);
  };
}

/// A square of 10 x 10 pixels in the middle, of one colour.
inline WarpSource patch(double depth, std::uint8_t alpha = 255)
{
  return [depth, alpha](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    for (int y = 10; y < 20; ++y)
    {
      for (int x = 15; x < 25; ++x)
      {
        visit(x, y, { { 200, 100, 0, alpha }, depth, facing });
      }
    }
  };
}

} // namespace dgtk::test

#endif
