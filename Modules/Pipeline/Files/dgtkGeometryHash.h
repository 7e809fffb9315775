// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGeometryHash_h
#define dgtkGeometryHash_h

// Private to Pipeline.

#include "dgtkStage.h"

#include <string>
#include <vector>

namespace dgtk
{

/// For each object with an id, a SHA-256 of its triangles in object coordinates at the scene's first frame, with
/// normals, texture coordinates, colours and materials, and of the files or pixels of its textures. Names count for
/// nothing. Throws InputError for a texture's file that can no longer be read.
std::vector<std::string> geometryHashes(const Stage& stage);

} // namespace dgtk

#endif
