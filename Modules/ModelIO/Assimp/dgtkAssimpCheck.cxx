// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpCheck.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
void require(bool holds, const char* what)
{
  if (!holds)
  {
    throw std::runtime_error(what);
  }
}

template <class Index>
bool below(const std::vector<Index>& list, std::size_t limit)
{
  return std::all_of(list.begin(), list.end(), [limit](Index i) { return i < limit; });
}

template <class Range>
bool finite(const Range& list)
{
  return std::all_of(list.begin(), list.end(), [](double x) { return std::isfinite(x); });
}

void check(const import::Mesh& mesh, std::size_t nodes)
{
  const std::size_t vertices = mesh.positions.size();
  require(vertices < 0xffffffffu, "too many vertices");
  require(mesh.normals.empty() || mesh.normals.size() == vertices, "normals and vertices do not match");
  require(mesh.uvs.empty() || mesh.uvs.size() == vertices, "texture coordinates and vertices do not match");
  require(mesh.colors.empty() || mesh.colors.size() == vertices, "colours and vertices do not match");
  std::uint64_t corners = 0;
  for (const std::uint32_t size : mesh.faceSizes)
  {
    corners += size;
  }
  require(corners == mesh.faceVertices.size(), "faces and their corners do not match");
  require(below(mesh.faceVertices, vertices), "a face names a vertex that does not exist");
  for (const import::Bone& bone : mesh.bones)
  {
    require(bone.node >= import::noIndex && bone.node < static_cast<std::int64_t>(nodes), "a bone has no node");
    require(bone.vertices.size() == bone.weights.size(), "vertices and weights of a bone do not match");
    require(below(bone.vertices, vertices), "a bone moves a vertex that does not exist");
    require(finite(bone.weights) && finite(bone.bone_from_mesh), "a bone's numbers are not finite");
  }
  for (const import::Target& target : mesh.targets)
  {
    require(target.positions.size() == vertices, "a morph target and its mesh do not match");
    require(std::isfinite(target.weight), "a morph target's weight is not finite");
  }
}

void checkTimes(const std::vector<double>& times)
{
  require(finite(times), "a key's time is not finite");
  require(std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return !(a < b); }) == times.end(),
    "keys are not in the order of time");
}

template <std::size_t N>
void check(const import::Keys<N>& keys)
{
  checkTimes(keys.times);
  require(keys.values.size() == keys.times.size(), "times and values of keys do not match");
  const bool cubic = keys.interpolation == import::Interpolation::Cubic;
  require(keys.in.size() == (cubic ? keys.times.size() : 0) && keys.out.size() == keys.in.size(),
    "times and tangents of keys do not match");
  for (const auto* list : { &keys.values, &keys.in, &keys.out })
  {
    require(std::all_of(list->begin(), list->end(), finite<std::array<double, N>>), "a key's value is not finite");
  }
}

void check(const import::Animation& animation, std::size_t nodes)
{
  require(std::isfinite(animation.duration) && animation.duration >= 0, "an animation's duration is not a time");
  const auto known = [nodes](std::int32_t node)
  { return node >= import::noIndex && node < static_cast<std::int64_t>(nodes); };
  for (const import::Channel& channel : animation.channels)
  {
    require(known(channel.node), "an animation moves a node that does not exist");
    check(channel.translation);
    check(channel.rotation);
    check(channel.scale);
  }
  for (const import::MorphChannel& morph : animation.morphs)
  {
    require(known(morph.node), "an animation moves a node that does not exist");
    checkTimes(morph.times);
    require(finite(morph.weights) && morph.weights.size() == morph.times.size() * std::size_t(morph.targets),
      "times and weights of morph targets do not match");
    const bool cubic = morph.interpolation == import::Interpolation::Cubic;
    require(morph.in.size() == (cubic ? morph.weights.size() : 0) && morph.out.size() == morph.in.size() &&
              finite(morph.in) && finite(morph.out),
      "times and tangents of morph targets do not match");
  }
}
} // namespace

void checkScene(const import::Scene& scene)
{
  require(!scene.nodes.empty(), "no node");
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
  {
    const import::Node& node = scene.nodes[i];
    require(i == 0 ? node.parent == import::noIndex : node.parent >= 0 && node.parent < static_cast<std::int64_t>(i),
      "a node stands before its parent");
    require(finite(node.parent_from_node), "a node's transform is not finite");
    require(below(node.meshes, scene.meshes.size()), "a node names a mesh that does not exist");
  }
  for (const import::Mesh& mesh : scene.meshes)
  {
    check(mesh, scene.nodes.size());
  }
  for (const import::Animation& animation : scene.animations)
  {
    check(animation, scene.nodes.size());
  }
}

} // namespace dgtk
