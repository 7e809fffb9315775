// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"

#include <algorithm>
#include <cmath>

// KITTI's odometry kit (readme.txt: calib.txt, times.txt, poses) and the file formats of the TUM RGB-D benchmark.

namespace dgtk
{

namespace
{
/// Seconds of a frame; what cannot be is no number.
double timeOf(const ExportedFrom& source, int frame) { return frame / source.manifest().fps; }

/// The pictures of a folder of a sequence, in their order.
std::vector<const ExportedName*> picturesIn(const ExportedFrom& source, const std::string& folder)
{
  std::vector<const ExportedName*> pictures;
  while (const ExportedName* next = source.named(folder + digitsOf(pictures.size(), 6) + ".png"))
  {
    pictures.push_back(next);
  }
  return pictures;
}

void judgeTimes(ExportJudge& judge, const std::string& file, const std::vector<const ExportedName*>& pictures)
{
  const std::string path = judge.source().path(file);
  const auto lines = linesOf(path);
  judge.exact("times", "lines", file, "", double(lines.size()), double(pictures.size()));
  for (std::size_t i = 0; i < std::min(lines.size(), pictures.size()); ++i)
  {
    const double expected =
      timeOf(judge.source(), pictures[i]->frame) - timeOf(judge.source(), pictures.front()->frame);
    const double found = numbersIn(path, i + 1, lines[i], 1)[0];
    judge.number("time", "s", file, "line " + std::to_string(i + 1), found, expected, 1e-9 * (1 + expected));
  }
}

void judgePoses(ExportJudge& judge, const std::string& file, const std::vector<const ExportedName*>& pictures)
{
  const std::string path = judge.source().path(file);
  const auto lines = linesOf(path);
  judge.exact("poses", "lines", file, "", double(lines.size()), double(pictures.size()));
  const CameraRecord* first = judge.source().camera(pictures.front()->camera, pictures.front()->frame);
  for (std::size_t i = 0; first && i < std::min(lines.size(), pictures.size()); ++i)
  {
    const std::vector<double> n = numbersIn(path, i + 1, lines[i], 12);
    const Eigen::Matrix3d turn = matrixOf(n, 4);
    const Eigen::Vector3d shift = Eigen::Vector3d(n[3], n[7], n[11]) / metresOf(judge.source());
    const Eigen::Matrix3d R = turn.transpose() * first->R;
    judge.pose(file, pictures[i]->camera, pictures[i]->frame, R, turn.transpose() * (first->t - shift), 1e-9);
    judge.holds("first pose", file, "line " + std::to_string(i + 1),
      i > 0 || (turn == Eigen::Matrix3d::Identity() && shift.isZero(0)), "another", "the identity");
  }
}

void judgeProjections(ExportJudge& judge, const std::string& file, const std::vector<const ExportedName*>& lefts,
  const std::vector<const ExportedName*>& rights)
{
  const ExportedFrom& source = judge.source();
  const std::string path = source.path(file);
  const auto all = keyedNumbers(path);
  for (const char* key : { "P0", "P1", "P2", "P3" })
  {
    const bool isRight = !rights.empty() && (key[1] == '1' || key[1] == '3');
    const ExportedName& picture = *(isRight ? rights : lefts).front();
    const std::vector<double>& P = numbersOf(all, path, key, 12);
    Eigen::Matrix3d K;
    K << P[0], P[1], P[2] + 0.5, P[4], P[5], P[6] + 0.5, P[8], P[9], P[10];
    judge.intrinsics(file, picture.camera, picture.frame, K, 1e-9);
    const CameraRecord* a = source.camera(lefts.front()->camera, lefts.front()->frame);
    const CameraRecord* b = source.camera(picture.camera, picture.frame);
    const double expected = a && b && isRight ? (b->t - a->t).x() * metresOf(source) : 0;
    judge.number("baseline", "m", file, key, P[3] / P[0], expected, 1e-9);
    judge.exact("baseline", "m", file, key, std::abs(P[7]) + std::abs(P[11]), 0);
  }
  static const std::vector<double> scanner{ 0, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0 };
  judge.holds("scanner", file, "Tr", numbersOf(all, path, "Tr", 12) == scanner, "another", "x forward, y left, z up");
}
} // namespace

void readKittiOdometry(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "poses/", "txt"))
  {
    const std::string folder = "sequences/" + stemOf(one->file.path) + '/';
    const auto lefts = picturesIn(judge.source(), folder + "image_2/");
    const auto rights = picturesIn(judge.source(), folder + "image_3/");
    judge.holds("pictures", one->file.path, folder, !lefts.empty() && (rights.empty() || rights.size() == lefts.size()),
      std::to_string(lefts.size()) + " and " + std::to_string(rights.size()), "as many on both sides");
    if (!lefts.empty())
    {
      judgePoses(judge, one->file.path, lefts);
      judgeTimes(judge, folder + "times.txt", lefts);
      judgeProjections(judge, folder + "calib.txt", lefts, rights);
    }
  }
}

