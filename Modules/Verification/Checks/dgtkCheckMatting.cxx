// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkSampledPixels.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::uint64_t fullMatting = 65535;
constexpr int trimapObject = 255;
constexpr int trimapUnknown = 128;
/// Pixels around which the trimap is unknown.
constexpr int band = 2;

struct MattingSet
{
  std::uint32_t id = 0;
  PicturePointer alpha;
  PicturePointer foreground;
  PicturePointer background;
  PicturePointer composite;
  PicturePointer trimap;
};

/// The object of a folder "matting_<name>", or "matting_#<id>" where the name holds a slash or begins with #.
std::uint32_t objectOf(const Dataset& dataset, const std::string& layer)
{
  const std::string name = layer.substr(std::string("matting_").size());
  const std::vector<ObjectRecord>& objects = dataset.objects();
  auto found = std::find_if(objects.begin(), objects.end(),
    [&](const ObjectRecord& object) { return '#' + std::to_string(object.id) == name; });
  if (found == objects.end())
  {
    found =
      std::find_if(objects.begin(), objects.end(), [&](const ObjectRecord& object) { return object.name == name; });
  }
  return found == objects.end() ? 0 : found->id;
}

/// composite = (alpha F + (65535 - alpha) B + 32767) / 65535, rounded down.
void checkComposite(const MattingSet& set, int x, int y, Meter& meter)
{
  const auto number = [&](const PicturePointer& of, int c) { return static_cast<std::uint64_t>(of->at(x, y, c)); };
  const std::uint64_t alpha = number(set.alpha, 0);
  for (int c = 0; c < 3; ++c)
  {
    const std::uint64_t sum = alpha * number(set.foreground, c) + (fullMatting - alpha) * number(set.background, c);
    const double found = set.composite->at(x, y, c);
    const auto expected = double((sum + fullMatting / 2) / fullMatting);
    meter.add(found - expected, [&] { return set.composite->offender(x, y, numberText(found), numberText(expected)); });
  }
}

/// The share of the object's samples, counted anew: all divided pixels, and some of the others.
void checkMattingAlpha(const MattingSet& set, const Samples& samples, int x, int y, Meter& meter)
{
  const double alpha = set.alpha->at(x, y) / double(fullMatting);
  if ((alpha == 0 || alpha == 1) && !Samples::isChosen(x, y))
  {
    return;
  }
  constexpr double rounding = 0.5 / double(fullMatting);
  samples.compare(x, y, set.id, alpha, rounding, meter,
    [&](double expected) { return set.alpha->offender(x, y, numberText(alpha), numberText(expected)); });
}

int trimapOf(double alpha) { return alpha == double(fullMatting) ? trimapObject : alpha == 0 ? 0 : trimapUnknown; }

/// Unknown unless alpha says the same, wholly, of all pixels around.
void checkTrimap(const MattingSet& set, int x, int y, Meter& meter)
{
  int expected = trimapOf(set.alpha->at(x, y));
  for (int j = std::max(0, y - band); j <= std::min(set.alpha->height() - 1, y + band); ++j)
  {
    for (int i = std::max(0, x - band); i <= std::min(set.alpha->width() - 1, x + band); ++i)
    {
      expected = trimapOf(set.alpha->at(i, j)) == expected ? expected : trimapUnknown;
    }
  }
  const int found = static_cast<int>(set.trimap->at(x, y));
  meter.equal(
    found == expected, [&] { return set.trimap->offender(x, y, std::to_string(found), std::to_string(expected)); });
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
    const MattingSet set{ objectOf(picture.dataset(), layer), image("_alpha.png"), image("_foreground.png"),
      image("_background.png"), image("_composite.png"), image("_trimap.png") };
    const auto measure = [&](const Row& row, double tolerance, const auto& pixel)
    {
      results.add(row, meterRows(picture.pool(), picture.height(), tolerance,
                         [&](int y, Meter& meter)
                         {
                           for (int x = 0; x < picture.width(); ++x)
                           {
                             pixel(x, y, meter);
                           }
                         }));
    };
    if (set.alpha && set.foreground && set.background && set.composite)
    {
      measure({ layer, "1/65535", { set.foreground->file(), set.background->file(), set.composite->file() } }, 0,
        [&](int x, int y, Meter& meter) { checkComposite(set, x, y, meter); });
    }
    if (set.alpha && set.id > 0)
    {
      const Samples samples(picture);
      measure({ layer + " alpha", "coverage", { set.alpha->file() }, mostOpenSamples }, coverageTolerance,
        [&](int x, int y, Meter& meter) { checkMattingAlpha(set, samples, x, y, meter); });
    }
    if (set.alpha && set.trimap)
    {
      measure({ layer + " trimap", "", { set.trimap->file() } }, 0,
        [&](int x, int y, Meter& meter) { checkTrimap(set, x, y, meter); });
    }
  }
}

} // namespace dgtk
