// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPairPass_h
#define dgtkPairPass_h

#include "dgtkLayers.h"

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

/// Another view and what is derived with it.
struct PairTarget
{
  std::size_t camera = 0; ///< the other camera: index into the scene's cameras
  int frame = 0;          ///< the other frame
  PairValue value = PairValue::Position;
  LayerSpec spec;     ///< of the values
  std::string folder; ///< of the files, below the camera's: "correspondence_right"
};

/// One pass for targets of several layers. A target has an output for its values and, unless they are motion, the next
/// one for its classes.
std::unique_ptr<LayerPass> makePairPass(const JobContext& context, const std::vector<PairTarget>& targets);

} // namespace dgtk

#endif
