// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHdf5Contents_h
#define dgtkHdf5Contents_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// A dataset of an HDF5 file.
struct Hdf5Dataset
{
  enum class Kind
  {
    Whole, ///< numbers without a fraction
    Real,
    Text
  };
  Kind kind = Kind::Whole;
  std::size_t bytes = 0; ///< of a number
  std::vector<std::uint64_t> dimensions;
  std::vector<double> values; ///< row by row
  std::string text;
  int deflate = -1;     ///< level of the filter; -1: none
  bool hasTime = false; ///< whether a message says when it was made or changed
};

/// The members of the root group of a file with superblock 0 and headers of version 1: whole numbers, real numbers and
/// texts of little-endian types, contiguous or in chunks, plain or deflated. Throws InputError for a damaged file and
/// for what it does not know.
std::map<std::string, Hdf5Dataset> readHdf5(const std::string& path);

} // namespace dgtk

#endif
