// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjectTruth_h
#define dgtkObjectTruth_h

#include "dgtkGroundTruthModule.h"

#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace dgtk
{

/// Pixels [x0, x1) of row y.
struct PixelRun
{
  int y = 0;
  int x0 = 0;
  int x1 = 0;
};

/// Pixels of an object: their number, their bounding box in pixel borders and, when kept, the pixels themselves.
struct ObjectPixels
{
  std::uint64_t count = 0;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0; ///< x1 = last column + 1; meaningless when count is 0
  std::vector<PixelRun> runs;         ///< rows top to bottom, left to right, longest possible

  /// Pixels come row by row from the top, left to right.
  void add(int x, int y, bool keepRuns)
  {
    this->x0 = this->count == 0 ? x : std::min(this->x0, x);
    this->y0 = this->count == 0 ? y : this->y0;
    this->x1 = this->count == 0 ? x + 1 : std::max(this->x1, x + 1);
    this->y1 = y + 1;
    ++this->count;
    if (keepRuns && !this->runs.empty() && this->runs.back().y == y && this->runs.back().x1 == x)
    {
      ++this->runs.back().x1;
    }
    else if (keepRuns)
    {
      this->runs.push_back({ y, x, x + 1 });
    }
  }
  /// Appends pixels of rows below these.
  DGTKGROUNDTRUTH_EXPORT void append(const ObjectPixels& below);
  /// Adds other pixels from anywhere, without their runs.
  DGTKGROUNDTRUTH_EXPORT void unite(const ObjectPixels& others);
};

/// COCO's uncompressed run lengths of a mask, column by column: outside first, then inside, in turn; they sum to
/// width * height. `runs` as in ObjectPixels.
DGTKGROUNDTRUTH_EXPORT std::vector<std::uint64_t> columnRunLengths(
  const std::vector<PixelRun>& runs, int width, int height);

/// What a linear map makes of an object's axes: rotation diag(scale), where they stay perpendicular.
struct PlacedAxes
{
  bool rigid = false;       ///< known; not of sheared objects and those without extent
  Eigen::Matrix3d rotation; ///< proper
  Eigen::Vector3d scale;    ///< x negative for a mirroring
};
DGTKGROUNDTRUTH_EXPORT PlacedAxes placedAxes(const Eigen::Matrix3d& linear);

/// Where an object is in a camera's frame.
struct ObjectPose
{
  Eigen::Matrix<double, 3, 4> matrix; ///< x_camera = matrix (x_object, 1)
  /// x_camera = rotation diag(scale) x_object + translation; rotation is proper, scale.x negative for a mirroring. Not
  /// known for sheared objects and those without extent.
  bool rigid = false;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  Eigen::Vector3d scale;
  /// Corners in the camera frame of the object's box: axis-aligned in its own frame, of the vertices of its triangles.
  /// Bits of the index: 1 x max, 2 y max, 4 z max.
  Eigen::Matrix<double, 8, 3> corners;
  /// [x0, y0, x1, y1] in pixels of the projections of the triangles' vertices in front of the camera, not clipped to
  /// the image; nothing when there is none.
  std::optional<Eigen::Vector4d> projected;
};
/// `state`: of the picture's own time, as all but `projected` are.
DGTKGROUNDTRUTH_EXPORT ObjectPose objectPose(const SceneState& state, std::uint32_t id, const View& view);

/// Which objects may be met by the rays of square blocks of pixels: conservative, from the projected triangles.
class DGTKGROUNDTRUTH_EXPORT BlockObjects
{
public:
  BlockObjects(const SceneState& state, const View& view);
  /// False when the ray of a pixel whose first surface is of `object` can meet no other one.
  bool mayHideOthers(int x, int y, std::uint32_t object) const
  {
    return this->Blocks[std::size_t(y >> shift) * this->Columns + (x >> shift)] != object;
  }
  /// The smallest part of a rectangle of the image outside which rays meet nothing; without height for none.
  PixelRect occupied(const PixelRect& rect) const;

private:
  static constexpr int shift = 3;
  static constexpr std::uint32_t several = 0xffffffff;
  void mark(std::uint32_t object, double x0, double y0, double x1, double y1);
  void markObject(std::uint32_t object, const Instance& instance, const View& view);
  void markCut(std::uint32_t object, const Eigen::Vector3d corners[3], const View& view);
  int Columns;
  int RowCount;
  std::vector<std::uint32_t> Blocks; ///< 0, an id, or Several
};

/// The objects of every pixel of rows, hidden or not, between near and far.
struct ObjectRows
{
  std::vector<ObjectPixels> visible; ///< by object id - 1; without runs
  std::vector<ObjectPixels> amodal;
};

/// `hits` of the pixels of `rect`. A pixel's visible object is always among its amodal ones. Thread-safe.
DGTKGROUNDTRUTH_EXPORT void collectObjects(const SceneState& state, const View& view, const OcclusionQuery& occlusion,
  const BlockObjects& blocks, const PixelRect& rect, const Hit* hits, bool amodalRuns, ObjectRows& rows);

} // namespace dgtk

#endif
