// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraModel_h
#define dgtkCameraModel_h

#include "dgtkCameraModule.h"
#include "dgtkRigid3.h"
#include "dgtkRollingShutter.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

// Conventions, written once for the whole library.
// Camera frame: x right, y down, z forward (OpenCV). x_camera = R * x_world + t.
// Pixels: the image's top-left corner is (0, 0); the centre of the pixel in column i, row j is (i + 0.5, j + 0.5).

/// A half line in the camera frame: x(t) = origin + t * direction, t >= 0. Directions are not normalised. One of zero
/// is no ray: nothing is seen there.
struct CameraRay
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;

  bool exists() const { return !this->direction.isZero(0); }
};

/// Frames, ends included.
struct TimeSpan
{
  double first = 0;
  double last = 0;
};

/// Projections that a 3x3 matrix describes, which OpenGL can draw and for which depth has a closed form per triangle.
/// perspective: pixel = (K x / z); otherwise (orthographic): pixel = K * (x, y, 1), K in pixels per scene unit.
/// K is [fx s cx; 0 fy cy; 0 0 1].
struct LinearProjection
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  bool perspective = true;
};

/// What a camera is made of besides its model, under the names that scene files and cameras.json have for them.
struct CameraParameters
{
  int width = 0;                    ///< pixels
  int height = 0;                   ///< pixels
  std::optional<Eigen::Matrix3d> K; ///< of an image of this size
  std::map<std::string, std::vector<double>> numbers = {};
  std::map<std::string, std::string> files = {}; ///< paths as they can be opened
  RollingShutter rollingShutter = {};

  /// The one number of a name that is there.
  double number(const std::string& name) const { return this->numbers.at(name).front(); }
};

/// How image points and rays of a camera belong together. Immutable. Everything that is derived from a camera asks
/// for rays and projections here; nothing else in the library assumes a kind of lens.
class DGTKCAMERA_EXPORT CameraModel
{
public:
  virtual ~CameraModel() = default;
  CameraModel(const CameraModel&) = delete;
  CameraModel& operator=(const CameraModel&) = delete;

  /// Name as written in scene files and cameras.json: "pinhole", "orthographic".
  virtual std::string name() const = 0;
  int width() const { return this->Parameters.width; }   ///< pixels
  int height() const { return this->Parameters.height; } ///< pixels
  /// What makeCamera() makes the same camera of, under its name().
  const CameraParameters& parameters() const { return this->Parameters; }

  /// The ray through an image point (pixels), in the camera frame, also for points outside the image where there is
  /// one. Of a linear() projection direction.z is 1 and origin.z is 0, so that the ray's parameter is the depth; of
  /// another one the direction has length 1, so that it is the distance, and is zero where no ray is: beyond the
  /// domain of the model, as around the image circle of a fisheye. Finite everywhere.
  virtual CameraRay rayThrough(const Eigen::Vector2d& pixel) const = 0;

  /// Image point of a point in the camera frame (scene units), also outside the image. False, and `pixel`
  /// untouched, when the point lies on no ray (behind the camera: pinhole z <= 0, orthographic z < 0; beyond the
  /// domain of a lens).
  virtual bool project(const Eigen::Vector3d& x_in_camera, Eigen::Vector2d& pixel) const = 0;

  /// The same of many at once; `seen` gets what project() returns.
  virtual void raysThrough(const Eigen::Vector2d* pixels, std::size_t count, CameraRay* rays) const;
  virtual void projectAll(
    const Eigen::Vector3d* x_in_camera, std::size_t count, Eigen::Vector2d* pixels, std::uint8_t* seen) const;

  /// When an image point is seen, frames after the picture's own. Continuous; all points of a row, or of a column, have
  /// the time of its centre where pixels are sampled.
  virtual double timeAt(const Eigen::Vector2d&) const { return 0; }
  /// The least and the largest timeAt().
  virtual TimeSpan times() const { return {}; }
  /// Whether timeAt() is not 0 throughout.
  bool rolls() const { return this->times().first != 0 || this->times().last != 0; }

  /// Whether all rays start at the camera's centre, the origin of its frame.
  virtual bool isCentral() const { return false; }

  /// The projection's matrix where it is linear, nothing otherwise. With a rolling shutter it is that of each instant.
  virtual std::optional<LinearProjection> linear() const { return std::nullopt; }

protected:
  explicit CameraModel(CameraParameters parameters)
    : Parameters(std::move(parameters))
  {
  }
  CameraModel(int width, int height)
    : CameraModel(CameraParameters{ width, height, std::nullopt })
  {
  }

private:
  CameraParameters Parameters;
};

