// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetPoints.h"

#include "dgtkTestDataset.h"

#include <gtest/gtest.h>

namespace
{
using namespace dgtk;
using test::SmallDataset;

/// The direction of a pixel's ray, and what it passes the frame's origin at: a unit before it, 3 aside.
Eigen::Vector3d direction(int x, int y) { return Eigen::Vector3d(x - 5.5, y - 3, 8).normalized(); }
Eigen::Vector3d aside(int x, int y) { return 3 * direction(x, y).unitOrthogonal(); }

/// (1 + s)^2 + 3^2 = 5^2 where s = 3.
TEST(DatasetPoints, DistancesAreFromTheOriginOfTheFrameWhereverARayBegins)
{
  SmallDataset files;
  files.add("left", "rays", 0, "", "npy", { "rays", PixelType::Float64, 6, "", "", "", "" },
    [](int x, int y, int channel)
    {
      const Eigen::Vector3d d = direction(x, y);
      return channel < 3 ? Eigen::Vector3d(d + aside(x, y))[channel] : d[channel - 3];
    });
  CameraRecord camera = SmallDataset::left(0);
  camera.model = "raytable";
  camera.hasK = false;
  camera.files = { { "rays", files.path("left/rays/000000.npy") } };
  const View view = viewOf(camera);
  const double distance = 5;
  for (const auto& [x, y] : { std::pair(0, 0), std::pair(11, 6), std::pair(5, 2) })
  {
    const auto found = pointOf({ "distance", {}, 1, "", "", "", "", Meaning::Distance }, view, x, y, &distance);
    ASSERT_TRUE(found.has_value());
    const Eigen::Vector3d expected = camera.R.transpose() * (4 * direction(x, y) + aside(x, y) - camera.t);
    EXPECT_LT((*found - expected).norm(), 1e-12) << x << ' ' << y;
  }
}
} // namespace
