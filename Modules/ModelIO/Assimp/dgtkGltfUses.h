// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltfUses_h
#define dgtkGltfUses_h

#include "dgtkGltfFile.h"

namespace dgtk::import
{

/// Reads what the nodes of a mesh say of it: joints of their skins (withoutSkins()), and weights of morph targets,
/// which Assimp 5.2 leaves out, as it does those targets' normals. A mesh whose nodes say several things is there once
/// for each. Throws std::exception.
void repairUses(GltfFile& file, const NodeMatch& nodes, Scene& scene);

} // namespace dgtk::import

#endif
