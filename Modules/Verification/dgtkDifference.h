// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDifference_h
#define dgtkDifference_h

#include <Eigen/Core>

#include <cmath>

// Differences of what was found from what is right. What is no number stays none, as it is wrong wherever a number is
// expected (Meter::add); std::max() and Eigen's usual maximum may lose it.

namespace dgtk
{

/// The larger one; NaN where one of them is.
inline double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

/// What an error is beyond its slack, at least 0; NaN where the error is.
inline double beyond(double error, double slack)
{
  const double over = error - slack;
  return over <= 0 ? 0 : over;
}

/// The largest difference of numbers of two matrices; NaN where one is.
template <typename A, typename B>
double apart(const Eigen::MatrixBase<A>& found, const Eigen::MatrixBase<B>& expected)
{
  return (found - expected).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

} // namespace dgtk

#endif
