// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"
#include "dgtkReadColmapRigs.h"
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

// COLMAP's "Output Format" and camera_models.h; the parts of the projection are written out in project().

namespace dgtk
{

namespace
{
struct ColmapCamera
{
  std::string model;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::vector<double> numbers;
};
struct ColmapPlace
{
  double u = 0;
  double v = 0;
  std::int64_t point = -1;
};
struct ColmapImage
{
  Eigen::Vector4d q{ 0, 0, 0, 1 }; ///< x y z w
  Eigen::Vector3d t{ 0, 0, 0 };
  std::uint32_t camera = 0;
  std::string name;
  std::vector<ColmapPlace> places;
  /// QW, QX, QY, QZ, TX, TY, TZ.
  std::array<double*, 7> numbers() { return { &q[3], &q[0], &q[1], &q[2], &t[0], &t[1], &t[2] }; }
};
struct ColmapPoint
{
  Eigen::Vector3d x{ 0, 0, 0 };
  int color[3] = { 0, 0, 0 };
  double error = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> track;
};
struct ColmapModel
{
  std::map<std::uint32_t, ColmapCamera> cameras;
  std::map<std::uint32_t, ColmapImage> images;
  std::map<std::int64_t, ColmapPoint> points;
};

struct Lens
{
  int id;
  const char* name;
  std::size_t numbers;
};
constexpr Lens kinds[] = { { 1, "PINHOLE", 4 }, { 4, "OPENCV", 8 }, { 5, "OPENCV_FISHEYE", 8 },
  { 6, "FULL_OPENCV", 12 } };

template <typename Same>
const Lens& kindOf(const std::string& path, const Same& same)
{
  for (const Lens& kind : kinds)
  {
    if (same(kind))
    {
      return kind;
    }
  }
  throw InputError(path, "has a camera model that nobody knows here");
}

/// Little-endian numbers one after another.
class ColmapBytes
{
public:
  explicit ColmapBytes(const std::string& path)
    : Path(path)
    , All(readFile(path))
  {
  }
  template <typename T>
  T next()
  {
    T value{};
    if (this->All.size() - this->At < sizeof value)
    {
      throw InputError(this->Path, "ends early");
    }
    std::memcpy(&value, this->All.data() + this->At, sizeof value);
    this->At += sizeof value;
    return value;
  }
  std::string text()
  {
    std::string text;
    for (char c = this->next<char>(); c != 0; c = this->next<char>())
    {
      text += c;
    }
    return text;
  }
  void end() const
  {
    if (this->At != this->All.size())
    {
      throw InputError(this->Path, "goes on behind its end");
    }
  }

private:
  std::string Path;
  std::string All;
  std::size_t At = 0;
};

void readBinary(const std::string& folder, ColmapModel& model)
{
  ColmapBytes cameras(folder + "cameras.bin");
  for (auto n = cameras.next<std::uint64_t>(); n > 0; --n)
  {
    ColmapCamera& camera = model.cameras[cameras.next<std::uint32_t>()];
    const int id = cameras.next<std::int32_t>();
    const Lens& kind = kindOf(folder + "cameras.bin", [id](const Lens& one) { return one.id == id; });
    camera.model = kind.name;
    camera.width = cameras.next<std::uint64_t>();
    camera.height = cameras.next<std::uint64_t>();
    for (std::size_t i = 0; i < kind.numbers; ++i)
    {
      camera.numbers.push_back(cameras.next<double>());
    }
  }
  cameras.end();
  ColmapBytes images(folder + "images.bin");
  for (auto n = images.next<std::uint64_t>(); n > 0; --n)
  {
    ColmapImage& image = model.images[images.next<std::uint32_t>()];
    for (double* number : image.numbers())
    {
      *number = images.next<double>();
    }
    image.camera = images.next<std::uint32_t>();
    image.name = images.text();
    for (auto places = images.next<std::uint64_t>(); places > 0; --places)
    {
      ColmapPlace place;
      place.u = images.next<double>();
      place.v = images.next<double>();
      place.point = static_cast<std::int64_t>(images.next<std::uint64_t>());
      image.places.push_back(place);
    }
  }
  images.end();
  ColmapBytes points(folder + "points3D.bin");
  for (auto n = points.next<std::uint64_t>(); n > 0; --n)
  {
    ColmapPoint& point = model.points[static_cast<std::int64_t>(points.next<std::uint64_t>())];
    for (int i = 0; i < 3; ++i)
    {
      point.x[i] = points.next<double>();
    }
    for (int& c : point.color)
    {
      c = points.next<std::uint8_t>();
    }
    point.error = points.next<double>();
    for (auto track = points.next<std::uint64_t>(); track > 0; --track)
    {
      const auto image = points.next<std::uint32_t>();
      point.track.emplace_back(image, points.next<std::uint32_t>());
    }
  }
  points.end();
}

/// Lines but comments, empty ones too.
std::vector<std::istringstream> textLines(const std::string& path)
{
  std::vector<std::istringstream> lines;
  std::istringstream all(readFile(path));
  for (std::string line; std::getline(all, line);)
  {
    if (line.empty() || line[0] != '#')
    {
      lines.emplace_back(line);
    }
  }
  return lines;
}

void requireEnd(const std::istringstream& line, const std::string& path)
{
  if (!line.eof())
  {
    throw InputError(path, "has something else among its numbers");
  }
}

void readTextImages(const std::string& path, ColmapModel& model)
{
  std::vector<std::istringstream> lines = textLines(path);
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2)
  {
    std::uint32_t id = 0;
    lines[i] >> id;
    ColmapImage& image = model.images[id];
    for (double* number : image.numbers())
    {
      lines[i] >> *number;
    }
    lines[i] >> image.camera >> image.name;
    for (ColmapPlace place; lines[i + 1] >> place.u >> place.v >> place.point;)
    {
      image.places.push_back(place);
    }
    requireEnd(lines[i], path);
    requireEnd(lines[i + 1], path);
  }
  if (lines.size() % 2 != 0)
  {
    throw InputError(path, lines.size(), "an image lacks its second line");
  }
}

void readText(const std::string& folder, ColmapModel& model)
{
  for (std::istringstream& line : textLines(folder + "cameras.txt"))
  {
    std::uint32_t id = 0;
    line >> id;
    ColmapCamera& camera = model.cameras[id];
    line >> camera.model >> camera.width >> camera.height;
    for (double number = 0; line >> number;)
    {
      camera.numbers.push_back(number);
    }
    requireEnd(line, folder + "cameras.txt");
    const Lens& kind = kindOf(folder + "cameras.txt", [&](const Lens& one) { return one.name == camera.model; });
    if (camera.numbers.size() != kind.numbers)
    {
      throw InputError(folder + "cameras.txt", "a camera has not the numbers of its model");
    }
  }
  readTextImages(folder + "images.txt", model);
  for (std::istringstream& line : textLines(folder + "points3D.txt"))
  {
    std::int64_t id = 0;
    line >> id;
    ColmapPoint& point = model.points[id];
    line >> point.x[0] >> point.x[1] >> point.x[2] >> point.color[0] >> point.color[1] >> point.color[2] >> point.error;
    for (std::pair<std::uint32_t, std::uint32_t> one; line >> one.first >> one.second;)
    {
      point.track.push_back(one);
    }
    requireEnd(line, folder + "points3D.txt");
  }
}

/// Pixels of a point in camera axes; none where it is not in front of the camera, as all models divide by z.
Eigen::Vector2d project(const ColmapCamera& camera, const Eigen::Vector3d& x)
{
  const std::vector<double>& n = camera.numbers;
  if (!(x[2] > 0))
  {
    return { infinite, infinite };
  }
  double a = x[0] / x[2];
  double b = x[1] / x[2];
  const double square = a * a + b * b;
  if (camera.model == "OPENCV_FISHEYE")
  {
    const double radius = std::sqrt(square);
    const double angle = std::atan(radius);
    const double s = angle * angle;
    const double bent = angle * (1 + s * (n[4] + s * (n[5] + s * (n[6] + s * n[7]))));
    const double scale = radius > 0 ? bent / radius : 1;
    a *= scale;
    b *= scale;
  }
  else if (camera.model != "PINHOLE")
  {
    const bool full = camera.model == "FULL_OPENCV";
    const double above = 1 + square * (n[4] + square * (n[5] + (full ? square * n[8] : 0)));
    const double below = full ? 1 + square * (n[9] + square * (n[10] + square * n[11])) : 1;
    const double u = a * above / below + 2 * n[6] * a * b + n[7] * (square + 2 * a * a);
    const double v = b * above / below + 2 * n[7] * a * b + n[6] * (square + 2 * b * b);
    a = u;
    b = v;
  }
  return { n[0] * a + n[2], n[1] * b + n[3] };
}

class ModelJudge
{
public:
  ModelJudge(ExportJudge& judge, const std::string& folder, const std::string& pictures, double half)
    : Judge(judge)
    , Folder(folder)
    , Pictures(pictures)
    , Half(half)
  {
    const bool binary = !filesIn(judge.source(), folder, "bin").empty();
    (binary ? readBinary : readText)(judge.source().path(folder), this->Own);
    this->Extension = binary ? ".bin" : ".txt";
    this->Tracks = trackPointsOf(judge.source());
  }

