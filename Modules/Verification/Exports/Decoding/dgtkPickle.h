// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPickle_h
#define dgtkPickle_h

// Private to Verification: Python pickles (Lib/pickletools.py) of dictionaries of dictionaries of NumPy arrays.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// An array, C order; its values stand in the file.
struct PickledArray
{
  std::string type; ///< "u1"
  std::vector<std::uint64_t> shape;
  std::size_t begin = 0;
  std::size_t bytes = 0;
};
using PickledVideos = std::map<std::string, std::map<std::string, PickledArray>>;

/// Throws InputError for a pickle of anything else; nothing in it is carried out.
PickledVideos readPickledVideos(const std::string& path, const std::string& bytes);

} // namespace dgtk

#endif
