// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStrangeCamera_h
#define dgtkStrangeCamera_h

#include "dgtkCameraModel.h"

#include <string>
#include <utility>

namespace dgtk::test
{

/// A model of a program of its own, which sees nothing.
class StrangeCamera final : public CameraModel
{
public:
  explicit StrangeCamera(const CameraParameters& of, std::string name = "strange")
    : CameraModel(of)
    , Name(std::move(name))
  {
  }
  std::string name() const override { return this->Name; }
  CameraRay rayThrough(const Eigen::Vector2d&) const override { return { { 0, 0, 0 }, { 0, 0, 1 } }; }
  bool project(const Eigen::Vector3d&, Eigen::Vector2d&) const override { return false; }

private:
  std::string Name;
};

} // namespace dgtk::test

#endif
