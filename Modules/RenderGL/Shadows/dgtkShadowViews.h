// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadowViews_h
#define dgtkShadowViews_h

#include "dgtkRasterCamera.h"
#include "dgtkSceneState.h"

#include <vector>

namespace dgtk
{

/// How a shadow map is drawn.
struct ShadowView
{
  RasterCamera camera;
  int size = 0;      ///< pixels a side
  double texel = 0;  ///< side of a texel in scene units, for a perspective at distance 1 along the axis
  bool cube = false; ///< one of six around a point: +x, -x, +y, -y, +z, -z of the world
  int nested = 1;    ///< a surface that is not in this map may be in one of so many from it on, itself included
  double pixels = 0; ///< side of a texel in pixels of the image, where it is coarsest
};

/// The maps of the lights that cast shadows, in the order of the lights, and the first map of each light (-1: none).
/// They hold what the camera's whole image sees, and all that may stand between it and the light: they depend on scene
/// and camera, never on what part of the image is drawn. Spots of up to 120 degrees have one map, others and points
/// six, directional lights up to four for surfaces nearer to the camera and farther off. Head lights have none.
std::vector<ShadowView> shadowViews(
  const SceneState& state, const View& view, bool zeroToOne, std::vector<int>& firstOfLight);

} // namespace dgtk

#endif
