// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayTable_h
#define dgtkRayTable_h

#include "dgtkCameraModel.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Rays through the centres of the pixels of an image; between them directions and origins are interpolated, each from
/// four, and up to the image's border continued. Where one of the four is not there, there is none. They may have
/// times, which are interpolated in the same way.
class RayTable
{
public:
  /// Of a .npy file: float32 or float64, rows x columns x 3 (directions) or x 6 (origins, directions), camera frame, or
  /// one more for the time in frames. Rays with a direction of zero or a number that is not finite are not there.
  /// Throws InputError. Files that were read last are kept.
  static std::shared_ptr<const RayTable> read(const std::string& path);

  int rows() const { return this->Rows; }
  int columns() const { return this->Columns; }
  /// The least and the largest time of a ray, frames after the picture's own.
  TimeSpan times() const { return this->Span; }
  /// At a point of the table, frames after the picture's own; beyond the centres of its outermost pixels as there.
  double time(const Eigen::Vector2d& point) const;

  /// At a point of the table, in pixels. Its direction has length 1, or is zero.
  CameraRay ray(const Eigen::Vector2d& point) const;
  /// Where a point in the camera frame is seen; of several places the first one by blocks of rows. False where it is
  /// not.
  bool find(const Eigen::Vector3d& x_in_camera, Eigen::Vector2d& point) const;

private:
  /// Four rays, at the corners of [0, 1] x [0, 1], and the part of the plane that they are for.
  struct Cell
  {
    CameraRay corners[4];
    Eigen::Vector2d least;
    Eigen::Vector2d most;
    CameraRay at(double a, double b) const;
    bool find(const Eigen::Vector3d& x, Eigen::Vector2d& place) const;
  };
  /// What the rays of some cells keep to: directions to a cone, origins to a ball.
  struct Bounds
  {
    Eigen::Vector3d axis{ 0, 0, 0 };
    double angle = -1; ///< radians; below 0: there are none
    Eigen::Vector3d centre{ 0, 0, 0 };
    double radius = 0;
    bool mayHold(const Eigen::Vector3d& x) const;
    static Bounds of(const std::vector<Bounds>& parts);
  };
  /// Square blocks of cells, each of four of the level below.
  struct Level
  {
    int columns;
    int rows;
    std::vector<Bounds> blocks;
  };

  RayTable(int rows, int columns, std::vector<CameraRay> rays, std::vector<double> times);
  const CameraRay& at(int column, int row) const { return this->Rays[std::size_t(row) * this->Columns + column]; }
  bool isWhole(int column, int row) const;
  Cell cell(int column, int row) const;
  Bounds boundsOfBlock(int column, int row) const;
  void addLevel();
  bool findIn(std::size_t level, int column, int row, const Eigen::Vector3d& x, Eigen::Vector2d& point) const;
  bool findInBlock(int column, int row, const Eigen::Vector3d& x, Eigen::Vector2d& point) const;

  int Rows;
  int Columns;
  std::vector<CameraRay> Rays;
  std::vector<double> Times; ///< frames, one a ray; empty: all 0
  TimeSpan Span;
  std::vector<Level> Levels; ///< the last one has one block
};

} // namespace dgtk

#endif
