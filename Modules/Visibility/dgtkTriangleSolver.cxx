// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTriangleSolver.h"

#include "dgtkError.h"

#include <algorithm>

namespace dgtk
{

namespace
{

/// det and adjugate of a 3x3 matrix; the inverse is adjugate / det.
double adjugate(const double m[3][3], double out[3][3])
{
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      out[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
    }
  }
  return m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
}

double frobenius(const double m[3][3])
{
  double sum = 0;
  for (int i = 0; i < 9; ++i)
  {
    sum += m[i / 3][i % 3] * m[i / 3][i % 3];
  }
  return std::sqrt(sum);
}

/// Sets `linear`, `centre` and `condition` from the exact matrix.
void invert(InstanceFrame& frame)
{
  double inverse[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      frame.linear[i][j] = frame.exactLinear[i][j].hi;
    }
  }
  const double determinant = adjugate(frame.linear, inverse);
  frame.condition = frobenius(frame.linear) * frobenius(inverse) / std::abs(determinant) / 3;
  frame.centre = { 0, 0, 0 };
  double centre[3];
  for (int i = 0; i < 3; ++i)
  {
    centre[i] = 0;
    for (int j = 0; j < 3; ++j)
    {
      centre[i] -= inverse[i][j] * frame.exactTranslation[j].hi;
    }
    centre[i] /= determinant;
  }
  if (std::isfinite(centre[0] + centre[1] + centre[2]) && std::isfinite(frame.condition))
  {
    frame.centre = { centre[0], centre[1], centre[2] };
  }
  else
  {
    frame.condition = std::numeric_limits<double>::infinity();
  }
}

Vector3dd transform(const InstanceFrame& frame, const double x[3])
{
  DoubleDouble out[3];
  for (int i = 0; i < 3; ++i)
  {
    out[i] = frame.exactTranslation[i];
    for (int j = 0; j < 3; ++j)
    {
      out[i] = out[i] + frame.exactLinear[i][j] * DoubleDouble(x[j]);
    }
  }
  return { out[0], out[1], out[2] };
}

bool finite(const Vector3& v) { return std::isfinite(v.x + v.y + v.z); }

/// Homogeneous image point of a point in the camera frame.
Vector3 inImage(const Vector3& v, LensKind kind) { return kind == LensKind::Parallel ? Vector3{ v.x, v.y, 1 } : v; }
Vector3dd inImage(const Vector3dd& v, LensKind kind)
{
  return kind == LensKind::Parallel ? Vector3dd{ v.x, v.y, 1 } : v;
}
/// Difference of two homogeneous image points.
Vector3 alongImage(const Vector3& v, LensKind kind) { return kind == LensKind::Parallel ? Vector3{ v.x, v.y, 0 } : v; }

} // namespace

Lens::Lens(const CameraModel& model)
  : Model(&model)
{
  const std::optional<LinearProjection> linear = model.linear();
  if (!linear)
  {
    return;
  }
  const Eigen::Matrix3d& K = linear->K;
  this->Kind = linear->perspective ? LensKind::Perspective : LensKind::Parallel;
  this->Fx = K(0, 0);
  this->Fy = K(1, 1);
  this->Cx = K(0, 2);
  this->Cy = K(1, 2);
  this->Skew = K(0, 1);
  this->InverseFx = 1 / this->Fx;
  this->InverseFy = 1 / this->Fy;
  for (const double u : { 0.0, double(model.width()) })
  {
    for (const double v : { 0.0, double(model.height()) })
    {
      const double dy = this->directionY(v);
      this->LargestDirection =
        std::max(this->LargestDirection, 1 + std::abs(dy) + std::abs(this->directionX(u, this->Skew * dy)));
    }
  }
}

Vector3dd Lens::exactDirection(double u, double v) const
{
  const DoubleDouble dy = (DoubleDouble(v) - DoubleDouble(this->Cy)) / DoubleDouble(this->Fy);
  const DoubleDouble dx =
    (DoubleDouble(u) - DoubleDouble(this->Cx) - DoubleDouble(this->Skew) * dy) / DoubleDouble(this->Fx);
  return { dx, dy, 1 };
}

