// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCoverage.h"

#include <algorithm>

namespace dgtk
{

SampleCount nearestCoverage(const std::uint32_t* ids, const double* depths, int samples)
{
  int nearest = 0;
  for (int i = 1; i < samples; ++i)
  {
    if (depths[i] < depths[nearest] || (depths[i] == depths[nearest] && ids[i] < ids[nearest]))
    {
      nearest = i;
    }
  }
  return { ids[nearest], static_cast<std::uint32_t>(std::count(ids, ids + samples, ids[nearest])) };
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
