// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <functional>

// KITTI's object development kit, readme.txt: labels of 15 columns, calib/*.txt.

namespace dgtk
{

namespace
{
using Corners = Eigen::Matrix<double, 8, 3>;

struct KittiLabel
{
  std::string type;
  std::vector<double> numbers; ///< truncated, occluded, alpha, left top right bottom, h w l, x y z, ry
};

std::vector<KittiLabel> labelsOf(const std::string& path)
{
  std::vector<KittiLabel> labels;
  std::size_t line = 0;
  for (const std::vector<std::string>& words : linesOf(path))
  {
    ++line;
    if (words.size() != 15)
    {
      throw InputError(path, line, "expected 15 columns, found " + std::to_string(words.size()));
    }
    KittiLabel label{ words[0], {} };
    for (std::size_t i = 1; i < words.size(); ++i)
    {
      label.numbers.push_back(numberIn(path, line, words[i]));
    }
    labels.push_back(label);
  }
  return labels;
}

/// As the kit draws them: x by length, y from the bottom up, z by width, turned by ry about y.
Corners cornersOf(const KittiLabel& label)
{
  const std::vector<double>& n = label.numbers;
  const double c = std::cos(n[13]);
  const double s = std::sin(n[13]);
  Corners corners;
  for (int i = 0; i < 8; ++i)
  {
    const double x = (i & 1 ? 0.5 : -0.5) * n[9];
    const double y = i & 2 ? 0 : -n[7];
    const double z = (i & 4 ? 0.5 : -0.5) * n[8];
    corners.row(i) << n[10] + c * x + s * z, n[11] + y, n[12] - s * x + c * z;
  }
  return corners;
}

/// The largest distance of a corner of one box from the nearest of the other.
double apart(const Corners& a, const Corners& b)
{
  double largest = 0;
  for (int i = 0; i < 8; ++i)
  {
    largest = larger(largest, (b.rowwise() - a.row(i)).rowwise().norm().minCoeff());
  }
  return largest;
}

/// How far corners of a box may be from those of one that is turned by some degrees about its centre.
double slackOf(const Corners& box, double degrees)
{
  const Eigen::RowVector3d centre = box.colwise().mean();
  return (box.rowwise() - centre).rowwise().norm().maxCoeff() * 2 * std::sin(degrees * pi / 360);
}

double statedTilt(const ExportedFrom& source)
{
  for (const LayerRounding& one : source.record().layers)
  {
    if (one.layer == "boxes")
    {
      return one.largest;
    }
  }
  return 0;
}

std::string option(const ExportedFrom& source, const std::string& name)
{
  for (const auto& [key, value] : source.record().request)
  {
    if (key == name)
    {
      return value;
    }
  }
  return "";
}

struct LabelPlace
{
  std::string file;
  std::string words; ///< which object
};

/// The class as a word: other bytes than letters, digits and '-' are '_', and "_N" follows where two classes are one
/// word.
bool isTypeOf(const std::string& type, const std::string& objectClass)
{
  std::string expected = objectClass.empty() ? "Misc" : objectClass;
  const auto isPlain = [](char c)
  { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-'; };
  std::replace_if(expected.begin(), expected.end(), std::not_fn(isPlain), '_');
  const std::string more = type.rfind(expected, 0) == 0 ? type.substr(expected.size()) : "another";
  return (more.empty() && expected != "DontCare") ||
         (more[0] == '_' && more.size() > 1 && more.find_first_not_of("0123456789", 1) == std::string::npos);
}

void judgeLabel(ExportJudge& judge, const LabelPlace& place, const KittiLabel& label, const BoxRecord& box)
{
  const std::vector<double>& n = label.numbers;
  const auto number = [&](const char* what, const char* unit, double found, double expected, double tolerance)
  { judge.number(what, unit, place.file, place.words, found, expected, tolerance); };
  const Eigen::Vector4d flat = option(judge.source(), "label_boxes") == "visible" ? *box.visible : *box.amodal;
  for (int i = 0; i < 4; ++i)
  {
    number("box", "px", n[std::size_t(3 + i)], flat[i] - (i < 2 ? 0 : 1), 0);
  }
  const double whole = double(std::max(box.pixelsWhole, box.pixelsAmodal));
  number("truncated", "1", n[0], (whole - double(box.pixelsAmodal)) / whole, 1e-12);
  const double hidden = double(box.pixelsAmodal - box.pixelsVisible) / double(box.pixelsAmodal);
  number("occluded", "1", n[1], double(hidden > 0.1) + double(hidden > 0.5), 0);
  number("alpha", "rad", std::remainder(n[2] - (n[13] - std::atan2(n[10], n[12])), 2 * pi), 0, 1e-12);
  const Corners expected = box.corners * metresOf(judge.source());
  const Corners found = cornersOf(label);
  const double off = larger(apart(found, expected), apart(expected, found));
  const double slack = slackOf(expected, statedTilt(judge.source()) + 1e-4);
  number("box 3d", "m", beyond(off, slack), 0, 1e-9);
  number("box 3d centre", "m", (found.colwise().mean() - expected.colwise().mean()).norm(), 0, 1e-9);
  judge.holds("type", place.file, place.words, isTypeOf(label.type, box.objectClass), label.type, box.objectClass);
}

/// The side that an object shows ahead: the length is along the axis that the export was asked for.
void judgeFront(ExportJudge& judge, const LabelPlace& place, const KittiLabel& label, const BoxRecord& box)
{
  const std::string front = option(judge.source(), "front");
  const int axis = front.empty() ? 0 : front.back() - 'x';
  const Eigen::RowVector3d edge = box.corners.row(1 << axis) - box.corners.row(0);
  judge.number("length", "m", place.file, place.words, label.numbers[9], edge.norm() * metresOf(judge.source()), 1e-9);
  const Eigen::Vector3d ahead(std::cos(label.numbers[13]), 0, -std::sin(label.numbers[13]));
  const double along = edge.normalized().dot(ahead.transpose()) * (front[0] == '-' ? -1 : 1);
  const double most = (statedTilt(judge.source()) + 1e-4) * pi / 180;
  if (edge.norm() > 0)
  {
    judge.number(
      "front", "rad", place.file, place.words, std::max(0.0, std::acos(std::min(1.0, along)) - most - 1e-7), 0, 1e-9);
  }
}

void judgeCalibration(ExportJudge& judge, const std::string& file, const ExportedName& picture)
{
  const std::string path = judge.source().path(file);
  const std::map<std::string, std::vector<double>> all = keyedNumbers(path);
  for (const char* name : { "P0", "P1", "P2", "P3" })
  {
    const std::vector<double>& P = numbersOf(all, path, name, 12);
    Eigen::Matrix3d K;
    K << P[0], P[1], P[2] + 0.5, P[4], P[5], P[6] + 0.5, P[8], P[9], P[10];
    judge.intrinsics(file, picture.camera, picture.frame, K, 1e-9);
    judge.exact("baseline", "m", file, name, std::abs(P[3]) + std::abs(P[7]) + std::abs(P[11]), 0);
  }
  static const std::vector<double> none{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  judge.holds("rotation", file, "R0_rect", numbersOf(all, path, "R0_rect", 9) == none, "another", "none");
  static const std::vector<double> scanner{ 0, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0 };
  judge.holds("scanner", file, "Tr_velo_to_cam", numbersOf(all, path, "Tr_velo_to_cam", 12) == scanner, "another",
    "axes x forward, y left, z up");
  static const std::vector<double> same{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  judge.holds(
    "scanner", file, "Tr_imu_to_velo", numbersOf(all, path, "Tr_imu_to_velo", 12) == same, "another", "no turn");
}

void judgeLabels(ExportJudge& judge, const std::string& file, const ExportedName& picture)
{
  std::vector<BoxRecord> boxes = judge.source().boxes(picture.camera, picture.frame);
  boxes.erase(
    std::remove_if(boxes.begin(), boxes.end(), [](const BoxRecord& box) { return !box.visible; }), boxes.end());
  const std::vector<KittiLabel> labels = labelsOf(judge.source().path(file));
  const std::string where = picture.camera + " at frame " + std::to_string(picture.frame);
  judge.exact("labels", "objects", file, where, double(labels.size()), double(boxes.size()));
  for (std::size_t i = 0; i < std::min(labels.size(), boxes.size()); ++i)
  {
    const LabelPlace place{ file, "line " + std::to_string(i + 1) };
    judgeLabel(judge, place, labels[i], boxes[i]);
    judgeFront(judge, place, labels[i], boxes[i]);
  }
}
} // namespace

void readKittiObject(ExportJudge& judge)
{
  const ExportedFrom& source = judge.source();
  for (const ExportedFile* one : filesIn(source, "training/label_2/", "txt"))
  {
    const std::string number = stemOf(one->file.path);
    if (const ExportedName* picture = pictureOf(judge, one->file.path, "training/image_2/" + number + ".png"))
    {
      judgeLabels(judge, one->file.path, *picture);
      judgeCalibration(judge, "training/calib/" + number + ".txt", *picture);
    }
  }
  std::set<std::string> listed;
  for (const ExportedFile* one : filesIn(source, "ImageSets/", "txt"))
  {
    for (const std::vector<std::string>& words : linesOf(source.path(one->file.path)))
    {
      pictureOf(judge, one->file.path, "training/image_2/" + words[0] + ".png");
      judge.holds("lists", one->file.path, words[0], listed.insert(words[0]).second, "a picture twice", "each once");
    }
  }
  judge.exact("lists", "", "ImageSets", "all parts", double(listed.size()), double(source.record().names.size()));
}

} // namespace dgtk
