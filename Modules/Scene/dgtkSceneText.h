// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneText_h
#define dgtkSceneText_h

#include "dgtkPathNames.h"

#include <string>
#include <string_view>
#include <utility>

namespace dgtk::scenefile
{

/// What a text is not, as an error says it; empty when `value` was read. Decimal, finite, the whole text.
std::string parseNumber(std::string_view text, double& value);

/// Paths as written below one folder, rewritten to be relative to another one; absolute paths and paths within the same
/// folder stay as they are.
class Relocation
{
public:
  Relocation(std::string fromFolder, std::string toFolder)
    : From(std::move(fromFolder))
    , To(std::move(toFolder))
  {
  }
  std::string of(const std::string& path);

private:
  std::string From;
  std::string To;
  PathNames Names;
};

/// File name without folder and extension.
std::string stemOf(const std::string& path);

} // namespace dgtk::scenefile

#endif
