// SPDX-License-Identifier: BSD-3-Clause
// Projects a point with an installed DGTk and lists its layers.
#include <dgtkCameraModel.h>
#include <dgtkGenerator.h>

#include <cstdio>

int main()
{
  const auto camera = dgtk::makePinholeFromFov(640, 480, 90.0, 0.0);
  Eigen::Vector2d pixel;
  const bool inFront = camera->project({ 0, 0, 2 }, pixel);
  std::printf("%g %g, %zu layers\n", pixel.x(), pixel.y(), dgtk::generatorLayers().size());
  return inFront && pixel == Eigen::Vector2d(320, 240) ? 0 : 1;
}
