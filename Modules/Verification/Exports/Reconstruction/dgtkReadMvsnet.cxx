// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

// MVSNet's "Input Data" (cams, pair.txt) and the scores of its colmap2mvsnet.py.

namespace dgtk
{

namespace
{
std::vector<std::string> allLines(const std::string& path)
{
  std::vector<std::string> lines;
  std::istringstream stream(readFile(path));
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

std::vector<double> numbersIn(const std::string& path, const std::vector<std::string>& lines, std::size_t at)
{
  std::vector<double> numbers;
  std::istringstream words(at < lines.size() ? lines[at] : "");
  for (std::string word; words >> word;)
  {
    numbers.push_back(numberIn(path, at + 1, word));
  }
  return numbers;
}

void judgeMvsnetCamera(ExportJudge& judge, const std::string& file, const ExportedName& picture)
{
  const std::string path = judge.source().path(file);
  const std::vector<std::string> lines = allLines(path);
  const bool whole =
    lines.size() == 12 && lines[0] == "extrinsic" && lines[5].empty() && lines[6] == "intrinsic" && lines[10].empty();
  judge.holds("camera", file, picture.name, whole, "other lines", "extrinsic, intrinsic and a range");
  if (!whole)
  {
    return;
  }
  std::vector<double> pose;
  std::vector<double> K;
  for (std::size_t row = 1; row < 10; row += row == 4 ? 3 : 1)
  {
    const std::vector<double> numbers = numbersIn(path, lines, row);
    std::vector<double>& all = row <= 4 ? pose : K;
    if (numbers.size() != (row <= 4 ? 4 : 3))
    {
      throw InputError(path, row + 1, "has another number of numbers");
    }
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  judge.pose(file, picture.camera, picture.frame, matrixOf(pose, 4), { pose[3], pose[7], pose[11] }, 1e-9);
  judge.holds("camera", file, picture.name,
    std::vector<double>(pose.begin() + 12, pose.end()) == std::vector<double>{ 0, 0, 0, 1 }, lines[4], "0 0 0 1");
  judge.intrinsics(file, picture.camera, picture.frame, matrixOf(K), 1e-9);
  const std::vector<double> range = numbersIn(path, lines, 11);
  const bool sound = range.size() == 4 && range[0] > 0 && range[3] > range[0] &&
                     std::abs(range[0] + range[1] * (range[2] - 1) - range[3]) <= 1e-9 * range[3];
  judge.holds("range", file, picture.name, sound, lines[11], "nearest, step, number, farthest");
  const PicturePointer depth = judge.source().picture(picture.camera, picture.frame, "depth");
  double least = infinite;
  double most = 0;
  for (int y = 0; y < depth->height(); ++y)
  {
    for (int x = 0; x < depth->width(); ++x)
    {
      const double z = depth->at(x, y);
      least = std::isfinite(z) ? std::min(least, z) : least;
      most = std::isfinite(z) ? std::max(most, z) : most;
    }
  }
  if (sound && most > 0 && judge.source().convention("depth_layer").empty())
  {
    judge.number("range", "", file, picture.name, range[0], least, 1e-9 * most);
    judge.number(
      "range", "", file, picture.name, range[3], most > (1 + 1e-6) * least ? most : 1.01 * least, 1e-9 * most);
  }
}

/// What two views see of points that stay, weighed by the angle between their rays.
double scoreOf(
  const ExportedFrom& source, const std::vector<TrackPoint>& points, const ExportedName& a, const ExportedName& b)
{
  const auto places = [&](const ExportedName& one)
  {
    const std::string file = source.file(one.camera, one.frame, "tracks", { "npy" });
    return readTrackPlaces(source.dataset() + '/' + file, points.size());
  };
  const auto centre = [&](const ExportedName& one)
  {
    const CameraRecord& camera = *source.camera(one.camera, one.frame);
    return Eigen::Vector3d(-(camera.R.transpose() * camera.t));
  };
  const std::vector<TrackPlace> first = places(a);
  const std::vector<TrackPlace> second = places(b);
  double score = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].isStatic && first[i].visibility == 1 && second[i].visibility == 1)
    {
      const Eigen::Vector3d one = centre(a) - points[i].x;
      const Eigen::Vector3d two = centre(b) - points[i].x;
      const double angle = std::atan2(one.cross(two).norm(), one.dot(two)) * 180 / EIGEN_PI;
      const double width = angle <= 5 ? 1 : 10;
      score += std::exp(-std::pow((angle - 5) / width, 2) / 2);
    }
  }
  return score;
}

void judgePairs(ExportJudge& judge, const std::string& file)
{
  const std::string path = judge.source().path(file);
  const std::vector<std::string> lines = allLines(path);
  const std::vector<ExportedName>& names = judge.source().record().names;
  const std::vector<TrackPoint> points = trackPointsOf(judge.source());
  judge.exact("pairs", "", file, "lines", double(lines.size()), double(2 * names.size() + 1));
  judge.holds("pairs", file, "views", numbersIn(path, lines, 0) == std::vector<double>{ double(names.size()) },
    lines.empty() ? "" : lines[0], std::to_string(names.size()));
  for (std::size_t i = 0; 2 * i + 2 < lines.size() && i < names.size(); ++i)
  {
    const std::vector<double> row = numbersIn(path, lines, 2 * i + 2);
    const std::string where = "view " + std::to_string(i);
    judge.holds("pairs", file, where, numbersIn(path, lines, 2 * i + 1) == std::vector<double>{ double(i) },
      lines[2 * i + 1], std::to_string(i));
    judge.exact("pairs", "", file, where, double(row.size()), row.empty() ? 1 : 2 * row[0] + 1);
    for (std::size_t k = 1; k + 1 < row.size(); k += 2)
    {
      const bool listed = row[k] >= 0 && row[k] < double(names.size());
      const std::size_t other = listed ? std::size_t(row[k]) : names.size();
      const bool known = listed && other != i && (k < 3 || row[k - 1] >= row[k + 1]);
      judge.holds("pairs", file, where, known, numberText(row[k]), "another view, the best first");
      if (known && (i % 16 == 0 || names.size() < 64)) // of many views some are looked at
      {
        const double expected = scoreOf(judge.source(), points, names[i], names[other]);
        judge.number("scores", "", file, where, row[k + 1], expected, 1e-5 * (1 + expected));
      }
    }
  }
}
} // namespace

void readMvsnet(ExportJudge& judge)
{
  for (const ExportedName& name : judge.source().record().names)
  {
    judgeMvsnetCamera(judge, "cams/" + stemOf(name.name) + "_cam.txt", name);
  }
  judgePairs(judge, "cams/pair.txt");
}

} // namespace dgtk
