// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPieces_h
#define dgtkPieces_h

#include "dgtkModel.h"
#include "dgtkRasterCamera.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace dgtk
{

/// Triangles that single precision cannot draw where they belong, cut in double precision into pieces that it can.
/// OpenGL interpolates depth with an error relative to the largest value on the triangle: a ground that begins under
/// the camera and reaches to the horizon would be wrong by percents there; and corners far away, on a triangle that
/// passes close by, turn rounding errors into pixels. Cut at depths that double, no piece has either.
struct Pieces
{
  // Three vertices per piece: OpenGL view coordinates, the model's normals, texture coordinates and colours (none
  // without).
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> uvs;
  std::vector<std::uint8_t> colors;
  std::vector<float> triangles; ///< per vertex: number of the triangle in its range
  /// The triangles of the range that were not cut: first (relative to the range) and count.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others;

  bool empty() const { return this->triangles.empty(); }
};

/// A range of a model's triangles as a camera sees it.
struct PieceRange
{
  const Model* model = nullptr;
  const Geometry* geometry = nullptr;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Eigen::Matrix4d view_from_object;
  double extent = 0; ///< largest coordinate that single precision has to deal with, view frame
  /// Smallest and largest depth of the range, or of a box around it.
  double least = 0;
  double largest = 0;
};

/// Whether the range may have triangles to cut.
bool mayNeedPieces(const PieceRange& range, const RasterCamera& camera);
/// Cuts what needs it and may be seen; leaves `pieces` empty when nothing does.
void makePieces(const PieceRange& range, const RasterCamera& camera, Pieces& pieces);

} // namespace dgtk

#endif
