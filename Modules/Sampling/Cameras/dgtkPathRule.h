// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPathRule_h
#define dgtkPathRule_h

#include "dgtkRuleValues.h"
#include "dgtkSceneDescription.h"

#include <vector>

namespace dgtk::samplerule
{

inline constexpr Range frameNumber{ 0, largestFrame, false, false, "a whole number from 0 to 999999" };
inline constexpr Range tries{ 1, 10000, false, false, "a whole number from 1 to 10000" };

/// A number, or [first, last].
struct FromTo
{
  double from;
  double to;
  double at(double u) const { return this->from + u * (this->to - this->from); }
};
FromTo fromTo(const JsonCursor& at, const Range& range);
/// Frames [first, last] and every `every`th of them, with the last.
std::vector<int> framesOf(const JsonCursor& at);
/// Attempts of a rule, and whether it is left out when none succeeds (otherwise the sample is refused).
int attemptsOf(const JsonCursor& at);
bool isOmitted(const JsonCursor& at);

} // namespace dgtk::samplerule

#endif
