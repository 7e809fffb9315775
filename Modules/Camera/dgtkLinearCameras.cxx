// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraModel.h"

#include "dgtkError.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace dgtk
{

namespace
{
constexpr int maximumSide = 1 << 20;
constexpr double pi = 3.14159265358979323846;

std::string textOf(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

void checkSize(int width, int height)
{
  if (width < 1 || height < 1 || width > maximumSide || height > maximumSide)
  {
    throw UsageError("image size out of range (expected 1 to " + std::to_string(maximumSide) +
                     " pixels a side, found " + std::to_string(width) + " x " + std::to_string(height) + ")");
  }
}

void checkK(const Eigen::Matrix3d& K)
{
  if (!K.allFinite())
  {
    throw UsageError("K has a value that is not finite");
  }
  if (!(K(0, 0) > 0) || !(K(1, 1) > 0))
  {
    throw UsageError(
      "focal lengths of K out of range (expected fx, fy > 0, found " + textOf(K(0, 0)) + ", " + textOf(K(1, 1)) + ")");
  }
  if (K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0 || K(2, 2) != 1)
  {
    throw UsageError("K is not of the form [fx s cx; 0 fy cy; 0 0 1]");
  }
}

/// Both linear models: they differ in what the inverse of K gives, a direction or an origin.
class LinearCamera : public CameraModel
{
public:
  LinearCamera(int width, int height, const Eigen::Matrix3d& K, bool perspective)
    : CameraModel(width, height)
    , Projection{ K, perspective }
  {
  }
  std::optional<LinearProjection> linear() const override { return this->Projection; }

protected:
  Eigen::Vector2d onPlane(const Eigen::Vector2d& pixel) const
  {
    const Eigen::Matrix3d& K = this->Projection.K;
    const double y = (pixel.y() - K(1, 2)) / K(1, 1);
    return { (pixel.x() - K(0, 2) - K(0, 1) * y) / K(0, 0), y };
  }
  Eigen::Vector2d inImage(double x, double y) const
  {
    const Eigen::Matrix3d& K = this->Projection.K;
    return { K(0, 0) * x + K(0, 1) * y + K(0, 2), K(1, 1) * y + K(1, 2) };
  }

private:
  LinearProjection Projection;
};

class Pinhole final : public LinearCamera
{
public:
  Pinhole(int width, int height, const Eigen::Matrix3d& K)
    : LinearCamera(width, height, K, true)
  {
  }
  std::string name() const override { return "pinhole"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = this->onPlane(pixel);
    return { Eigen::Vector3d::Zero(), Eigen::Vector3d(p.x(), p.y(), 1) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    if (!(x.z() > 0))
    {
      return false;
    }
    pixel = this->inImage(x.x() / x.z(), x.y() / x.z());
    return true;
  }
};

class Orthographic final : public LinearCamera
{
public:
  Orthographic(int width, int height, const Eigen::Matrix3d& K)
    : LinearCamera(width, height, K, false)
  {
  }
  std::string name() const override { return "orthographic"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = this->onPlane(pixel);
    return { Eigen::Vector3d(p.x(), p.y(), 0), Eigen::Vector3d(0, 0, 1) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    if (!(x.z() >= 0))
    {
      return false;
    }
    pixel = this->inImage(x.x(), x.y());
    return true;
  }
};

/// K of an image `viewWidth` x `viewHeight` wide at distance 1; a width of 0 gives square pixels.
Eigen::Matrix3d centredK(int width, int height, double viewWidth, double viewHeight)
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(1, 1) = height / viewHeight;
  K(0, 0) = viewWidth > 0 ? width / viewWidth : K(1, 1);
  K(0, 2) = 0.5 * width;
  K(1, 2) = 0.5 * height;
  return K;
}

} // namespace

std::shared_ptr<const CameraModel> makePinhole(int width, int height, const Eigen::Matrix3d& K)
{
  checkSize(width, height);
  checkK(K);
  return std::make_shared<Pinhole>(width, height, K);
}

std::shared_ptr<const CameraModel> makePinholeFromFov(int width, int height, double fovYDegrees, double aspect)
{
  checkSize(width, height);
  if (!(fovYDegrees > 0 && fovYDegrees < 180))
  {
    throw UsageError(
      "field of view out of range (expected more than 0 and less than 180 degrees, found " + textOf(fovYDegrees) + ")");
  }
  if (!std::isfinite(aspect))
  {
    throw UsageError("aspect is not finite");
  }
  const double viewHeight = 2 * std::tan(fovYDegrees * (pi / 360));
  const Eigen::Matrix3d K = centredK(width, height, aspect > 0 ? aspect * viewHeight : 0, viewHeight);
  checkK(K);
  return std::make_shared<Pinhole>(width, height, K);
}

std::shared_ptr<const CameraModel> makeOrthographic(int width, int height, double viewHeight, double aspect)
{
  checkSize(width, height);
  if (!(viewHeight > 0) || !std::isfinite(viewHeight))
  {
    throw UsageError("view height out of range (expected a number > 0, found " + textOf(viewHeight) + ")");
  }
  if (!std::isfinite(aspect))
  {
    throw UsageError("aspect is not finite");
  }
  const Eigen::Matrix3d K = centredK(width, height, aspect > 0 ? aspect * viewHeight : 0, viewHeight);
  checkK(K);
  return std::make_shared<Orthographic>(width, height, K);
}

std::shared_ptr<const CameraModel> makeRecordedCamera(
  const std::string& model, int width, int height, const Eigen::Matrix3d& K)
{
  if (model == "pinhole")
  {
    return makePinhole(width, height, K);
  }
  if (model != "orthographic")
  {
    return nullptr;
  }
  const double viewHeight = height / K(1, 1);
  return makeOrthographic(width, height, viewHeight, width / K(0, 0) / viewHeight);
}

} // namespace dgtk
