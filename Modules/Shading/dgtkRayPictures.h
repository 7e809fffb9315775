// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayPictures_h
#define dgtkRayPictures_h

#include "dgtkShadingModule.h"

#include "dgtkPictureSource.h"

#include <memory>

namespace dgtk
{

class ThreadPool;

/// Colours of hits that are known. Immutable and thread-safe.
class DGTKSHADING_EXPORT HitShader
{
public:
  virtual ~HitShader() = default;
  /// Fills RGB of the pixels of `hits`, three values each: what makeRayPictures() makes of them with one sample a
  /// pixel. `pool` shares the work.
  virtual void shade(const VisibilityBuffer& hits, ThreadPool& pool, float* rgb) const = 0;
};

/// Of a scene and a view of it. While there is one, others share its textures.
DGTKSHADING_EXPORT std::shared_ptr<const HitShader> makeHitShader(
  const std::shared_ptr<const SceneState>& state, const View& view);

/// Pictures whose colours are shaded where the rays of the engine "ray" hit, for every camera: the hits are that
/// engine's, to the bit. Materials, lights, environment and fog are those of the raster engine, by the same equations;
/// shadows are rays; nothing is cut off at white. `pool` shares the work and must outlive the source; what drawColor()
/// leaves to be done may be done when the source has another scene, or is gone.
/// Throws MachineError when Embree cannot work (no memory).
DGTKSHADING_EXPORT std::unique_ptr<PictureSource> makeRayPictures(ThreadPool& pool);

} // namespace dgtk

#endif