  void judgeAll()
  {
    for (const auto& [id, image] : this->Own.images)
    {
      this->judgeImage(id, image);
    }
    this->judgePoints();
    judgeColmapRigs(this->Judge, this->Folder, this->Extension, this->Rigged);
  }

private:
  std::string file(const char* name) const { return this->Folder + name + this->Extension; }

  void judgeImage(std::uint32_t id, const ColmapImage& image)
  {
    const ExportedName* picture = pictureOf(this->Judge, this->file("images"), this->Pictures + image.name);
    const auto camera = this->Own.cameras.find(image.camera);
    this->Judge.holds("cameras", this->file("images"), image.name, camera != this->Own.cameras.end(),
      std::to_string(image.camera), "a camera of the model");
    this->Rigged[id] = { image.camera, picture };
    if (!picture || camera == this->Own.cameras.end())
    {
      return;
    }
    const std::string cameras = this->file("cameras");
    const std::vector<double>& n = camera->second.numbers;
    Eigen::Matrix3d K;
    K << n[0], 0, n[2] + this->Half, 0, n[1], n[3] + this->Half, 0, 0, 1;
    this->Judge.intrinsics(cameras, picture->camera, picture->frame, K, 1e-9);
    this->Judge.size(cameras, picture->camera, picture->frame, camera->second.width, camera->second.height);
    const Eigen::Matrix3d R = rotationOf(image.q);
    this->Judge.pose(this->file("images"), picture->camera, picture->frame, R, image.t, 1e-9);
    this->judgePlaces(id, image, camera->second, *picture);
  }

