// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpConvert_h
#define dgtkAssimpConvert_h

#include "dgtkAssimpStream.h"

struct aiScene;

namespace dgtk::import
{

/// Everything of Assimp's scene that a Model can hold.
void convert(const aiScene& from, bool gltf, Scene& to);

/// Materials and embedded pictures.
void convertMaterials(const aiScene& from, bool gltf, Scene& to);

/// Where a material's pictures lie: all where the first one does.
struct PicturePlace
{
  unsigned channel = 0; ///< of texture coordinates
  std::array<float, 2> scale{ 1, 1 };
  std::array<float, 2> offset{ 0, 0 }; ///< after scaling
};
PicturePlace placeOf(const aiScene& from, unsigned material, bool gltf);

} // namespace dgtk::import

#endif
