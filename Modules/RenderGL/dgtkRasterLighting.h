// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterLighting_h
#define dgtkRasterLighting_h

#include "dgtkEnvironmentMap.h"
#include "dgtkPartMapper.h"
#include "dgtkRasterCamera.h"
#include "dgtkShadowMaps.h"

#include <functional>
#include <memory>
#include <vector>

namespace dgtk
{

/// Lights, their shadows, environment and fog of a scene state, for the draws of a frame. The context must be current.
class RasterLighting
{
public:
  explicit RasterLighting(RasterFrame& frame)
    : Frame(frame)
  {
  }
  ~RasterLighting();
  RasterLighting(const RasterLighting&) = delete;
  RasterLighting& operator=(const RasterLighting&) = delete;

  void setState(std::shared_ptr<const SceneState> state);
  /// What shadow maps are for: its whole image.
  void setView(const View& view);
  /// Makes the environment and the shadow maps where they are not there; `draw` draws depths for a camera to the bound
  /// framebuffer.
  void prepare(bool zeroToOne, const std::function<void(const RasterCamera&, int)>& draw);
  /// Tells the frame what the shaders get for a camera.
  void aim(const RasterCamera& camera);
  /// Binds what they read to its texture units.
  void bind();
  EnvironmentMap& environment() { return this->Environment; }

private:
  void uploadLights();

  RasterFrame& Frame;
  std::shared_ptr<const SceneState> State;
  View Seen;
  EnvironmentMap Environment;
  ShadowMaps Shadows;
  std::vector<int> FirstShadows; // of each light
  bool EnvironmentReady = false;
  bool ShadowsReady = false;
  unsigned int LightBuffer = 0;
  unsigned int LightTexture = 0;
};

} // namespace dgtk

#endif
