// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadowMaps_h
#define dgtkShadowMaps_h

#include "dgtkShadowViews.h"

#include <functional>
#include <vector>

namespace dgtk
{

/// Shadow maps as layers of a texture. The context must be current.
class ShadowMaps
{
public:
  /// Of the buffer texture: texels of four floats for each map. Four columns of window depth and clip coordinates from
  /// view coordinates; then size of a texel, pixels a side, 1 for the first of a cube, number of
  /// maps from this one on that may hold a surface.
  static constexpr int stride = 5;

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
