// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSpaceNeeded.h"

#include "dgtkError.h"
#include "dgtkLayers.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>

#include <sys/statvfs.h>
#include <sys/vfs.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr std::uint64_t mostDeflated = 1032; // zlib's largest ratio
constexpr std::uint64_t usuallyDeflated = 4; // pictures of scenes; ids are smaller, noise is not
constexpr long btrfsMagic = 0x9123683E;
constexpr long zfsMagic = 0x2FC12FC1;

void operator+=(SpaceNeeded& sum, const SpaceNeeded& more)
{
  sum.least += more.least;
  sum.likely += more.likely;
}

std::string sizeText(std::uint64_t bytes)
{
  constexpr double kilo = 1000;
  constexpr double most = 999.5; // what three digits round to 1000
  const char* const units[] = { "bytes", "KB", "MB", "GB", "TB", "PB" };
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= most && unit + 1 < std::size(units); ++unit)
  {
    value /= kilo;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", value, units[unit]);
  return text;
}
} // namespace

SpaceNeeded spaceOf(const LayerSpec& spec, const std::string& format, int width, int height)
{
  const std::uint64_t values = std::uint64_t(width) * std::uint64_t(height) * std::uint64_t(spec.channels);
  const auto whole = [](std::uint64_t bytes) { return SpaceNeeded{ bytes, bytes }; };
  if (format == "npy")
  {
    return whole(values * bytesOf(spec.type));
  }
  if (format == "pfm" || format == "flo")
  {
    return whole(values * sizeof(float));
  }
  if (format == "dgd")
  {
    return whole(values * sizeof(double));
  }
  if (format == "ppm") // 24 bits for an id
  {
    return whole(spec.channels == 1 ? 3 * values : values * bytesOf(spec.type));
  }
  if (format == "png" || format == "exr")
  {
    return { values / mostDeflated, values * (format == "png" ? 1 : sizeof(float)) / usuallyDeflated };
  }
  return {};
}

SpaceNeeded spaceOf(const WorkPlan& plan, const Stage& stage)
{
  SpaceNeeded sum;
  for (const Job& job : plan.jobs)
  {
    for (const LayerOutput& output : outputsOf(plan, stage, job))
    {
      for (const std::string& format : output.formats)
      {
        sum += spaceOf(output.spec, format, output.width, output.height);
      }
    }
  }
  return sum;
}

SpaceFree spaceIn(const std::string& folder, std::uint64_t enough)
{
  std::error_code code;
  fs::path there = fs::absolute(folder, code);
  while (!fs::exists(there, code) && there.has_parent_path() && there != there.parent_path())
  {
    there = there.parent_path();
  }
  struct statvfs info = {};
  struct statfs kind = {};
  if (::statvfs(there.c_str(), &info) != 0 || ::statfs(there.c_str(), &kind) != 0)
  {
    return { std::numeric_limits<std::uint64_t>::max(), false };
  }
  SpaceFree free;
  free.bytes = std::uint64_t(::geteuid() == 0 ? info.f_bfree : info.f_bavail) * info.f_frsize;
  free.exact = long(kind.f_type) != btrfsMagic && long(kind.f_type) != zfsMagic;
  if (free.bytes >= enough)
  {
    return free;
  }
  // what stands there is kept or goes
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
  {
    std::error_code ignored;
    free.bytes += it->is_symlink(ignored) || !it->is_regular_file(ignored) ? 0 : it->file_size(ignored);
  }
  return free;
}

std::string checkSpace(const std::string& folder, const SpaceNeeded& needed, const SpaceFree& free)
{
  const std::string there = ", and there are " + sizeText(free.bytes);
  if (needed.least > free.bytes && free.exact)
  {
    throw MachineError(folder + ": the dataset needs at least " + sizeText(needed.least) + there);
  }
  return needed.likely > free.bytes ? folder + ": the dataset needs some " + sizeText(needed.likely) + there : "";
}

} // namespace dgtk