TriangleSolver::TriangleSolver(const SceneState& state, const dgtk::View& view)
  : State(state)
  , TheView(view)
  , Seen(*view.model)
  , FrameCount(state.instances.size())
  , Frames(new InstanceFrame[state.instances.size()])
  , TriangleCounts(state.instances.size(), 0)
  , Planes(planeCount)
  , Exacts(exactCount)
{
}

void TriangleSolver::makeFrame(const Hit& hit)
{
  const std::size_t index = std::size_t(hit.object) - 1;
  if (index >= this->FrameCount || hit.triangle >= this->State.instances[index].model->triangles.size())
  {
    throw UsageError("visibility buffer names a triangle that the scene does not have (object " +
                     std::to_string(hit.object) + ", triangle " + std::to_string(hit.triangle) + ")");
  }
  const Instance& instance = this->State.instances[index];
  const Rigid3& pose = this->TheView.camera_from_world;
  InstanceFrame& frame = this->Frames[index];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      DoubleDouble sum(j < 3 ? 0.0 : pose.translation[i]);
      for (int k = 0; k < 3; ++k)
      {
        const double factor =
          j < 3 ? instance.world_from_object.linear(k, j) : instance.world_from_object.translation[k];
        sum = sum + twoProduct(pose.rotation(i, k), factor);
      }
      (j < 3 ? frame.exactLinear[i][j] : frame.exactTranslation[i]) = sum;
    }
  }
  invert(frame);
  const double centre[3] = { frame.centre.x, frame.centre.y, frame.centre.z };
  frame.remainder = rounded(transform(frame, centre));
  frame.positions = instance.geometry->positions.data();
  frame.triangles = instance.model->triangles.data();
  this->TriangleCounts[index] = std::uint32_t(instance.model->triangles.size());
}

void TriangleSolver::cornersOf(const InstanceFrame& frame, const Hit& hit, Vector3 out[3])
{
  const std::array<std::uint32_t, 3>& triangle = frame.triangles[hit.triangle];
  const auto& m = frame.linear;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& position = frame.positions[triangle[i]];
    const double x = position.x() - frame.centre.x;
    const double y = position.y() - frame.centre.y;
    const double z = position.z() - frame.centre.z;
    out[i].x = (m[0][0] * x + m[0][1] * y) + (m[0][2] * z + frame.remainder.x);
    out[i].y = (m[1][0] * x + m[1][1] * y) + (m[1][2] * z + frame.remainder.y);
    out[i].z = (m[2][0] * x + m[2][1] * y) + (m[2][2] * z + frame.remainder.z);
  }
}

void TriangleSolver::makePlane(const Hit& hit, Plane& plane)
{
  const InstanceFrame& frame = this->frameOf(hit);
  const LensKind kind = this->Seen.Kind;
  Vector3 corner[3];
  cornersOf(frame, hit, corner);
  plane.hit = hit;
  const Vector3 e1 = corner[1] - corner[0];
  const Vector3 e2 = corner[2] - corner[0];
  plane.n = cross(e1, e2);
  plane.d = dot(plane.n, corner[0]);
  const Vector3 a = inImage(corner[0], kind);
  plane.second = cross(alongImage(e2, kind), a);
  plane.third = cross(a, alongImage(e1, kind));

  // Relative error of t <= (error of the vertices) / (distance of the camera from the plane), the same for slivers
  // with the rounding of n.
  constexpr double factor = 16 * unitRoundoff / acceptedError;
  const double reach = std::max({ sumNorm(corner[0]), sumNorm(corner[1]), sumNorm(corner[2]) }) * frame.condition;
  const double s1 = dot(e1, e1);
  const double s2 = dot(e2, e2);
  const double error = factor * factor * std::max(dot(plane.n, plane.n) * reach * reach, s1 * s2 * std::max(s1, s2));
  const double scale = kind == LensKind::Parallel
                         ? plane.n.z * std::max(0.0, std::min({ corner[0].z, corner[1].z, corner[2].z }))
                         : plane.d;
  plane.state = Plane::State::Plain;
  if (!(scale * scale > error))
  {
    const ExactTriangle& exactly = this->exact(hit);
    plane.state = exactly.valid ? Plane::State::Exact : Plane::State::None;
    plane.n = rounded(exactly.n);
    plane.d = exactly.d.hi;
    plane.second = rounded(exactly.lines[1]);
    plane.third = rounded(exactly.lines[2]);
  }
}

