// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr double Full = 65535;
constexpr int Object = 255;
constexpr int Unknown = 128;

struct MattingSet
{
  PicturePointer alpha;
  PicturePointer foreground;
  PicturePointer background;
  PicturePointer composite;
  PicturePointer trimap;
};

/// composite = alpha foreground + (1 - alpha) background, steps of 16 bits.
void checkComposite(const MattingSet& set, int x, int y, Meter& meter)
{
  const double alpha = set.alpha->at(x, y) / Full;
  for (int c = 0; c < 3; ++c)
  {
    const double found = set.composite->at(x, y, c);
    const double expected = alpha * set.foreground->at(x, y, c) + (1 - alpha) * set.background->at(x, y, c);
    meter.add(found - expected, [&] { return set.composite->offender(x, y, numberText(found), numberText(expected)); });
  }
}

/// Where the trimap says object or background, alpha does.
void checkTrimap(const MattingSet& set, int x, int y, Meter& meter)
{
  const int found = static_cast<int>(set.trimap->at(x, y));
  const double alpha = set.alpha->at(x, y);
  const bool right = found == Unknown || (found == Object && alpha == Full) || (found == 0 && alpha == 0);
  meter.equal(right,
    [&] { return set.trimap->offender(x, y, std::to_string(found), "128, as alpha is " + numberText(alpha / Full)); });
}
} // namespace

void checkMatting(Picture& picture, Results& results)
{
  for (const std::string& layer : picture.dataset().layers(picture.camera(), picture.frame()))
  {
    if (layer.compare(0, 8, "matting_") != 0)
    {
      continue;
    }
    const auto image = [&](const char* suffix) { return picture.image(layer, { suffix }); };
    const MattingSet set{ image("_alpha.png"), image("_foreground.png"), image("_background.png"),
      image("_composite.png"), image("_trimap.png") };
    const auto measure = [&](const std::string& name, double tolerance, const auto& pixel)
    {
      results.add(name, "1/65535",
        meterRows(picture.pool(), picture.height(), tolerance,
          [&](int y, Meter& row)
          {
            for (int x = 0; x < picture.width(); ++x)
            {
              pixel(set, x, y, row);
            }
          }));
    };
    if (set.alpha && set.foreground && set.background && set.composite)
    {
      measure(layer, 1, checkComposite);
    }
    if (set.alpha && set.trimap)
    {
      measure(layer + " trimap", 0, checkTrimap);
    }
  }
}

} // namespace dgtk
