// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

namespace dgtk
{

std::vector<std::vector<std::string>> linesOf(const std::string& path)
{
  std::istringstream text(readFile(path));
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(text, line);)
  {
    if (!line.empty() && line[0] == '#')
    {
      continue;
    }
    std::vector<std::string> words(1);
    for (const char c : line)
    {
      if (c == ' ')
      {
        words.emplace_back();
      }
      else
      {
        words.back() += c;
      }
    }
    lines.push_back(words);
  }
  return lines;
}

double numberIn(const std::string& path, std::size_t line, const std::string& word)
{
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size())
  {
    throw InputError(path, line, "expected a number, found " + quoted(word));
  }
  return value;
}

std::map<std::string, std::vector<double>> keyedNumbers(const std::string& path)
{
  std::map<std::string, std::vector<double>> found;
  std::size_t at = 0;
  for (const std::vector<std::string>& words : linesOf(path))
  {
    ++at;
    if (words[0].size() > 1 && words[0].back() == ':')
    {
      std::vector<double>& numbers = found[words[0].substr(0, words[0].size() - 1)];
      for (std::size_t i = 1; i < words.size(); ++i)
      {
        numbers.push_back(numberIn(path, at, words[i]));
      }
    }
  }
  return found;
}

const std::vector<double>& numbersOf(
  const std::map<std::string, std::vector<double>>& all, const std::string& path, const std::string& key, int count)
{
  const auto found = all.find(key);
  if (found == all.end() || found->second.size() != std::size_t(count))
  {
    throw InputError(path, "expected " + std::to_string(count) + " numbers of " + key);
  }
  return found->second;
}

std::vector<double> numbersIn(
  const std::string& path, std::size_t line, const std::vector<std::string>& words, std::size_t count)
{
  if (words.size() != count)
  {
    throw InputError(path, line,
      "expected " + std::to_string(count) + " fields, one space between them, found " + std::to_string(words.size()));
  }
  std::vector<double> numbers;
  numbers.reserve(count);
  for (const std::string& word : words)
  {
    numbers.push_back(numberIn(path, line, word));
  }
  return numbers;
}

std::string digitsOf(const std::string& number, std::size_t digits)
{
  return std::string(digits - std::min(digits, number.size()), '0') + number;
}

Eigen::Matrix3d fromWholeCentres(Eigen::Matrix3d K)
{
  K(0, 2) += 0.5;
  K(1, 2) += 0.5;
  return K;
}

Eigen::Matrix3d matrixOf(const std::vector<double>& numbers, std::size_t step)
{
  Eigen::Matrix3d matrix;
  for (std::size_t i = 0; i < 9; ++i)
  {
    matrix(Eigen::Index(i / 3), Eigen::Index(i % 3)) = numbers.at(i / 3 * step + i % 3);
  }
  return matrix;
}

Eigen::Matrix3d rotationOf(const Eigen::Vector4d& q)
{
  Eigen::Matrix3d cross;
  cross << 0, -q.z(), q.y(), q.z(), 0, -q.x(), -q.y(), q.x(), 0;
  return Eigen::Matrix3d::Identity() + 2 * q.w() * cross + 2 * cross * cross;
}

double metresOf(const ExportedFrom& source)
{
  for (const auto& [key, value] : source.record().request)
  {
    if (key == "unit_metres" && !value.empty())
    {
      return numberIn(source.path(exportName), 0, value);
    }
  }
  if (source.manifest().metresPerUnit <= 0)
  {
    throw InputError(source.path(exportName), "nobody says how long the dataset's unit is");
  }
  return source.manifest().metresPerUnit;
}

std::vector<TrackPoint> trackPointsOf(const ExportedFrom& source)
{
  std::set<int> frames;
  for (const ExportedName& picture : source.record().names)
  {
    frames.insert(picture.frame);
  }
  std::map<std::uint32_t, std::size_t> sights; // frames at which an object is there
  if (Folder(source.dataset()).look(posesName) == EntryKind::File)
  {
    for (const PoseRecord& pose : readPoses(source.document(posesName)))
    {
      sights[pose.id] += pose.visible ? frames.count(pose.frame) : 0;
    }
  }
  std::vector<TrackPoint> points = readTrackPoints(source.dataset() + '/' + trackPointsFile);
  for (TrackPoint& point : points)
  {
    const auto found = sights.find(point.object);
    const std::size_t there = found == sights.end() ? 0 : found->second;
    point.isStatic = point.isStatic && (there == 0 || there == frames.size());
  }
  return points;
}

std::vector<const ExportedFile*> filesIn(
  const ExportedFrom& source, const std::string& folder, const std::string& extension)
{
  std::vector<const ExportedFile*> files;
  for (const ExportedFile& one : source.record().files)
  {
    const std::string& path = one.file.path;
    if (path.rfind(folder, 0) == 0 && extensionOf(path) == extension)
    {
      files.push_back(&one);
    }
  }
  return files;
}

const ExportedName* pictureOf(ExportJudge& judge, const std::string& file, const std::string& name)
{
  const ExportedName* found = judge.source().named(name);
  judge.holds("names", file, name, found != nullptr, "a picture", "one of export.json");
  return found;
}

std::string stemOf(const std::string& path)
{
  const std::size_t begin = path.rfind('/') + 1;
  return path.substr(begin, path.rfind('.') - begin);
}

} // namespace dgtk
