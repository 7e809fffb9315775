// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFileTable_h
#define dgtkFileTable_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// The files of a dataset in some 60 bytes each: a dataset of many pictures has many times as many files. A path is
/// its camera's name, what all files of a layer have around the frame's digits, and the frame.
class DGTKDATASETIO_EXPORT FileTable
{
public:
  static constexpr std::uint32_t noShot = 0xffffffff;

  /// A file, and the number of the shot that it belongs to.
  void add(const DatasetFile& file, std::uint32_t shot);
  /// Behind the last one.
  void finish();

  std::size_t size() const { return this->Entries.size(); }
  /// The file's number; none for one that is not listed.
  std::optional<std::uint32_t> find(const std::string& path) const;
  /// Numbers of a shot's files, sorted by layer (in the order in which the layers came) and path.
  std::vector<std::uint32_t> ofShot(std::uint32_t shot) const;
  std::vector<std::uint32_t> ofShot(std::uint32_t shot, const std::string& layer) const;
  bool hasLayer(const std::string& layer) const; ///< of a shot

  std::string pathOf(std::uint32_t number) const { return this->pathOf(this->Entries[number]); }
  std::uint32_t shotOf(std::uint32_t number) const { return this->Entries[number].shot; }
  /// Without camera and frame.
  DatasetFile at(std::uint32_t number) const;

private:
  /// What files of a kind have in common.
  struct Form
  {
    std::string before; ///< the frame's digits
    std::string after;
    std::uint32_t layer = 0;
  };
  struct Entry
  {
    std::uint64_t bytes = 0;
    std::array<std::uint8_t, 32> hash = {};
    std::uint32_t camera = 0; ///< place in Cameras; the first one is ""
    std::uint32_t form = 0;   ///< place in Forms
    std::int32_t frame = -1;  ///< whose digits the path has, -1 for none
    std::uint32_t shot = noShot;
  };
  std::string pathOf(const Entry& entry) const;
  std::uint32_t layerOf(const Entry& entry) const { return this->Forms[entry.form].layer; }
  std::uint32_t layerNumber(const std::string& layer);

  std::deque<Entry> Entries; ///< sorted by path
  bool Sorted = true;
  std::string LastPath; ///< while files are added
  std::vector<std::uint32_t> ByShot;
  std::vector<std::string> Cameras{ "" };
  std::map<std::string, std::uint32_t> CameraNumbers{ { "", 0 } };
  std::vector<Form> Forms;
  std::map<std::array<std::string, 3>, std::uint32_t> FormNumbers; ///< by before, after, layer
  std::vector<std::string> Layers;
  std::vector<bool> OfShots; ///< of a layer: whether a shot has it
};

} // namespace dgtk

#endif
