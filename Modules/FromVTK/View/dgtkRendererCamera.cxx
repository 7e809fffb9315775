// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRendererCamera.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <Eigen/Geometry>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int usualSide = 300; ///< of VTK's windows
constexpr double leaning = 1e-9;
constexpr double margin = 1e-3;         ///< of near and far around what there is
constexpr double leastNear = 1e-6;      ///< of far
constexpr double leastDistance = 1e-20; ///< VTK's own

using Row = Eigen::RowVector4d;

Eigen::Matrix4d matrixOf(const vtkMatrix4x4& from)
{
  Eigen::Matrix4d to;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      to(i, j) = from.GetElement(i, j);
    }
  }
  return to;
}

[[noreturn]] void fail(const std::string& what) { throw InputError("VTK scene", "its camera " + what); }

/// A camera that has the given image of the world.
class Decomposition
{
public:
  /// clip_from_world of OpenGL, in an image of this size. Parallel rays have no centre: `eye` tells where depth is 0.
  Decomposition(const Eigen::Matrix4d& clip, double width, double height, const Eigen::Vector3d& eye)
    : Position(eye)
  {
    const Row w = clip.row(3);
    this->Perspective = !w.head<3>().isZero(0);
    const Row x = width / 2 * (clip.row(0) + w);
    const Row y = height / 2 * (w - clip.row(1));
    this->Perspective ? this->perspective(x, y, w) : this->parallel(x / w[3], y / w[3], clip.row(2) / w[3]);
    this->Near = this->depthOf(w + clip.row(2));
    this->Far = this->depthOf(w - clip.row(2));
  }

  bool isUsable() const
  {
    return this->K.allFinite() && this->Position.allFinite() && this->CameraFromWorld.allFinite();
  }

  bool Perspective = true;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d CameraFromWorld = Eigen::Matrix3d::Identity();
  Eigen::Vector3d Position;
  double Near = 0; ///< not a number where the plane leans
  double Far = 0;

private:
  /// RQ decomposition of the left 3 x 3 of the projection (Hartley and Zisserman, Multiple View Geometry, 6.2.4).
  void perspective(const Row& x, const Row& y, const Row& w)
  {
    const double scale = w.head<3>().norm();
    Eigen::Matrix<double, 3, 4> P;
    P << x / scale, y / scale, w / scale;
    const Eigen::Vector3d first = P.row(0).head<3>().transpose();
    const Eigen::Vector3d second = P.row(1).head<3>().transpose();
    const Eigen::Vector3d ahead = P.row(2).head<3>().transpose();
    this->K(0, 2) = first.dot(ahead);
    this->K(1, 2) = second.dot(ahead);
    this->fromRows(first - this->K(0, 2) * ahead, second - this->K(1, 2) * ahead, ahead);
    const Eigen::Matrix3d left = P.leftCols<3>();
    this->Position = -(left.inverse() * P.col(3));
  }

  void parallel(const Row& x, const Row& y, const Row& depth)
  {
    const Eigen::Vector3d first = x.head<3>().transpose();
    const Eigen::Vector3d second = y.head<3>().transpose();
    const Eigen::Vector3d deep = depth.head<3>().transpose();
    const Eigen::Vector3d across = first.cross(second).normalized();
    const Eigen::Vector3d ahead = deep.dot(across) < 0 ? Eigen::Vector3d(-across) : across;
    if ((deep.normalized() - ahead).norm() > leaning)
    {
      fail("leans: its parallel view is not across its near plane");
    }
    this->fromRows(first, second, ahead);
    this->K(0, 2) = first.dot(this->Position) + x[3];
    this->K(1, 2) = second.dot(this->Position) + y[3];
  }

  void fromRows(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& ahead)
  {
    this->K(1, 1) = y.norm();
    const Eigen::Vector3d down = y / this->K(1, 1);
    this->K(0, 1) = x.dot(down);
    const Eigen::Vector3d right = x - this->K(0, 1) * down;
    this->K(0, 0) = right.norm();
    this->CameraFromWorld.row(0) = right.transpose() / this->K(0, 0);
    this->CameraFromWorld.row(1) = down.transpose();
    this->CameraFromWorld.row(2) = ahead.transpose();
    if (this->CameraFromWorld.determinant() < 0)
    {
      fail("mirrors its picture");
    }
  }

  /// Of a plane of the world across the view.
  double depthOf(const Row& plane) const
  {
    const Eigen::Vector3d normal = plane.head<3>().transpose();
    const Eigen::Vector3d ahead = this->CameraFromWorld.row(2).transpose();
    const double along = normal.dot(ahead);
    const bool leans = (normal - along * ahead).norm() > leaning * normal.norm();
    return leans ? std::numeric_limits<double>::quiet_NaN() : -(normal.dot(this->Position) + plane[3]) / along;
  }
};

