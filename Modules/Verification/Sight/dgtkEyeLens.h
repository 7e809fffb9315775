// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEyeLens_h
#define dgtkEyeLens_h

#include "dgtkDatasetDocuments.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Projections of the lenses by arithmetic of its own: OpenCV's where it has the model, the papers' otherwise. Whether
/// a point is in the domain of the lens is not asked.
class EyeLens
{
public:
  /// Null for a model that is not known here, and for parameters that no camera of the model has.
  static std::shared_ptr<const EyeLens> of(const CameraRecord& record);
  /// "cv::fisheye::projectPoints": as results are called.
  std::string name() const { return this->Model.name; }
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
  EyeLens(const CameraRecord& record, const Row& row)
    : Record(record)
    , Model(row)
  {
  }

  CameraRecord Record;
  const Row& Model;
};

} // namespace dgtk

#endif
