// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShownPictures_h
#define dgtkShownPictures_h

#include "dgtkPictureView.h"

#include <QColor>

#include <memory>

namespace dgtk::test
{

inline QColor toQt(Rgb color) { return { color[0], color[1], color[2] }; }

inline std::shared_ptr<PictureValues> makeValues(int width, int height, int step = 1)
{
  auto picture = std::make_shared<PictureValues>();
  picture->info = { "npy", PixelType::UInt8, 1, width, height };
  picture->window = { 0, 0, width, height };
  picture->step = step;
  picture->values = Rows(PixelType::UInt8, 1, (width + step - 1) / step, 0, (height + step - 1) / step);
  return picture;
}

/// A picture of which every step-th pixel is there; its colours say where: red the column, green the row.
inline std::shared_ptr<ShownPicture> makeShown(int width, int height, int step = 1)
{
  const std::shared_ptr<PictureValues> picture = makeValues(width, height, step);
  auto shown = std::make_shared<ShownPicture>();
  shown->ask.key = { "left", 3, "depth" };
  for (int row = 0; row < picture->rows(); ++row)
  {
    for (int column = 0; column < picture->columns(); ++column)
    {
      shown->colors.pixels.push_back(0xff000000u | unsigned(column % 40 * 6) << 16 | unsigned(row % 40 * 6) << 8);
    }
  }
  shown->picture = picture;
  return shown;
}

} // namespace dgtk::test

#endif
