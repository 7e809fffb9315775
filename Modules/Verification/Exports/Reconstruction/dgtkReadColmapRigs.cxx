// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadColmapRigs.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonFile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstring>
#include <sstream>

// COLMAP's "Output Format" of 3.12 and "Rig Support"; the configuration of rig_bundle_adjuster of 3.8.

namespace dgtk
{

namespace
{
/// Numbers one after another: little-endian, or words.
class Values
{
public:
  Values(const std::string& path, bool binary)
    : Path(path)
    , Binary(binary)
    , All(readFile(path))
  {
    if (!binary)
    {
      std::istringstream lines(this->All);
      std::string words;
      for (std::string line; std::getline(lines, line);)
      {
        this->Lines += line.empty() || line[0] == '#' ? 0 : 1;
        words += line.empty() || line[0] == '#' ? "" : line + '\n';
      }
      this->Words.str(words);
    }
  }
  template <typename T>
  T next()
  {
    T value{};
    if (!this->Binary)
    {
      double number = 0;
      this->Words >> number;
      this->require(!this->Words.fail());
      return static_cast<T>(number);
    }
    this->require(this->All.size() - this->At >= sizeof value);
    std::memcpy(&value, this->All.data() + this->At, sizeof value);
    this->At += sizeof value;
    return value;
  }
  /// So many records follow.
  std::uint64_t count() { return this->Binary ? this->next<std::uint64_t>() : this->Lines; }
  std::uint32_t camera()
  {
    std::string kind;
    const bool right = this->Binary ? this->next<std::int32_t>() == 0 : (this->Words >> kind) && kind == "CAMERA";
    this->require(right);
    return this->next<std::uint32_t>();
  }
  Eigen::Isometry3d pose()
  {
    double n[7];
    for (double& one : n)
    {
      one = this->next<double>();
    }
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::Quaterniond(n[0], n[1], n[2], n[3]));
    pose.translation() = Eigen::Vector3d(n[4], n[5], n[6]);
    return pose;
  }
  void end() { this->require(this->Binary ? this->At == this->All.size() : (this->Words >> std::ws).eof()); }

private:
  void require(bool right) const
  {
    if (!right)
    {
      throw InputError(this->Path, "does not have the numbers that rigs or frames have");
    }
  }
  std::string Path;
  bool Binary;
  std::string All;
  std::size_t At = 0;
  std::uint64_t Lines = 0;
  std::istringstream Words;
};

/// By camera its axes from the rig's, which are the first camera's.
using Rig = std::map<std::uint32_t, Eigen::Isometry3d>;

std::map<std::uint32_t, Rig> readRigs(const std::string& path, bool binary)
{
  Values values(path, binary);
  std::map<std::uint32_t, Rig> rigs;
  for (std::uint64_t n = values.count(); n > 0; --n)
  {
    Rig& rig = rigs[values.next<std::uint32_t>()];
    const auto sensors = values.next<std::uint32_t>();
    rig[values.camera()] = Eigen::Isometry3d::Identity();
    for (std::uint32_t i = 1; i < sensors; ++i)
    {
      const std::uint32_t camera = values.camera();
      if (values.next<std::uint8_t>() != 1)
      {
        throw InputError(path, "a camera of a rig has no place");
      }
      rig[camera] = values.pose();
    }
  }
  values.end();
  return rigs;
}

/// What rig_config.json says of a rig is what the rigs say.
void judgeConfiguration(ExportJudge& judge, const std::string& file, const std::map<std::uint32_t, Rig>& rigs)
{
  constexpr double rounding = 1e-12;
  const nlohmann::json all = readJsonFile(judge.source().path(file));
  std::size_t several = 0;
  for (const auto& [number, rig] : rigs)
  {
    several += rig.size() > 1 ? 1 : 0;
  }
  judge.exact("rigs", "", file, "rigs", double(all.size()), double(several));
  for (const nlohmann::json& one : all)
  {
    for (const nlohmann::json& camera : one.at("cameras"))
    {
      const auto id = camera.at("camera_id").get<std::uint32_t>();
      const std::string where = "camera " + std::to_string(id);
      const auto rig =
        std::find_if(rigs.begin(), rigs.end(), [&](const auto& candidate) { return candidate.second.count(id) > 0; });
      judge.holds("rigs", file, where, rig != rigs.end(), "another", "a camera of a rig");
      if (rig == rigs.end())
      {
        continue;
      }
      const Eigen::Isometry3d& pose = rig->second.at(id);
      const auto q = camera.at("rel_qvec").get<std::vector<double>>();
      const auto t = camera.at("rel_tvec").get<std::vector<double>>();
      const Eigen::Matrix3d R = Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)).toRotationMatrix();
      const double off = (R - pose.linear()).cwiseAbs().maxCoeff();
      const double apart = (Eigen::Vector3d(t.at(0), t.at(1), t.at(2)) - pose.translation()).norm();
      judge.number("rigs", "", file, where, std::max(off, apart), 0, rounding * (1 + pose.translation().norm()));
    }
  }
}
} // namespace

void judgeColmapRigs(ExportJudge& judge, const std::string& folder, const std::string& extension,
  const std::map<std::uint32_t, RiggedImage>& images)
{
  const std::string file = folder + "frames" + extension;
  if (!judge.source().exported(file))
  {
    return;
  }
  const bool binary = extension == ".bin";
  const std::map<std::uint32_t, Rig> rigs = readRigs(judge.source().path(folder + "rigs" + extension), binary);
  Values values(judge.source().path(file), binary);
  std::map<std::uint64_t, int> seen;
  for (std::uint64_t n = values.count(); n > 0; --n)
  {
    const std::string where = "frame " + std::to_string(values.next<std::uint32_t>());
    const auto rig = rigs.find(values.next<std::uint32_t>());
    const Eigen::Isometry3d rigFromWorld = values.pose();
    for (auto pictures = values.next<std::uint32_t>(); pictures > 0; --pictures)
    {
      const std::uint32_t camera = values.camera();
      const auto number = values.next<std::uint64_t>();
      const auto image = images.find(static_cast<std::uint32_t>(number));
      const bool right = rig != rigs.end() && rig->second.count(camera) > 0 && image != images.end() &&
                         image->second.camera == camera && image->second.picture;
      judge.holds("rigs", file, where, right, std::to_string(number), "a picture of a camera of the frame's rig");
      if (right)
      {
        const Eigen::Isometry3d pose = rig->second.at(camera) * rigFromWorld;
        const ExportedName& picture = *image->second.picture;
        judge.pose(file, picture.camera, picture.frame, pose.linear(), pose.translation(), 1e-8);
        ++seen[number];
      }
    }
  }
  values.end();
  for (const auto& [number, image] : images)
  {
    const auto has = [camera = image.camera](const auto& rig) { return rig.second.count(camera) > 0; };
    const std::string where = "picture " + std::to_string(number);
    judge.exact("rigs", "", file, where + ", frames", seen[number], 1);
    judge.exact("rigs", "", folder + "rigs" + extension, where + ", rigs of its camera",
      double(std::count_if(rigs.begin(), rigs.end(), has)), 1);
  }
  const std::string configuration = folder + "rig_config.json";
  useJson(judge.source().path(configuration), [&] { judgeConfiguration(judge, configuration, rigs); });
}

} // namespace dgtk
