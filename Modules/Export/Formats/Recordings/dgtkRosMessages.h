// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRosMessages_h
#define dgtkRosMessages_h

// Private to Export: messages of ROS 1 as they are serialised, which bags and MCAP files have in common.

#include "dgtkRigid3.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk::ros
{

/// A type of messages. The definition has those that it is made of behind it, as ROS joins them; comments count neither
/// for the sum nor for readers, and there are none.
struct Type
{
  const char* name;
  const char* md5;
  std::string definition;
};
const Type& compressedImageType();
const Type& imageType();
const Type& cameraInfoType();
const Type& transformsType();

/// Head of a message: number and time of its frame, and the axes that it is said in.
struct Stamp
{
  std::uint32_t sequence = 0;
  std::uint64_t nanoseconds = 0;
};

/// Seconds and nanoseconds, 4 bytes each.
void putTime(std::string& to, std::uint64_t nanoseconds);
/// Length in 4 bytes, then the text.
void putText(std::string& to, const std::string& text);

/// What stands before the bytes of a compressed picture of `bytes` bytes.
std::string compressedImageHead(
  const Stamp& stamp, const std::string& frame, const std::string& format, std::uint32_t bytes);
/// What stands before the rows of a picture of one float32 a pixel.
std::string floatImageHead(const Stamp& stamp, const std::string& frame, int width, int height);

/// A lens as ROS names it. Centres of pixels are whole numbers.
struct CameraInfo
{
  int width = 0;
  int height = 0;
  std::string model; ///< "plumb_bob", ...
  std::vector<double> D;
  Eigen::Matrix3d K;
  double baseline = 0; ///< metres along x from the pair's left camera
};
std::string cameraInfo(const Stamp& stamp, const std::string& frame, const CameraInfo& info);

/// Where axes are: x_parent = transform x_child, metres.
struct Transform
{
  std::string child;
  Rigid3 parentFromChild;
};
std::string transforms(const Stamp& stamp, const std::string& parent, const std::vector<Transform>& all);

} // namespace dgtk::ros

#endif
