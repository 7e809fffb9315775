// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpDeformation.h"

#include "dgtkAssimpCheck.h"
#include "dgtkJointMotion.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk
{

namespace
{
/// How the values of the key at or before a time and of the next one make the value at it: sums of values and tangents
/// with these factors.
struct Between
{
  std::size_t key = 0;
  bool atKey = true;   ///< the key's value as it is
  double fraction = 0; ///< of the way to the next key, in (0, 1)
  double value[2] = { 1, 0 };
  double tangent[2] = { 0, 0 }; ///< of this key's `out` and the next key's `in`
};

Between find(const std::vector<double>& times, double time, import::Interpolation interpolation)
{
  Between at;
  const bool isStep = interpolation == import::Interpolation::Step;
  const auto after = std::upper_bound(times.begin(), times.end(), isStep ? time + roundingOf(time) : time);
  at.key = after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.begin() || after == times.end() || times[at.key] == time || isStep)
  {
    return at;
  }
  const double length = times[at.key + 1] - times[at.key];
  const double s = (time - times[at.key]) / length;
  at.atKey = false;
  at.fraction = s;
  at.value[0] = 1 - s;
  at.value[1] = s;
  if (interpolation == import::Interpolation::Cubic)
  {
    // glTF 2.0, appendix C.5
    at.value[0] = 2 * s * s * s - 3 * s * s + 1;
    at.value[1] = -2 * s * s * s + 3 * s * s;
    at.tangent[0] = length * (s * s * s - 2 * s * s + s);
    at.tangent[1] = length * (s * s * s - s * s);
  }
  return at;
}

template <int N>
using Value = Eigen::Matrix<double, N, 1>;

/// Whether nothing changes from a key to the next: what lies between is the same, too, without any rounding.
template <std::size_t N>
bool staysAfter(const import::Keys<N>& keys, std::size_t key)
{
  const std::array<double, N> zero{};
  return keys.values[key] == keys.values[key + 1] &&
         (keys.in.empty() || (keys.out[key] == zero && keys.in[key + 1] == zero));
}

template <std::size_t N>
Value<int(N)> blend(const import::Keys<N>& keys, const Between& at)
{
  using Map = Eigen::Map<const Value<int(N)>>;
  if (at.atKey || staysAfter(keys, at.key))
  {
    return Map(keys.values[at.key].data());
  }
  Value<int(N)> result =
    at.value[0] * Map(keys.values[at.key].data()) + at.value[1] * Map(keys.values[at.key + 1].data());
  if (!keys.in.empty())
  {
    result += at.tangent[0] * Map(keys.out[at.key].data()) + at.tangent[1] * Map(keys.in[at.key + 1].data());
  }
  return result;
}

Eigen::Vector3d vectorAt(const import::Keys<3>& keys, double time)
{
  return blend(keys, find(keys.times, time, keys.interpolation));
}

/// `q`: w, x, y, z.
Eigen::Quaterniond quaternion(const Eigen::Vector4d& q)
{
  const double length = q.norm();
  return length > 0 ? Eigen::Quaterniond(q[0] / length, q[1] / length, q[2] / length, q[3] / length)
                    : Eigen::Quaterniond::Identity();
}

Eigen::Quaterniond rotationAt(const import::Keys<4>& keys, double time)
{
  const Between at = find(keys.times, time, keys.interpolation);
  if (at.atKey || keys.interpolation == import::Interpolation::Cubic || staysAfter(keys, at.key))
  {
    return quaternion(blend(keys, at));
  }
  const auto key = [&keys](std::size_t i) { return quaternion(Eigen::Vector4d(keys.values[i].data())); };
  return slerp(key(at.key), key(at.key + 1), at.fraction);
}

/// The node's own transform where an animation gives some of translation, rotation, scale: what it does not give is
/// taken from the node at rest.
Eigen::Affine3d animated(const import::Channel& channel, const Eigen::Affine3d& rest, double time)
{
  Eigen::Vector3d scale = rest.linear().colwise().norm().transpose();
  Eigen::Matrix3d rotation = rest.linear();
  for (int i = 0; i < 3; ++i)
  {
    rotation.col(i) /= scale[i] > 0 ? scale[i] : 1;
  }
  if (!channel.rotation.times.empty())
  {
    rotation = rotationAt(channel.rotation, time).toRotationMatrix();
  }
  if (!channel.scale.times.empty())
  {
    scale = vectorAt(channel.scale, time);
  }
  Eigen::Affine3d result = rest;
  result.linear() = rotation * scale.asDiagonal();
  if (!channel.translation.times.empty())
  {
    result.translation() = vectorAt(channel.translation, time);
  }
  return result;
}

bool areZero(const std::vector<double>& tangents)
{
  return std::all_of(tangents.begin(), tangents.end(), [](double t) { return t == 0; });
}

template <std::size_t N>
bool areOneValue(const import::Keys<N>& keys)
{
  const auto isFirst = [&](const std::array<double, N>& value) { return value == keys.values.front(); };
  const auto isZero = [](const std::array<double, N>& tangent) { return tangent == std::array<double, N>{}; };
  return std::all_of(keys.values.begin(), keys.values.end(), isFirst) &&
         std::all_of(keys.in.begin(), keys.in.end(), isZero) && std::all_of(keys.out.begin(), keys.out.end(), isZero);
}

bool areOneValue(const import::Channel& channel)
{
  return areOneValue(channel.translation) && areOneValue(channel.rotation) && areOneValue(channel.scale);
}

/// Rows of weights: each is the first one where each value is that of the row before.
bool areOneRow(const import::MorphChannel& morph)
{
  const std::vector<double>& weights = morph.weights;
  const std::size_t row = std::min<std::size_t>(morph.targets, weights.size());
  return std::equal(weights.begin() + std::ptrdiff_t(row), weights.end(), weights.begin()) && areZero(morph.in) &&
         areZero(morph.out);
}

Eigen::Vector3d point(const import::Float3& p) { return { p[0], p[1], p[2] }; }
} // namespace

