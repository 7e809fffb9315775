// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOutputLanes_h
#define dgtkOutputLanes_h

#include "dgtkFrameOutput.h"

namespace dgtk
{

/// All representations: they share the surface of each pixel.
std::unique_ptr<OutputLane> makeGeometryLane(const WorkPlan& plan, const Job& job, const std::string& camera,
  std::shared_ptr<const SceneState> state, const View& view, ThreadPool& pool);

/// The colour picture in one format.
std::unique_ptr<OutputLane> makeColorLane(
  const WorkPlan& plan, const Job& job, const std::string& camera, const View& view, const std::string& format);

/// A picture held by a band, in one format, under a path relative to the dataset.
std::unique_ptr<OutputLane> makePictureLane(const WorkPlan& plan, const LayerSpec& spec, const std::string& name,
  const View& view, const std::string& format, std::vector<float> Band::*rgb);

/// IEC 61966-2-1, values in [0, 1].
float linearFromEncoded(float v);
float encodedFromLinear(float v);

/// The thesis's tile images.
std::unique_ptr<OutputLane> makeTilesLane(
  const WorkPlan& plan, const Job& job, const std::string& camera, const View& view);

/// Colours of rows [y, y + height) of a band as a layer of the type of `spec`: 8 and 16 bits are rounded, float32 is
/// linear light (IEC 61966-2-1).
Rows quantise(const Band& band, const LayerSpec& spec, int y, int height, std::vector<float> Band::*rgb = &Band::rgb);

} // namespace dgtk

#endif
