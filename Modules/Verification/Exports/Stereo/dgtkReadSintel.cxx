// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <cstring>

// sintel_io.py (cam_read) and the layout of SceneFlow's camera_data.txt.

namespace dgtk
{

namespace
{
void judgeCamera(ExportJudge& judge, const std::string& file, const ExportedName& picture)
{
  const std::string path = judge.source().path(file);
  const std::string bytes = readFile(path);
  float tag = 0;
  double numbers[21] = {};
  if (bytes.size() != sizeof tag + sizeof numbers)
  {
    throw InputError(path, "is no camera of Sintel: " + std::to_string(bytes.size()) + " bytes");
  }
  std::memcpy(&tag, bytes.data(), sizeof tag);
  std::memcpy(numbers, bytes.data() + sizeof tag, sizeof numbers);
  judge.holds("tag", file, "", tag == 202021.25F, "another", "202021.25");
  const std::vector<double> pose(std::begin(numbers) + 9, std::end(numbers));
  judge.intrinsics(file, picture.camera, picture.frame,
    fromWholeCentres(matrixOf({ std::begin(numbers), std::begin(numbers) + 9 })), 1e-9);
  judge.pose(file, picture.camera, picture.frame, matrixOf(pose, 4), { numbers[12], numbers[16], numbers[20] }, 0);
}
} // namespace

void readSintel(ExportJudge& judge)
{
  const std::string folder = "training/camdata_left/";
  for (const ExportedFile* one : filesIn(judge.source(), folder, "cam"))
  {
    const std::string& file = one->file.path;
    const std::string place = file.substr(folder.size(), file.rfind('.') - folder.size());
    if (const ExportedName* picture = pictureOf(judge, file, "training/final/" + place + ".png"))
    {
      judgeCamera(judge, file, *picture);
    }
  }
}

namespace
{
/// "L T00 T01 ... T33": the world from a camera that looks along -z, y up.
void judgeMatrix(ExportJudge& judge, const std::string& file, std::size_t line, const std::vector<std::string>& words,
  const std::string& side, const std::string& name)
{
  const std::string path = judge.source().path(file);
  if (words.size() != 17 || words[0] != side)
  {
    throw InputError(path, line, "expected " + side + " and 16 numbers");
  }
  Eigen::Matrix4d world;
  for (int i = 0; i < 16; ++i)
  {
    world(i / 4, i % 4) = numberIn(path, line, words[std::size_t(i) + 1]);
  }
  judge.holds("last row", file, name, world.row(3) == Eigen::RowVector4d(0, 0, 0, 1), "another", "0 0 0 1");
  if (const ExportedName* picture = pictureOf(judge, file, name))
  {
    Eigen::Matrix3d turn = world.topLeftCorner<3, 3>();
    turn.col(1) *= -1;
    turn.col(2) *= -1;
    const Eigen::Matrix3d R = turn.transpose();
    judge.pose(file, picture->camera, picture->frame, R, -(R * world.topRightCorner<3, 1>()), 1e-9);
  }
}

void judgeSintelSequence(ExportJudge& judge, const std::string& file)
{
  const std::string path = judge.source().path(file);
  const std::string begin = "camera_data/";
  const std::string sequence = file.substr(begin.size(), file.rfind('/') + 1 - begin.size());
  const auto lines = linesOf(path);
  std::size_t frames = 0;
  for (std::size_t i = 0; i + 3 < lines.size(); i += 4, ++frames)
  {
    if (lines[i].size() != 2 || lines[i][0] != "Frame" || lines[i + 3] != std::vector<std::string>{ "" })
    {
      throw InputError(path, i + 1, "expected Frame, L, R and an empty line");
    }
    const std::string digits = digitsOf(lines[i][1], 4);
    const std::string folder = "frames_finalpass/" + sequence;
    judgeMatrix(judge, file, i + 2, lines[i + 1], "L", folder + "left/" + digits + ".png");
    judgeMatrix(judge, file, i + 3, lines[i + 2], "R", folder + "right/" + digits + ".png");
  }
  judge.exact("frames", "", file, "", double(frames),
    double(filesIn(judge.source(), "frames_finalpass/" + sequence + "left/", "png").size()));
}
} // namespace

void readFlyingThings(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "camera_data/", "txt"))
  {
    judgeSintelSequence(judge, one->file.path);
  }
}

} // namespace dgtk
