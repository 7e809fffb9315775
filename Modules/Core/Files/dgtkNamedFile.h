// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNamedFile_h
#define dgtkNamedFile_h

#include "dgtkCoreModule.h"

#include <string>

namespace dgtk
{

/// What a path leads to by links, whether it is there or not; the path itself where it is no link. Throws MachineError
/// for links that lead to one another.
DGTKCORE_EXPORT std::string linkedPath(const std::string& path);

/// Writes a whole file that somebody names himself, as an editor does: where a link stands what it leads to is replaced
/// (and the link stays), and a file that is there keeps its mode. Throws MachineError, also for one that is read-only.
/// Not for files in folders that others may fill, as datasets are: see Folder. Durable, as AtomicFile::commitDurably().
DGTKCORE_EXPORT void writeNamedFile(const std::string& path, const std::string& contents);

} // namespace dgtk

#endif
