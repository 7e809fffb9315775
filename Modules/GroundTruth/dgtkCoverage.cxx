// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCoverage.h"

#include <algorithm>
#include <limits>

namespace dgtk
{

SampleCount nearestCoverage(const std::uint32_t* ids, const double* depths, int samples)
{
  constexpr double sameDepth = 1e-9; // a part of it, as for surfaces along one ray
  const double limit = *std::min_element(depths, depths + samples) * (1 + sameDepth);
  std::uint32_t nearest = std::numeric_limits<std::uint32_t>::max();
  for (int i = 0; i < samples; ++i)
  {
    nearest = depths[i] <= limit ? std::min(nearest, ids[i]) : nearest;
  }
  return { nearest, static_cast<std::uint32_t>(std::count(ids, ids + samples, nearest)) };
}

void rankCoverages(const std::uint32_t* ids, int samples, std::vector<SampleCount>& coverages)
{
  coverages.clear();
  for (int i = 0; i < samples; ++i)
  {
    const auto known =
      std::find_if(coverages.begin(), coverages.end(), [&](const SampleCount& c) { return c.id == ids[i]; });
    if (known == coverages.end())
    {
      coverages.push_back({ ids[i], 1 });
    }
    else
    {
      ++known->count;
    }
  }
  std::sort(coverages.begin(), coverages.end(),
    [](const SampleCount& a, const SampleCount& b) { return a.count != b.count ? a.count > b.count : a.id < b.id; });
}

} // namespace dgtk
