// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDrawOrder_h
#define dgtkDrawOrder_h

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dgtk
{

/// A box in view coordinates (x right, y up, z towards the viewer), its faces included.
struct ViewBox
{
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

/// The order in which to draw what lies in the boxes, as indices: the nearest first, because what is hidden is not
/// shaded. Boxes that meet keep the order of their indices, so that of surfaces at the same place the first is seen,
/// as it is in the visibility buffer. Empty boxes (min > max) meet nothing.
std::vector<std::size_t> drawOrder(const std::vector<ViewBox>& boxes);

} // namespace dgtk

#endif
