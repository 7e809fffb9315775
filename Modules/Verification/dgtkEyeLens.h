// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEyeLens_h
#define dgtkEyeLens_h

// Private to Verification.

#include "dgtkDatasetDocuments.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace dgtk
{

/// Projections of the lenses by arithmetic of its own: OpenCV's where it has the model, the papers' otherwise. Whether
/// a point is in the domain of the lens is not asked.
class EyeLens
{
public:
  explicit EyeLens(const CameraRecord& record)
    : Record(record)
  {
  }
  /// Whether the camera's model is known here.
  bool exists() const { return rowOf(this->Record.model) != nullptr; }
  /// "cv::fisheye::projectPoints": as results are called.
  std::string name() const { return rowOf(this->Record.model)->name; }
  /// Pixels of points in the camera frame.
  std::vector<Eigen::Vector2d> project(const std::vector<Eigen::Vector3d>& x_in_camera) const;

  /// Columns between two places of a pixel that are as right as each other: the image's width at the left and the right
  /// border where these are one direction, otherwise 0.
  double seam(const Eigen::Vector2d& pixel) const;

private:
  using Points = std::vector<Eigen::Vector3d>;
  using Pixels = std::vector<Eigen::Vector2d>;
  struct Row
  {
    const char* model;
    const char* name;
    Pixels (*onPlane)(const CameraRecord& record, const Points& points); ///< before K
    bool round;                                                          ///< left and right border are one
  };
  static const Row* rowOf(const std::string& model);

  const CameraRecord& Record;
};

} // namespace dgtk

#endif