/// A model whose functions of many points are loops without a virtual call: class Mine final : public RowsOf<Mine>.
template <class Model, class Base = CameraModel>
class RowsOf : public Base
{
public:
  using Base::Base;
  void raysThrough(const Eigen::Vector2d* pixels, std::size_t count, CameraRay* rays) const override
  {
    const auto& model = static_cast<const Model&>(*this);
    for (std::size_t i = 0; i < count; ++i)
    {
      rays[i] = model.Model::rayThrough(pixels[i]);
    }
  }
  void projectAll(
    const Eigen::Vector3d* x_in_camera, std::size_t count, Eigen::Vector2d* pixels, std::uint8_t* seen) const override
  {
    const auto& model = static_cast<const Model&>(*this);
    for (std::size_t i = 0; i < count; ++i)
    {
      seen[i] = model.Model::project(x_in_camera[i], pixels[i]) ? 1 : 0;
    }
  }
};

class InstantSource;

/// A camera at one instant, as the ground truth needs it; or at the instants of a rolling shutter.
struct View
{
  std::string name;
  std::shared_ptr<const CameraModel> model;
  Rigid3 camera_from_world; ///< at the picture's own time
  double near = 0.1;        ///< smallest parameter of a ray that is seen (depth, or distance), scene units, > 0
  double far = 1000.0;      ///< largest one, scene units, > near
  /// Where the camera and the scene are when its image points are seen (dgtkInstantSource.h); null: the whole image is
  /// seen at once.
  std::shared_ptr<const InstantSource> instants = nullptr;
};

/// K = [fx s cx; 0 fy cy; 0 0 1], pixels. Throws UsageError unless 1 <= width, height <= 2^20, K has that form, all its
/// values are finite and fx, fy > 0.
DGTKCAMERA_EXPORT std::shared_ptr<const CameraModel> makePinhole(int width, int height, const Eigen::Matrix3d& K);

/// gluPerspective's camera: vertical field of view in degrees (0, 180); aspect = width / height of the *view*. fy = H/2
/// / tan(fovY/2), fx = W/2 / (aspect * tan(fovY/2)), principal point (W/2, H/2). aspect <= 0 means square pixels.
/// Throws UsageError outside these ranges.
DGTKCAMERA_EXPORT std::shared_ptr<const CameraModel> makePinholeFromFov(
  int width, int height, double fovYDegrees, double aspect);

/// Parallel projection; `viewHeight` is the height of the image in scene units; square pixels unless aspect > 0.
/// Throws UsageError unless viewHeight is finite and > 0.
DGTKCAMERA_EXPORT std::shared_ptr<const CameraModel> makeOrthographic(
  int width, int height, double viewHeight, double aspect);

/// camera_from_world of a camera at `eye` that looks at `lookAt` with `up` upwards in the image (gluLookAt).
/// Throws UsageError when eye and lookAt coincide or up is parallel to the view.
DGTKCAMERA_EXPORT Rigid3 lookAtPose(
  const Eigen::Vector3d& eye, const Eigen::Vector3d& lookAt, const Eigen::Vector3d& up);

/// World units per pixel by the thesis's equations 4.1 and 4.2, per axis with the field of view of that axis:
/// 2 (far - near) tan(fov / 2) / pixels; and the same at the far plane: 2 far tan(fov / 2) / pixels. 2 tan(fov / 2) of
/// a pinhole is the full extent of the image at depth 1, W / fx, wherever its principal point is; of a lens, all pixels
/// count as those in the middle of the image. Orthographic: the size of a pixel, at any depth.
/// Throws UsageError unless 0 < near < far.
struct WorldResolution
{
  Eigen::Vector2d thesis;
  Eigen::Vector2d farPlane;
};
DGTKCAMERA_EXPORT WorldResolution worldResolution(const View& view);

/// OpenGL matrices of a linear view, for files that hold them (column vectors, clip z in [-w, w], y up).
/// projection: 4x4; modelView: 4x4 = diag(1,-1,-1,1) * [R|t]. Throws UsageError for a camera that is not linear, and
/// unless 0 < near < far.
struct OpenGLMatrices
{
  Eigen::Matrix4d projection;
  Eigen::Matrix4d modelView;
};
DGTKCAMERA_EXPORT OpenGLMatrices openGLMatrices(const View& view);

} // namespace dgtk

#endif
