// SPDX-License-Identifier: BSD-3-Clause
// usage: TestCalibration DATASET
// Reads a rendered dataset back from disk and projects the 3D points of its pixels with OpenCV and with the thesis's
// own formula (section 4.3): both must give the pixel's centre.
#include "dgtkDatasetDocuments.h"
#include "dgtkLayerReader.h"

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace
{
// Largest distance of a reprojected point from its pixel's centre, pixels: rounding of double arithmetic at 1e4 pixels
// of focal length and 1e5 units of depth stays below 1e-8.
constexpr double tolerance = 1e-6;
constexpr int step = 7; // every step-th pixel in both directions

struct Sample
{
  cv::Point2d centre; // pixels, y down
  cv::Point3d world;
};

struct Worst
{
  double distance = 0;
  std::string where;
  void update(double candidate, const std::string& place)
  {
    if (!(candidate <= this->distance)) // NaN counts
    {
      this->distance = candidate;
      this->where = place;
    }
  }
};

std::string fileOf(
  const std::string& folder, const dgtk::CameraRecord& camera, const char* layer, const char* extension)
{
  char number[16];
  std::snprintf(number, sizeof number, "%06d", camera.frame);
  return folder + '/' + camera.name + '/' + layer + '/' + number + '.' + extension;
}

// World points of pixels, from depth and cameras.json.
std::vector<Sample> unproject(const dgtk::CameraRecord& camera, const dgtk::Rows& depth)
{
  const Eigen::Matrix3d inverse = camera.K.inverse();
  std::vector<Sample> samples;
  for (int y = 0; y < camera.height; y += step)
  {
    for (int x = 0; x < camera.width; x += step)
    {
      const double z = depth.row<double>(y)[x];
      if (!std::isfinite(z))
      {
        continue;
      }
      const Eigen::Vector3d ray = inverse * Eigen::Vector3d(x + 0.5, y + 0.5, 1);
      const Eigen::Vector3d inCamera =
        camera.model == "orthographic" ? Eigen::Vector3d(ray.x(), ray.y(), z) : Eigen::Vector3d(ray * z);
      const Eigen::Vector3d world = camera.R.transpose() * (inCamera - camera.t);
      samples.push_back({ { x + 0.5, y + 0.5 }, { world.x(), world.y(), world.z() } });
    }
  }
  return samples;
}

void checkOpenCV(
  const dgtk::CameraRecord& camera, const std::vector<Sample>& samples, const std::string& place, Worst& worst)
{
  cv::Matx33d K;
  cv::Matx33d R;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      K(i, j) = camera.K(i, j);
      R(i, j) = camera.R(i, j);
    }
  }
  cv::Mat rotation;
  cv::Rodrigues(R, rotation);
  std::vector<cv::Point3d> points;
  points.reserve(samples.size());
  for (const Sample& sample : samples)
  {
    points.push_back(sample.world);
  }
  std::vector<cv::Point2d> projected;
  cv::projectPoints(points, rotation, cv::Vec3d(camera.t.x(), camera.t.y(), camera.t.z()), K, cv::noArray(), projected);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    worst.update(cv::norm(projected[i] - samples[i].centre), place + " (OpenCV)");
  }
}

// The file is read word by word, without the library: K, R|t, Viewport and their numbers.
void checkThesis(
  const std::string& path, const dgtk::CameraRecord& camera, const std::vector<Sample>& samples, Worst& worst)
{
  std::ifstream file(path);
  std::string word;
  cv::Matx33d K;
  cv::Matx34d Rt;
  double viewport[4] = { NAN, NAN, NAN, NAN };
  file >> word;
  for (double& v : K.val)
  {
    file >> v;
  }
  file >> word;
  for (double& v : Rt.val)
  {
    file >> v;
  }
  file >> word >> viewport[0] >> viewport[1] >> viewport[2] >> viewport[3];
  if (!file || word != "Viewport" || viewport[3] != camera.height)
  {
    worst.update(INFINITY, path + ": not of the thesis's form");
    return;
  }
  const cv::Matx33d pixels(
    viewport[2] / 2, 0, viewport[0] + viewport[2] / 2, 0, viewport[3] / 2, viewport[1] + viewport[3] / 2, 0, 0, 1);
  const cv::Matx34d M = pixels * K * Rt;
  for (const Sample& sample : samples)
  {
    const cv::Vec3d p = M * cv::Vec4d(sample.world.x, sample.world.y, sample.world.z, 1);
    const cv::Point2d centre(p[0] / p[2], camera.height - p[1] / p[2]);
    worst.update(cv::norm(centre - sample.centre), path);
  }
}
} // namespace

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: TestCalibration DATASET\n");
    return 2;
  }
  const std::string folder = argv[1];
  Worst worst;
  std::size_t points = 0;
  for (const dgtk::CameraRecord& camera : dgtk::readCameras(folder + "/cameras.json"))
  {
    const std::string depthFile = fileOf(folder, camera, "depth", "npy");
    const dgtk::ImageData depth = dgtk::readLayerFile(depthFile);
    const std::vector<Sample> samples = unproject(camera, depth.pixels);
    points += samples.size();
    if (samples.empty())
    {
      continue;
    }
    if (camera.model == "pinhole")
    {
      checkOpenCV(camera, samples, depthFile, worst);
    }
    checkThesis(fileOf(folder, camera, "calibration", "txt"), camera, samples, worst);
  }
  std::printf("%zu points, largest reprojection error %.3g pixels %s\n", points, worst.distance, worst.where.c_str());
  return points > 0 && worst.distance < tolerance ? 0 : 1;
}
