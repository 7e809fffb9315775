// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUprightBox_h
#define dgtkUprightBox_h

#include "dgtkObjectDocuments.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dgtk
{

/// A 3D box that is turned about the camera's y alone, as KITTI has them.
struct UprightBox
{
  double length = 0; ///< along the object's front axis; scene units
  double height = 0; ///< along the axis of the object that is nearest to the camera's y
  double width = 0;
  Eigen::Vector3d bottom{ 0, 0, 0 }; ///< centre of the bottom face, camera axes
  double yaw = 0;                    ///< about y: 0 looks along x, -pi / 2 along z
  double tilt = 0; ///< radians between the object's own box and this one, which has its size and centre
};

/// The box of an object whose front is one of its own axes: "x", "-x", "y", ... Nothing for sheared objects, and for
/// those that are flat in two directions.
std::optional<UprightBox> uprightBox(const BoxRecord& box, const std::string& front);

} // namespace dgtk

#endif
