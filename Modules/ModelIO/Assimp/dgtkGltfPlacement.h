// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltfPlacement_h
#define dgtkGltfPlacement_h

#include "dgtkGltfFile.h"

#include <array>
#include <vector>

namespace dgtk::import
{

constexpr const char* textureTransform = "KHR_texture_transform";

/// Where a picture lies: its coordinates are scaled, then turned, then moved, v down.
struct Placement
{
  std::size_t set = 0;         ///< of texture coordinates
  std::size_t importedSet = 0; ///< the one that the importer takes
  std::array<double, 2> offset{ 0, 0 };
  double rotation = 0; ///< radians, counter-clockwise as a picture is seen
  std::array<double, 2> scale{ 1, 1 };
  GltfFile::Json texture{}; ///< of the file: its index, as it is written

  bool isPlain() const { return *this == Placement{ this->set, 0, { 0, 0 }, 0, { 1, 1 } }; }
  bool operator==(const Placement& o) const
  {
    return this->set == o.set && this->offset == o.offset && this->rotation == o.rotation && this->scale == o.scale;
  }
};

/// Of a material's pictures, the one of its colour first.
std::vector<Placement> placementsOf(const GltfFile::Json& material);
/// Moves the texture coordinates of a mesh.
void place(const Placement& where, Mesh& mesh);

} // namespace dgtk::import

#endif
