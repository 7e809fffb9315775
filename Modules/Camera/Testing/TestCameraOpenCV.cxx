// SPDX-License-Identifier: BSD-3-Clause
// OpenCV as judge of the models that it has: what a pixel's ray meets is projected to the pixel.
#include "dgtkRandomCameras.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include <functional>

using namespace dgtk;

namespace
{
constexpr double tolerance = 1e-6; // pixels
constexpr int randomCameras = 40;

using Project = std::function<cv::Point2d(const CameraParameters&, const Eigen::Vector3d&)>;

const CameraRow& rowOf(const std::string& model)
{
  return *std::find_if(
    cameraRows().begin(), cameraRows().end(), [&](const CameraRow& row) { return row.model == model; });
}

cv::Matx33d withoutSkew(const Eigen::Matrix3d& K) { return { K(0, 0), 0, K(0, 2), 0, K(1, 1), K(1, 2), 0, 0, 1 }; }

/// K's skew, which OpenCV's projections mostly do not know, is added to what they say.
cv::Point2d skewed(const cv::Point2d& p, const Eigen::Matrix3d& K)
{
  return { p.x + K(0, 1) * (p.y - K(1, 2)) / K(1, 1), p.y };
}

cv::Point2d projectPinhole(const CameraParameters& of, const Eigen::Vector3d& x)
{
  std::vector<cv::Point2d> found;
  const auto distortion = of.numbers.find("distortion");
  cv::projectPoints(std::vector<cv::Point3d>{ { x.x(), x.y(), x.z() } }, cv::Vec3d(), cv::Vec3d(), withoutSkew(*of.K),
    distortion != of.numbers.end() ? distortion->second : std::vector<double>(4), found);
  return skewed(found[0], *of.K);
}

cv::Point2d projectFisheye(const CameraParameters& of, const Eigen::Vector3d& x)
{
  std::vector<cv::Point2d> found;
  cv::fisheye::projectPoints(std::vector<cv::Point3d>{ { x.x(), x.y(), x.z() } }, found, cv::Vec3d(), cv::Vec3d(),
    withoutSkew(*of.K), of.numbers.at("distortion"), (*of.K)(0, 1) / (*of.K)(0, 0));
  return found[0];
}

/// What cv::omnidir::projectPoints() does, which is not among OpenCV's main modules: the point on the unit sphere is
/// seen from xi behind its centre, with the first four coefficients.
cv::Point2d projectOmnidirectional(const CameraParameters& of, const Eigen::Vector3d& x)
{
  return projectPinhole(of, x.normalized() + Eigen::Vector3d(0, 0, of.number("xi")));
}

void judge(const std::string& model, std::size_t numbers, const Project& project, double leastCosine)
{
  test::RandomCameras random(23);
  int rays = 0;
  for (int i = 0; i < randomCameras; ++i)
  {
    const auto camera = random.make(rowOf(model), numbers);
    ASSERT_TRUE(camera);
    for (int y = 0; y < camera->height(); y += 1 + camera->height() / 9)
    {
      for (int x = 0; x < camera->width(); x += 1 + camera->width() / 9)
      {
        const Eigen::Vector2d centre(x + 0.5, y + 0.5);
        const CameraRay ray = camera->rayThrough(centre);
        if (!ray.exists() || ray.direction.z() <= leastCosine)
        {
          continue;
        }
        ++rays;
        const cv::Point2d found = project(camera->parameters(), 3 * ray.direction);
        ASSERT_LE(std::hypot(found.x - centre.x(), found.y - centre.y()), tolerance) << centre.transpose();
      }
    }
  }
  EXPECT_GT(rays, randomCameras * 30);
}
} // namespace

TEST(OpenCV, ProjectsThePinholesRays)
{
  for (const std::size_t numbers : { 4, 5, 8, 12, 14 })
  {
    SCOPED_TRACE(numbers);
    judge("pinhole", numbers, projectPinhole, 0);
  }
}

TEST(OpenCV, ProjectsTheFisheyesRays) { judge("fisheye", 4, projectFisheye, 1e-3); } // before the camera

TEST(OpenCV, ProjectsTheOmnidirectionalRays) { judge("omnidirectional", 0, projectOmnidirectional, -2); }
