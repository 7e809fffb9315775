// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRuleValues.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>

namespace dgtk::samplerule
{

void onlyKeys(const JsonCursor& at, const std::vector<std::string>& known)
{
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    if (std::find(known.begin(), known.end(), at.key(i)) == known.end())
    {
      const std::string near = nearest(at.key(i), known);
      at.fail("has the unknown key " + quoted(at.key(i)), near.empty() ? "one of " + joined(known) : "perhaps " + near);
    }
  }
}

} // namespace dgtk::samplerule
