// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportTally_h
#define dgtkReportTally_h

// Private to Report: what is counted over pixels.

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Documents of the page: keys keep their order.
using ReportJson = nlohmann::ordered_json;

/// Numbers of any size: extremes, mean and eight bins an octave, whose edges are the same for all datasets:
/// bin k is from 2^(k div 8) (1 + (k mod 8) / 8) on.
struct NumberTally
{
  std::uint64_t values = 0;  ///< finite ones
  std::uint64_t nothing = 0; ///< not finite
  std::uint64_t zero = 0;
  std::uint64_t negative = 0;
  double least = 0;
  double most = 0;
  double sum = 0;
  std::vector<std::uint64_t> bins; ///< of positive values; empty before the first

  void add(double value);
  void merge(const NumberTally& other);
  ReportJson json() const;
};

/// Shares from 0 to 1 in equal bins; 1 is in the last.
struct ShareTally
{
  explicit ShareTally(int count = 32)
    : bins(std::size_t(count), 0)
  {
  }
  std::uint64_t values = 0;
  std::uint64_t zero = 0; ///< exactly 0
  std::uint64_t one = 0;  ///< exactly 1
  double sum = 0;
  double least = 1;
  double most = 0;
  std::vector<std::uint64_t> bins;

  void add(double value);
  void merge(const ShareTally& other);
  ReportJson json() const;
};

/// Pixels of each id.
using IdTally = std::map<std::uint32_t, std::uint64_t>;

} // namespace dgtk

#endif
