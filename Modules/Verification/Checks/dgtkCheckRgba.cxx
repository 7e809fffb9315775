// SPDX-License-Identifier: BSD-3-Clause
// The picture without its background: shares counted anew, and the picture that comes out when the background is back.
#include "dgtkCheck.h"
#include "dgtkSampledPixels.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr double fullRgba = 255;
constexpr double shareRounding = 0.5 / fullRgba;
/// Levels: what rounding of both files and of the share can make.
constexpr double levels = 2;

/// The share of the samples that meet nothing: all divided pixels, and some of the others.
void checkShare(const PictureFile& file, const Samples& samples, int x, int y, Meter& meter)
{
  const double share = 1 - file.at(x, y, 3) / fullRgba;
  if ((share == 0 || share == 1) && !Samples::isChosen(x, y))
  {
    return;
  }
  samples.compare(x, y, 0, share, shareRounding, meter,
    [&](double expected) { return file.offender(x, y, "alpha " + numberText(1 - share), numberText(1 - expected)); });
}

/// The colour of the background: that of a pixel which nothing covers, and whose samples all have a ray.
std::optional<Eigen::Vector3d> backgroundOf(const PictureFile& file, const PictureFile& color, const Samples& samples)
{
  for (int y = 0; y < file.height(); ++y)
  {
    for (int x = 0; x < file.width(); ++x)
    {
      if (file.at(x, y, 3) == 0 && samples.withoutRay(x, y) == 0)
      {
        return Eigen::Vector3d(color.at(x, y, 0), color.at(x, y, 1), color.at(x, y, 2));
      }
    }
  }
  return std::nullopt;
}
} // namespace

void checkRgba(Picture& picture, Results& results)
{
  const PicturePointer file = picture.image("color_rgba", { ".png" });
  if (!file || file->channels() != 4)
  {
    return;
  }
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
  const Samples samples(picture);
  measure({ "color_rgba alpha", "coverage", { file->file() }, mostOpenSamples }, coverageTolerance,
    [&](int x, int y, Meter& meter) { checkShare(*file, samples, x, y, meter); });
  const PicturePointer color = picture.image("color", { ".png" });
  const std::optional<Eigen::Vector3d> background =
    color && color->type() == PixelType::UInt8 ? backgroundOf(*file, *color, samples) : std::nullopt;
  if (!background)
  {
    return;
  }
  measure({ "color_rgba", "levels", { file->file() }, mostOpenSamples }, levels,
    [&](int x, int y, Meter& meter)
    {
      const double alpha = file->at(x, y, 3) / fullRgba;
      // The picture is black where there is no ray; a curve bends what is black in part.
      const double dark = alpha < 1 ? samples.withoutRay(x, y) / double(samples.all()) : 0;
      for (int c = 0; c < 3; ++c)
      {
        const double value = file->at(x, y, c);
        const double found = alpha * value + std::max(0.0, 1 - alpha - dark) * (*background)[c];
        const double shown = color->at(x, y, c);
        if (alpha == 0 && (value != 0 || dark > 0))
        {
          meter.add(value, [&] { return file->offender(x, y, numberText(value), "0 where nothing is"); });
          continue;
        }
        // What is brighter than white in front of the background, or darker than black, has no code.
        const bool white = value == fullRgba && found < shown;
        const bool black = value == 0 && found > shown;
        const double apart = alpha > 0 && (white || black) ? 0 : found - shown;
        if (std::abs(apart) > levels && samples.at(x, y).isDoubtful(0))
        {
          meter.skip(); // what is drawn and what is traced may differ by a sample at an edge
          continue;
        }
        meter.add(apart, [&] { return file->offender(x, y, numberText(found), numberText(shown)); });
      }
    });
}

} // namespace dgtk
