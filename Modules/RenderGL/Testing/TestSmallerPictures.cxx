// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModel.h"
#include "dgtkTestScene.h"

#include <gtest/gtest.h>

#include <memory>

using namespace dgtk;
using namespace dgtk::test;

// A picture of 6 x 6 texels, alike by fours, on 3 x 3 pixels: each sees one of the picture of half the size, whose rows
// have nine bytes.
TEST(SmallerPictures, OfAnyWidth)
{
  const auto value = [](int x, int y, int channel) { return std::uint8_t(40 * (channel == 0 ? x : y) + 60 * channel); };
  auto image = std::make_shared<Image>();
  image->width = image->height = 6;
  for (int y = 0; y < 6; ++y)
  {
    for (int x = 0; x < 6; ++x)
    {
      image->rgba.insert(
        image->rgba.end(), { value(x / 2, y / 2, 0), value(x / 2, y / 2, 1), value(x / 2, y / 2, 2), 255 });
    }
  }
  for (const char* renderer : { "vtk", "ray" })
  {
    usePictures(renderer);
    ModelBuilder model;
    Material material = flat({ 1, 1, 1 });
    material.texture = model.texture(image);
    model.part(material);
    model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
    const ColorBuffer colors = renderColor(stateOf({ model.finish() }), frontView(3, 3));
    for (int y = 0; y < 3; ++y)
    {
      for (int x = 0; x < 3; ++x)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          EXPECT_NEAR(colorAt(colors, x, y)[channel], value(x, y, channel) / 255.0, 0.01)
            << renderer << ' ' << x << ' ' << y << ' ' << channel;
        }
      }
    }
  }
  usePictures("vtk");
}
