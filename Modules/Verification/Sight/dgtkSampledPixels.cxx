// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampledPixels.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
/// The samples a side of a pixel that the request asked for.
int samplesOf(const Manifest& manifest)
{
  static const std::set<std::string> options{ "alpha_samples", "color_rgba_samples", "coverage_samples",
    "matting_samples" };
  for (const auto& [option, value] : manifest.request)
  {
    const int samples = options.count(option) > 0 && value.size() < 4 ? std::atoi(value.c_str()) : 0;
    if (samples > 0)
    {
      return samples;
    }
  }
  return 1;
}
} // namespace

Samples::Samples(Picture& picture)
  : Owner(picture)
  , Width(picture.width())
  , Side(samplesOf(picture.dataset().manifest()))
  , Known(std::size_t(picture.width()) * picture.height())
{
}

const SampledPixel& Samples::at(int x, int y) const
{
  std::unique_ptr<const SampledPixel>& known = this->Known[std::size_t(y) * this->Width + x];
  if (!known)
  {
    known = std::make_unique<const SampledPixel>(this->count(x, y));
  }
  return *known;
}

int Samples::withoutRay(int x, int y) const
{
  int number = 0;
  for (int k = 0; k < this->all(); ++k)
  {
    number += this->Owner.eye().ray(this->placeOf(x, y, k % this->Side, k / this->Side)).exists() ? 0 : 1;
  }
  return number;
}

SampledPixel Samples::count(int x, int y) const
{
  SampledPixel pixel;
  std::map<std::uint32_t, double> depths; // the smallest of each object
  double least = infinite;
  for (int j = 0; j < this->Side; ++j)
  {
    for (int i = 0; i < this->Side; ++i)
    {
      const Eigen::Vector2d place = this->placeOf(x, y, i, j);
      const First first = this->firstAt(x, y, place);
      ++pixel.counts[first.id];
      least = std::min(least, first.depth);
      depths[first.id] = std::min(depths.emplace(first.id, first.depth).first->second, first.depth);
      std::set<std::uint32_t> around;
      for (const Eigen::Vector2d& offset :
        { Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1) })
      {
        around.insert(this->firstAt(x, y, place + edgeReach * offset).id);
      }
      around.erase(first.id);
      for (const std::uint32_t other : around)
      {
        pixel.counts[other]; // may show as well
        ++pixel.doubtful[other];
        ++pixel.doubtful[first.id];
      }
    }
  }
  pixel.nearest = std::find_if(depths.begin(), depths.end(),
    [&](const auto& object) {
      return object.second <= least * (1 + wideDepthTolerance);
    })->first;
  return pixel;
}

/// Samples have the time of their pixel.
Samples::First Samples::firstAt(int x, int y, const Eigen::Vector2d& place) const
{
  std::vector<Hit> hits;
  std::vector<double> depths;
  this->Owner.sight(x, y).surfaces(place, hits, depths);
  return hits.empty() ? First{} : First{ hits.front().object, depths.front() };
}

} // namespace dgtk
