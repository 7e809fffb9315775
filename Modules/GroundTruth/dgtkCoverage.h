// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCoverage_h
#define dgtkCoverage_h

#include "dgtkGroundTruthModule.h"

#include <cstdint>
#include <vector>

namespace dgtk
{

/// How many of a pixel's samples meet an object first.
struct SampleCount
{
  std::uint32_t id = 0; ///< 0: background
  std::uint32_t count = 0;
  bool operator==(const SampleCount& o) const { return this->id == o.id && this->count == o.count; }
};

/// Section 4.7 of the thesis: the object at the smallest depth among a pixel's `samples` samples, and how many of them
/// show it; count / samples is its coverage (equation 4.11). Depth +inf: background, id 0. Of depths that
/// differ by less than 1e-9 of them the lowest id.
DGTKGROUNDTRUTH_EXPORT SampleCount nearestCoverage(const std::uint32_t* ids, const double* depths, int samples);

/// The counts of all ids among `samples` samples, background included, the largest first, equal ones by id. They sum
/// to `samples`.
DGTKGROUNDTRUTH_EXPORT void rankCoverages(const std::uint32_t* ids, int samples, std::vector<SampleCount>& coverages);

/// Displacement, in pixels, of sample `index` of `count` evenly spaced ones from the pixel's centre: (index + 0.5) /
/// count - 0.5. 0 for the middle one of an odd count.
inline double sampleOffset(int index, int count) { return (index + 0.5) / count - 0.5; }

} // namespace dgtk

#endif
