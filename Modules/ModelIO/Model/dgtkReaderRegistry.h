// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReaderRegistry_h
#define dgtkReaderRegistry_h

#include "dgtkModelContents.h"

namespace dgtk
{

/// Reads one file. Throws InputError.
using ReadFunction = ModelContents (*)(const std::string& path, const ReadOptions& options);

struct ReaderRow
{
  ReaderInfo info;
  ReadFunction read;
};

const std::vector<ReaderRow>& readerRows();

} // namespace dgtk

#endif
