// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHdf5File_h
#define dgtkHdf5File_h

#include "dgtkExporter.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// Writes an HDF5 file of arrays and texts in its root group, in the form that all versions of the library read
/// (superblock 0, version 1 of headers and trees). Not with the library: its files differ from version to version, and
/// it writes one file at a time, whatever the threads. There is no time in it.
class Hdf5File
{
public:
  enum class Type
  {
    UInt8,
    Int32,
    Float32
  };
  /// Rows of an image; (height, width) of one channel, else (height, width, channels).
  struct Shape
  {
    int height = 0;
    int width = 0;
    int channels = 1;
  };

  /// `level`: of gzip, 1 to 9.
  explicit Hdf5File(int level);
  /// `fill` makes the rows from top to bottom, channels interleaved, in the type's own numbers. At most 32 members.
  void add(const std::string& name, Type type, const Shape& shape, const std::function<void(int y, void* row)>& fill);
  /// A text of fixed length.
  void add(const std::string& name, const std::string& text);
  /// The whole file.
  std::string bytes() const;

private:
  struct Member
  {
    std::string name;
    Type type = Type::UInt8;
    std::vector<std::uint64_t> dimensions; ///< none of a text
    std::uint64_t chunkRows = 0;
    std::vector<std::string> chunks; ///< compressed; of a text the text itself
  };
  std::string headerOf(const Member& member, std::uint64_t data) const;
  static std::string treeOf(const Member& member, std::uint64_t data);
  int Level;
  std::vector<Member> Members; ///< sorted by name
};

} // namespace dgtk

#endif
