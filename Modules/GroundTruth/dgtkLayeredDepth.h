// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayeredDepth_h
#define dgtkLayeredDepth_h

#include "dgtkGroundTruthModule.h"

#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dgtk
{

/// One surface of a layered depth pixel.
struct LayeredSurface
{
  std::array<float, 4> rgba{}; ///< display-referred colour of this surface alone and its opacity, in [0, 1]
  double depth = 0;            ///< z in the camera frame, scene units; of a lens the distance along the ray
  std::uint32_t splatIndex = 0;
  Hit hit;
};

/// What layered depth rows are made of.
struct LayeredInput
{
  PixelRect rect;             ///< full-width rows, or a part of one row
  const Hit* first = nullptr; ///< the visibility buffer: what every other layer takes for the first surface
  const float* rgb = nullptr; ///< the picture, 3 per pixel, where it has one sample a pixel; else null
  // What was peeled, in any order: of pixel i, rows top to bottom, the surfaces begins[i] up to begins[i + 1], counted
  // from begins[0].
  const std::uint32_t* begins = nullptr;
  const Hit* hits = nullptr;
  const float* rgba = nullptr; ///< 4 a surface
};

/// Layered depth pixels of the input's rectangle.
struct LayeredRows
{
  std::vector<std::uint32_t> counts; ///< surfaces of each pixel, rows top to bottom
  std::vector<LayeredSurface> surfaces;
};

/// Puts the peeled surfaces of each pixel in order. Depth is the exact intersection of the ray through the pixel's
/// centre with the triangle's plane, within near and far; ties are in the order of (object, triangle).
///
/// The first surface is the one of `first`, with the picture's colour where it is opaque; nothing there, no surface at
/// all. Drawing tells depths apart to about 1e-6 of their value: a surface nearer than the first by no more than a
/// relative 2e-6 coincides with it and gets its depth; one that is nearer still (at pixels on an edge) is left out, as
/// is a triangle whose plane gives a depth outside the triangle's own range. Thread-safe.
DGTKGROUNDTRUTH_EXPORT void layeredDepthRows(
  const SceneState& state, const View& view, const LayeredInput& in, LayeredRows& out);

/// The splat index of Shade, Gortler, He and Szeliski (Layered Depth Images, SIGGRAPH 1998), 11 bits `dddddxxxyyy`:
/// d = floor(32 log(distance / near) / log(far / near)), 0..31, of the distance from the camera's centre;
/// x, y = floor(4 (n + 1)), 0..7, of the unit normal towards the camera in the camera frame (x right, y down).
DGTKGROUNDTRUTH_EXPORT std::uint32_t splatIndex(
  double distance, const Eigen::Vector3d& normal, double near, double far);

/// The middle of the distances that share a splat index (geometric mean of the ends).
DGTKGROUNDTRUTH_EXPORT double splatDistance(std::uint32_t splatIndex, double near, double far);

/// The unit normal in the middle of those that share a splat index, z <= 0 (towards the camera).
DGTKGROUNDTRUTH_EXPORT Eigen::Vector3d splatNormal(std::uint32_t splatIndex);

} // namespace dgtk

#endif
