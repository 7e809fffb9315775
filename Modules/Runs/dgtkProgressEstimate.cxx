// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkProgressEstimate.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double guessedRate = 0.1; // pictures a second, before the first is done
constexpr double shortest = 1e-3;   // seconds
} // namespace

void ProgressEstimate::report(double seconds, int done, int total)
{
  if (!this->Begun)
  {
    this->Begun = true;
    this->Kept = done;
    this->First = this->Last = seconds;
  }
  if (done > this->Done)
  {
    this->Last = seconds;
  }
  this->Done = done;
  this->Total = total;
}

double ProgressEstimate::rate() const
{
  return this->Done > this->Kept ? (this->Done - this->Kept) / std::max(shortest, this->Last - this->First)
                                 : guessedRate;
}

double ProgressEstimate::doneAt(double seconds) const
{
  const double passed = std::max(0.0, seconds - this->Last);
  return std::min<double>(this->Total, this->Done + 1 - std::exp(-passed * this->rate()));
}

double ProgressEstimate::fractionAt(double seconds) const
{
  return this->Total > 0 ? this->doneAt(seconds) / this->Total : 0;
}

std::optional<double> ProgressEstimate::secondsLeftAt(double seconds) const
{
  if (this->Total == 0 || (this->Done == this->Kept && this->Done < this->Total))
  {
    return std::nullopt;
  }
  return (this->Total - this->doneAt(seconds)) / this->rate();
}

} // namespace dgtk
