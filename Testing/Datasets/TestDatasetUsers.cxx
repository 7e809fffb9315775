// SPDX-License-Identifier: BSD-3-Clause
// OpenCV as a user of rendered datasets: what its matchers and its calibration find from the colours alone must be what
// the ground truth says. This catches wrong signs, axes and half pixels that agreement with ourselves would hide.
//
//   TestDatasetUsers stereo|flow|chessboard|lenses DIR
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkLayerReader.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

/// Largest difference in pixels that counts as agreement, and the part of the visible pixels that must agree.
constexpr double agreement = 1.0;
constexpr double wanted = 0.85;
/// Pixels: largest median of the signed differences, per axis (twice that for SGBM). The classic error is half a pixel.
constexpr double unbiased = 0.1;
/// Pixels: how well the chessboard must recover fx, fy, cx and cy.
constexpr double calibrated = 0.05;
/// The same of lenses, whose coefficients are found beside: a thousandth of fx; of cx and cy less than half a pixel.
constexpr double calibratedFocal = 0.266;
constexpr double calibratedCentre = 0.4;
/// Pixels: mean of what calibrations leave of the corners.
constexpr double reprojected = 0.03;
constexpr int border = 16; // pixels without a whole window around them

/// All rows of an image file; CV_64F for float64, CV_32F for float32, CV_8U for uint8.
cv::Mat load(const std::string& path)
{
  const std::unique_ptr<RowReader> reader = openLayerFile(path);
  const ImageInfo& info = reader->info();
  const Rows rows = reader->read(info.height);
  const int depth = info.type == PixelType::Float64 ? CV_64F : info.type == PixelType::Float32 ? CV_32F : CV_8U;
  if (bytesOf(info.type) != CV_ELEM_SIZE1(depth))
  {
    throw std::runtime_error(path + ": is of an unexpected type");
  }
  return cv::Mat(info.height, info.width, CV_MAKETYPE(depth, info.channels), const_cast<std::byte*>(rows.data()))
    .clone();
}

cv::Mat gray(const std::string& path)
{
  cv::Mat result;
  cv::cvtColor(load(path), result, cv::COLOR_RGB2GRAY);
  return result;
}

double median(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.empty() ? 0 : *middle;
}

/// What a matcher found minus the truth, at visible pixels.
class Differences
{
public:
  void add(const cv::Vec2d& difference)
  {
    this->Agreeing += cv::norm(difference) < agreement;
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Signed[axis].push_back(difference[axis]);
    }
  }

  /// 0 when enough pixels agree and none of the axes is off by more than `bound` on the whole; says so.
  int verdict(const char* what, double bound = unbiased)
  {
    const std::size_t all = this->Signed[0].size();
    const double part = all ? double(this->Agreeing) / double(all) : 0;
    const double bias[2] = { median(this->Signed[0]), median(this->Signed[1]) };
    std::printf("%s: %zu of %zu visible pixels (%.1f %%) within %g pixel, median difference %+.3f, %+.3f\n", what,
      this->Agreeing, all, 100 * part, agreement, bias[0], bias[1]);
    return part >= wanted && all > 10000 && std::max(std::abs(bias[0]), std::abs(bias[1])) < bound ? 0 : 1;
  }

private:
  std::size_t Agreeing = 0;
  std::vector<double> Signed[2];
};

int stereo(const std::string& folder)
{
  const cv::Mat left = gray(folder + "/left/color/000000.png");
  const cv::Mat right = gray(folder + "/right/color/000000.png");
  const auto matcher = cv::StereoSGBM::create(0, 64, 5, 8 * 25, 32 * 25, 1, 0, 5, 50, 2);
  cv::Mat found;
  matcher->compute(left, right, found); // 1/16 pixel
  cv::Mat flow; // finer than SGBM, which counts sixteenths and leans to one side by more than two of them
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(left, right, flow);
  const cv::Mat truth = load(folder + "/left/disparity/000000.pfm");
  const cv::Mat classes = load(folder + "/left/disparity/000000.png");
  Differences blocks, rows;
  for (int y = border; y < left.rows - border; ++y)
  {
    for (int x = 64 + border; x < left.cols - border; ++x)
    {
      if (classes.at<unsigned char>(y, x) == 1)
      {
        const double disparity = truth.at<float>(y, x);
        blocks.add({ found.at<short>(y, x) / 16.0 - disparity, 0 });
        rows.add(cv::Vec2d(-flow.at<cv::Vec2f>(y, x)[0] - disparity, flow.at<cv::Vec2f>(y, x)[1]));
      }
    }
  }
  return blocks.verdict("StereoSGBM", 2 * unbiased) | rows.verdict("DIS, left to right");
}