const ExactTriangle& TriangleSolver::exact(const Hit& hit)
{
  ExactTriangle& entry = this->Exacts[slot(hit) % exactCount];
  if (entry.hit == hit)
  {
    return entry;
  }
  const InstanceFrame& frame = this->frameOf(hit);
  const LensKind kind = this->Seen.Kind;
  Vector3dd image[3];
  for (int i = 0; i < 3; ++i)
  {
    entry.corners[i] = transform(frame, frame.positions[frame.triangles[hit.triangle][i]].data());
    image[i] = inImage(entry.corners[i], kind);
  }
  const Vector3dd e1 = entry.corners[1] - entry.corners[0];
  const Vector3dd e2 = entry.corners[2] - entry.corners[0];
  entry.hit = hit;
  entry.n = cross(e1, e2);
  entry.d = dot(entry.n, entry.corners[0]);
  for (int i = 0; i < 3; ++i)
  {
    entry.lines[i] = cross(image[(i + 1) % 3], image[(i + 2) % 3]);
  }
  const Vector3 n = rounded(entry.n);
  const double area = dot(n, n);
  const double sides = dot(e1, e1).hi * dot(e2, e2).hi;
  entry.valid = finite(n) && finite(rounded(entry.corners[0])) && area > degenerateSine * degenerateSine * sides &&
                std::isfinite(sides) &&
                (kind == LensKind::Parallel ? n.z != 0 : entry.d.hi != 0 || kind == LensKind::General);
  return entry;
}

namespace
{
GeneralRay generalOf(const CameraRay& ray)
{
  return { { ray.origin.x(), ray.origin.y(), ray.origin.z() },
    { ray.direction.x(), ray.direction.y(), ray.direction.z() } };
}
} // namespace

GeneralRay TriangleSolver::generalRay(double u, double v) const
{
  return generalOf(this->Seen.Model->rayThrough({ u, v }));
}

PlanePoint TriangleSolver::pointOnRay(const Hit& hit, const CameraRay& ray, bool barycentrics)
{
  const Plane& prepared = this->plane(hit);
  if (prepared.state == Plane::State::None)
  {
    return {};
  }
  const GeneralRay general = generalOf(ray);
  // A ray from the camera's centre: the plane and its lines are those of a perspective.
  const double divisor = dot(prepared.n, general.direction);
  constexpr double factor = 16 * unitRoundoff / acceptedError;
  if (prepared.state != Plane::State::Plain || !ray.origin.isZero(0) ||
      !(std::abs(divisor) > factor * sumNorm(prepared.n) * sumNorm(general.direction)))
  {
    return this->generalPoint(hit, general, prepared, barycentrics);
  }
  PlanePoint point;
  const double t = prepared.d / divisor;
  if (t > 0)
  {
    point.t = t;
    point.second = barycentrics ? dot(prepared.second, general.direction) / divisor : point.second;
    point.third = barycentrics ? dot(prepared.third, general.direction) / divisor : point.third;
  }
  return point;
}

