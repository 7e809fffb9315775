// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAlbedo_h
#define dgtkAlbedo_h

#include "dgtkGroundTruthModule.h"

#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace dgtk
{

/// Colour of a surface point without light: the material's diffuse colour times its texture's nearest texel (as
/// isCutOut() finds it) and the colour of its vertices, sRGB, 8 bits. `barycentrics` of the second and third corner.
/// Thread-safe.
DGTKGROUNDTRUTH_EXPORT std::array<std::uint8_t, 3> albedoAt(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics);

/// The nearest texel (as isCutOut() finds it) of Model::textures[texture] at a surface point, sRGB in [0, 1]; white
/// where there is no such texture, picture or texture coordinate. Thread-safe.
DGTKGROUNDTRUTH_EXPORT Eigen::Vector3d texelAt(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics, int texture);

/// The material of a triangle; null for a model without materials. Thread-safe.
DGTKGROUNDTRUTH_EXPORT const Material* materialOf(const Instance& instance, std::uint32_t triangle);

} // namespace dgtk

#endif
