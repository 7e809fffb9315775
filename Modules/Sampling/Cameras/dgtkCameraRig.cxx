// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraRig.h"

#include "dgtkError.h"
#include "dgtkPathRule.h"
#include "dgtkSampleTree.h"
#include "dgtkStage.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace dgtk
{

using namespace samplerule;
using namespace sampletree;

namespace
{
constexpr std::size_t none = std::size_t(-1);

/// The camera that each is mounted on.
std::vector<std::size_t> basesOf(const JsonCursor& cameras)
{
  std::map<std::string, std::size_t> named;
  const std::vector<JsonCursor> items = cameras.items();
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    const JsonNode* const name = items[i].node().find("name");
    if (name != nullptr && name->type == JsonNode::Type::String)
    {
      named.emplace(name->text, i);
    }
  }
  std::vector<std::size_t> bases;
  for (const JsonCursor& item : items)
  {
    bases.push_back(none);
    if (item.node().find("rig") == nullptr)
    {
      continue;
    }
    const JsonCursor at = item["rig"]["camera"];
    const auto base = named.find(at.string(false));
    if (base == named.end())
    {
      at.fail("names no camera", "the name of a camera of the scene, which is not random", quoted(at.text()));
    }
    bases.back() = base->second;
  }
  return bases;
}

/// The pose alone: the lens, and files that it may have, do not matter.
CameraDescription poseOf(const CameraDescription& camera)
{
  CameraDescription pose;
  pose.eye = camera.eye;
  pose.lookAt = camera.lookAt;
  pose.up = camera.up;
  pose.posed = camera.posed;
  pose.position = camera.position;
  pose.orientation = camera.orientation;
  return pose;
}

/// Every frame from the first to the last key; none: it does not move.
std::vector<int> framesOfPose(const CameraDescription& pose)
{
  SceneDescription scene;
  scene.cameras = { pose };
  std::vector<int> frames = scene.keyFrames();
  if (frames.size() > 1)
  {
    const int first = frames.front();
    frames.resize(std::size_t(frames.back() - first) + 1);
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      frames[i] = first + int(i);
    }
  }
  return frames;
}

Eigen::Quaterniond offsetOf(const JsonCursor& rig)
{
  if (!rig.has("orientation"))
  {
    return Eigen::Quaterniond::Identity();
  }
  constexpr double tolerance = 0.01;
  const JsonCursor at = rig["orientation"];
  const Eigen::Vector4d wxyz = at.matrix<Eigen::Vector4d>(coordinate);
  if (!(std::abs(wxyz.norm() - 1) < tolerance))
  {
    at.fail("is not a rotation", "a quaternion w, x, y, z of length 1", "length " + std::to_string(wxyz.norm()));
  }
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

JsonNode listOf(const std::vector<double>& numbers)
{
  JsonNode list(JsonNode::Type::Array);
  for (const double number : numbers)
  {
    list.children.push_back(JsonNode::of(number));
  }
  return list;
}

JsonNode trackOf(const std::vector<int>& frames, std::vector<JsonNode> values)
{
  if (frames.empty())
  {
    return std::move(values.front());
  }
  JsonNode keys(JsonNode::Type::Array);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    JsonNode key = listOf({ double(frames[i]) });
    key.children.push_back(std::move(values[i]));
    keys.children.push_back(std::move(key));
  }
  JsonNode track(JsonNode::Type::Object);
  track.add("keys", std::move(keys));
  return track;
}
} // namespace

std::vector<std::vector<std::size_t>> rigsOf(const JsonDocument& scene)
{
  const JsonCursor root(scene);
  if (!root.has("cameras") || root["cameras"].node().type != JsonNode::Type::Array)
  {
    return {};
  }
  const JsonCursor cameras = root["cameras"];
  const std::vector<std::size_t> bases = basesOf(cameras);
  std::vector<std::vector<std::size_t>> mounted(bases.size());
  std::vector<std::vector<std::size_t>> rigs;
  std::size_t grouped = 0;
  for (std::size_t i = 0; i < bases.size(); ++i)
  {
    if (bases[i] != none)
    {
      mounted[bases[i]].push_back(i);
    }
  }
  for (std::size_t i = 0; i < bases.size(); ++i)
  {
    if (bases[i] == none)
    {
      std::vector<std::size_t> rig{ i };
      for (std::size_t k = 0; k < rig.size(); ++k)
      {
        rig.insert(rig.end(), mounted[rig[k]].begin(), mounted[rig[k]].end());
      }
      grouped += rig.size();
      rigs.push_back(std::move(rig));
    }
  }
  for (std::size_t i = 0; grouped < bases.size() && i < bases.size(); ++i)
  {
    std::size_t at = i;
    for (std::size_t step = 0; step < bases.size() && at != none; ++step)
    {
      at = bases[at];
    }
    if (at != none)
    {
      cameras.element(at)["rig"]["camera"].fail(
        "is mounted on itself", "cameras without a circle", quoted(cameras.element(at)["name"].text()));
    }
  }
  return rigs;
}

void mountOn(JsonNode& camera, const JsonDocument& rig, const CameraDescription& base)
{
  const JsonCursor at(rig);
  onlyKeys(at, { "camera", "position", "orientation" });
  const Eigen::Vector3d offset = at.has("position") ? at["position"].vector(coordinate) : Eigen::Vector3d(0, 0, 0);
  const Eigen::Quaterniond turn = offsetOf(at);
  const CameraDescription pose = poseOf(base);
  const std::vector<int> frames = framesOfPose(pose);
  std::vector<JsonNode> positions;
  std::vector<JsonNode> orientations;
  Eigen::Vector4d last(1, 0, 0, 0);
  for (const int frame : frames.empty() ? std::vector<int>{ 0 } : frames)
  {
    const Rigid3 world = cameraView(pose, frame).camera_from_world.inverse();
    const Eigen::Vector3d x = world * offset;
    const Eigen::Quaterniond q = (Eigen::Quaterniond(world.rotation) * turn).normalized();
    Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
    wxyz = wxyz.dot(last) < 0 ? Eigen::Vector4d(-wxyz) : wxyz; // the same rotation, without a jump
    last = wxyz;
    positions.push_back(listOf({ x.x(), x.y(), x.z() }));
    orientations.push_back(listOf({ wxyz[0], wxyz[1], wxyz[2], wxyz[3] }));
  }
  setMember(camera, "position", trackOf(frames, std::move(positions)));
  setMember(camera, "orientation", trackOf(frames, std::move(orientations)));
}

} // namespace dgtk
