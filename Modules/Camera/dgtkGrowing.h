// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGrowing_h
#define dgtkGrowing_h

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dgtk
{

/// A value and the slope there.
struct ValueSlope
{
  double value;
  double slope;
};

/// A function that grows from 0 at 0 on to some end, and its inverse: Newton's method within brackets, from a table.
/// Function: ValueSlope operator()(double) const.
template <class Function>
class Growing
{
public:
  /// It grows up to `last`. Values up to `usual` are the ones that are asked for mostly.
  Growing(Function function, double last, double usual)
    : Of(std::move(function))
    , Last(last)
    , Most(Of(last).value)
    , Usual(std::min(usual, Most))
  {
    double x = 0;
    for (int i = 0; i <= steps; ++i)
    {
      x = this->solve(this->Usual * i / steps, { x, this->Last }, x);
      this->Starts[std::size_t(i)] = x;
    }
  }
  double last() const { return this->Last; }
  double most() const { return this->Most; } ///< the value there
  ValueSlope operator()(double x) const { return this->Of(x); }

  /// For 0 <= value <= most().
  double inverse(double value) const
  {
    if (value >= this->Usual)
    {
      return this->solve(value, { this->Starts.back(), this->Last }, this->Starts.back());
    }
    const int i = std::min(static_cast<int>(value / this->Usual * steps), steps - 1);
    return this->solve(
      value, { this->Starts[std::size_t(i)], this->Starts[std::size_t(i) + 1] }, this->nearInverse(value));
  }

  /// To some six digits, for a start.
  double nearInverse(double value) const
  {
    if (value >= this->Usual)
    {
      return this->inverse(value);
    }
    const double at = value / this->Usual * steps;
    const int i = std::min(static_cast<int>(at), steps - 1);
    const double low = this->Starts[std::size_t(i)];
    return low + (at - i) * (this->Starts[std::size_t(i) + 1] - low);
  }

private:
  static constexpr int steps = 1024;
  static constexpr int mostTries = 200;    // halves of a bracket
  static constexpr double settled = 1e-15; // part of x by which the last step moves it

  double solve(double value, std::pair<double, double> bracket, double x) const
  {
    for (int tries = 0; tries < mostTries; ++tries)
    {
      const ValueSlope here = this->Of(x);
      (here.value < value ? bracket.first : bracket.second) = x;
      double next = x + (value - here.value) / here.slope;
      if (!(next >= bracket.first && next <= bracket.second))
      {
        next = 0.5 * (bracket.first + bracket.second);
      }
      const double step = std::abs(next - x);
      x = next;
      if (step <= settled * x)
      {
        break;
      }
    }
    return x;
  }

  Function Of;
  double Last;
  double Most;
  double Usual;
  std::vector<double> Starts = std::vector<double>(steps + 1);
};

/// How far a function grows: up to where its slope falls to `least`, or to `last`, in steps of which each is `ratio`
/// times as long as the one before. `slope` of a number; at 0 it is above `least`.
template <class Slope>
double growsUpTo(const Slope& slope, double least, double last, double firstStep, double ratio)
{
  double low = 0;
  for (double step = firstStep; low < last; step *= ratio)
  {
    double high = std::min(low + step, last);
    if (slope(high) > least)
    {
      low = high;
      continue;
    }
    while (high - low > 1e-15 * high)
    {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high)
      {
        break;
      }
      (slope(middle) > least ? low : high) = middle;
    }
    return low;
  }
  return last;
}

} // namespace dgtk

#endif
