// SPDX-License-Identifier: BSD-3-Clause
// The view of a dataset's cameras, on no display.
#include "dgtkCloudView.h"

#include "dgtkTestDataset.h"
#include "dgtkTestWidgets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

TEST(CloudView, AClickTakesTheNearestCamera)
{
  test::needApplication();
  CloudView cloud(nullptr);
  cloud.resize(200, 150);
  std::string picked;
  QObject::connect(&cloud, &CloudView::cameraPicked, [&](const QString& name) { picked = name.toStdString(); });
  const WorldRay ray = cloud.camera().ray(120.5, 60.5, 200, 150);
  std::vector<View> views;
  for (const auto& [name, along] : { std::pair("near", 4.0), std::pair("far", 8.0), std::pair("behind", -4.0) })
  {
    View view = viewOf(test::SmallDataset::left(0));
    view.name = name;
    view.camera_from_world.translation =
      -(view.camera_from_world.rotation * (ray.origin + along * ray.direction.normalized()));
    views.push_back(view);
  }
  for (int turn = 0; turn < 3; ++turn)
  {
    cloud.setCameras(views, "");
    picked.clear();
    test::sendMouse(cloud, QEvent::MouseButtonPress, { 120, 60 });
    test::sendMouse(cloud, QEvent::MouseButtonRelease, { 120, 60 });
    EXPECT_EQ(picked, "near") << turn;
    std::rotate(views.begin(), views.begin() + 1, views.end());
  }
}
} // namespace
