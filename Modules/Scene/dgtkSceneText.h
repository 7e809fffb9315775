// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneText_h
#define dgtkSceneText_h

// Private to Scene.

#include <string>
#include <string_view>

namespace dgtk::scenefile
{

/// What a text is not, as an error says it; empty when `value` was read. Decimal, finite, the whole text.
std::string parseNumber(std::string_view text, double& value);

/// `path` as written below `fromFolder`, rewritten to be relative to `toFolder`; absolute paths and paths within the
/// same folder stay as they are.
std::string relocate(const std::string& path, const std::string& fromFolder, const std::string& toFolder);

/// File name without folder and extension.
std::string stemOf(const std::string& path);

} // namespace dgtk::scenefile

#endif
