// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunLengths_h
#define dgtkRunLengths_h

// Private to Export: masks as COCO has them.

#include "dgtkLayer.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Pixels of an object: run lengths column by column from the left, each from top to bottom; outside first.
struct RunLengths
{
  int width = 0; ///< pixels
  int height = 0;
  std::vector<std::uint64_t> counts; ///< they sum to width * height

  std::uint64_t area() const;
  /// [x, y, width, height] of the pixels' borders; zeros without a pixel.
  Eigen::Vector4d box() const;
  /// COCO's compressed text: five bits a character, every count from the fourth on as the difference from the one two
  /// before (cocoapi, maskApi.c).
  std::string compressed() const;
};

/// The masks of all ids but 0 in whole rows of the layer `objects`.
std::map<std::uint32_t, RunLengths> masksOf(const Rows& objects);

/// Closed polygons along the borders of a mask's pixels, in pixels from the image's corner: x, y in turn, clockwise on
/// the screen, corners only. Pixels that touch at a corner alone are apart. None where the mask has a hole.
std::vector<std::vector<double>> polygonsOf(const RunLengths& mask);

/// The same of any mask, holes too, which go round counter-clockwise.
std::vector<std::vector<double>> bordersOf(const RunLengths& mask);
/// All of them as one polygon: from one to the next and back on one line. By the even-odd rule it has the mask's
/// pixels.
std::vector<double> joinedBorder(const RunLengths& mask);

} // namespace dgtk

#endif