  void judgePlaces(std::uint32_t id, const ColmapImage& image, const ColmapCamera& camera, const ExportedName& picture)
  {
    const ExportedFrom& source = this->Judge.source();
    const std::string layer = source.dataset() + '/' + source.file(picture.camera, picture.frame, "tracks", { "npy" });
    const std::vector<TrackPlace> places = readTrackPlaces(layer, this->Tracks.size());
    const Eigen::Matrix3d R = rotationOf(image.q);
    std::set<std::int64_t> seen;
    for (std::size_t i = 0; i < image.places.size(); ++i)
    {
      const ColmapPlace& place = image.places[i];
      const std::string where = image.name + ", point " + std::to_string(place.point);
      const auto point = this->Own.points.find(place.point);
      const bool known = point != this->Own.points.end() && place.point >= 1 &&
                         std::size_t(place.point) <= places.size() && seen.insert(place.point).second;
      this->Judge.holds("tracks", this->file("images"), where, known, "a point", "one of the model, once");
      if (!known)
      {
        continue;
      }
      const TrackPlace& own = places[std::size_t(place.point) - 1];
      const double apart = larger(std::abs(place.u + this->Half - own.u), std::abs(place.v + this->Half - own.v));
      this->Judge.number("places", "px", this->file("images"), where, own.visibility == 1 ? apart : infinite, 0, 1e-9);
      const Eigen::Vector2d pixel = project(camera, R * point->second.x + image.t);
      this->Judge.number("reprojection", "px", this->file("points3D"), where,
        (pixel - Eigen::Vector2d(place.u, place.v)).norm(), 0, 1e-6);
      const auto& track = point->second.track;
      const bool back =
        std::any_of(track.begin(), track.end(), [&](const auto& one) { return one.first == id && one.second == i; });
      this->Judge.holds("tracks", this->file("points3D"), where, back, "a track", "one that names the place");
      ++this->Places;
    }
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (places[i].visibility == 1 && (R * this->Tracks[i].x + image.t).z() > 0)
      {
        ++this->Seen[std::int64_t(i) + 1];
      }
    }
  }