[[noreturn]] void failUnusable(vtkCamera& camera)
{
  const auto vectorOf = [](const double* v) { return Eigen::Vector3d(v[0], v[1], v[2]); };
  const Eigen::Vector3d position = vectorOf(camera.GetPosition());
  const Eigen::Vector3d ahead = vectorOf(camera.GetFocalPoint()) - position;
  const Eigen::Vector3d up = vectorOf(camera.GetViewUp());
  if (!ahead.allFinite() || !up.allFinite())
  {
    fail("has a position, a focal point or a view up that is no number");
  }
  if (camera.GetDistance() <= leastDistance)
  {
    fail("stands in its focal point");
  }
  if (ahead.normalized().cross(up.normalized()).norm() < leaning)
  {
    fail("looks along its view up");
  }
  if (camera.GetParallelProjection() != 0 && !(camera.GetParallelScale() > 0))
  {
    fail("has a parallel scale of " + shortest(camera.GetParallelScale()));
  }
  fail("has matrices that cannot be taken apart");
}

/// A camera that sees all props, as the renderer makes one when it draws for the first time.
vtkSmartPointer<vtkCamera> overview(vtkRenderer& renderer, double aspect)
{
  double bounds[6];
  renderer.ComputeVisiblePropBounds(bounds);
  vtkNew<vtkRenderer> apart;
  apart->SetAspect(aspect, 1);
  apart->ResetCamera(bounds);
  return apart->GetActiveCamera();
}

/// A parallel camera's middle is that of its image: it stands where that is so.
void setParallel(const Eigen::Matrix3d& K, const Eigen::Matrix3d& cameraFromWorld, CameraDescription& camera)
{
  if (std::abs(K(0, 1)) > leaning * K(0, 0))
  {
    fail("shears its parallel picture");
  }
  const double width = camera.width / K(0, 0);
  const double height = camera.height / K(1, 1);
  camera.viewHeight = height;
  camera.aspect = width / height;
  const Eigen::Vector3d beside(width / 2 - K(0, 2) / K(0, 0), height / 2 - K(1, 2) / K(1, 1), 0);
  camera.position = Eigen::Vector3d(camera.position.at(0) + cameraFromWorld.transpose() * beside);
}

bool wasDrawn(vtkRenderer& renderer)
{
  vtkRenderWindow* const window = renderer.GetRenderWindow();
  return window != nullptr && window->GetNeverRendered() == 0;
}
} // namespace

std::pair<int, int> rendererSize(vtkRenderer& renderer)
{
  vtkRenderWindow* const window = renderer.GetRenderWindow();
  const int* const asked = window != nullptr ? window->GetSize() : nullptr;
  const bool open = asked != nullptr && asked[0] > 0 && asked[1] > 0;
  const double size[2] = { double(open ? asked[0] : usualSide), double(open ? asked[1] : usualSide) };
  double view[4];
  renderer.GetViewport(view);
  const auto side = [&](int axis)
  { return std::max(1, int(std::lround(view[axis + 2] * size[axis])) - int(std::lround(view[axis] * size[axis]))); };
  return { side(0), side(1) };
}

RendererCamera rendererCamera(vtkRenderer& renderer, int width, int height)
{
  RendererCamera view;
  const double aspect = double(width) / height;
  const bool made = renderer.IsActiveCameraCreated() != 0;
  view.camera = made ? vtkSmartPointer<vtkCamera>(renderer.GetActiveCamera()) : overview(renderer, aspect);
  view.drawn = made && wasDrawn(renderer);
  const Eigen::Matrix4d viewFromWorld = matrixOf(*view.camera->GetModelViewTransformMatrix());
  const Eigen::Matrix4d clip = matrixOf(*view.camera->GetProjectionTransformMatrix(aspect, -1, 1)) * viewFromWorld;
  const Eigen::Vector4d eye = viewFromWorld.inverse().col(3);
  const Decomposition parts(clip, width, height, eye.head<3>() / eye[3]);
  if (!parts.isUsable())
  {
    failUnusable(*view.camera);
  }
  CameraDescription& camera = view.description;
  camera.name = "camera";
  camera.model = parts.Perspective ? "pinhole" : "orthographic";
  camera.width = width;
  camera.height = height;
  camera.posed = true;
  camera.position = parts.Position;
  parts.Perspective ? void(camera.K = parts.K) : setParallel(parts.K, parts.CameraFromWorld, camera);
  const Eigen::Quaterniond turn(Eigen::Matrix3d(parts.CameraFromWorld.transpose()));
  camera.orientation = Quaternion{ turn.w(), turn.x(), turn.y(), turn.z() };
  view.nearPlane = parts.Near;
  view.farPlane = parts.Far;
  return view;
}

void setRange(RendererCamera& view, double nearest, double farthest)
{
  CameraDescription& camera = view.description;
  if (view.drawn)
  {
    if (!std::isfinite(view.nearPlane) || !std::isfinite(view.farPlane))
    {
      fail("leans: its near plane is not across its view");
    }
    camera.near = view.nearPlane;
    camera.far = view.farPlane;
  }
  else
  {
    camera.far = farthest > 0 ? farthest * (1 + margin) : 1;
    camera.near = nearest * (1 - margin);
  }
  camera.near = std::max(camera.near, camera.far * leastNear);
}

} // namespace dgtk
