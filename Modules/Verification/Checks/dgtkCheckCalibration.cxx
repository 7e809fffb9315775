// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include "dgtkError.h"

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

namespace dgtk
{

namespace
{
/// Pixels: the rounding of world points.
constexpr double calibrationTolerance = 1e-9;
/// Part of the largest number of a matrix, or of 1.
constexpr double matrixTolerance = 1e-9;

/// World points of the pixels of a row: the position of the file, or the depth unprojected.
struct RowPoints
{
  std::vector<int> columns;
  std::vector<cv::Point3d> points;
};

class CalibrationPoints
{
public:
  explicit CalibrationPoints(Picture& picture)
    : Owner(picture)
    , Position(picture.quietly([&] { return picture.values("position"); }))
    , Depth(picture.quietly([&] { return picture.values("depth"); }))
  {
    if (this->Position && this->Position->type() != PixelType::Float64)
    {
      this->Position = nullptr;
    }
    if (this->Depth && this->Depth->type() != PixelType::Float64)
    {
      this->Depth = nullptr;
    }
  }
  const PictureFile* file() const { return this->Position ? this->Position.get() : this->Depth.get(); }
  RowPoints row(int y) const
  {
    RowPoints row;
    for (int x = 0; x < this->Owner.width(); ++x)
    {
      const Eye& eye = this->Owner.sight(x, y).eye();
      Eigen::Vector3d X =
        this->Position ? this->Position->at3(x, y) : eye.toWorld(eye.at(centreOf(x, y), this->Depth->at(x, y)));
      X = this->Owner.time().rolls() ? this->Owner.eye().toWorld(eye.toCamera(X)) : X; // as if the camera stood still
      if (X.allFinite())
      {
        row.columns.push_back(x);
        row.points.emplace_back(X.x(), X.y(), X.z());
      }
    }
    return row;
  }

private:
  Picture& Owner;
  PicturePointer Position;
  PicturePointer Depth;
};

using Project = std::function<std::vector<cv::Point2d>(const std::vector<cv::Point3d>&)>;

/// The points of each pixel, projected, must give its centre.
Meter projectedPoints(
  Picture& picture, const CalibrationPoints& points, const std::string& file, const Project& project)
{
  return meterRows(picture.pool(), picture.height(), calibrationTolerance,
    [&](int y, Meter& meter)
    {
      const RowPoints row = points.row(y);
      if (row.points.empty())
      {
        return;
      }
      const std::vector<cv::Point2d> projected = project(row.points);
      for (std::size_t i = 0; i < projected.size(); ++i)
      {
        const cv::Point2d centre(row.columns[i] + 0.5, y + 0.5);
        const cv::Point3d& X = row.points[i];
        const double range =
          picture.eye().range(centreOf(row.columns[i], y), picture.eye().toCamera({ X.x, X.y, X.z }));
        meter.add(cv::norm(projected[i] - centre) / picture.eye().farness(range),
          [&] {
            return Offender{ file, row.columns[i], y, numbersText(&projected[i].x, 2), numbersText(&centre.x, 2) };
          });
      }
    });
}

void checkOpenCV(Picture& picture, const CalibrationPoints& points, Results& results)
{
  const CameraRecord& camera = picture.eye().record();
  cv::Matx33d K;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      K(i, j) = camera.K(i, j);
    }
  }
  if (K(0, 1) != 0) // projectPoints knows no skew
  {
    return;
  }
  // cv::Rodrigues() takes square roots of roundings near half a turn, which level cameras make that look along -z.
  const Eigen::AngleAxisd turn(camera.R);
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  const cv::Vec3d rotation(vector.x(), vector.y(), vector.z());
  const cv::Vec3d translation(camera.t.x(), camera.t.y(), camera.t.z());
  results.add({ "cv::projectPoints", "pixel", { points.file()->file() } },
    projectedPoints(picture, points, points.file()->file(),
      [&](const std::vector<cv::Point3d>& world)
      {
        std::vector<cv::Point2d> projected;
        cv::projectPoints(world, rotation, translation, K, cv::noArray(), projected);
        return projected;
      }));
}

/// Of a lens, whose rays are its model's: so that these are checked.
void checkLens(Picture& picture, const CalibrationPoints& points, Results& results)
{
  const EyeLens& lens = *picture.eye().lens();
  results.add({ lens.name(), "pixel", { points.file()->file() } },
    projectedPoints(picture, points, points.file()->file(),
      [&](const std::vector<cv::Point3d>& world)
      {
        std::vector<Eigen::Vector3d> x_in_camera;
        x_in_camera.reserve(world.size());
        for (const cv::Point3d& X : world)
        {
          x_in_camera.push_back(picture.eye().toCamera({ X.x, X.y, X.z }));
        }
        std::vector<cv::Point2d> projected;
        for (const Eigen::Vector2d& pixel : lens.project(x_in_camera))
        {
          projected.emplace_back(pixel.x(), pixel.y());
        }
        return projected;
      }));
}

void checkThesis(Picture& picture, const CalibrationPoints& points, const std::string& file, Results& results)
{
  const Calibration calibration = readCalibration(picture.dataset().absolute(file));
  const Eigen::Matrix<double, 3, 4> matrix = calibration.cameraMatrix();
  results.add(
    { "thesis", "pixel", { file } }, projectedPoints(picture, points, file,
                                       [&](const std::vector<cv::Point3d>& world)
                                       {
                                         std::vector<cv::Point2d> projected;
                                         for (const cv::Point3d& X : world)
                                         {
                                           const Eigen::Vector3d p = matrix * Eigen::Vector4d(X.x, X.y, X.z, 1);
                                           projected.emplace_back(p.x() / p.z(), picture.height() - p.y() / p.z());
                                         }
                                         return projected;
                                       }));
}

/// The same calibration as cameras.json, entry by entry.
void checkEntries(Picture& picture, const std::string& file, Results& results)
{
  const Calibration calibration = readCalibration(picture.dataset().absolute(file));
  Meter meter(matrixTolerance);
  const OpenGLMatrices matrices = openGLMatrices(picture.eye().view());
  const Calibration expected =
    makeCalibration(matrices.projection, matrices.modelView, picture.width(), picture.height());
  const auto compare = [&](const auto& found, const auto& right)
  {
    int i = 0;
    int j = 0;
    const double error = (found - right).cwiseAbs().maxCoeff(&i, &j) / std::max(1.0, right.cwiseAbs().maxCoeff());
    meter.add(error, [&] { return Offender{ file, -1, -1, numberText(found(i, j)), numberText(right(i, j)) }; });
  };
  compare(calibration.K, expected.K);
  compare(calibration.Rt, expected.Rt);
  const auto viewport = [](const Calibration& c) { return Eigen::Vector4d(c.x, c.y, c.width, c.height); };
  compare(viewport(calibration), viewport(expected));
  results.add({ "calibration", "relative", { file } }, meter);
}
} // namespace

void checkCalibration(Picture& picture, Results& results)
{
  const CalibrationPoints points(picture);
  const std::string text = picture.dataset().find(picture.camera(), "calibration", picture.frame(), { ".txt" });
  if (points.file() && picture.eye().pinhole())
  {
    checkOpenCV(picture, points, results);
  }
  else if (points.file() && picture.eye().lens() != nullptr)
  {
    checkLens(picture, points, results);
  }
  if (picture.eye().linear() && !text.empty())
  {
    checkEntries(picture, text, results);
    if (points.file())
    {
      checkThesis(picture, points, text, results);
    }
  }
}

} // namespace dgtk