AssimpDeformation::AssimpDeformation(std::shared_ptr<const import::Scene> scene, std::vector<PosedMesh> meshes)
  : Scene(std::move(scene))
  , Meshes(std::move(meshes))
{
  for (const import::Mesh& mesh : this->Scene->meshes)
  {
    this->Skins.emplace_back();
    Skin& skin = this->Skins.back();
    if (mesh.bones.empty())
    {
      continue;
    }
    skin.first.assign(mesh.positions.size() + 1, 0);
    for (const import::Bone& bone : mesh.bones)
    {
      for (const std::uint32_t vertex : bone.vertices)
      {
        ++skin.first[vertex + 1];
      }
    }
    for (std::size_t i = 1; i < skin.first.size(); ++i)
    {
      skin.first[i] += skin.first[i - 1];
    }
    skin.list.resize(skin.first.back());
    std::vector<std::uint32_t> next = skin.first;
    for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    {
      for (std::size_t i = 0; i < mesh.bones[b].vertices.size(); ++i)
      {
        skin.list[next[mesh.bones[b].vertices[i]]++] = { static_cast<std::uint32_t>(b), mesh.bones[b].weights[i] };
      }
    }
  }
}

const import::Animation* AssimpDeformation::animationOf(int animation) const
{
  const std::vector<import::Animation>& all = this->Scene->animations;
  return animation >= 0 && static_cast<std::size_t>(animation) < all.size() ? &all[static_cast<std::size_t>(animation)]
                                                                            : nullptr;
}

double AssimpDeformation::timeOf(int animation, double frame) const
{
  const import::Animation* known = this->animationOf(animation);
  return !known || std::isnan(frame) ? 0 : std::clamp(frame / fps, 0.0, known->duration);
}

bool AssimpDeformation::holds(int animation) const
{
  const import::Animation* const known = this->animationOf(animation);
  return known && known->joints.empty() && known->blends.empty() &&
         std::all_of(known->channels.begin(), known->channels.end(),
           [](const import::Channel& channel) { return areOneValue(channel); }) &&
         std::all_of(known->morphs.begin(), known->morphs.end(), areOneRow);
}

std::vector<Eigen::Affine3d> AssimpDeformation::pose(int animation, double time) const
{
  const std::vector<import::Node>& nodes = this->Scene->nodes;
  std::vector<Eigen::Affine3d> pose;
  pose.reserve(nodes.size());
  for (const import::Node& node : nodes)
  {
    pose.push_back(affineOf(node.parent_from_node));
  }
  if (const import::Animation* known = this->animationOf(animation))
  {
    for (const import::Channel& channel : known->channels)
    {
      if (channel.node >= 0)
      {
        Eigen::Affine3d& own = pose[static_cast<std::size_t>(channel.node)];
        own = animated(channel, own, time);
      }
    }
  }
  return poseOf(nodes, pose, this->animationOf(animation), time);
}

