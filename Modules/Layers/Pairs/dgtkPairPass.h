// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPairPass_h
#define dgtkPairPass_h

#include "dgtkLayers.h"
#include "dgtkPairValues.h"

#include <vector>

namespace dgtk
{

/// Another view and what is derived with it.
struct PairTarget
{
  std::size_t camera = 0; ///< the other camera: index into the scene's cameras
  int frame = 0;          ///< the other frame
  PairValue value = PairValue::Position;
  bool isMoved = false; ///< relates the other camera with the picture's own at the other frame, not with its pixels
  LayerSpec spec;       ///< of the values
  std::string folder;   ///< of the files, below the camera's: "correspondence_right"
};

/// One pass for targets of several layers. A target has an output for its values and, unless they are motion, the next
/// one for its classes.
std::unique_ptr<LayerPass> makePairPass(const JobContext& context, const std::vector<PairTarget>& targets);

} // namespace dgtk

#endif
