// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLinearCamera.h"

namespace dgtk
{

LinearCamera::LinearCamera(int width, int height, const Eigen::Matrix3d& K, bool perspective)
  : CameraModel(CameraParameters{ width, height, K })
  , Plane(K)
  , Perspective(perspective)
{
  checkCameraSize(width, height);
}

} // namespace dgtk
