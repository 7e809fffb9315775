// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"

#include <algorithm>
#include <cmath>

// calib.txt of Middlebury 2014 (vision.middlebury.edu/stereo/data/scenes2014) and of ETH3D.

namespace dgtk
{

namespace
{
/// "cam0=[f 0 cx; 0 f cy; 0 0 1]" and "doffs=1.5" as numbers.
std::map<std::string, std::vector<double>> calibrationOf(const std::string& path)
{
  std::map<std::string, std::vector<double>> found;
  std::size_t line = 0;
  for (std::vector<std::string> words : linesOf(path))
  {
    ++line;
    const std::size_t equals = words[0].find('=');
    if (equals == std::string::npos)
    {
      throw InputError(path, line, "expected KEY=VALUE");
    }
    std::vector<double>& numbers = found[words[0].substr(0, equals)];
    words[0].erase(0, equals + 1);
    for (std::string word : words)
    {
      word.erase(
        std::remove_if(word.begin(), word.end(), [](char c) { return c == '[' || c == ']' || c == ';'; }), word.end());
      numbers.push_back(numberIn(path, line, word));
    }
  }
  return found;
}

/// The least and the most of a picture's disparities; 0 and 0 for none.
std::pair<double, double> rangeOf(const ExportedFrom& source, const ExportedName& picture)
{
  const PicturePointer layer = source.picture(picture.camera, picture.frame, "disparity");
  double least = infinite;
  double most = -infinite;
  for (int i = 0; i < layer->width() * layer->height(); ++i)
  {
    const double value = layer->at(i % layer->width(), i / layer->width());
    least = std::isfinite(value) ? std::min(least, value) : least;
    most = std::isfinite(value) ? std::max(most, value) : most;
  }
  return most < least ? std::pair(0.0, 0.0) : std::pair(least, most);
}

void judgeCalibration(ExportJudge& judge, const std::string& file, const ExportedName& left, const ExportedName& right)
{
  const ExportedFrom& source = judge.source();
  const std::string path = source.path(file);
  const std::map<std::string, std::vector<double>> all = calibrationOf(path);
  const auto one = [&](const char* key) { return numbersOf(all, path, key, 1)[0]; };
  judge.size(file, left.camera, left.frame, int(one("width")), int(one("height")));
  judge.size(file, right.camera, right.frame, int(one("width")), int(one("height")));
  judge.intrinsics(file, left.camera, left.frame, fromWholeCentres(matrixOf(numbersOf(all, path, "cam0", 9))), 1e-9);
  judge.intrinsics(file, right.camera, right.frame, fromWholeCentres(matrixOf(numbersOf(all, path, "cam1", 9))), 1e-9);
  const CameraRecord* a = source.camera(left.camera, left.frame);
  const CameraRecord* b = source.camera(right.camera, right.frame);
  if (a && b)
  {
    judge.number("doffs", "px", file, "", one("doffs"), b->K(0, 2) - a->K(0, 2), 1e-9);
    judge.number("baseline", "mm", file, "", one("baseline"), (a->t - b->t).x() * metresOf(source) * 1000, 1e-9);
  }
  const auto [least, most] = rangeOf(source, left);
  judge.holds("range", file, "ndisp, vmin, vmax",
    one("ndisp") == std::max(1.0, std::floor(most) + 2) && one("vmax") == std::ceil(most) &&
      one("vmin") == std::floor(least) && one("isint") == 0,
    "another range", "that of all disparities");
  judge.exact("offsets", "px", file, "dyavg, dymax", std::abs(one("dyavg")) + std::abs(one("dymax")), 0);
}
} // namespace

void readStereo(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "", "txt"))
  {
    const std::string& file = one->file.path;
    const std::string folder = file.substr(0, file.rfind('/') + 1);
    const ExportedName* left = pictureOf(judge, file, folder + "im0.png");
    const ExportedName* right = pictureOf(judge, file, folder + "im1.png");
    if (left && right)
    {
      judgeCalibration(judge, file, *left, *right);
    }
  }
}

} // namespace dgtk
