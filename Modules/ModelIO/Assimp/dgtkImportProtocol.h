// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkImportProtocol_h
#define dgtkImportProtocol_h

#include <charconv>
#include <cstdint>
#include <string>

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

/// A part of a URI without its escapes ("%20").
inline std::string withoutPercents(const std::string& uri)
{
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i)
  {
    unsigned code = 0;
    const char* digits = uri.data() + i + 1;
    const bool escape =
      uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    plain += escape ? static_cast<char>(code) : uri[i];
    i += escape ? 2 : 0;
  }
  return plain;
}

} // namespace dgtk::import

#endif
