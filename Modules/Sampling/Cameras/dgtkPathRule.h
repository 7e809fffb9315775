// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPathRule_h
#define dgtkPathRule_h

#include "dgtkJson.h"
#include "dgtkSampleWorld.h"
#include "dgtkSceneDescription.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace dgtk::samplerule
{

inline constexpr Range coordinate{ -1e15, 1e15, false, false, "a number from -1e15 to 1e15" };
inline constexpr Range positive{ 0, 1e15, true, false, "a number above 0, at most 1e15" };
inline constexpr Range notNegative{ 0, 1e15, false, false, "a number from 0 to 1e15" };
inline constexpr Range degrees{ -36000, 36000, false, false, "degrees from -36000 to 36000" };
inline constexpr Range frameNumber{ 0, largestFrame, false, false, "a whole number from 0 to 999999" };
inline constexpr Range tries{ 1, 10000, false, false, "a whole number from 1 to 10000" };

/// Fails at a key that is none of these.
void onlyKeys(const JsonCursor& at, const std::vector<std::string>& known);
/// A point, or the centre of the objects that a name or pattern stands for.
Eigen::Vector3d pointOf(const JsonCursor& at, const SampleWorld& world);
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
