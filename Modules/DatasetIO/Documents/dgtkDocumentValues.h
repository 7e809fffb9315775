// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDocumentValues_h
#define dgtkDocumentValues_h

// Private to DatasetIO: values of a dataset's documents.

#include "dgtkDatasetDocuments.h"
#include "dgtkFile.h"
#include "dgtkJson.h"
#include "dgtkJsonText.h"

#include <cstdint>
#include <limits>
#include <set>
#include <string>

namespace dgtk
{

inline constexpr Range anyFrame{ -2147483648.0, 2147483647.0, false, false,
  "a whole number from -2147483648 to 2147483647" };
inline constexpr Range aSize{ 1, 2147483647.0, false, false, "a whole number from 1 to 2147483647" };
inline constexpr Range anId{ 1, 4294967295.0, false, false, "a whole number from 1 to 4294967295" };
inline constexpr Range anIndex{ 0, 4294967295.0, false, false, "a whole number from 0 to 4294967295" };
inline constexpr Range aCount{ 0, 9007199254740991.0, false, false, "a whole number from 0 to 2^53 - 1" };
inline constexpr Range aboveZero{ 0, 1.7976931348623157e308, true, false, "a number above 0" };

inline JsonDocument readJson(const std::string& path)
{
  return parseJson(path, readFile(path, std::uint64_t(1) << 30), 64'000'000);
}

inline int integerOf(const JsonCursor& at, const Range& range) { return static_cast<int>(at.wholeNumber(range)); }
inline std::uint32_t idOf(const JsonCursor& at, const Range& range = anId)
{
  return static_cast<std::uint32_t>(at.wholeNumber(range));
}
inline std::uint64_t countOf(const JsonCursor& at) { return static_cast<std::uint64_t>(at.wholeNumber(aCount)); }
inline std::string hashOf(const JsonCursor& at)
{
  const std::string& value = at.text();
  if (value.size() != 64 || value.find_first_not_of("0123456789abcdef") != std::string::npos)
  {
    at.failType("64 hexadecimal digits");
  }
  return value;
}

/// A member a line, of keys and texts.
template <typename Pairs>
std::string pairsText(const Pairs& pairs)
{
  JsonObject object(4);
  for (const auto& [key, value] : pairs)
  {
    object.text(key, value);
  }
  return pairs.empty() ? "{}" : object.block();
}
inline std::vector<std::pair<std::string, std::string>> pairsIn(const JsonCursor& object)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0, n = object.memberCount(); i < n; ++i)
  {
    pairs.emplace_back(object.key(i), object.member(i).text());
  }
  return pairs;
}
inline std::vector<std::string> textsIn(const JsonCursor& list)
{
  std::vector<std::string> texts;
  for (const JsonCursor& item : list.items())
  {
    texts.push_back(item.text());
  }
  return texts;
}

/// Why a file of a dataset or an export cannot have this name; "" where it can.
std::string faultOfName(const std::string& name);

/// A file of a manifest.
DatasetFile fileOf(const JsonCursor& value);
JsonObject fileObject(const DatasetFile& file);

/// Throws InputError where a link stands in place of one of the names that it is given, or of a folder that leads
/// there; looks at many names together.
class LinkCheck
{
public:
  explicit LinkCheck(const Folder& folder)
    : Where(folder)
  {
  }
  void add(const std::string& name);
  void finish(); ///< behind the last one

private:
  const Folder& Where;
  std::set<std::string> Names;
};

} // namespace dgtk

#endif
