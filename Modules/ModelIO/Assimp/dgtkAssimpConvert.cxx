// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpConvert.h"

#include <assimp/scene.h>

#include <algorithm>
#include <map>

namespace dgtk::import
{

namespace
{
constexpr int deepest = 2000;
constexpr std::size_t mostNodes = 1'000'000;

using NodeIndex = std::map<std::string, std::int32_t>;

Matrix matrix(const aiMatrix4x4& m)
{
  return { m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4 };
}

std::vector<Float3> vectors(const aiVector3D* from, unsigned count)
{
  std::vector<Float3> to(count);
  for (unsigned i = 0; i < count; ++i)
  {
    to[i] = { from[i].x, from[i].y, from[i].z };
  }
  return to;
}

void addNode(const aiNode& from, std::int32_t parent, int depth, Scene& to, NodeIndex& index)
{
  if (depth > deepest || to.nodes.size() >= mostNodes)
  {
    throw std::runtime_error("has too many nodes or nests them too deeply");
  }
  Node node;
  node.name = from.mName.C_Str();
  node.parent = parent;
  node.parent_from_node = matrix(from.mTransformation);
  node.meshes.assign(from.mMeshes, from.mMeshes + from.mNumMeshes);
  const auto self = static_cast<std::int32_t>(to.nodes.size());
  index.emplace(node.name, self);
  to.nodes.push_back(std::move(node));
  for (unsigned i = 0; i < from.mNumChildren; ++i)
  {
    addNode(*from.mChildren[i], self, depth + 1, to, index);
  }
}

std::int32_t find(const NodeIndex& nodes, const std::string& name)
{
  const auto found = nodes.find(name);
  return found == nodes.end() ? noIndex : found->second;
}

Bone converted(const aiBone& from, const NodeIndex& nodes)
{
  Bone to;
  to.node = find(nodes, from.mName.C_Str());
  to.bone_from_mesh = matrix(from.mOffsetMatrix);
  for (unsigned i = 0; i < from.mNumWeights; ++i)
  {
    to.vertices.push_back(from.mWeights[i].mVertexId);
    to.weights.push_back(from.mWeights[i].mWeight);
  }
  return to;
}

void addTargets(const aiMesh& from, Mesh& to)
{
  for (unsigned i = 0; i < from.mNumAnimMeshes; ++i)
  {
    const aiAnimMesh& target = *from.mAnimMeshes[i];
    Target made;
    made.weight = static_cast<double>(target.mWeight);
    made.positions = to.positions;
    if (target.mVertices && target.mNumVertices == from.mNumVertices)
    {
      made.positions = vectors(target.mVertices, target.mNumVertices);
    }
    to.targets.push_back(std::move(made));
  }
}

bool colorsVary(const aiMesh& mesh)
{
  const aiColor4D* colors = mesh.mColors[0];
  for (unsigned i = 0; colors && i < mesh.mNumVertices; ++i)
  {
    if (colors[i].r != 1 || colors[i].g != 1 || colors[i].b != 1)
    {
      return true;
    }
  }
  return false;
}

Mesh converted(const aiScene& scene, bool gltf, const aiMesh& from, const NodeIndex& nodes)
{
  Mesh to;
  to.name = from.mName.C_Str();
  to.material = static_cast<std::int32_t>(from.mMaterialIndex);
  to.positions = vectors(from.mVertices, from.mVertices ? from.mNumVertices : 0);
  if (from.mNormals)
  {
    to.normals = vectors(from.mNormals, from.mNumVertices);
  }
  const PicturePlace place = placeOf(scene, from.mMaterialIndex, gltf);
  if (const aiVector3D* uv = from.mTextureCoords[place.channel])
  {
    for (unsigned i = 0; i < from.mNumVertices; ++i)
    {
      to.uvs.push_back({ uv[i].x * place.scale[0] + place.offset[0], uv[i].y * place.scale[1] + place.offset[1] });
    }
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i)
  {
    const aiFace& face = from.mFaces[i];
    to.faceSizes.push_back(face.mNumIndices);
    to.faceVertices.insert(to.faceVertices.end(), face.mIndices, face.mIndices + face.mNumIndices);
  }
  for (unsigned i = 0; i < from.mNumBones; ++i)
  {
    to.bones.push_back(converted(*from.mBones[i], nodes));
  }
  addTargets(from, to);
  return to;
}

template <std::size_t N, class Key, class Value>
Keys<N> keys(const Key* from, unsigned count, double ticks, Value value)
{
  Keys<N> to;
  for (unsigned i = 0; i < count; ++i)
  {
    // importers leave keys unsorted or doubled now and then
    const double time = from[i].mTime / ticks;
    if (to.times.empty() || time > to.times.back())
    {
      to.times.push_back(time);
      to.values.push_back(value(from[i].mValue));
    }
  }
  return to;
}

Channel converted(const aiNodeAnim& from, double ticks, const NodeIndex& nodes)
{
  const auto vector = [](const aiVector3D& v) { return std::array<double, 3>{ v.x, v.y, v.z }; };
  const auto rotation = [](const aiQuaternion& q) { return std::array<double, 4>{ q.w, q.x, q.y, q.z }; };
  Channel to;
  to.node = find(nodes, from.mNodeName.C_Str());
  to.translation = keys<3>(from.mPositionKeys, from.mNumPositionKeys, ticks, vector);
  to.rotation = keys<4>(from.mRotationKeys, from.mNumRotationKeys, ticks, rotation);
  to.scale = keys<3>(from.mScalingKeys, from.mNumScalingKeys, ticks, vector);
  return to;
}

MorphChannel converted(const aiMeshMorphAnim& from, double ticks, std::int32_t node)
{
  MorphChannel to;
  to.node = node;
  for (unsigned i = 0; i < from.mNumKeys; ++i)
  {
    for (unsigned j = 0; j < from.mKeys[i].mNumValuesAndWeights; ++j)
    {
      to.targets = std::max(to.targets, from.mKeys[i].mValues[j] + 1);
    }
  }
  if (to.targets > 65536)
  {
    throw std::runtime_error("has too many morph targets");
  }
  for (unsigned i = 0; i < from.mNumKeys; ++i)
  {
    const double time = from.mKeys[i].mTime / ticks;
    if (!to.times.empty() && !(time > to.times.back()))
    {
      continue;
    }
    const std::size_t row = to.weights.size();
    to.times.push_back(time);
    to.weights.resize(row + to.targets, 0);
    for (unsigned j = 0; j < from.mKeys[i].mNumValuesAndWeights; ++j)
    {
      to.weights[row + from.mKeys[i].mValues[j]] = from.mKeys[i].mWeights[j];
    }
  }
  return to;
}

Animation converted(const aiAnimation& from, const NodeIndex& nodes)
{
  Animation to;
  const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25;
  to.name = from.mName.C_Str();
  to.duration = from.mDuration / ticks;
  for (unsigned i = 0; i < from.mNumChannels; ++i)
  {
    to.channels.push_back(converted(*from.mChannels[i], ticks, nodes));
  }
  for (unsigned i = 0; i < from.mNumMorphMeshChannels; ++i)
  {
    const aiMeshMorphAnim& morph = *from.mMorphMeshChannels[i];
    to.morphs.push_back(converted(morph, ticks, find(nodes, morph.mName.C_Str())));
  }
  for (const MorphChannel& morph : to.morphs)
  {
    to.duration = std::max(to.duration, morph.times.empty() ? 0 : morph.times.back());
  }
  return to;
}
} // namespace

void convert(const aiScene& from, bool gltf, Scene& to)
{
  if (!from.mRootNode)
  {
    throw std::runtime_error("has no node");
  }
  NodeIndex nodes;
  addNode(*from.mRootNode, noIndex, 0, to, nodes);
  convertMaterials(from, gltf, to);
  bool colored = false;
  for (unsigned i = 0; i < from.mNumMeshes; ++i)
  {
    to.meshes.push_back(converted(from, gltf, *from.mMeshes[i], nodes));
    colored = colored || (!gltf && colorsVary(*from.mMeshes[i]));
  }
  if (colored)
  {
    to.warnings.emplace_back("colours of vertices are not drawn");
  }
  for (unsigned i = 0; i < from.mNumAnimations; ++i)
  {
    to.animations.push_back(converted(*from.mAnimations[i], nodes));
  }
}

} // namespace dgtk::import
