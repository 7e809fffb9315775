// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolderWay_h
#define dgtkFolderWay_h

// Private to Pipeline.

#include "dgtkFolderContents.h"

#include <string>

namespace dgtk
{

/// Runs what writes into a folder; a refusal of the folder says what may be done about it, in Python's words.
template <typename Body>
void withWayOut(const Body& body)
{
  try
  {
    body();
  }
  catch (const FolderError& error)
  {
    const FolderContents contents = error.contents();
    const bool other = contents == FolderContents::FinishedOther || contents == FolderContents::UnfinishedOther;
    throw UsageError(
      error.what() + std::string(contents == FolderContents::Unfinished ? "; resume completes it, replace starts over"
                                 : other                                ? "; replace removes it"
                                                                        : ""));
  }
}

} // namespace dgtk

#endif
