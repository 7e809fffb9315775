// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDistributions_h
#define dgtkDistributions_h

#include "dgtkSamplingModule.h"

#include "dgtkJson.h"
#include "dgtkSceneDescription.h"
#include "dgtkValueUniforms.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace dgtk
{

/// A point that geometry decides: it stands in a tree of drawn values until the object is where it belongs.
struct GeometryPoint
{
  bool onSurface = false; ///< of the object; otherwise relative to its centre
  std::string object;     ///< name, or of a centre a pattern
  /// Distance from the centre; of a surface: the three uniforms of SampleGeometry::onSurface().
  Eigen::Vector3d numbers{ 0, 0, 0 };
  double above = 0; ///< of a surface: along its normal
};
JsonNode nodeOf(const GeometryPoint& point, int line);
/// Whether a node is one.
bool isGeometryPoint(const JsonNode& node);
GeometryPoint geometryPointOf(const JsonNode& node);

/// The value that uniforms stand for: `at` is the object with the word, whose values are numbers and names alone.
/// Everything but choice and permutation. Throws InputError, with the value's place.
DGTKSAMPLING_EXPORT JsonNode drawnValue(
  const std::string& word, const JsonCursor& at, const ValueUniforms& uniform, UpAxis up);

/// The index that a uniform chooses; each is as likely as its weight, all alike without weights. Some weight is above
/// 0.
std::size_t chosen(double uniform, std::size_t count, const std::vector<double>& weights);
/// 0 to count - 1, in one of all orders, by `count - 1` uniforms.
std::vector<std::size_t> shuffled(std::size_t count, const ValueUniforms& uniform);

} // namespace dgtk

#endif
