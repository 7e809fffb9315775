// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSparseCorrespondence_h
#define dgtkSparseCorrespondence_h

#include "dgtkPipelineModule.h"

#include "dgtkCorrespondence.h"
#include "dgtkStage.h"

#include <cstddef>
#include <vector>

namespace dgtk
{

/// Two views of a scene.
struct SparseRequest
{
  std::size_t fromCamera = 0; ///< index into the scene's cameras
  int fromFrame = 0;
  std::size_t toCamera = 0;
  int toFrame = 0;
  int width = 0; ///< pixels of both images; 0: the camera's own size
  int height = 0;
};

/// What an image point of the first view sees, and where that is in the second.
struct SparseMatch
{
  Eigen::Vector2d from; ///< pixels
  Correspondence to;
  Hit hit; ///< object 0 where there is no surface
};

/// Correspondences of image points (pixels, inside the first image).
DGTKPIPELINE_EXPORT std::vector<SparseMatch> correspondPoints(
  const Stage& stage, const SparseRequest& request, const std::vector<Eigen::Vector2d>& points);

} // namespace dgtk

#endif
