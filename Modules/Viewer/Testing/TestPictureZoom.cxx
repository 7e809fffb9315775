// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureZoom.h"

#include <gtest/gtest.h>

namespace
{
using dgtk::PictureZoom;
using Eigen::Vector2d;

constexpr double zoomTolerance = 1e-9; // pixels
const Vector2d image(640, 480);
const Vector2d widget(500, 300);

TEST(PictureZoom, FitsTheWholeImage)
{
  PictureZoom zoom;
  zoom.fit(image, widget);
  EXPECT_DOUBLE_EQ(zoom.scale(), 300.0 / 480);
  EXPECT_LT((zoom.toWidget(image / 2, widget) - widget / 2).norm(), zoomTolerance);
  EXPECT_NEAR(zoom.toWidget({ 0, 0 }, widget).y(), 0, zoomTolerance);
  EXPECT_NEAR(zoom.toWidget(image, widget).y(), 300, zoomTolerance);
}

TEST(PictureZoom, TheImagePointUnderTheMouseStays)
{
  PictureZoom zoom;
  zoom.fit(image, widget);
  const Vector2d mouse(317, 120);
  const Vector2d point = zoom.toImage(mouse, widget);
  for (const double factor : { 1.3, 5.0, 0.9, 4.0 })
  {
    zoom.zoomBy(factor, mouse, widget);
    EXPECT_LT((zoom.toImage(mouse, widget) - point).norm(), zoomTolerance);
    EXPECT_LT((zoom.toWidget(point, widget) - mouse).norm(), 1e-6);
  }
  zoom.zoomTo(1e9, mouse, widget);
  EXPECT_LE(zoom.scale(), 128);
  zoom.zoomTo(0, mouse, widget);
  EXPECT_GT(zoom.scale(), 0.2);
}

TEST(PictureZoom, PanningFollowsTheMouseUpToTheBorder)
{
  PictureZoom zoom;
  zoom.fit(image, widget);
  zoom.zoomTo(2, widget / 2, widget);
  const Vector2d point = zoom.toImage({ 100, 100 }, widget);
  zoom.pan({ 30, -20 });
  EXPECT_LT((zoom.toWidget(point, widget) - Vector2d(130, 80)).norm(), zoomTolerance);
  zoom.pan({ 1e6, 1e6 });
  EXPECT_EQ(zoom.center(), Vector2d(0, 0));
}

TEST(PictureZoom, RevealingMovesNoMoreThanItMust)
{
  PictureZoom zoom;
  zoom.fit(image, widget);
  zoom.zoomTo(10, widget / 2, widget);
  const Vector2d before = zoom.center();
  zoom.reveal(before + Vector2d(5, -5), widget);
  EXPECT_EQ(zoom.center(), before);
  const Vector2d far(0.5, 479.5);
  zoom.reveal(far, widget);
  const Vector2d at = zoom.toWidget(far, widget);
  EXPECT_TRUE((at.array() >= 0).all() && (at.array() <= widget.array()).all());
}
} // namespace