namespace
{
/// ICL-NUIM's dialect: numbers in place of times, depth before colour, y up in camera and world.
bool isIcl(const ExportedFrom& source) { return source.convention("dialect") == "icl-nuim"; }

struct TumPicture
{
  std::string time;
  std::string file;
  const ExportedName* picture = nullptr;
};

/// "TIME FILE" lines; the picture is the one that the file shows.
std::vector<TumPicture> listOf(ExportJudge& judge, const std::string& folder, const std::string& name)
{
  const std::string file = folder + name;
  const std::string path = judge.source().path(file);
  std::vector<TumPicture> list;
  for (const std::vector<std::string>& words : linesOf(path))
  {
    if (words.size() != 2)
    {
      throw InputError(path, list.size() + 1, "expected a time and a file");
    }
    const ExportedFile* found = judge.source().exported(folder + words[1]);
    judge.holds("names", file, words[1], found != nullptr, "a file", "one of the export");
    const ExportedName* picture = found ? judge.source().nameOf(found->file.camera, found->file.frame) : nullptr;
    if (picture)
    {
      const double time = numberIn(path, list.size() + 1, words[0]);
      const bool numbered = isIcl(judge.source());
      const double expected = numbered ? picture->frame : timeOf(judge.source(), picture->frame);
      judge.number("time", "s", file, words[1], time, expected, numbered ? 0 : 5.01e-7);
    }
    list.push_back({ words[0], words[1], picture });
  }
  return list;
}

void judgeTrajectory(ExportJudge& judge, const std::string& file, const std::vector<TumPicture>& pictures)
{
  const std::string path = judge.source().path(file);
  const auto lines = linesOf(path);
  judge.exact("poses", "lines", file, "", double(lines.size()), double(pictures.size()));
  for (std::size_t i = 0; i < std::min(lines.size(), pictures.size()); ++i)
  {
    const std::vector<double> n = numbersIn(path, i + 1, lines[i], 8);
    judge.holds(
      "time", file, "line " + std::to_string(i + 1), lines[i][0] == pictures[i].time, lines[i][0], pictures[i].time);
    Eigen::Matrix3d R = rotationOf({ n[4], n[5], n[6], n[7] }).transpose();
    Eigen::Vector3d place = Eigen::Vector3d(n[1], n[2], n[3]) / metresOf(judge.source());
    if (isIcl(judge.source()))
    {
      place[1] = -place[1];
      R.row(1) = -R.row(1);
      R.col(1) = -R.col(1);
    }
    if (pictures[i].picture)
    {
      judge.pose(file, pictures[i].picture->camera, pictures[i].picture->frame, R, -(R * place), 1e-9);
    }
  }
}

void judgeSequence(ExportJudge& judge, const std::string& folder)
{
  const std::vector<TumPicture> rgb = listOf(judge, folder, "rgb.txt");
  const std::vector<TumPicture> depth = listOf(judge, folder, "depth.txt");
  judge.exact("associations", "lines", folder + "depth.txt", "", double(depth.size()), double(rgb.size()));
  judgeTrajectory(judge, folder + "groundtruth.txt", rgb);
  const bool eth = judge.source().convention("dialect") == "eth3d-slam";
  const std::string file = folder + (eth ? "associated.txt" : "associations.txt");
  const auto lines = linesOf(judge.source().path(file));
  judge.exact("associations", "lines", file, "", double(lines.size()), double(rgb.size()));
  for (std::size_t i = 0; i < std::min({ lines.size(), rgb.size(), depth.size() }); ++i)
  {
    std::vector<std::string> expected{ rgb[i].time, rgb[i].file, depth[i].time, depth[i].file };
    if (isIcl(judge.source()))
    {
      std::rotate(expected.begin(), expected.begin() + 2, expected.end());
    }
    judge.holds("associations", file, "line " + std::to_string(i + 1),
      lines[i] == expected && rgb[i].picture && rgb[i].picture == depth[i].picture, "others",
      "the picture's own depth map");
  }
  const std::string calibration = folder + "calibration.txt";
  const auto numbers = linesOf(judge.source().path(calibration));
  judge.exact("intrinsics", "lines", calibration, "", double(numbers.size()), 1);
  for (const TumPicture& one : rgb)
  {
    const std::vector<double> n =
      numbersIn(judge.source().path(calibration), 1, numbers.empty() ? std::vector<std::string>() : numbers[0], 4);
    Eigen::Matrix3d K;
    K << n[0], 0, n[2] + 0.5, 0, isIcl(judge.source()) ? -n[1] : n[1], n[3] + 0.5, 0, 0, 1;
    if (one.picture)
    {
      judge.intrinsics(calibration, one.picture->camera, one.picture->frame, K, 1e-9);
    }
  }
}
} // namespace

void readTum(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "", "txt"))
  {
    const std::string& file = one->file.path;
    if (stemOf(file) == "rgb")
    {
      judgeSequence(judge, file.substr(0, file.rfind('/') + 1));
    }
  }
}

} // namespace dgtk
