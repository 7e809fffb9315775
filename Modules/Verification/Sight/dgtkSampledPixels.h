// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampledPixels_h
#define dgtkSampledPixels_h

#include "dgtkPicture.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace dgtk
{

/// The samples of a pixel, by the first object that each meets; 0 is the background.
struct SampledPixel
{
  std::map<std::uint32_t, int> counts;   ///< also of those that may show only, with 0
  std::map<std::uint32_t, int> doubtful; ///< samples that may as well show it, or another object
  std::uint32_t nearest = 0;             ///< of the sample with the smallest depth
  bool isDoubtful(std::uint32_t id) const
  {
    const auto found = this->doubtful.find(id);
    return found != this->doubtful.end() && found->second > 0;
  }
};

/// Counts the samples of pixels anew, by rays; each pixel once. Rows may be asked for by several threads.
class Samples
{
public:
  explicit Samples(Picture& picture);

  /// Samples of a pixel, all of its rows and columns.
  int all() const { return this->Side * this->Side; }
  const SampledPixel& at(int x, int y) const;
  /// How many of them have no ray, beyond what a lens sees.
  int withoutRay(int x, int y) const;
  /// Whether a pixel that is not divided is looked at: one of 16.
  static bool isChosen(int x, int y) { return x % 4 == 0 && y % 4 == 0; }
  /// Measures the share of an object in a pixel; where samples within EdgeReach of an edge explain the difference, it
  /// is left open. `rounding` is that of the share.
  template <typename Where>
  void compare(int x, int y, std::uint32_t id, double share, double rounding, Meter& meter, const Where& where) const
  {
    const SampledPixel& pixel = this->at(x, y);
    const auto number = [&](const std::map<std::uint32_t, int>& of)
    { return of.count(id) > 0 ? double(of.at(id)) / this->all() : 0; };
    const double error = beyond(std::abs(share - number(pixel.counts)), rounding);
    if (error > meter.Tolerance && error <= number(pixel.doubtful) + meter.Tolerance)
    {
      meter.skip();
      return;
    }
    meter.add(error, [&] { return where(number(pixel.counts)); });
  }

private:
  struct First
  {
    std::uint32_t id = 0;
    double depth = infinite;
  };
  Eigen::Vector2d placeOf(int x, int y, int i, int j) const
  {
    return { x + (i + 0.5) / this->Side, y + (j + 0.5) / this->Side };
  }
  First firstAt(int x, int y, const Eigen::Vector2d& place) const;
  SampledPixel count(int x, int y) const;

  const Picture& Owner;
  int Width;
  int Side;
  mutable std::vector<std::unique_ptr<const SampledPixel>> Known;
};

/// Part of a pixel; the smallest true difference is one sample of 256, and float32 shares round by 3e-8.
constexpr double coverageTolerance = 1e-7;
/// Share: most pixels that are looked at are divided by edges.
constexpr double mostOpenSamples = 0.5;

} // namespace dgtk

#endif
