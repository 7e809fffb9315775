// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPinholeTwins.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>
#include <map>
#include <string>

namespace dgtk
{

namespace
{
using Camera = std::map<int, const DatasetShot*>; ///< by frame

std::map<std::string, Camera> byName(const std::vector<DatasetShot>& shots)
{
  std::map<std::string, Camera> cameras;
  for (const DatasetShot& shot : shots)
  {
    cameras[shot.name()][shot.frame()] = &shot;
  }
  return cameras;
}

bool isPlain(const Camera& camera)
{
  return std::all_of(camera.begin(), camera.end(), [](const auto& one) { return isPinhole(one.second->camera); });
}

/// Whether the other camera sees from the same places, turned alike.
bool standsAs(const Camera& camera, const Camera& other)
{
  constexpr double rounding = 1e-9;
  return std::all_of(camera.begin(), camera.end(),
    [&](const auto& one)
    {
      const auto found = other.find(one.first);
      if (found == other.end())
      {
        return false;
      }
      const CameraRecord& a = one.second->camera;
      const CameraRecord& b = found->second->camera;
      return (a.R - b.R).norm() <= rounding && (a.t - b.t).norm() <= rounding * std::max(1.0, a.t.norm());
    });
}

bool hasSizeOf(const Camera& camera, const Camera& other)
{
  const CameraRecord& a = camera.begin()->second->camera;
  const CameraRecord& b = other.begin()->second->camera;
  return a.width == b.width && a.height == b.height;
}

[[noreturn]] void refuse(const std::string& name, const Camera& camera)
{
  const CameraRecord& first = camera.begin()->second->camera;
  std::string matrix = "a \"K\" or \"fovY\" of its own";
  if (first.hasK)
  {
    const auto row = [&](int i)
    { return '[' + shortest(first.K(i, 0)) + ", " + shortest(first.K(i, 1)) + ", " + shortest(first.K(i, 2)) + ']'; };
    matrix = "such as \"K\": [" + row(0) + ", " + row(1) + ", " + row(2) + ']';
  }
  throw UsageError("undistort: camera " + quoted(name) + " (" + lensText(first) +
                   ") needs a pinhole twin, which the dataset lacks; nothing is rendered anew here: add a camera with "
                   "the same poses to the scene, \"model\": \"pinhole\" without distortion and rolling shutter, " +
                   std::to_string(first.width) + 'x' + std::to_string(first.height) + ", " + matrix +
                   ", and render it");
}

const Camera& twinOf(const std::string& name, const Camera& camera, const std::map<std::string, Camera>& all)
{
  const Camera* twin = nullptr;
  for (const auto& [other, candidate] : all)
  {
    const bool better = !twin || (!hasSizeOf(camera, *twin) && hasSizeOf(camera, candidate));
    if (better && other != name && isPlain(candidate) && standsAs(camera, candidate))
    {
      twin = &candidate;
    }
  }
  if (!twin)
  {
    refuse(name, camera);
  }
  return *twin;
}
} // namespace

std::vector<DatasetShot> withTwins(const std::vector<DatasetShot>& wanted, const std::vector<DatasetShot>& all)
{
  const std::map<std::string, Camera> known = byName(all);
  std::map<std::pair<std::string, int>, const DatasetShot*> taken;
  for (const auto& [name, camera] : byName(wanted))
  {
    const Camera& source = isPlain(camera) ? camera : twinOf(name, camera, known);
    for (const auto& [frame, shot] : camera)
    {
      const DatasetShot* one = source.at(frame);
      taken[{ one->name(), frame }] = one;
    }
  }
  std::vector<DatasetShot> shots;
  shots.reserve(taken.size());
  for (const auto& [place, shot] : taken)
  {
    shots.push_back(*shot);
  }
  return shots;
}

} // namespace dgtk