int flowWith(const char* name, const cv::Mat& found, const cv::Mat& truth, const cv::Mat& classes)
{
  Differences differences;
  for (int y = border; y < truth.rows - border; ++y)
  {
    for (int x = border; x < truth.cols - border; ++x)
    {
      if (classes.at<unsigned char>(y, x) == 1)
      {
        differences.add(cv::Vec2d(found.at<cv::Vec2f>(y, x) - truth.at<cv::Vec2f>(y, x)));
      }
    }
  }
  return differences.verdict(name);
}

int flow(const std::string& folder)
{
  int failed = 0;
  for (const int step : { 1, -1 })
  {
    const cv::Mat one = gray(folder + "/camera/color/000001.png");
    const cv::Mat two = gray(folder + (step > 0 ? "/camera/color/000002.png" : "/camera/color/000000.png"));
    const std::string layer = folder + (step > 0 ? "/camera/flow_forward" : "/camera/flow_backward");
    const cv::Mat truth = load(layer + "/000001.flo");
    const cv::Mat classes = load(layer + "/000001.png");
    cv::Mat found;
    cv::calcOpticalFlowFarneback(one, two, found, 0.5, 4, 13, 5, 7, 1.5, 0);
    failed |= flowWith(step > 0 ? "Farneback, forward" : "Farneback, backward", found, truth, classes);
    cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(one, two, found = cv::Mat());
    failed |= flowWith(step > 0 ? "DIS, forward" : "DIS, backward", found, truth, classes);
    double largest = 0;
    cv::minMaxLoc(cv::abs(truth.reshape(1)), nullptr, &largest, nullptr, nullptr, truth.reshape(1) < 1e9);
    std::printf("largest flow: %.1f pixels\n", largest);
  }
  return failed;
}

/// Corners of the board in the pictures of a camera.
struct Boards
{
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> corners;
  cv::Size size;
  std::size_t pictures = 0;
};

/// Moves corners to where the edges around them meet, each seen as far as no other corner is near.
void refine(const cv::Mat& picture, std::vector<cv::Point2f>& corners)
{
  cv::Mat smooth; // the differences of sharp pixels lean to their centres
  cv::GaussianBlur(picture, smooth, cv::Size(), 1.5);
  const std::vector<cv::Point2f> rough = corners;
  for (cv::Point2f& corner : corners)
  {
    double space = picture.cols;
    for (const cv::Point2f& other : rough)
    {
      space = other == corner ? space : std::min(space, cv::norm(other - corner));
    }
    const int half = int(0.6 * space);
    std::vector<cv::Point2f> one{ corner };
    cv::cornerSubPix(
      smooth, one, { half, half }, { -1, -1 }, { cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-4 });
    corner = one[0];
  }
}

Boards findBoards(const std::string& folder, const std::string& name, const std::vector<CameraRecord>& cameras)
{
  const cv::Size inner(9, 6);
  constexpr float square = 0.03f;
  std::vector<cv::Point3f> board;
  for (int j = 0; j < inner.height; ++j)
  {
    for (int i = 0; i < inner.width; ++i)
    {
      board.emplace_back(square * float(i), square * float(j), 0.0f);
    }
  }
  Boards boards;
  for (const CameraRecord& camera : cameras)
  {
    if (camera.name != name)
    {
      continue;
    }
    char file[64];
    std::snprintf(file, sizeof file, "/%s/color/%06d.png", camera.name.c_str(), camera.frame);
    const cv::Mat picture = gray(folder + file);
    boards.size = picture.size();
    ++boards.pictures;
    std::vector<cv::Point2f> found;
    if (cv::findChessboardCorners(picture, inner, found, cv::CALIB_CB_FAST_CHECK))
    {
      refine(picture, found);
      for (cv::Point2f& corner : found)
      {
        corner += cv::Point2f(0.5f, 0.5f); // OpenCV counts from the centre of the first pixel
      }
      boards.points.push_back(board);
      boards.corners.push_back(found);
    }
  }
  return boards;
}

