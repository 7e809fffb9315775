// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRuleValues_h
#define dgtkRuleValues_h

#include "dgtkJson.h"

#include <string>
#include <vector>

namespace dgtk::samplerule
{

inline constexpr Range coordinate{ -1e15, 1e15, false, false, "a number from -1e15 to 1e15" };
inline constexpr Range positive{ 0, 1e15, true, false, "a number above 0, at most 1e15" };
inline constexpr Range notNegative{ 0, 1e15, false, false, "a number from 0 to 1e15" };
inline constexpr Range degrees{ -36000, 36000, false, false, "degrees from -36000 to 36000" };

/// Fails at a key that is none of these.
void onlyKeys(const JsonCursor& at, const std::vector<std::string>& known);

} // namespace dgtk::samplerule

#endif
