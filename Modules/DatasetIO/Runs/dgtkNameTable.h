// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNameTable_h
#define dgtkNameTable_h

#include "dgtkDatasetIOModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

namespace dgtk
{

/// Hands on names of files, one by one.
using ForNames = std::function<void(const std::function<void(const std::string& name)>& visit)>;

/// A set of many names in 24 bytes each: the first half of a name's SHA-256, so that none is taken for another one, and
/// a number of its own, 0 at first.
class DGTKDATASETIO_EXPORT NameTable
{
public:
  void add(const std::string& name);
  /// Behind the last add(); what follows may be called from any thread but for the numbers.
  void finish();

  std::size_t size() const { return this->Entries.size(); } ///< of names that differ
  bool has(const std::string& name) const { return this->numberOf(name) != nullptr; }
  /// Null for a name that was not added.
  const std::uint64_t* numberOf(const std::string& name) const;
  std::uint64_t* numberOf(const std::string& name);

private:
  struct Entry
  {
    std::uint64_t hash[2] = {};
    std::uint64_t number = 0;
    static bool isLess(const Entry& a, const Entry& b);
  };
  static Entry entryOf(const std::string& name);

  std::deque<Entry> Entries; ///< sorted by hash, but for those behind the last finish()
  std::size_t Enough = 4096; ///< of entries, before what was added twice is looked for
};

} // namespace dgtk

#endif
