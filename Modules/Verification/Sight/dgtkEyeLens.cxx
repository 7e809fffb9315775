// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEyeLens.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkPortableMath.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
using Points = std::vector<Eigen::Vector3d>;
using Pixels = std::vector<Eigen::Vector2d>;

double number(const CameraRecord& record, const char* name) { return record.numbers.at(name).at(0); }

std::vector<double> distortionOf(const CameraRecord& record)
{
  const auto found = record.numbers.find("distortion");
  return found == record.numbers.end() ? std::vector<double>(4, 0.0) : found->second;
}

std::vector<cv::Point3d> forOpenCV(const Points& points)
{
  std::vector<cv::Point3d> copies;
  for (const Eigen::Vector3d& x : points)
  {
    copies.emplace_back(x.x(), x.y(), x.z());
  }
  return copies;
}

Pixels fromOpenCV(const std::vector<cv::Point2d>& points)
{
  Pixels copies;
  for (const cv::Point2d& p : points)
  {
    copies.emplace_back(p.x, p.y);
  }
  return copies;
}

template <class One>
Pixels each(const Points& points, const One& one)
{
  Pixels found;
  std::transform(points.begin(), points.end(), std::back_inserter(found), one);
  return found;
}

Pixels pinhole(const CameraRecord& record, const Points& points)
{
  std::vector<cv::Point2d> found;
  cv::projectPoints(forOpenCV(points), cv::Vec3d(), cv::Vec3d(), cv::Matx33d::eye(), distortionOf(record), found);
  return fromOpenCV(found);
}

/// OpenCV's is that of points before the camera; the others are turned about the axis at a right angle.
Pixels fisheye(const CameraRecord& record, const Points& points)
{
  const std::vector<double> k = distortionOf(record);
  std::vector<cv::Point2d> found;
  cv::fisheye::projectPoints(forOpenCV(points), found, cv::Vec3d(), cv::Vec3d(), cv::Matx33d::eye(), k);
  Pixels pixels = fromOpenCV(found);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double across = std::hypot(points[i].x(), points[i].y());
    if (!(points[i].z() > 1e-3 * across))
    {
      const double angle = std::atan2(across, points[i].z());
      const double s = angle * angle;
      pixels[i] = points[i].head<2>() * (angle * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))) / across);
    }
  }
  return pixels;
}

/// cv::omnidir: the unit sphere, seen from xi behind its centre by a pinhole with four coefficients.
Pixels omnidirectional(const CameraRecord& record, const Points& points)
{
  Points seen;
  for (const Eigen::Vector3d& x : points)
  {
    seen.emplace_back(x.normalized() + Eigen::Vector3d(0, 0, number(record, "xi")));
  }
  return pinhole(record, seen);
}

/// Usenko et al. 2018, equations 40 to 42.
Pixels doubleSphere(const CameraRecord& record, const Points& points)
{
  const double xi = number(record, "xi");
  const double alpha = number(record, "alpha");
  return each(points,
    [&](const Eigen::Vector3d& x) -> Eigen::Vector2d
    {
      const double d1 = x.norm();
      const double behind = xi * d1 + x.z();
      const double d2 = std::hypot(std::hypot(x.x(), x.y()), behind);
      return x.head<2>() / (alpha * d2 + (1 - alpha) * behind);
    });
}

/// Khomutenko et al. 2016, equations 5 and 6.
Pixels eucm(const CameraRecord& record, const Points& points)
{
  const double alpha = number(record, "alpha");
  const double beta = number(record, "beta");
  return each(points,
    [&](const Eigen::Vector3d& x) -> Eigen::Vector2d
    {
      const double rho = std::sqrt(beta * (x.x() * x.x() + x.y() * x.y()) + x.z() * x.z());
      return x.head<2>() / (alpha * rho + (1 - alpha) * x.z());
    });
}

Pixels equirectangular(const CameraRecord& record, const Points& points)
{
  return each(points,
    [&](const Eigen::Vector3d& x)
    {
      const double longitude = std::atan2(x.x(), x.z());
      const double latitude = std::asin(std::clamp(-x.y() / x.norm(), -1.0, 1.0));
      return Eigen::Vector2d(record.width * (longitude + pi) / (2 * pi), record.height * (pi / 2 - latitude) / pi);
    });
}
} // namespace

const EyeLens::Row* EyeLens::rowOf(const std::string& model)
{
  static const Row rows[] = { { "pinhole", "cv::projectPoints", &pinhole, false },
    { "fisheye", "cv::fisheye::projectPoints", &fisheye, false },
    { "omnidirectional", "cv::projectPoints of the sphere", &omnidirectional, false },
    { "double-sphere", "projection", &doubleSphere, false }, { "eucm", "projection", &eucm, false },
    { "equirectangular", "projection", &equirectangular, true } };
  const Row* const found =
    std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return model == row.model; });
  return found == std::end(rows) ? nullptr : found;
}

std::shared_ptr<const EyeLens> EyeLens::of(const CameraRecord& record)
{
  const Row* const row = rowOf(record.model);
  try
  {
    const std::optional<Eigen::Matrix3d> K = record.hasK ? std::optional(record.K) : std::nullopt;
    const CameraParameters of{ record.width, record.height, K, record.numbers, record.files };
    if (row == nullptr)
    {
      return nullptr;
    }
    CameraRecord whole = record; // with usual values
    whole.numbers = makeCamera(record.model, of)->parameters().numbers;
    return std::shared_ptr<const EyeLens>(new EyeLens(whole, *row));
  }
  catch (const UsageError&)
  {
    return nullptr;
  }
}

std::vector<Eigen::Vector2d> EyeLens::project(const std::vector<Eigen::Vector3d>& x_in_camera) const
{
  Pixels pixels = this->Model.onPlane(this->Record, x_in_camera);
  const Eigen::Matrix3d& K = this->Record.K;
  for (Eigen::Vector2d& pixel : pixels)
  {
    if (this->Record.hasK)
    {
      pixel = K.topLeftCorner<2, 2>() * pixel + K.topRightCorner<2, 1>();
    }
  }
  return pixels;
}

double EyeLens::seam(const Eigen::Vector2d& pixel) const
{
  constexpr double rounding = 1e-9; // pixels
  const double width = this->Record.width;
  return this->Model.round && std::min(pixel.x(), width - pixel.x()) <= rounding ? width : 0;
}

} // namespace dgtk
