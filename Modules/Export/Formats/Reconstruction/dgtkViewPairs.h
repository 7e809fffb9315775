// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewPairs_h
#define dgtkViewPairs_h

#include "dgtkDatasetView.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace dgtk
{

/// Which views of a dataset go together, by the points of the layer `tracks` that both see and that stay: for each the
/// angle between their rays counts, most at 5 degrees (MVSNet's colmap2mvsnet.py). Tracks are read when they are first
/// asked for; a bit for each view and point is kept.
class ViewPairs
{
public:
  explicit ViewPairs(const DatasetView& dataset)
    : Dataset(dataset)
  {
  }

  /// Score and number of the views that go best with one, the best first; at most `most` of them. Of more than 64 other
  /// views those are scored that are best by some of the points. May be called from any thread.
  std::vector<std::pair<double, std::size_t>> bestOf(std::size_t view, std::size_t most) const;

private:
  void read() const;
  std::vector<std::uint32_t> seenBy(std::size_t view) const;
  bool sees(std::size_t view, std::uint32_t point) const;
  double weight(std::size_t a, std::size_t b, std::uint32_t point) const;
  double score(std::size_t a, std::size_t b, const std::vector<std::uint32_t>& seenByFirst) const;
  std::vector<std::size_t> candidates(std::size_t view, const std::vector<std::uint32_t>& seen) const;

  const DatasetView& Dataset;
  mutable std::once_flag Once;
  mutable std::vector<Eigen::Vector3d> Points;
  mutable std::vector<Eigen::Vector3d> Centres; ///< one a view
  mutable std::size_t Words = 0;                ///< of a view's bits
  mutable std::vector<std::uint64_t> Seen;
};

} // namespace dgtk

#endif
