// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFileTable_h
#define dgtkFileTable_h

// Private to Export.

#include "dgtkDatasetDocuments.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// The files of a dataset in few bytes each: a dataset of many pictures has many times as many files.
class FileTable
{
public:
  static constexpr std::uint32_t noShot = 0xffffffff;

  /// A file, and the number of the shot that it belongs to.
  void add(const DatasetFile& file, std::uint32_t shot);
  /// Behind the last one.
  void finish();

  /// The file's number; none for one that is not listed.
  std::optional<std::uint32_t> find(const std::string& path) const;
  /// Numbers of a shot's files, sorted by layer (in the order in which the layers came) and path.
  std::vector<std::uint32_t> ofShot(std::uint32_t shot) const;
  std::vector<std::uint32_t> ofShot(std::uint32_t shot, const std::string& layer) const;
  bool hasLayer(const std::string& layer) const; ///< of a shot

  std::string pathOf(std::uint32_t number) const;
  std::uint32_t shotOf(std::uint32_t number) const { return this->Entries[number].shot; }
  /// Without camera and frame.
  DatasetFile at(std::uint32_t number) const;

private:
  struct Entry
  {
    std::uint64_t path = 0; ///< place in Paths
    std::uint64_t bytes = 0;
    std::array<std::uint8_t, 32> hash = {};
    std::uint32_t length = 0; ///< of the path
    std::uint32_t shot = noShot;
    std::uint32_t layer = 0;
  };
  int compare(const Entry& entry, const std::string& path) const;
  std::string Paths; ///< one behind the other
  std::vector<Entry> Entries;
  std::vector<std::uint32_t> ByPath;
  std::vector<std::uint32_t> ByShot;
  std::vector<std::string> Layers;
  std::vector<bool> OfShots; ///< of a layer: whether a shot has it
};

} // namespace dgtk

#endif
