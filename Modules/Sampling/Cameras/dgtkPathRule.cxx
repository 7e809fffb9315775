// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPathRule.h"

#include <string>

namespace dgtk::samplerule
{

FromTo fromTo(const JsonCursor& at, const Range& range)
{
  if (at.node().type == JsonNode::Type::Number)
  {
    return { at.number(range), at.number(range) };
  }
  at.listSize(2);
  return { at.element(0).number(range), at.element(1).number(range) };
}

std::vector<int> framesOf(const JsonCursor& at)
{
  const JsonCursor range = at["frames"];
  range.listSize(2);
  const int first = static_cast<int>(range.element(0).wholeNumber(frameNumber));
  const int last = static_cast<int>(range.element(1).wholeNumber(frameNumber));
  if (first >= last)
  {
    range.fail("is empty", "[first, last]", std::to_string(first) + ", " + std::to_string(last));
  }
  constexpr Range steps{ 1, largestFrame, false, false, "a whole number from 1 to 999999" };
  const int every = at.has("every") ? static_cast<int>(at["every"].wholeNumber(steps)) : 1;
  std::vector<int> frames;
  for (int frame = first; frame < last; frame += every)
  {
    frames.push_back(frame);
  }
  frames.push_back(last);
  return frames;
}

int attemptsOf(const JsonCursor& at)
{
  return at.has("attempts") ? static_cast<int>(at["attempts"].wholeNumber(tries)) : 100;
}

bool isOmitted(const JsonCursor& at) { return at.has("otherwise") && at["otherwise"].oneOf({ "refuse", "omit" }) == 1; }

} // namespace dgtk::samplerule
