// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelEntry_h
#define dgtkModelEntry_h

#include "dgtkModelContents.h"

#include <string>
#include <vector>

namespace dgtk
{

/// A model that is kept in a file: its contents, and what each of its dependencies was like.
struct ModelEntry
{
  ModelContents contents;
  std::vector<std::string> identities; ///< one a dependency
};

/// Writes an entry, in the byte order of the machine. Throws MachineError when the file cannot be written.
void writeModelEntry(const std::string& path, ModelEntry& entry);

/// Reads an entry. False when there is none, or when a single byte of it is not as it was written.
bool readModelEntry(const std::string& path, ModelEntry& entry);

} // namespace dgtk

#endif
