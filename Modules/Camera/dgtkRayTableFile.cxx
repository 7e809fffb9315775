// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayTable.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <mutex>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t mostKept = 4;
constexpr int mostSide = 1 << 16;
constexpr double mostFrames = 1000; ///< between a ray and its picture

/// As numpy.save() writes it.
struct Header
{
  int rows = 0;
  int columns = 0;
  int channels = 0;
  std::size_t bytes = 0; ///< of a number
  std::size_t start = 0;
};

[[noreturn]] void fail(const std::string& path, const std::string& found)
{
  throw InputError(path, "is no table of rays",
    "a NumPy array of float32 or float64, height x width x 3 (directions) or x 6 (origins, directions), or one more "
    "(times in frames), 2 x 2 at least",
    found);
}

Header readHeader(const std::string& path, const std::string& file)
{
  if (file.size() < 12 || file.compare(0, 6, "\x93NUMPY") != 0 || file[6] < 1 || file[6] > 3)
  {
    fail(path, "no NumPy file");
  }
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 8, file[6] == 1 ? 2 : 4);
  Header header;
  header.start = (file[6] == 1 ? 10 : 12) + std::size_t(length);
  const std::string text = file.substr(0, std::min(file.size(), header.start)).substr(file[6] == 1 ? 10 : 12);
  const std::string shown = text.substr(0, text.find_last_not_of(" \n") + 1);
  char type = 0;
  int bytes = 0;
  int read = 0;
  if (std::sscanf(text.c_str(), "{'descr': '<%c%d', 'fortran_order': False, 'shape': (%d, %d, %d), }%n", &type, &bytes,
        &header.rows, &header.columns, &header.channels, &read) != 5 ||
      read == 0 || type != 'f' || (bytes != 4 && bytes != 8) || header.rows < 2 || header.columns < 2 ||
      header.rows > mostSide || header.columns > mostSide)
  {
    fail(path, quoted(shown));
  }
  header.bytes = std::size_t(bytes);
  const std::size_t numbers = std::size_t(header.rows) * std::size_t(header.columns) * std::size_t(header.channels);
  const int lines = header.channels % 3 == 1 ? header.channels - 1 : header.channels; // without the time
  if ((lines != 3 && lines != 6) || file.size() != header.start + numbers * header.bytes)
  {
    fail(path, quoted(shown) + " and " + std::to_string(file.size() - std::min(file.size(), header.start)) + " bytes");
  }
  return header;
}

double numberAt(const std::string& file, const Header& header, std::size_t index)
{
  const char* const from = file.data() + header.start + index * header.bytes;
  double wide = 0;
  float narrow = 0;
  header.bytes == 8 ? std::memcpy(&wide, from, 8) : std::memcpy(&narrow, from, 4);
  return header.bytes == 8 ? wide : double(narrow);
}

/// `times` stays empty where there are none but 0.
std::vector<CameraRay> raysOf(
  const std::string& path, const std::string& file, const Header& header, std::vector<double>& times)
{
  std::vector<CameraRay> rays(std::size_t(header.rows) * std::size_t(header.columns));
  bool timed = false;
  std::size_t index = 0;
  for (CameraRay& ray : rays)
  {
    ray = { Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
    for (Eigen::Vector3d* part : { &ray.origin, &ray.direction })
    {
      for (int i = 0; i < 3 && (header.channels >= 6 || part == &ray.direction); ++i)
      {
        (*part)[i] = numberAt(file, header, index++);
      }
    }
    const double length = std::sqrt(ray.direction.squaredNorm());
    const bool there = ray.origin.allFinite() && std::isfinite(length) && length > 0;
    ray = there ? CameraRay{ ray.origin, ray.direction / length }
                : CameraRay{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
    if (header.channels % 3 == 1)
    {
      const double time = numberAt(file, header, index++);
      if (there && !(std::abs(time) <= mostFrames))
      {
        fail(path, "a time of " + shortest(time) + " frames (expected -" + shortest(mostFrames) + " to " +
                     shortest(mostFrames) + ")");
      }
      times.push_back(there ? time : 0);
      timed = timed || times.back() != 0;
    }
  }
  if (!timed)
  {
    times.clear();
  }
  if (std::none_of(rays.begin(), rays.end(), [](const CameraRay& ray) { return ray.exists(); }))
  {
    fail(path, "directions that are all 0 or no number");
  }
  return rays;
}

struct Kept
{
  std::string path;
  std::filesystem::file_time_type time;
  std::uintmax_t bytes = 0;
  std::shared_ptr<const RayTable> table;
};
} // namespace

std::shared_ptr<const RayTable> RayTable::read(const std::string& path)
{
  static std::mutex mutex;
  static std::deque<Kept> kept;
  const std::lock_guard<std::mutex> lock(mutex);
  std::error_code none;
  Kept now{ path, std::filesystem::last_write_time(path, none), std::filesystem::file_size(path, none), nullptr };
  for (const Kept& one : kept)
  {
    if (one.path == now.path && one.time == now.time && one.bytes == now.bytes)
    {
      return one.table;
    }
  }
  const std::string file = readFile(path);
  const Header header = readHeader(path, file);
  std::vector<double> times;
  std::vector<CameraRay> rays = raysOf(path, file, header, times);
  now.table.reset(new RayTable(header.rows, header.columns, std::move(rays), std::move(times)));
  kept.push_back(now);
  if (kept.size() > mostKept)
  {
    kept.pop_front();
  }
  return now.table;
}

} // namespace dgtk
