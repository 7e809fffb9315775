// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMasks_h
#define dgtkMasks_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Masks of the layer `amodal`.
struct Masks
{
  int width = 0;
  int height = 0;
  std::map<std::uint32_t, std::vector<char>> byId; ///< rows top to bottom, 1 inside
  bool inside(std::uint32_t id, int x, int y) const
  {
    const auto mask = this->byId.find(id);
    return mask != this->byId.end() && mask->second[std::size_t(y) * this->width + x] != 0;
  }
};

/// Reads `<frame>.json` of amodal. Throws InputError for a file that is not one of that size.
Masks readMasks(const std::string& path, int width, int height);

} // namespace dgtk

#endif
