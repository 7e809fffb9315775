// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPickle.h"
#include "dgtkReadTexts.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTrackDocuments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// TAP-Vid's README (points, occluded, query_points) and NumPy's .npz: a ZIP of .npy.

namespace dgtk
{

namespace
{
/// An array of a .npz, as it stands there.
struct Array
{
  std::string file; ///< for errors
  std::string type;
  std::vector<std::size_t> shape;
  std::string bytes;
  template <typename T>
  T at(std::size_t i) const
  {
    if (i >= this->bytes.size() / sizeof(T))
    {
      throw InputError(this->file, "has an array that is too short");
    }
    T value{};
    std::memcpy(&value, this->bytes.data() + i * sizeof(T), sizeof(T));
    return value;
  }
};

std::string between(const std::string& text, const std::string& from, const std::string& to)
{
  const std::size_t begin = text.find(from);
  const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin + from.size());
  return end == std::string::npos ? "" : text.substr(begin + from.size(), end - begin - from.size());
}

Array arrayOf(const std::string& path, const std::string& bytes)
{
  const std::size_t head = bytes.size() > 10 ? 10 + std::uint8_t(bytes[8]) + 256 * std::uint8_t(bytes[9]) : 0;
  if (head == 0 || bytes.compare(0, 6, "\x93NUMPY") != 0 || head > bytes.size())
  {
    throw InputError(path, "has a member that is no .npy");
  }
  const std::string text = bytes.substr(10, head - 10);
  Array array{ path, between(text, "'descr': '", "'"), {}, bytes.substr(head) };
  std::size_t values = 1;
  std::string number;
  for (const char c : between(text, "'shape': (", ")") + ',')
  {
    if (c == ',' && !number.empty())
    {
      array.shape.push_back(std::stoul(number));
      values *= array.shape.back();
      number.clear();
    }
    number += c >= '0' && c <= '9' ? std::string(1, c) : "";
  }
  const std::size_t size = array.type.empty() ? 0 : std::size_t(array.type.back() - '0');
  if (array.bytes.size() != values * size)
  {
    throw InputError(path, "has an array that is not as long as its shape says");
  }
  return array;
}

std::uint32_t sumOf(const std::string& bytes)
{
  std::uint32_t sum = 0xffffffff;
  for (const char c : bytes)
  {
    sum ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i)
    {
      sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0xedb88320U : 0U);
    }
  }
  return ~sum;
}

/// The members of a ZIP that are stored as they are.
std::map<std::string, Array> arraysIn(const std::string& path)
{
  const std::string all = readFile(path);
  const auto number = [&](std::size_t at, std::size_t bytes)
  {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes && at + i < all.size(); ++i)
    {
      value |= std::uint32_t(static_cast<unsigned char>(all[at + i])) << (8 * i);
    }
    return value;
  };
  std::map<std::string, Array> arrays;
  for (std::size_t at = 0; number(at, 4) == 0x04034b50;)
  {
    const std::size_t size = number(at + 22, 4);
    const std::size_t name = number(at + 26, 2);
    const std::size_t start = at + 30 + name + number(at + 28, 2);
    if (number(at + 8, 2) != 0 || number(at + 18, 4) != size || start + size > all.size())
    {
      throw InputError(path, "is no archive of stored members");
    }
    const std::string bytes = all.substr(start, size);
    if (sumOf(bytes) != number(at + 14, 4))
    {
      throw InputError(path, "has a member with another sum");
    }
    arrays.emplace(all.substr(at + 30, name), arrayOf(path, bytes));
    at = start + size;
  }
  return arrays;
}

void judgeVideo(ExportJudge& judge, const std::string& folder, const std::vector<const ExportedName*>& frames)
{
  const std::string file = folder + "tracks.npz";
  const std::string path = judge.source().path(file);
  const std::map<std::string, Array> arrays = arraysIn(path);
  for (const char* name : { "points.npy", "occluded.npy", "query_points.npy", "track.npy", "object.npy" })
  {
    if (arrays.count(name) == 0)
    {
      throw InputError(path, std::string("lacks ") + name);
    }
  }
  const Array& points = arrays.at("points.npy");
  const Array& occluded = arrays.at("occluded.npy");
  const Array& queries = arrays.at("query_points.npy");
  const Array& tracks = arrays.at("track.npy");
  const std::size_t count = tracks.shape.at(0);
  const std::vector<std::size_t> shape{ count, frames.size(), 2 };
  judge.holds("shapes", file, "points", points.shape == shape && queries.shape.at(0) == count, "others", "N, T, 2");
  const std::vector<TrackPoint> own = readTrackPoints(judge.source().dataset() + '/' + trackPointsFile);
  std::vector<std::vector<TrackPlace>> places;
  std::vector<int> first(own.size(), -1);
  for (const ExportedName* frame : frames)
  {
    const std::string layer = judge.source().file(frame->camera, frame->frame, "tracks", { "npy" });
    places.push_back(readTrackPlaces(judge.source().dataset() + '/' + layer, own.size()));
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      first[i] = first[i] < 0 && places.back()[i].visibility == 1 ? int(places.size() - 1) : first[i];
    }
  }
  std::size_t expected = 0;
  for (const int one : first)
  {
    expected += one >= 0;
  }
  judge.exact("tracks", "", file, "", double(count), double(expected));
  if (points.shape != shape || points.type != "<f4" || occluded.type != "|b1")
  {
    return;
  }
  const CameraRecord* camera = judge.source().camera(frames.front()->camera, frames.front()->frame);
  for (std::size_t i = 0; i < count && camera; ++i)
  {
    const auto number = std::size_t(tracks.at<std::int64_t>(i));
    const std::string where = "track " + std::to_string(i);
    const bool known = number < own.size() && first[number] >= 0;
    judge.holds("tracks", file, where, known && arrays.at("object.npy").at<std::int64_t>(i) == own[number].object,
      std::to_string(number), "a point that is seen, of its object");
    for (std::size_t t = 0; known && t < frames.size(); ++t)
    {
      const TrackPlace& place = places[t][number];
      const std::size_t at = i * frames.size() + t;
      const bool there = std::isfinite(place.u);
      const double x = there ? place.u / camera->width : 0;
      const double y = there ? place.v / camera->height : 0;
      const double off = larger(beyond(std::abs(double(points.at<float>(2 * at)) - x), 6e-8 * std::abs(x)),
        beyond(std::abs(double(points.at<float>(2 * at + 1)) - y), 6e-8 * std::abs(y)));
      judge.number("points", "share", file, where, off, 0, 1e-12);
      judge.holds("occluded", file, where, (occluded.at<std::uint8_t>(at) == 0) == (place.visibility == 1), "other",
        "class " + std::to_string(int(place.visibility)));
    }
    if (known)
    {
      const auto t = std::size_t(first[number]);
      const TrackPlace& place = places[t][number];
      const Eigen::Vector3d query(queries.at<float>(3 * i), queries.at<float>(3 * i + 1), queries.at<float>(3 * i + 2));
      const double off = apart(query, Eigen::Vector3d(double(t), place.v, place.u));
      judge.number("queries", "px", file, where, off, 0, 6e-8 * (camera->width + camera->height));
    }
  }
}