/// Root of the mean square of what is left, pixels; K receives the camera's matrix.
double calibrate(const CameraRecord& camera, const Boards& boards, cv::Mat& K)
{
  const auto distortion = camera.numbers.find("distortion");
  const std::size_t numbers = distortion == camera.numbers.end() ? 0 : distortion->second.size();
  cv::Mat found;
  std::vector<cv::Mat> rotations, translations;
  if (camera.model == "fisheye")
  {
    return cv::fisheye::calibrate(boards.points, boards.corners, boards.size, K, found, rotations, translations,
      cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
  }
  const int none = cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
  return cv::calibrateCamera(boards.points, boards.corners, boards.size, K, found, rotations, translations,
    numbers == 0   ? none
    : numbers == 8 ? cv::CALIB_RATIONAL_MODEL
                   : 0);
}

/// Pixels.
struct Bounds
{
  double focal;
  double centre;
};

int calibrateBy(const std::string& folder, const std::string& name, const Bounds& bounds)
{
  const std::vector<CameraRecord> cameras = readCameras(folder + "/cameras.json");
  const CameraRecord& camera =
    *std::find_if(cameras.begin(), cameras.end(), [&](const CameraRecord& one) { return one.name == name; });
  const Boards boards = findBoards(folder, name, cameras);
  cv::Mat K = cv::Mat::eye(3, 3, CV_64F);
  const double error = calibrate(camera, boards, K);
  const Eigen::Matrix3d& truth = camera.K;
  double largest = 0;
  const int places[4][2] = { { 0, 0 }, { 1, 1 }, { 0, 2 }, { 1, 2 } };
  const char* const names[4] = { "fx", "fy", "cx", "cy" };
  for (int k = 0; k < 4; ++k)
  {
    const double value = K.at<double>(places[k][0], places[k][1]);
    const double expected = truth(places[k][0], places[k][1]);
    std::printf("%s %.4f, truth %.4f, difference %+.4f\n", names[k], value, expected, value - expected);
    largest = std::max(largest, std::abs(value - expected) / (k < 2 ? bounds.focal : bounds.centre));
  }
  std::printf("%s: chessboard found in %zu of %zu pictures, reprojection error %.4f pixel\n", name.c_str(),
    boards.corners.size(), boards.pictures, error);
  return boards.corners.size() >= 12 && largest <= 1 && error <= reprojected ? 0 : 1;
}

int chessboard(const std::string& folder) { return calibrateBy(folder, "camera", { calibrated, calibrated }); }

/// Cameras with lenses: of their parameters OpenCV finds those that it was given.
int lenses(const std::string& folder)
{
  int failed = 0;
  for (const char* name : { "five", "eight", "fisheye" })
  {
    failed = std::max(failed, calibrateBy(folder, name, { calibratedFocal, calibratedCentre }));
  }
  return failed;
}
} // namespace

int main(int argc, char** argv)
{
  try
  {
    cv::setNumThreads(1); // those that wait would spin
    const std::string kind = argc == 3 ? argv[1] : "";
    const std::map<std::string, int (*)(const std::string&)> kinds{ { "stereo", &stereo }, { "flow", &flow },
      { "chessboard", &chessboard }, { "lenses", &lenses } };
    if (kinds.count(kind) != 0)
    {
      return kinds.at(kind)(argv[2]);
    }
    std::fprintf(stderr, "usage: TestDatasetUsers stereo|flow|chessboard|lenses DIR\n");
    return 2;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
