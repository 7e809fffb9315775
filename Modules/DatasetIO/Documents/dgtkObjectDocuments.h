// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjectDocuments_h
#define dgtkObjectDocuments_h

#include "dgtkDatasetIOModule.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// The text files of the layers `boxes`, `amodal` and `points`; see Documentation/Formats/objects_truth.md. Every
// `...Text` function is a pure function; every `read...` function throws an InputError that names the file and the
// place.

namespace dgtk
{

/// A named point of an object in a picture.
struct KeypointRecord
{
  std::string name;
  Eigen::Vector3d x{ 0, 0, 0 };         ///< camera frame
  std::optional<Eigen::Vector2d> pixel; ///< "u", "v" in the file; null there for what is behind the camera
  int visibility = 0;                   ///< class as in class images, 0 to 5
};

/// One object in the file of `boxes`.
struct BoxRecord
{
  std::uint32_t id = 0;
  std::string name;
  std::string objectClass;
  std::uint64_t pixelsVisible = 0;
  std::uint64_t pixelsAmodal = 0;
  std::uint64_t pixelsWhole = 0;            ///< with those around the image; 0 in files of older versions
  std::optional<Eigen::Vector4d> visible;   ///< [x0, y0, x1, y1], pixel borders
  std::optional<Eigen::Vector4d> amodal;    ///< likewise
  std::optional<Eigen::Vector4d> whole;     ///< likewise, with pixels around the image
  std::optional<Eigen::Vector4d> projected; ///< pixels
  bool rigid = false;                       ///< whether R and scale are known; null in the file otherwise
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
  Eigen::Matrix<double, 8, 3> corners = Eigen::Matrix<double, 8, 3>::Zero();
  std::vector<KeypointRecord> keypoints; ///< in the file only where there are any
};
DGTKDATASETIO_EXPORT std::string boxesText(const std::string& camera, int frame, const std::vector<BoxRecord>& objects);
DGTKDATASETIO_EXPORT std::vector<BoxRecord> readBoxes(const std::string& path);

/// One object in the file of `amodal`.
struct MaskRecord
{
  std::uint32_t id = 0;
  std::vector<std::uint64_t> counts; ///< run lengths column by column, outside first
};
DGTKDATASETIO_EXPORT std::string amodalText(int width, int height, const std::vector<MaskRecord>& masks);
struct AmodalMasks
{
  int width = 0; ///< pixels
  int height = 0;
  std::vector<MaskRecord> masks; ///< the run lengths of each are as long as the image
};
DGTKDATASETIO_EXPORT AmodalMasks readAmodal(const std::string& path);

/// One point in the files of `points`.
struct PointRecord
{
  struct Sight
  {
    std::uint32_t camera = 0; ///< index into the cameras of the file
    double u = 0;             ///< pixels
    double v = 0;
  };
  Eigen::Vector3d x{ 0, 0, 0 };
  Eigen::Vector3f normal{ 0, 0, 0 };
  std::uint8_t color[3] = { 0, 0, 0 };
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;
  std::vector<Sight> track;
};
DGTKDATASETIO_EXPORT std::string pointsText(
  int frame, const std::vector<std::string>& cameras, const std::vector<PointRecord>& points);
struct TrackedPoints
{
  int frame = 0;
  std::vector<std::string> cameras;
  std::vector<PointRecord> points; ///< without normal and colour; an index of a camera may be any
};
/// Reads the `.json`.
DGTKDATASETIO_EXPORT TrackedPoints readPoints(const std::string& path);
/// Binary little-endian PLY: x y z double, nx ny nz float, red green blue uchar, object triangle uint.
DGTKDATASETIO_EXPORT std::string pointsPly(const std::vector<PointRecord>& points);

} // namespace dgtk

#endif
