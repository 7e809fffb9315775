// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMeter_h
#define dgtkMeter_h

#include "dgtkDifference.h"
#include "dgtkThreadPool.h"
#include "dgtkVerification.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Shortest text of a number; "inf", "nan".
std::string numberText(double value);
/// "(a, b, c)"
std::string numbersText(const double* values, int count);

/// Collects residuals; keeps the first of the largest.
class Meter
{
public:
  explicit Meter(double tolerance)
    : Tolerance(tolerance)
  {
  }

  /// `where()` makes the Offender and is called only for a new largest residual. NaN counts as infinite.
  template <typename Where>
  void add(double error, const Where& where)
  {
    error = std::isnan(error) ? infinite : std::abs(error);
    ++this->Count;
    this->Bad += error > this->Tolerance;
    if (error > this->Largest)
    {
      this->Largest = error;
      this->Worst = where();
    }
  }
  /// A value that is right or wrong.
  template <typename Where>
  void equal(bool same, const Where& where)
  {
    this->add(same ? 0 : infinite, where);
  }
  void good(std::uint64_t count = 1) { this->Count += count; }
  void skip(std::uint64_t count = 1) { this->Skipped += count; }
  void merge(const Meter& later);

  std::uint64_t Count = 0;
  std::uint64_t Skipped = 0;
  std::uint64_t Bad = 0;
  double Tolerance;
  double Largest = 0;
  Offender Worst;
};

/// Share of the values of a row that may be left open, unless the row says otherwise. Of pictures of a usual size it is
/// some 1e-3; where triangles are as small as pixels, or an edge runs along a row of pixels' centres, more.
constexpr double usualMostOpen = 0.1;

/// A line of the report.
struct Row
{
  std::string layer;
  std::string unit;
  std::vector<std::string> files; ///< of the dataset, whose contents are compared
  double mostOpen = usualMostOpen;
};

/// The residuals of all checks, in the order of checks, then layers.
class Results
{
public:
  void startCheck(int index, const std::string& name);
  /// Adds what was measured by the current check; a row shows the largest of its tolerances.
  void add(const Row& row, const Meter& meter);
  /// A file that cannot be used at all.
  void unusable(const std::string& layer, const std::string& file, const std::string& what);
  /// Whether some row compares the contents of a file.
  bool compares(const std::string& file) const { return this->Compared.count(file) > 0; }
  /// Adds what other threads found of the same checks.
  void merge(const Results& other);
  VerificationReport report() const;

private:
  void add(const std::pair<int, std::string>& key, const Residual& found);
  int Index = 0;
  std::string Check;
  std::map<std::pair<int, std::string>, Residual> Residuals;
  std::set<std::string> Compared;
};

/// Calls body(y, meter) for the rows [0, height) on the pool. The result does not depend on the threads.
Meter meterRows(ThreadPool& pool, int height, double tolerance, const std::function<void(int, Meter&)>& body);

} // namespace dgtk

#endif
