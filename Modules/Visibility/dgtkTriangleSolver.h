// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTriangleSolver_h
#define dgtkTriangleSolver_h

#include "dgtkDoubleDouble.h"
#include "dgtkVisibility.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace dgtk
{

// Intersections are computed in double from vertices relative to the camera. A bound of the error decides, for each
// triangle and each pixel by itself, whether that is good enough; if not, the same formula is evaluated in
// double-double. No result depends on neighbouring pixels or on what is cached.

/// How the rays of the pixels are made.
enum class LensKind
{
  Perspective, ///< origin 0, direction (dx, dy, 1)
  Parallel,    ///< origin (dx, dy, 0), direction (0, 0, 1)
  General      ///< CameraModel::rayThrough
};

struct Lens
{
  explicit Lens(const CameraModel& model);
  double directionX(double u, double skewDy) const { return ((u - this->Cx) - skewDy) * this->InverseFx; }
  double directionY(double v) const { return (v - this->Cy) * this->InverseFy; }
  Vector3dd exactDirection(double u, double v) const;

  const CameraModel* Model;
  LensKind Kind = LensKind::General;
  double Fx = 1, Fy = 1, Cx = 0, Cy = 0, Skew = 0;
  double InverseFx = 1, InverseFy = 1;
  double LargestDirection = 1; ///< largest |dx| + |dy| + 1 of a pixel
};

struct Vector3
{
  double x, y, z;
};
inline Vector3 operator-(const Vector3& a, const Vector3& b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }
inline double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(const Vector3& a, const Vector3& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
/// |x| + |y| + |z|
inline double sumNorm(const Vector3& a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }
inline Vector3 rounded(const Vector3dd& a) { return { a.x.hi, a.y.hi, a.z.hi }; }

/// Unit roundoff of double.
constexpr double unitRoundoff = 1.1102230246251565e-16;
/// Largest bound of a relative error that is left to plain double, once for the triangle and once for the pixel.
constexpr double acceptedError = 4e-13;
/// A triangle whose sides at a corner enclose an angle with a sine below this has no area.
constexpr double degenerateSine = 1e-15;

/// A pixel's ray of any lens, in the camera frame.
struct GeneralRay
{
  Vector3 origin;
  Vector3 direction;
};

/// Plane n.x = d of a triangle in the camera frame, and the lines whose values at (dx, dy, 1), divided by n.direction
/// (or n.z), are the barycentric coordinates of the second and third corner.
struct Plane
{
  enum class State
  {
    Plain, ///< computed in double
    Exact, ///< double was too coarse: rounded from double-double
    None   ///< no area, seen from its own plane, or not finite
  };
  Hit hit;
  State state = State::None;
  Vector3 n;
  double d;
  Vector3 second;
  Vector3 third;
};

/// The same in double-double, from the exact values of the vertices and matrices.
struct ExactTriangle
{
  Hit hit;
  bool valid = false;
  Vector3dd corners[3];
  Vector3dd n;
  DoubleDouble d;
  Vector3dd lines[3]; ///< opposite to the corners; for General of corners that are relative to the camera centre
};

/// Where a ray meets a plane; t is +inf when it does not.
struct PlanePoint
{
  double t = std::numeric_limits<double>::infinity();
  double second = std::numeric_limits<double>::quiet_NaN();
  double third = std::numeric_limits<double>::quiet_NaN();
};

/// Vertices of one instance, in the camera frame.
struct InstanceFrame
{
  DoubleDouble exactLinear[3][3];
  DoubleDouble exactTranslation[3];
  double linear[3][3];
  Vector3 centre;    ///< the camera's centre in the object frame: differences to it keep their relative accuracy
  Vector3 remainder; ///< image of `centre`
  double condition;  ///< of `linear`; 1 for rotations and uniform scales, +inf for singular ones
  const Eigen::Vector3d* positions;
  const std::array<std::uint32_t, 3>* triangles;
};

/// Prepares triangles of one state for one view, with small caches. One per thread.
class TriangleSolver
{
public:
  TriangleSolver(const SceneState& state, const View& view);

  const Lens& lens() const { return this->Seen; }
  /// The corners in the camera frame, in double.
  void corners(const Hit& hit, Vector3 out[3]) { this->cornersOf(this->frameOf(hit), hit, out); }
  const Plane& plane(const Hit& hit)
  {
    Plane& entry = this->Planes[slot(hit) % planeCount];
    if (entry.hit != hit)
    {
      this->makePlane(hit, entry);
    }
    return entry;
  }
  const ExactTriangle& exact(const Hit& hit);
  double condition(const Hit& hit) { return this->frameOf(hit).condition; }

  /// Intersection in double-double, rounded.
  PlanePoint exactPoint(const Hit& hit, double u, double v);
  /// Intersection of the ray through an image point with the plane of a triangle, as accurate as it takes.
  PlanePoint point(const Hit& hit, double u, double v, bool barycentrics);
  /// The same of a ray of a camera that is not linear.
  PlanePoint pointOnRay(const Hit& hit, const CameraRay& ray, bool barycentrics);

  static std::size_t slot(const Hit& hit)
  {
    return std::size_t((hit.triangle * 0x9E3779B1u) ^ (hit.object * 0x85EBCA77u)) >> 7;
  }

private:
  GeneralRay generalRay(double u, double v) const;
  static constexpr std::size_t planeCount = 512;
  static constexpr std::size_t exactCount = 32;

  const InstanceFrame& frameOf(const Hit& hit)
  {
    const std::size_t index = std::size_t(hit.object) - 1;
    if (index >= this->FrameCount || hit.triangle >= this->TriangleCounts[index])
    {
      this->makeFrame(hit);
    }
    return this->Frames[index];
  }
  void makeFrame(const Hit& hit);
  static void cornersOf(const InstanceFrame& frame, const Hit& hit, Vector3 out[3]);
  void makePlane(const Hit& hit, Plane& plane);
  PlanePoint generalPoint(const Hit& hit, const GeneralRay& ray, const Plane& plane, bool barycentrics);
  PlanePoint exactGeneralPoint(const ExactTriangle& triangle, const GeneralRay& ray) const;

  const SceneState& State;
  const dgtk::View& TheView;
  Lens Seen;
  std::size_t FrameCount;
  std::unique_ptr<InstanceFrame[]> Frames;
  std::vector<std::uint32_t> TriangleCounts; ///< 0 until the frame is made
  std::vector<Plane> Planes;
  std::vector<ExactTriangle> Exacts;
};

/// Evaluates a prepared plane at a linear lens's pixel. False when double is too coarse for this pixel.
/// `skewX`: |skew dy / fx|, the rounding of a skewed dx.
template <LensKind Kind, bool WithBarycentrics>
inline bool evaluate(const Plane& plane, double dx, double dy, double skewX, PlanePoint& point)
{
  constexpr double guard = 4 * unitRoundoff / acceptedError;
  const double x = plane.n.x * dx;
  const double y = plane.n.y * dy;
  const double size = std::abs(plane.n.x) * (std::abs(dx) + skewX) + std::abs(y);
  double divisor;
  if (Kind == LensKind::Perspective)
  {
    divisor = x + y + plane.n.z;
    if (!(std::abs(divisor) >= guard * (size + std::abs(plane.n.z))))
    {
      return false;
    }
    point.t = plane.d / divisor;
  }
  else
  {
    divisor = plane.n.z;
    const double dividend = plane.d - x - y;
    if (!(std::abs(dividend) >= guard * (size + std::abs(plane.d))))
    {
      return false;
    }
    point.t = dividend / divisor;
  }
  if (!(point.t > 0))
  {
    point = {};
    return true;
  }
  if (WithBarycentrics)
  {
    const double inverse = 1 / divisor;
    point.second = (plane.second.x * dx + plane.second.y * dy + plane.second.z) * inverse;
    point.third = (plane.third.x * dx + plane.third.y * dy + plane.third.z) * inverse;
  }
  return true;
}

} // namespace dgtk

#endif
