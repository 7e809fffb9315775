// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelFolder_h
#define dgtkModelFolder_h

#include <string>

namespace dgtk
{

/// Whether a name leads into a folder, by its words alone; links are not looked at.
bool isNamedBeneath(const std::string& path, const std::string& folder);

/// Whether a file lies in a folder or below it, with all links followed. False when there is no such file.
bool liesBeneath(const std::string& path, const std::string& folder);

/// Folder of a file: "." when the path has none.
std::string folderOfFile(const std::string& path);

} // namespace dgtk

#endif
