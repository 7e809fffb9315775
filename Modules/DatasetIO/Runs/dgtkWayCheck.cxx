// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWayCheck.h"

#include "dgtkError.h"
#include "dgtkFile.h"

namespace dgtk
{

void WayCheck::check(const std::string& name, EntryKind kind, bool ours) const
{
  const char* what = kind == EntryKind::Blocked  ? "a link or a file stands where a folder of the dataset has to be"
                     : kind == EntryKind::Folder ? "a folder stands where a file of the dataset has to be"
                     : kind != EntryKind::Nothing && !ours ? "is in the way, and no run has written it"
                                                           : nullptr;
  if (what)
  {
    throw UsageError(this->Where.pathOf(name) + ": " + what + "; name another folder, or take it away");
  }
}

void WayCheck::add(const std::string& name)
{
  constexpr std::size_t together = 4096;
  this->Names.insert(name);
  this->Partial.insert(partialName(name));
  if (this->Names.size() == together)
  {
    this->finish();
  }
}

void WayCheck::finish()
{
  this->Where.look(this->Names, [this](const std::string& name, EntryKind kind)
    { this->check(name, kind, kind == EntryKind::Nothing || this->Listed.has(name)); });
  this->Where.look(this->Partial, [this](const std::string& name, EntryKind kind) { this->check(name, kind, true); });
  this->Names.clear();
  this->Partial.clear();
}

} // namespace dgtk
