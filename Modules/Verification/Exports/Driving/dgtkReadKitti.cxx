// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

// KITTI's development kits (stereo/flow 2015, raw data): calib_cam_to_cam.txt.

namespace dgtk
{

namespace
{
using Numbers = std::map<std::string, std::vector<double>>;

double expectedBaseline(const ExportedFrom& source, const ExportedName& left, const ExportedName& right)
{
  const CameraRecord* a = source.camera(left.camera, left.frame);
  const CameraRecord* b = source.camera(right.camera, right.frame);
  return a && b ? (a->t - b->t).x() * metresOf(source) : infinite;
}

/// Camera `number` of calib_cam_to_cam.txt, which shows a picture; metres from the left camera to it.
void judgeCamera(ExportJudge& judge, const std::string& file, const Numbers& all, const std::string& number,
  const ExportedName& picture, double offset)
{
  const std::string path = judge.source().path(file);
  const std::vector<double>& P = numbersOf(all, path, "P_rect_" + number, 12);
  const std::vector<double>& size = numbersOf(all, path, "S_rect_" + number, 2);
  const std::vector<double>& T = numbersOf(all, path, "T_" + number, 3);
  judge.size(file, picture.camera, picture.frame, int(size[0]), int(size[1]));
  judge.holds("size", file, "S_" + number, numbersOf(all, path, "S_" + number, 2) == size, "another", "S_rect's");
  judge.holds("distortion", file, "D_" + number, numbersOf(all, path, "D_" + number, 5) == std::vector<double>(5, 0.0),
    "another", "none");
  judge.intrinsics(file, picture.camera, picture.frame, fromWholeCentres(matrixOf(P, 4)), 1e-9);
  judge.intrinsics(
    file, picture.camera, picture.frame, fromWholeCentres(matrixOf(numbersOf(all, path, "K_" + number, 9))), 1e-9);
  const std::string where = "camera " + number;
  judge.number("baseline", "m", file, where, P[3] / P[0], offset, 1e-9);
  judge.number("baseline", "m", file, where, T[0], offset, 1e-9);
  judge.exact("baseline", "m", file, where, P[7] + P[11] + T[1] + T[2], 0);
  static const std::vector<double> none{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  judge.holds("rotation", file, where,
    numbersOf(all, path, "R_rect_" + number, 9) == none && numbersOf(all, path, "R_" + number, 9) == none, "another",
    "none");
}

void judgeCamToCam(ExportJudge& judge, const std::string& file, const ExportedName& left, const ExportedName* right)
{
  const Numbers all = keyedNumbers(judge.source().path(file));
  const double baseline = right ? -expectedBaseline(judge.source(), left, *right) : 0;
  for (const char* number : { "00", "02" })
  {
    judgeCamera(judge, file, all, number, left, 0);
  }
  for (const char* number : { "01", "03" })
  {
    judgeCamera(judge, file, all, number, right ? *right : left, baseline);
  }
}
} // namespace

void readKitti2015(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "training/calib_cam_to_cam/", "txt"))
  {
    const std::string& file = one->file.path;
    const std::string number = stemOf(file);
    const ExportedName* left = pictureOf(judge, file, "training/image_2/" + number + "_10.png");
    const ExportedName* right = pictureOf(judge, file, "training/image_3/" + number + "_10.png");
    if (left && right)
    {
      judgeCamToCam(judge, file, *left, right);
    }
  }
}

void readKittiDepth(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "", "txt"))
  {
    judgeCamToCam(judge, one->file.path, { one->file.camera, one->file.frame, "" }, nullptr);
  }
}

} // namespace dgtk
