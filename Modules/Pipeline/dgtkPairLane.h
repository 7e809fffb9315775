// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPairLane_h
#define dgtkPairLane_h

#include "dgtkFrameLayers.h"

#include <vector>

namespace dgtk
{

/// What is written of the correspondence with another view.
enum class PairValue
{
  Position,     ///< (x', y')
  Displacement, ///< (x', y') - (x, y)
  FromLeft,     ///< x - x': disparity of the left camera of a pair
  FromRight,    ///< x' - x: of the right one
  Motion        ///< of the surface point in the axes of the camera, scene units; no class image
};

/// Another view and the files of what is derived with it.
struct PairTarget
{
  std::size_t camera = 0; ///< the other camera: index into the scene's cameras
  int frame = 0;          ///< the other frame
  PairValue value = PairValue::Position;
  LayerSpec spec;     ///< of the values
  std::string folder; ///< of the files, below the camera's: "correspondence_right"
  std::vector<std::string> formats;
};

/// Specification of the class image of a layer.
LayerSpec classSpec(const std::string& layer);

/// Files that a target has for a job: one a format, then the class image where there is one.
std::vector<std::string> pairFiles(const PairTarget& target, const std::string& camera, int frame);

std::unique_ptr<OutputLane> makePairLane(const JobContext& context, const std::vector<PairTarget>& targets);

} // namespace dgtk

#endif
