// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxMotion_h
#define dgtkFbxMotion_h

#include "dgtkAssimpStream.h"
#include "dgtkFbxScene.h"

#include <map>
#include <utility>

namespace dgtk::import
{

/// What animations move: the nodes of models, and blend shapes.
struct FbxTargets
{
  std::vector<std::int32_t> nodes; ///< by object; noIndex: it is none
  /// Numbers of blend shapes, by the object and its property that is their percentage.
  std::map<std::pair<std::size_t, std::string>, std::int32_t> blends;
};

/// The animation stacks of a file.
std::vector<Animation> readFbxAnimations(const FbxScene& scene, const FbxTargets& targets);

} // namespace dgtk::import

#endif