  /// All that can be in the model are in it, with their colours; tracks have no place that no picture has.
  void judgePoints()
  {
    const std::string file = this->file("points3D");
    std::size_t elements = 0;
    for (const auto& [id, point] : this->Own.points)
    {
      elements += point.track.size();
      const bool known = id >= 1 && std::size_t(id) <= this->Tracks.size();
      this->Judge.holds("points", file, "point " + std::to_string(id), known, "a point", "one of tracks/points.json");
      const bool same = !known || std::equal(point.color, point.color + 3, this->Tracks[std::size_t(id) - 1].color);
      this->Judge.exact("errors", "px", file, "point " + std::to_string(id), point.error, 0);
      this->Judge.holds("colors", file, "point " + std::to_string(id), same, "another", "that of tracks/points.json");
    }
    this->Judge.exact("tracks", "", file, "elements", double(elements), double(this->Places));
    for (std::size_t i = 0; i < this->Tracks.size(); ++i)
    {
      const auto seen = this->Seen.find(std::int64_t(i) + 1);
      const bool wanted = this->Tracks[i].isStatic && seen != this->Seen.end() && seen->second > 1;
      const bool there = this->Own.points.count(std::int64_t(i) + 1) > 0;
      this->Judge.holds("points", file, "point " + std::to_string(i + 1), there || !wanted, "none", "a point");
    }
  }

  ExportJudge& Judge;
  std::string Folder;
  std::string Pictures;
  std::string Extension;
  double Half;
  ColmapModel Own;
  std::vector<TrackPoint> Tracks;
  std::map<std::int64_t, int> Seen;
  std::map<std::uint32_t, RiggedImage> Rigged;
  std::size_t Places = 0;
};

/// Folders of models: those with a file named cameras.
std::set<std::string> modelFolders(const ExportedFrom& source)
{
  std::set<std::string> folders;
  for (const ExportedFile& one : source.record().files)
  {
    if (stemOf(one.file.path) == "cameras")
    {
      folders.insert(one.file.path.substr(0, one.file.path.rfind('/') + 1));
    }
  }
  return folders;
}

void judgeLists(ExportJudge& judge, const std::string& top)
{
  const std::string fusion = top + "stereo/fusion.cfg";
  const std::string match = top + "stereo/patch-match.cfg";
  const auto names = linesOf(judge.source().path(fusion));
  const auto pairs = linesOf(judge.source().path(match));
  const std::size_t pictures = judge.source().picturesBelow(top + "images/");
  judge.exact("lists", "", fusion, "lines", double(names.size()), double(pictures));
  judge.exact("lists", "", match, "lines", double(pairs.size()), double(2 * pictures));
  for (std::size_t i = 0; i < names.size() && 2 * i < pairs.size(); ++i)
  {
    pictureOf(judge, fusion, top + "images/" + names[i].at(0));
    const bool same = pairs[2 * i] == names[i] && 2 * i + 1 < pairs.size() &&
                      pairs[2 * i + 1] == std::vector<std::string>{ "__auto__,", "20" };
    judge.holds("lists", match, names[i][0], same, "another", "its name, and 20 views of COLMAP's choice");
  }
}
} // namespace

void readColmap(ExportJudge& judge)
{
  for (const std::string& folder : modelFolders(judge.source()))
  {
    ModelJudge(judge, folder, "images/", 0).judgeAll();
  }
}

void readColmapDense(ExportJudge& judge)
{
  for (const std::string& folder : modelFolders(judge.source()))
  {
    const std::string top = folder.substr(0, folder.size() - std::string("sparse/").size());
    ModelJudge(judge, folder, top + "images/", 0.5).judgeAll();
    judgeLists(judge, top);
  }
}

} // namespace dgtk
