// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpGltf_h
#define dgtkAssimpGltf_h

#include "dgtkAssimpStream.h"

#include <functional>
#include <string>

namespace dgtk::import
{

/// All of a file of that name. Throws std::runtime_error.
using ReadContents = std::function<std::string(const std::string& name)>;

/// Reads animations and the joints of skins from a glTF file again, where Assimp 5.2 loses something: steps and splines
/// between keys become lines, weights below 0 become 0, nodes of equal names are confused, and joints without a name
/// are not found; and what repairMeshes() says. What cannot be read is left as Assimp has it, with a
/// warning, but what would be other triangles: that is Scene::error.
void repairGltf(const std::string& path, const ReadContents& contentsOf, Scene& scene);

/// Why Assimp may refuse a glTF file, in words, or "": what it says itself is seldom the reason.
std::string gltfProblem(const std::string& path, const ReadContents& contentsOf);

} // namespace dgtk::import

#endif
