// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReaderRegistry_h
#define dgtkReaderRegistry_h

#include "dgtkModelReader.h"

namespace dgtk
{

/// Reads one file. Throws InputError; never returns null.
using ReadFunction = std::shared_ptr<Model> (*)(const std::string& path, const ReadOptions& options);

struct ReaderRow
{
  ReaderInfo info;
  ReadFunction read;
};

const std::vector<ReaderRow>& readerRows();

} // namespace dgtk

#endif