PlanePoint TriangleSolver::exactPoint(const Hit& hit, double u, double v)
{
  const ExactTriangle& triangle = this->exact(hit);
  PlanePoint point;
  if (!triangle.valid)
  {
    return point;
  }
  if (this->Seen.Kind == LensKind::General)
  {
    return this->exactGeneralPoint(triangle, this->generalRay(u, v));
  }
  const Vector3dd direction = this->Seen.exactDirection(u, v);
  DoubleDouble dividend = triangle.d;
  DoubleDouble divisor = triangle.n.z;
  if (this->Seen.Kind == LensKind::Perspective)
  {
    divisor = dot(triangle.n, direction);
  }
  else
  {
    dividend = dividend - triangle.n.x * direction.x - triangle.n.y * direction.y;
  }
  const double t = (dividend / divisor).hi;
  if (t > 0 && std::isfinite(t))
  {
    point = { t, (dot(triangle.lines[1], direction) / divisor).hi, (dot(triangle.lines[2], direction) / divisor).hi };
  }
  return point;
}

PlanePoint TriangleSolver::exactGeneralPoint(const ExactTriangle& triangle, const GeneralRay& ray) const
{
  const Vector3dd origin{ ray.origin.x, ray.origin.y, ray.origin.z };
  const Vector3dd direction{ ray.direction.x, ray.direction.y, ray.direction.z };
  const DoubleDouble divisor = dot(triangle.n, direction);
  const double t = ((triangle.d - dot(triangle.n, origin)) / divisor).hi;
  if (!(t > 0) || !std::isfinite(t))
  {
    return {};
  }
  const Vector3dd a = triangle.corners[0] - origin;
  const Vector3dd b = triangle.corners[1] - origin;
  const Vector3dd c = triangle.corners[2] - origin;
  return { t, (dot(cross(c, a), direction) / divisor).hi, (dot(cross(a, b), direction) / divisor).hi };
}

PlanePoint TriangleSolver::generalPoint(const Hit& hit, const GeneralRay& ray, const Plane& prepared, bool barycentrics)
{
  Vector3 corner[3];
  this->corners(hit, corner);
  const Vector3 e1 = corner[1] - corner[0];
  const Vector3 e2 = corner[2] - corner[0];
  const Vector3 a = corner[0] - ray.origin;
  const Vector3& n = prepared.n;
  const double dividend = dot(n, a);
  const double divisor = dot(n, ray.direction);
  constexpr double factor = 16 * unitRoundoff / acceptedError;
  const double reach = std::max({ sumNorm(corner[0]), sumNorm(corner[1]), sumNorm(corner[2]) }) + sumNorm(ray.origin);
  const double sliver = std::max(dot(e1, e1), dot(e2, e2));
  const double size = std::max(sumNorm(n) * reach * this->condition(hit), sliver * std::sqrt(sliver));
  if (!(std::abs(dividend) > factor * size) || !(std::abs(divisor) > factor * sumNorm(n) * sumNorm(ray.direction)))
  {
    const ExactTriangle& exactly = this->exact(hit);
    return exactly.valid ? this->exactGeneralPoint(exactly, ray) : PlanePoint{};
  }
  PlanePoint point;
  const double t = dividend / divisor;
  if (t > 0)
  {
    point.t = t;
    if (barycentrics)
    {
      point.second = dot(cross(e2, a), ray.direction) / divisor;
      point.third = dot(cross(a, e1), ray.direction) / divisor;
    }
  }
  return point;
}

PlanePoint TriangleSolver::point(const Hit& hit, double u, double v, bool barycentrics)
{
  const Lens& lens = this->Seen;
  const Plane& prepared = this->plane(hit);
  PlanePoint point;
  if (prepared.state == Plane::State::None)
  {
    return point;
  }
  if (lens.Kind == LensKind::General)
  {
    return this->generalPoint(hit, this->generalRay(u, v), prepared, barycentrics);
  }
  const double dy = lens.directionY(v);
  const double skew = lens.Skew * dy;
  const double dx = lens.directionX(u, skew);
  const double skewX = std::abs(skew * lens.InverseFx);
  const bool done = lens.Kind == LensKind::Perspective
                      ? evaluate<LensKind::Perspective, true>(prepared, dx, dy, skewX, point)
                      : evaluate<LensKind::Parallel, true>(prepared, dx, dy, skewX, point);
  return done ? point : this->exactPoint(hit, u, v);
}

} // namespace dgtk
