// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPathNames_h
#define dgtkPathNames_h

#include "dgtkCoreModule.h"

#include <map>
#include <string>

namespace dgtk
{

/// Whole names of files that stay where they are meanwhile: each folder is looked up once. Not thread-safe.
class DGTKCORE_EXPORT PathNames
{
public:
  /// One name for all spellings of a path: absolute, without links where it exists.
  const std::string& of(const std::string& path);
  /// The path as seen from a folder, both without links, with '/' between folders.
  std::string relative(const std::string& path, const std::string& folder);

private:
  std::map<std::string, std::string> Known;
};

/// A path as a message shows it: without ways into a folder and out again, but where a link makes them lead elsewhere.
DGTKCORE_EXPORT std::string tidied(const std::string& path);

} // namespace dgtk

#endif
