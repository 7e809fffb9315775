// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadowMaps_h
#define dgtkShadowMaps_h

// Private to RenderGL.

#include "dgtkRasterCamera.h"
#include "dgtkSceneState.h"

#include <array>
#include <functional>
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
};

/// A ball that holds all that is drawn; radius 0 when there is nothing.
struct BoundingBall
{
  Eigen::Vector3d centre{ 0, 0, 0 };
  double radius = 0;
};

/// The maps of the lights that cast shadows, in the order of the lights, and the first map of each light (-1: none).
/// Every map sees all of the ball that its light can reach: it depends on the scene, never on the camera. Directional
/// lights have one map, spots of up to 120 degrees one, others six. Head lights have none.
std::vector<ShadowView> shadowViews(
  const std::vector<LightState>& lights, const BoundingBall& ball, bool zeroToOne, std::vector<int>& firstOfLight);

/// Shadow maps as layers of a texture. The context must be current.
class ShadowMaps
{
public:
  /// Of the buffer texture: texels of four floats for each map. Four columns of window depth and clip coordinates from
  /// view coordinates; then size of a texel, pixels a side, 1 for the first of a cube.
  static constexpr int Stride = 5;

  ~ShadowMaps();
  /// Draws all maps by `draw`, which draws depths for a camera to the bound framebuffer. Throws MachineError when
  /// OpenGL cannot hold them.
  void update(std::vector<ShadowView> views, bool zeroToOne, const std::function<void(const RasterCamera&, int)>& draw);
  /// Hands the shaders the matrices for a camera, whose lights are in view coordinates.
  void aim(const Eigen::Matrix4d& view_from_world);
  bool empty() const { return this->Views.empty(); }
  /// Binds maps and data to texture units.
  void bind(int mapsUnit, int dataUnit) const;

private:
  void allocate(int size, int layers);
  std::vector<ShadowView> Views;
  bool ZeroToOne = true;
  int Size = 0;
  int Layers = 0;
  unsigned int Framebuffer = 0;
  unsigned int Maps = 0;
  unsigned int Buffer = 0;
  unsigned int Data = 0;
};

} // namespace dgtk

#endif
