// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImportProtocol_h
#define dgtkImportProtocol_h

#include <cstdint>

/// How dgtk-import, which opens nothing itself, asks the library for files (dgtkHelperChannel.h).
namespace dgtk::import
{

struct FileRequest
{
  char name[4096] = {}; ///< as the importer names it
};

struct FileAnswer
{
  std::uint32_t found = 0; ///< 1: the open file comes with it
  char path[4096] = {};    ///< what was found, for messages
};

} // namespace dgtk::import

#endif
