// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRosMessages.h"

#include "dgtkDatasetView.h"
#include "dgtkLayerFile.h"

namespace dgtk::ros
{

namespace
{
/// A type that is a part of another, behind it.
std::string part(const std::string& name, const std::string& fields)
{
  return std::string(80, '=') + "\nMSG: " + name + '\n' + fields;
}

std::string headerPart() { return part("std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n"); }
} // namespace

const Type& compressedImageType()
{
  static const Type type{ "sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f",
    "Header header\nstring format\nuint8[] data\n" + headerPart() };
  return type;
}

const Type& imageType()
{
  static const Type type{ "sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743",
    "Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n" +
      headerPart() };
  return type;
}

const Type& cameraInfoType()
{
  static const Type type{ "sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214",
    "Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] D\nfloat64[9] K\nfloat64[9] R\n"
    "float64[12] P\nuint32 binning_x\nuint32 binning_y\nRegionOfInterest roi\n" +
      headerPart() +
      part("sensor_msgs/RegionOfInterest",
        "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n") };
  return type;
}

const Type& transformsType()
{
  static const Type type{ "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec",
    "geometry_msgs/TransformStamped[] transforms\n" +
      part("geometry_msgs/TransformStamped", "Header header\nstring child_frame_id\nTransform transform\n") +
      headerPart() + part("geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n") +
      part("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n") +
      part("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n") };
  return type;
}

namespace
{
void putNumber(std::string& to, int number) { putLittle(to, static_cast<std::uint32_t>(number)); }

void putHeader(std::string& to, const Stamp& stamp, const std::string& frame)
{
  putLittle(to, stamp.sequence);
  putTime(to, stamp.nanoseconds);
  putText(to, frame);
}
} // namespace

void putTime(std::string& to, std::uint64_t nanoseconds)
{
  constexpr std::uint64_t second = 1000000000;
  putLittle(to, static_cast<std::uint32_t>(nanoseconds / second));
  putLittle(to, static_cast<std::uint32_t>(nanoseconds % second));
}

void putText(std::string& to, const std::string& text)
{
  putLittle(to, static_cast<std::uint32_t>(text.size()));
  to += text;
}

std::string compressedImageHead(
  const Stamp& stamp, const std::string& frame, const std::string& format, std::uint32_t bytes)
{
  std::string head;
  putHeader(head, stamp, frame);
  putText(head, format);
  putLittle(head, bytes);
  return head;
}

std::string floatImageHead(const Stamp& stamp, const std::string& frame, int width, int height)
{
  constexpr int bytes = 4;
  std::string head;
  putHeader(head, stamp, frame);
  putNumber(head, height);
  putNumber(head, width);
  putText(head, "32FC1");
  head += '\0'; // little-endian
  putNumber(head, width * bytes);
  putLittle(head, static_cast<std::uint32_t>(std::uint64_t(width) * height * bytes));
  return head;
}

std::string cameraInfo(const Stamp& stamp, const std::string& frame, const CameraInfo& info)
{
  std::string text;
  putHeader(text, stamp, frame);
  putNumber(text, info.height);
  putNumber(text, info.width);
  putText(text, info.model);
  putLittle(text, static_cast<std::uint32_t>(info.D.size()));
  for (const double k : info.D)
  {
    putLittle(text, k);
  }
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();
  P.leftCols<3>() = info.K;
  P(0, 3) = info.baseline == 0 ? 0 : -info.K(0, 0) * info.baseline;
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 9; ++i)
  {
    putLittle(text, info.K(i / 3, i % 3));
  }
  for (int i = 0; i < 9; ++i)
  {
    putLittle(text, R(i / 3, i % 3));
  }
  for (int i = 0; i < 12; ++i)
  {
    putLittle(text, P(i / 4, i % 4));
  }
  constexpr std::size_t rest = 2 * 4 + 4 * 4 + 1; // no binning, no region
  return text + std::string(rest, '\0');
}

std::string transforms(const Stamp& stamp, const std::string& parent, const std::vector<Transform>& all)
{
  std::string text;
  putLittle(text, static_cast<std::uint32_t>(all.size()));
  for (const Transform& one : all)
  {
    putHeader(text, stamp, parent);
    putText(text, one.child);
    const Eigen::Vector3d& t = one.parentFromChild.translation;
    const Eigen::Vector4d q = quaternionOf(one.parentFromChild.rotation);
    for (const double number : { t[0], t[1], t[2], q[1], q[2], q[3], q[0] })
    {
      putLittle(text, number);
    }
  }
  return text;
}

} // namespace dgtk::ros
