// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStrangeCamera_h
#define dgtkStrangeCamera_h

#include "dgtkCameraModel.h"

#include <string>

namespace dgtk::test
{

/// A model of a program of its own, which sees nothing.
class StrangeCamera final : public CameraModel
{
public:
  explicit StrangeCamera(const CameraParameters& of)
    : CameraModel(of)
  {
  }
  std::string name() const override { return "strange"; }
  CameraRay rayThrough(const Eigen::Vector2d&) const override { return { { 0, 0, 0 }, { 0, 0, 1 } }; }
  bool project(const Eigen::Vector3d&, Eigen::Vector2d&) const override { return false; }
};

} // namespace dgtk::test

#endif
