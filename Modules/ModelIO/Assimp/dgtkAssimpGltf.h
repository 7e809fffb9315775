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

/// The bytes of a glTF file without what harms Assimp 5.2 and repairGltf() reads; "" where there is nothing such. It
/// crashes on a skin without matrices, mixes up joints of several types, gives all nodes of a mesh the skin of the last
/// one, and reads beyond sparse accessors whose rows have gaps. Throws std::runtime_error where those may be in what
/// cannot be parsed.
std::string withoutHarm(const std::string& path, const ReadContents& contentsOf);
/// As withoutHarm(), as Assimp 5.2 takes them: it wants a scene, the sets of an attribute in the order of their
/// numbers, extras to be objects, and something to draw in every primitive. "" where they are no glTF.
std::string inOrder(const std::string& path, const ReadContents& contentsOf);

/// Reads places of nodes again from a glTF file, in double precision, and animations, where Assimp 5.2 loses something:
/// steps and splines between keys become lines, weights below 0 become 0, and nodes of equal names are confused; and
/// what repairMeshes() and repairUses() say. What cannot be read is left as Assimp has it, with a warning, but what
/// would be other triangles: that is Scene::error.
void repairGltf(const std::string& path, const ReadContents& contentsOf, Scene& scene);

/// Why Assimp may refuse a glTF file, in words, or "": what it says itself is seldom the reason.
std::string gltfProblem(const std::string& path, const ReadContents& contentsOf);

} // namespace dgtk::import

#endif