std::vector<double> AssimpDeformation::weightsAt(const PosedMesh& posed, int animation, double time) const
{
  const import::Mesh& mesh = this->Scene->meshes[posed.mesh];
  std::vector<double> weights;
  for (const import::Target& target : mesh.targets)
  {
    weights.push_back(target.weight);
  }
  const import::Animation* known = this->animationOf(animation);
  for (const import::Blend& blend : mesh.blends)
  {
    addWeights(blend, percentAt(blend, known, time), weights);
  }
  if (!known)
  {
    return weights;
  }
  for (const import::MorphChannel& morph : known->morphs)
  {
    if (morph.node != static_cast<std::int32_t>(posed.node) || morph.times.empty())
    {
      continue;
    }
    const Between at = find(morph.times, time, morph.interpolation);
    const std::size_t row = at.key * morph.targets;
    for (std::size_t i = 0; i < std::min<std::size_t>(weights.size(), morph.targets); ++i)
    {
      const std::size_t key = row + i;
      weights[i] = morph.weights[key];
      if (!at.atKey)
      {
        const std::size_t next = key + morph.targets;
        const double bent = morph.in.empty() ? 0 : at.tangent[0] * morph.out[key] + at.tangent[1] * morph.in[next];
        const bool stays = morph.weights[next] == morph.weights[key];
        weights[i] = (stays ? weights[i] : at.value[0] * weights[i] + at.value[1] * morph.weights[next]) + bent;
      }
    }
  }
  return weights;
}

void AssimpDeformation::positionsOf(const PosedMesh& where, const std::vector<Eigen::Affine3d>& pose, int animation,
  double time, std::vector<Eigen::Vector3d>& positions) const
{
  const import::Mesh& mesh = this->Scene->meshes[where.mesh];
  const Skin& skin = this->Skins[where.mesh];
  const std::vector<double> weights = this->weightsAt(where, animation, time);
  const Eigen::Affine3d& model_from_mesh = pose[where.node];
  std::vector<Eigen::Affine3d> model_from_bind;
  for (const import::Bone& bone : mesh.bones)
  {
    model_from_bind.push_back(
      bone.node >= 0 ? pose[static_cast<std::size_t>(bone.node)] * affineOf(bone.bone_from_mesh) : model_from_mesh);
  }
  for (const std::uint32_t vertex : where.vertices)
  {
    const Eigen::Vector3d rest = point(mesh.positions[vertex]);
    Eigen::Vector3d p = rest;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      if (weights[i] != 0)
      {
        p += weights[i] * (point(mesh.targets[i].positions[vertex]) - rest);
      }
    }
    const double dualShare = mesh.dualQuaternions.empty() ? 0 : mesh.dualQuaternions[vertex];
    DualQuaternions dual;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0;
    for (std::size_t i = skin.first.empty() ? 0 : skin.first[vertex]; !skin.first.empty() && i < skin.first[vertex + 1];
         ++i)
    {
      const Eigen::Affine3d& moved = model_from_bind[skin.list[i].bone];
      sum += double(skin.list[i].weight) * (moved * p);
      total += double(skin.list[i].weight);
      if (dualShare > 0)
      {
        dual.add(moved, double(skin.list[i].weight));
      }
    }
    Eigen::Vector3d posed = model_from_mesh * p;
    if (total > 0)
    {
      posed = sum / total;
      posed = dualShare > 0 ? Eigen::Vector3d((1 - dualShare) * posed + dualShare * dual(p)) : posed;
    }
    positions.push_back(posed);
  }
}

