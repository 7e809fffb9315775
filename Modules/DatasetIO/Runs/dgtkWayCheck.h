// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWayCheck_h
#define dgtkWayCheck_h

#include "dgtkFolder.h"
#include "dgtkNameTable.h"

#include <set>
#include <string>

namespace dgtk
{

/// Whether files of a run, or of its predecessor, can be written: reached without links, no folder in their place, and
/// nothing there that the predecessor does not list; those of a folder are looked at together. Throws UsageError.
class WayCheck
{
public:
  WayCheck(const Folder& folder, const NameTable& listed)
    : Where(folder)
    , Listed(listed)
  {
  }
  void add(const std::string& name);
  void finish(); ///< behind the last one

private:
  void check(const std::string& name, EntryKind kind, bool ours) const;
  const Folder& Where;
  const NameTable& Listed;
  std::set<std::string> Names;
  std::set<std::string> Partial;
};

} // namespace dgtk

#endif
