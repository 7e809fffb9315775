// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltfMeshes_h
#define dgtkGltfMeshes_h

#include "dgtkGltfFile.h"

namespace dgtk::import
{

/// Reads again what Assimp 5.2 gets wrong of meshes, or leaves out: attributes that are not floats, colours of vertices
/// (COLOR_0), how strongly materials glow (KHR_materials_emissive_strength), and where they place their pictures
/// (KHR_texture_transform; a material has one placement, that of the first of its pictures, and a warning where others
/// lie elsewhere). Warns of triangles and pictures that it leaves out. Throws std::exception.
void repairMeshes(GltfFile& file, const NodeMatch& nodes, Scene& scene);

} // namespace dgtk::import

#endif