std::vector<Eigen::Matrix3d> AssimpDeformation::linearOf(
  std::uint32_t mesh, std::uint32_t node, const std::vector<Eigen::Affine3d>& pose) const
{
  const Skin& skin = this->Skins[mesh];
  if (skin.first.empty())
  {
    return { pose[node].linear() };
  }
  std::vector<Eigen::Matrix3d> model_from_bind;
  for (const import::Bone& bone : this->Scene->meshes[mesh].bones)
  {
    model_from_bind.push_back(bone.node >= 0 ? Eigen::Matrix3d(pose[static_cast<std::size_t>(bone.node)].linear() *
                                                               affineOf(bone.bone_from_mesh).linear())
                                             : Eigen::Matrix3d(pose[node].linear()));
  }
  std::vector<Eigen::Matrix3d> linear;
  for (std::size_t v = 0; v + 1 < skin.first.size(); ++v)
  {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = skin.first[v]; i < skin.first[v + 1]; ++i)
    {
      sum += double(skin.list[i].weight) * model_from_bind[skin.list[i].bone];
    }
    linear.push_back(skin.first[v] == skin.first[v + 1] ? Eigen::Matrix3d(pose[node].linear()) : sum);
  }
  return linear;
}

void AssimpDeformation::positionsAt(int animation, double frame, std::vector<Eigen::Vector3d>& sourcePositions) const
{
  sourcePositions.clear();
  const double time = this->timeOf(animation, frame);
  const std::vector<Eigen::Affine3d> all = this->pose(animation, time);
  for (const PosedMesh& mesh : this->Meshes)
  {
    this->positionsOf(mesh, all, animation, time, sourcePositions);
  }
}

template <class A>
void io(A& a, PosedMesh& posed)
{
  a(posed.node), a(posed.mesh), a(posed.vertices);
}

std::string AssimpDeformation::saved() const
{
  std::string bytes;
  const auto put = [&bytes](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  StreamWriter<decltype(put)> writer(put);
  writer(const_cast<import::Scene&>(*this->Scene)); // which a writer does not change
  writer(const_cast<std::vector<PosedMesh>&>(this->Meshes));
  return bytes;
}

std::shared_ptr<AssimpDeformation> AssimpDeformation::restored(const std::string& bytes)
{
  const auto scene = std::make_shared<import::Scene>();
  std::vector<PosedMesh> meshes;
  MemoryReader reader({ bytes.data() }, bytes.size());
  reader(*scene);
  reader(meshes);
  checkScene(*scene);
  for (const PosedMesh& posed : meshes)
  {
    const bool known = posed.node < scene->nodes.size() && posed.mesh < scene->meshes.size();
    const std::size_t vertices = known ? scene->meshes[posed.mesh].positions.size() : 0;
    const auto inside = [vertices](std::uint32_t vertex) { return vertex < vertices; };
    if (!known || !std::all_of(posed.vertices.begin(), posed.vertices.end(), inside))
    {
      throw std::runtime_error("posed mesh");
    }
  }
  return std::make_shared<AssimpDeformation>(scene, std::move(meshes));
}

bool AssimpDeformation::moves() const
{
  std::vector<char> drawn(this->Scene->nodes.size(), 0);
  for (const PosedMesh& posed : this->Meshes)
  {
    drawn[posed.node] = 1;
    for (const import::Bone& bone : this->Scene->meshes[posed.mesh].bones)
    {
      drawn[bone.node >= 0 ? static_cast<std::size_t>(bone.node) : 0] = 1;
    }
  }
  for (std::size_t i = this->Scene->nodes.size(); i-- > 1;)
  {
    const std::int32_t parent = this->Scene->nodes[i].parent;
    drawn[parent >= 0 ? static_cast<std::size_t>(parent) : 0] |= drawn[i];
  }
  const auto isDrawn = [&drawn](const auto& channel)
  { return channel.node >= 0 && drawn[static_cast<std::size_t>(channel.node)] != 0; };
  std::set<std::int32_t> used;
  for (const PosedMesh& posed : this->Meshes)
  {
    for (const import::Blend& blend : this->Scene->meshes[posed.mesh].blends)
    {
      used.insert(blend.number);
    }
  }
  const auto isUsed = [&used](const import::BlendChannel& channel) { return used.count(channel.number) > 0; };
  return std::any_of(this->Scene->animations.begin(), this->Scene->animations.end(),
    [&](const import::Animation& animation)
    {
      return std::any_of(animation.channels.begin(), animation.channels.end(), isDrawn) ||
             std::any_of(animation.morphs.begin(), animation.morphs.end(), isDrawn) ||
             std::any_of(animation.joints.begin(), animation.joints.end(), isDrawn) ||
             std::any_of(animation.blends.begin(), animation.blends.end(), isUsed);
    });
}

} // namespace dgtk
