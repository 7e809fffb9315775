// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleWorld_h
#define dgtkSampleWorld_h

#include "dgtkSampleModels.h"
#include "dgtkStage.h"
#include "dgtkSurfaceDistance.h"
#include "dgtkVisibility.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// The objects of one sample, where they are at last, for its cameras. What is made is made when it is asked for. One
/// thread.
class SampleWorld
{
public:
  /// Objects alone; `models` outlives this.
  SampleWorld(SceneDescription scene, SampleModels& models);

  const SceneDescription& scene() const { return this->Scene; }
  /// The scene at a frame, and what is known of it; the same where nothing moves.
  std::shared_ptr<const SceneState> stateAt(int frame);
  const SurfaceDistance& surfacesAt(int frame);
  const OcclusionQuery& queryAt(int frame);

private:
  struct Moment
  {
    std::shared_ptr<const SceneState> state;
    std::unique_ptr<SurfaceDistance> surfaces;
    std::unique_ptr<OcclusionQuery> query;
  };
  Moment& momentAt(int frame);

  SceneDescription Scene;
  SampleModels& Models;
  std::shared_ptr<const Stage> TheStage;
  bool Moves = false;
  std::map<int, Moment> Moments;
};

} // namespace dgtk

#endif
