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

/// Channel of texture coordinates that a material's picture uses.
unsigned uvChannel(const aiScene& from, unsigned material);

} // namespace dgtk::import

#endif
