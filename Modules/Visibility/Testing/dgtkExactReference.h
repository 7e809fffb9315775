// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExactReference_h
#define dgtkExactReference_h

#include "dgtkSyntheticScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dgtk::test
{

// Intersections in 113-bit arithmetic, straight from the definition: the vertices go to the world, then to the camera;
// the ray goes through K; one linear system of Moeller and Trumbore.

__extension__ typedef __float128 Quad;
using QuadPoint = std::array<Quad, 3>;

struct ReferencePoint
{
  Quad t;
  Quad second;
  Quad third;
};

inline QuadPoint transformQuad(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, const QuadPoint& x)
{
  QuadPoint out;
  for (int i = 0; i < 3; ++i)
  {
    out[i] = translation[i];
    for (int j = 0; j < 3; ++j)
    {
      out[i] += Quad(linear(i, j)) * x[j];
    }
  }
  return out;
}

inline ReferencePoint referencePoint(
  const SceneState& state, const View& view, const Hit& hit, double pixelX, double pixelY)
{
  const Instance& instance = state.instances[hit.object - 1];
  QuadPoint v[3];
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& p = instance.geometry->positions[instance.model->triangles[hit.triangle][i]];
    v[i] = transformQuad(view.camera_from_world.rotation, view.camera_from_world.translation,
      transformQuad(
        instance.world_from_object.linear, instance.world_from_object.translation, { p.x(), p.y(), p.z() }));
  }
  const LinearProjection projection = *view.model->linear();
  const Eigen::Matrix3d& K = projection.K;
  const Quad y = (Quad(pixelY) - K(1, 2)) / K(1, 1);
  const Quad x = (Quad(pixelX) - K(0, 2) - Quad(K(0, 1)) * y) / K(0, 0);
  const QuadPoint origin = projection.perspective ? QuadPoint{ 0, 0, 0 } : QuadPoint{ x, y, 0 };
  const QuadPoint direction = projection.perspective ? QuadPoint{ x, y, 1 } : QuadPoint{ 0, 0, 1 };
  const auto minus = [](const QuadPoint& a, const QuadPoint& b) {
    return QuadPoint{ a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  const auto cross = [](const QuadPoint& a, const QuadPoint& b) {
    return QuadPoint{ a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
  };
  const auto dot = [](const QuadPoint& a, const QuadPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const QuadPoint e1 = minus(v[1], v[0]);
  const QuadPoint e2 = minus(v[2], v[0]);
  const QuadPoint s = minus(origin, v[0]);
  const QuadPoint p = cross(direction, e2);
  const QuadPoint q = cross(s, e1);
  const Quad determinant = dot(e1, p);
  return { dot(e2, q) / determinant, dot(s, p) / determinant, dot(direction, q) / determinant };
}

/// Largest relative error of t of a strip, and largest error of a barycentric coordinate, over the pixels that hit
/// something.
struct ReferenceErrors
{
  double t = 0;
  double barycentrics = 0;
  int pixels = 0;
};

inline ReferenceErrors errorsOf(const SurfaceRows& rows)
{
  ReferenceErrors errors;
  for (int i = 0; i < rows.rect.width * rows.rect.height; ++i)
  {
    if (rows.hits[i].object == 0)
    {
      continue;
    }
    ++errors.pixels;
    const ReferencePoint exact = referencePoint(*rows.state, *rows.view, rows.hits[i],
      rows.rect.x + i % rows.rect.width + 0.5, rows.rect.y + i / rows.rect.width + 0.5);
    if (exact.t <= 0) // behind the camera: nothing
    {
      errors.t = rows.t[i] == std::numeric_limits<double>::infinity() ? errors.t : 1e300;
      continue;
    }
    const double error = double((Quad(rows.t[i]) - exact.t) / exact.t);
    errors.t = std::max(errors.t, error == error ? std::abs(error) : 1e300);
    if (!rows.barycentrics.empty())
    {
      const double second = std::abs(double(Quad(rows.barycentrics[2 * i]) - exact.second));
      const double third = std::abs(double(Quad(rows.barycentrics[2 * i + 1]) - exact.third));
      errors.barycentrics =
        std::max({ errors.barycentrics, second == second ? second : 1e300, third == third ? third : 1e300 });
    }
  }
  return errors;
}

} // namespace dgtk::test

#endif
