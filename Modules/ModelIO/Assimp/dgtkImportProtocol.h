// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImportProtocol_h
#define dgtkImportProtocol_h

#include <cstdint>

/// What the library and dgtk-import say to each other (dgtkHelperChannel.h). dgtk-import starts once, and makes a copy
/// of itself for each model, with a channel of its own. That opens nothing itself: it asks for files.
namespace dgtk::import
{

/// Beside it come the copy's end of a channel, and where it writes the model.
struct ModelRequest
{
  char path[4096] = {};
  char format[16] = {};
};

/// What comes through the channel of a model.
struct Question
{
  std::uint32_t hasEnded = 0; ///< 1: the copy has come to its end
  std::int32_t status = 0;    ///< then: as of waitpid()
  char name[4096] = {};       ///< else: of the file that is wanted, as the importer names it
};

struct FileAnswer
{
  std::uint32_t found = 0; ///< 1: the open file comes with it
  char path[4096] = {};    ///< what was found, for messages
};

} // namespace dgtk::import

#endif
