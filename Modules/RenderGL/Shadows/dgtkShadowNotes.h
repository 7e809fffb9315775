// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadowNotes_h
#define dgtkShadowNotes_h

#include "dgtkRenderGLModule.h"

#include "dgtkSceneState.h"

#include <cstddef>
#include <vector>

namespace dgtk
{

/// A light whose shadows are coarse in an image.
struct CoarseShadow
{
  std::size_t light = 0; ///< of SceneState::lights
  double pixels = 0;     ///< side of a texel of its shadow map in pixels of the image, where it is coarsest
};

/// The lights of which a texel of the shadow map is larger than 8 pixels of the view's image somewhere. Needs no
/// OpenGL. Throws UsageError for a camera that is not linear.
DGTKRENDERGL_EXPORT std::vector<CoarseShadow> coarseShadows(const SceneState& state, const View& view);

} // namespace dgtk

#endif
