// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLensCamera_h
#define dgtkLensCamera_h

// Private to Camera: what the models have in common that see through one point, by an image plane and K.

#include "dgtkCameraEntry.h"
#include "dgtkImagePlane.h"

#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// Where an image stands still (a step on the plane for one of the ray's angle or its tangent, 1 in the middle of a
/// lens without distortion), rays and pixels no longer say each other: the domain of a model ends where it falls to
/// this.
constexpr double leastStretch = 1e-4;
/// Part of the domain's radius by which projected points may be beyond it, so that rounding does not hide its end.
constexpr double edgeSlack = 1e-12;
/// The same where a root says the end: part of leastStretch.
constexpr double rootSlack = 1e-6;
/// Of points on a plane whose domain has no end by itself: 89.994 degrees of a pinhole.
constexpr double largestRadius = 1e4;

class LensCamera : public CameraModel
{
public:
  /// `K` is what `of` has, or what it gives by its field of view; of the numbers those are kept that K does not say.
  LensCamera(const CameraParameters& of, const Eigen::Matrix3d& K);
  bool isCentral() const override { return true; }

protected:
  const ImagePlane& plane() const { return this->Plane; }
  /// Farthest that the plane's points of the image are from its middle.
  double imageRadius() const;
  static CameraRay noRay() { return { Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() }; }

private:
  ImagePlane Plane;
};

/// K of a camera: that which is given, or by fovY and aspect. `radius` of a model: how far from the middle of the plane
/// a ray of an angle to the axis (radians) is without the distortion; not finite where there is none. Throws UsageError
/// for a field of view that the model does not have.
Eigen::Matrix3d lensMatrix(const CameraParameters& of, const std::function<double(double)>& radius);

/// "distortion": numbers in OpenCV's order.
CameraParameter distortionParameter(const std::string& help, std::vector<std::size_t> counts);

} // namespace dgtk

#endif
