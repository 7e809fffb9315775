// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkProgressEstimate_h
#define dgtkProgressEstimate_h

#include "dgtkRunsModule.h"

#include <optional>

namespace dgtk
{

/// How far a run is between its reports: within the picture that is being drawn it goes on, ever slower, and never
/// beyond it. Seconds count from the start of the run.
class DGTKRUNS_EXPORT ProgressEstimate
{
public:
  /// `done` of `total` pictures, 0 <= done <= total; done never falls. What the first report has counts as kept from an
  /// earlier run.
  void report(double seconds, int done, int total);

  /// In [0, 1], never falling; 0 before the first report.
  double fractionAt(double seconds) const;
  /// None before a picture is done.
  std::optional<double> secondsLeftAt(double seconds) const;

private:
  double rate() const; ///< pictures a second
  double doneAt(double seconds) const;

  bool Begun = false;
  int Kept = 0;
  int Done = 0;
  int Total = 0;
  double First = 0;
  double Last = 0; ///< when Done became what it is
};

} // namespace dgtk

#endif
