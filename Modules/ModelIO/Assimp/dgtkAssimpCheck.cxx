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
  require(mesh.restNormals.empty() || mesh.restNormals.size() == vertices, "normals and vertices do not match");
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
  require(mesh.dualQuaternions.empty() || mesh.dualQuaternions.size() == vertices, "shares and vertices do not match");
  require(finite(mesh.dualQuaternions), "a share of dual quaternions is not finite");
  for (const import::Blend& blend : mesh.blends)
  {
    require(std::isfinite(blend.percent) && finite(blend.full) && blend.full.size() == blend.targets.size() &&
              below(blend.targets, mesh.targets.size()),
      "a blend shape and its targets do not match");
  }
}

void check(const import::Joint& joint)
{
  require(finite(joint.translation) && finite(joint.rotation) && finite(joint.scale) && finite(joint.before) &&
            finite(joint.middle) && finite(joint.after),
    "a node's transform is not finite");
  std::array<std::int32_t, 3> order = joint.order;
  std::sort(order.begin(), order.end());
  require(order == std::array<std::int32_t, 3>{ 0, 1, 2 }, "a node turns about an axis that does not exist");
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

void check(const import::Curve& curve)
{
  const std::size_t keys = curve.times.size();
  checkTimes(curve.times);
  require(keys > 0 && curve.values.size() == keys && curve.segments.size() == keys && curve.handles.size() == keys,
    "times and values of keys do not match");
  require(finite(curve.values) && finite(curve.slopes) &&
            std::all_of(curve.handles.begin(), curve.handles.end(), finite<std::array<double, 4>>),
    "a key's value is not finite");
}

void check(const std::vector<import::Layer>& layers, std::int64_t curves)
{
  for (const import::Layer& layer : layers)
  {
    require(finite(layer.values) && std::isfinite(layer.weight), "a layer's value is not finite");
    require(layer.weightCurve < curves &&
              std::all_of(layer.curves.begin(), layer.curves.end(), [curves](std::int32_t c) { return c < curves; }),
      "a layer names a curve that does not exist");
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
  const auto curves = static_cast<std::int64_t>(animation.curves.size());
  for (const import::Curve& curve : animation.curves)
  {
    check(curve);
  }
  for (const import::JointChannel& channel : animation.joints)
  {
    require(channel.node >= 0 && known(channel.node), "an animation moves a node that does not exist");
    check(channel.layers, curves);
  }
  for (std::size_t i = 0; i < animation.blends.size(); ++i)
  {
    require(i == 0 || animation.blends[i - 1].number < animation.blends[i].number, "blend shapes are not in order");
    check(animation.blends[i].layers, curves);
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
    require(node.joint.size() <= 1, "a node is several joints");
    std::for_each(node.joint.begin(), node.joint.end(), [](const import::Joint& joint) { check(joint); });
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