std::string colorLayer(const ExportedFrom& source)
{
  const TextPairs& request = source.record().request;
  const auto found =
    std::find_if(request.begin(), request.end(), [](const auto& pair) { return pair.first == "color"; });
  return found == request.end() ? "color" : found->second;
}

/// The benchmark's own file: its tracks are those of the archives, its video the dataset's pictures.
void judgePickle(ExportJudge& judge, const std::map<std::string, std::vector<const ExportedName*>>& videos)
{
  const std::string file = "tapvid.pkl";
  const std::string path = judge.source().path(file);
  const std::string bytes = readFile(path);
  const PickledVideos all = readPickledVideos(path, bytes);
  judge.exact("videos", "", file, "", double(all.size()), double(videos.size()));
  for (const auto& [folder, frames] : videos)
  {
    const std::string name = folder.substr(0, folder.size() - 1);
    if (all.count(name) == 0)
    {
      judge.holds("videos", file, name, false, "none", "a video");
      continue;
    }
    const std::map<std::string, PickledArray>& arrays = all.at(name);
    const std::map<std::string, Array> archive = arraysIn(judge.source().path(folder + "tracks.npz"));
    for (const auto& [key, member] : { std::pair<const char*, const char*>{ "points", "points.npy" },
           std::pair<const char*, const char*>{ "occluded", "occluded.npy" } })
    {
      const auto one = arrays.find(key);
      const Array& other = archive.at(member);
      const bool same = one != arrays.end() && other.type.substr(1) == one->second.type &&
                        std::vector<std::uint64_t>(other.shape.begin(), other.shape.end()) == one->second.shape &&
                        bytes.compare(one->second.begin, one->second.bytes, other.bytes) == 0;
      judge.holds(key, file, name, same, "others", "those of the archive");
    }
    const auto video = arrays.find("video");
    const CameraRecord* camera = judge.source().camera(frames.front()->camera, frames.front()->frame);
    const std::vector<std::uint64_t> shape{ frames.size(), std::uint64_t(camera ? camera->height : 0),
      std::uint64_t(camera ? camera->width : 0), 3 };
    const bool shaped = video != arrays.end() && video->second.type == "u1" && video->second.shape == shape;
    judge.holds("color", file, name, shaped, "another shape", "T, H, W, 3");
    for (std::size_t t = 0; shaped && t < frames.size(); ++t)
    {
      const PicturePointer own =
        judge.source().picture(frames[t]->camera, frames[t]->frame, colorLayer(judge.source()), { "png" });
      std::size_t at = video->second.begin + t * std::size_t(shape[1] * shape[2] * 3);
      std::size_t wrong = 0;
      for (int y = 0; y < own->height(); ++y)
      {
        for (int x = 0; x < own->width(); ++x)
        {
          for (int c = 0; c < 3; ++c, ++at)
          {
            const double value = own->at(x, y, c) / (own->type() == PixelType::UInt16 ? 257 : 1);
            wrong += std::abs(double(static_cast<unsigned char>(bytes[at])) - value) > 0.5;
          }
        }
      }
      judge.exact("color", "values", file, name + " " + std::to_string(t), double(wrong), 0);
    }
  }
}

} // namespace

void readTapvid(ExportJudge& judge)
{
  std::map<std::string, std::vector<const ExportedName*>> videos;
  for (const ExportedName& name : judge.source().record().names)
  {
    videos[name.name.substr(0, name.name.find('/') + 1)].push_back(&name);
  }
  for (const auto& [folder, frames] : videos)
  {
    judgeVideo(judge, folder, frames);
  }
  const std::vector<const ExportedFile*> pickles = filesIn(judge.source(), "", "pkl");
  if (!pickles.empty())
  {
    judgePickle(judge, videos);
  }
}

} // namespace dgtk
