// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxImport_h
#define dgtkFbxImport_h

#include "dgtkAssimpStream.h"

#include <string>

namespace dgtk::import
{

/// Reads an FBX file of version 7 (2011 and later), binary or text, in its own axes and units: meshes with materials,
/// their colours' pictures, normals and texture coordinates; pivots, rotation orders and geometric transforms (FBX SDK,
/// FbxNode), inherited scales as Maya has them, skins, blend shapes, curves and layers. Throws std::runtime_error.
void readFbx(const std::string& bytes, Scene& to);

} // namespace dgtk::import

#endif
