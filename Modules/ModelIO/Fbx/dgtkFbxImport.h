// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxImport_h
#define dgtkFbxImport_h

#include "dgtkAssimpStream.h"

#include <string>

namespace dgtk::import
{

/// Reads an FBX file of version 7 (2011 and later), binary or text: meshes with materials, normals and texture
/// coordinates, pivots, rotation orders, geometric transforms, skins, blend shapes and animation with all its kinds of
/// curves and layers, as the FBX SDK defines them. Throws std::runtime_error.
void readFbx(const std::string& bytes, Scene& to);

} // namespace dgtk::import

#endif
