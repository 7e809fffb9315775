// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonPieces_h
#define dgtkJsonPieces_h

#include "dgtkCoreModule.h"

#include "dgtkJson.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// An element of a long list, while it is read.
struct JsonPiece
{
  JsonCursor value;
  std::uint64_t begin = 0; ///< of an object or a list: its bytes in the file, from the first bracket
  std::uint64_t end = 0;   ///< behind the last one
};

/// A list at the root of a document, whose elements are handed on one by one.
struct JsonLongList
{
  std::string key;
  std::function<void(const JsonPiece&)> visit;
};

/// Reads a file as parseJson() does, in little memory however long these lists are: what is returned has them empty.
/// Throws InputError also for what readFile() refuses.
DGTKCORE_EXPORT JsonDocument readJsonPieces(const std::string& file, const std::vector<JsonLongList>& lists);

/// Elements of a list that follow each other in a file, from `begin` of the first to `end` of the last, as a list;
/// errors name places below `label`. Throws InputError.
DGTKCORE_EXPORT JsonDocument readJsonPieces(
  const std::string& file, std::uint64_t begin, std::uint64_t end, const std::string& label);

} // namespace dgtk

#endif
