// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelPly_h
#define dgtkModelPly_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// A model of a dataset (Documentation/Formats/dataset.md, models): object coordinates, scene units.
struct ModelPly
{
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<double, 2>> uvs; ///< (0, 0) is the picture's lower left corner; none for a model without
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<int> textures; ///< of each triangle: index into `pictures`, -1 for none
  std::vector<std::string> pictures;
  std::vector<std::string> wraps; ///< of each picture: "clamp mirror" along u and v, or "" where it repeats
};

/// Throws InputError for a file that is damaged.
ModelPly readModelPly(const std::string& path);
/// The names of its pictures, which stand beside it.
std::vector<std::string> picturesOfModel(const std::string& path);

} // namespace dgtk

#endif
