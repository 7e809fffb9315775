// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceColor_h
#define dgtkSurfaceColor_h

#include "dgtkMeter.h"
#include "dgtkVisibility.h"

#include <cstdint>
#include <functional>

namespace dgtk
{

/// Of 8 bits: rounding to the nearest, either way in the middle.
constexpr double colorTolerance = 0.5 + 1e-6;

/// Measures the albedo of a point of a triangle by weights of its corners, in 255ths: the material's diffuse colour
/// times the texel that the point lies in, on a border any of those that meet there. `where`: how the point is called.
void meterColor(const Instance& instance, const Hit& hit, const Eigen::Vector3d& weights, const std::uint8_t* color,
  const std::function<Offender(const std::string& found, const std::string& expected)>& where, Meter& meter);

} // namespace dgtk

#endif
