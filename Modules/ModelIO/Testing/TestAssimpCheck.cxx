// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpCheck.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

using namespace dgtk::import;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// What a helper may send: each list that can be of a wrong length has one, and cubic keys have tangents.
Scene soundScene()
{
  Scene scene;
  Mesh mesh;
  mesh.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  mesh.normals = mesh.positions;
  mesh.restNormals = mesh.positions;
  mesh.uvs.resize(3);
  mesh.colors.resize(3);
  mesh.faceSizes = { 3 };
  mesh.faceVertices = { 0, 1, 2 };
  Bone bone;
  bone.node = 1;
  bone.vertices = { 0, 2 };
  bone.weights = { 1, 0.5F };
  mesh.bones = { bone };
  Target target;
  target.positions = mesh.positions;
  mesh.targets = { target };
  mesh.dualQuaternions = { 0, 0.5, 1 };
  Blend blend;
  blend.targets = { 0 };
  blend.full = { 100 };
  mesh.blends = { blend };
  scene.meshes = { mesh };

  scene.nodes.resize(3);
  scene.nodes[1].parent = 0;
  scene.nodes[1].meshes = { 0 };
  scene.nodes[2].parent = 1;
  scene.nodes[2].joint.resize(1);

  Animation animation;
  animation.duration = 2;
  Channel channel;
  channel.node = 1;
  channel.translation.times = { 0, 1 };
  channel.translation.values.resize(2);
  channel.translation.interpolation = Interpolation::Cubic;
  channel.translation.in.resize(2);
  channel.translation.out.resize(2);
  channel.rotation.times = { 0, 1 };
  channel.rotation.values.resize(2);
  channel.scale.times = { 0, 1 };
  channel.scale.values.resize(2);
  animation.channels = { channel };
  MorphChannel morph;
  morph.node = 1;
  morph.times = { 0, 1 };
  morph.targets = 2;
  morph.weights = { 0, 0.5, 1, 0 };
  morph.interpolation = Interpolation::Cubic;
  morph.in.resize(4);
  morph.out.resize(4);
  animation.morphs = { morph };
  Curve curve;
  curve.times = { 0, 1 };
  curve.values = { 3, 4 };
  curve.segments.resize(2);
  curve.handles.resize(2);
  animation.curves = { curve };
  Layer layer;
  layer.weightCurve = 0;
  layer.curves = { 0, -1, 0 };
  JointChannel joint;
  joint.node = 2;
  joint.layers = { layer };
  animation.joints = { joint };
  animation.blends.resize(2);
  animation.blends[1].number = 1;
  animation.blends[1].layers = { layer };
  scene.animations = { animation };
  return scene;
}

struct Error
{
  const char* says;
  std::function<void(Scene&)> plant;
};

std::string refusalOf(const Scene& scene)
{
  try
  {
    dgtk::checkScene(scene);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

void expectEachIsRefused(const std::vector<Error>& errors)
{
  ASSERT_EQ(refusalOf(soundScene()), "");
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    Scene scene = soundScene();
    errors[i].plant(scene);
    EXPECT_EQ(refusalOf(scene), errors[i].says) << "error " << i;
  }
}

Mesh& meshOf(Scene& scene) { return scene.meshes[0]; }
Bone& boneOf(Scene& scene) { return scene.meshes[0].bones[0]; }
Joint& jointOf(Scene& scene) { return scene.nodes[2].joint[0]; }
Animation& animationOf(Scene& scene) { return scene.animations[0]; }
Channel& channelOf(Scene& scene) { return scene.animations[0].channels[0]; }
MorphChannel& morphOf(Scene& scene) { return scene.animations[0].morphs[0]; }
Curve& curveOf(Scene& scene) { return scene.animations[0].curves[0]; }
Layer& layerOf(Scene& scene) { return scene.animations[0].joints[0].layers[0]; }
} // namespace

TEST(AssimpCheck, MeshesAreRefusedForEachListAndIndex)
{
  expectEachIsRefused({
    { "normals and vertices do not match", [](Scene& s) { meshOf(s).normals.pop_back(); } },
    { "normals and vertices do not match", [](Scene& s) { meshOf(s).restNormals.pop_back(); } },
    { "texture coordinates and vertices do not match", [](Scene& s) { meshOf(s).uvs.pop_back(); } },
    { "colours and vertices do not match", [](Scene& s) { meshOf(s).colors.pop_back(); } },
    { "faces and their corners do not match", [](Scene& s) { meshOf(s).faceSizes = { 2 }; } },
    { "faces and their corners do not match",
      [](Scene& s) {
        meshOf(s).faceSizes = { 0xffffffffu, 4 };
      } }, // 3 of 2^32
    { "a face names a vertex that does not exist", [](Scene& s) { meshOf(s).faceVertices[2] = 3; } },
    { "a bone has no node", [](Scene& s) { boneOf(s).node = 3; } },
    { "a bone has no node", [](Scene& s) { boneOf(s).node = -2; } },
    { "vertices and weights of a bone do not match", [](Scene& s) { boneOf(s).weights.pop_back(); } },
    { "a bone moves a vertex that does not exist", [](Scene& s) { boneOf(s).vertices[1] = 3; } },
    { "a bone's numbers are not finite", [](Scene& s) { boneOf(s).weights[1] = float(notANumber); } },
    { "a bone's numbers are not finite", [](Scene& s) { boneOf(s).bone_from_mesh[15] = infinite; } },
    { "a morph target and its mesh do not match", [](Scene& s) { meshOf(s).targets[0].positions.pop_back(); } },
    { "a morph target's weight is not finite", [](Scene& s) { meshOf(s).targets[0].weight = notANumber; } },
    { "shares and vertices do not match", [](Scene& s) { meshOf(s).dualQuaternions.pop_back(); } },
    { "a share of dual quaternions is not finite", [](Scene& s) { meshOf(s).dualQuaternions[2] = notANumber; } },
    { "a blend shape and its targets do not match", [](Scene& s) { meshOf(s).blends[0].percent = infinite; } },
    { "a blend shape and its targets do not match", [](Scene& s) { meshOf(s).blends[0].full[0] = notANumber; } },
    { "a blend shape and its targets do not match", [](Scene& s) { meshOf(s).blends[0].full.push_back(200); } },
    { "a blend shape and its targets do not match", [](Scene& s) { meshOf(s).blends[0].targets[0] = 1; } },
  });
}

TEST(AssimpCheck, NodesAreRefusedForEachIndexAndNumber)
{
  expectEachIsRefused({
    { "no node", [](Scene& s) { s.nodes.clear(); } },
    { "a node stands before its parent", [](Scene& s) { s.nodes[0].parent = 0; } },
    { "a node stands before its parent", [](Scene& s) { s.nodes[1].parent = noIndex; } },
    { "a node stands before its parent", [](Scene& s) { s.nodes[2].parent = 2; } },
    { "a node's transform is not finite", [](Scene& s) { s.nodes[1].parent_from_node[3] = notANumber; } },
    { "a node is several joints", [](Scene& s) { s.nodes[2].joint.resize(2); } },
    { "a node names a mesh that does not exist", [](Scene& s) { s.nodes[2].meshes = { 1 }; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).translation[2] = notANumber; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).rotation[2] = notANumber; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).scale[2] = infinite; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).before[15] = notANumber; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).middle[15] = notANumber; } },
    { "a node's transform is not finite", [](Scene& s) { jointOf(s).after[15] = notANumber; } },
    { "a node turns about an axis that does not exist",
      [](Scene& s) {
        jointOf(s).order = { 2, 0, 2 };
      } },
    { "a node turns about an axis that does not exist",
      [](Scene& s) {
        jointOf(s).order = { 0, 1, 3 };
      } },
  });
}

TEST(AssimpCheck, KeysAreRefusedForEachListIndexAndTime)
{
  expectEachIsRefused({
    { "an animation's duration is not a time", [](Scene& s) { animationOf(s).duration = -1; } },
    { "an animation's duration is not a time", [](Scene& s) { animationOf(s).duration = infinite; } },
    { "an animation moves a node that does not exist", [](Scene& s) { channelOf(s).node = 3; } },
    { "an animation moves a node that does not exist", [](Scene& s) { channelOf(s).node = -2; } },
    { "a key's time is not finite", [](Scene& s) { channelOf(s).translation.times[1] = notANumber; } },
    { "keys are not in the order of time", [](Scene& s) { channelOf(s).translation.times[1] = 0; } },
    { "keys are not in the order of time",
      [](Scene& s) {
        channelOf(s).rotation.times = { 2, 1 };
      } },
    { "keys are not in the order of time",
      [](Scene& s) {
        channelOf(s).scale.times = { 2, 1 };
      } },
    { "times and values of keys do not match", [](Scene& s) { channelOf(s).rotation.values.pop_back(); } },
    { "times and tangents of keys do not match", [](Scene& s) { channelOf(s).translation.in.pop_back(); } },
    { "times and tangents of keys do not match", [](Scene& s) { channelOf(s).translation.out.pop_back(); } },
    { "times and tangents of keys do not match", [](Scene& s) { channelOf(s).rotation.in.resize(2); } },
    { "times and tangents of keys do not match",
      [](Scene& s) { channelOf(s).rotation.interpolation = Interpolation::Cubic; } },
    { "a key's value is not finite", [](Scene& s) { channelOf(s).rotation.values[1][3] = notANumber; } },
    { "a key's value is not finite", [](Scene& s) { channelOf(s).translation.in[1][2] = notANumber; } },
    { "a key's value is not finite", [](Scene& s) { channelOf(s).translation.out[1][2] = infinite; } },
    { "an animation moves a node that does not exist", [](Scene& s) { morphOf(s).node = 3; } },
    { "keys are not in the order of time",
      [](Scene& s) {
        morphOf(s).times = { 1, 1 };
      } },
    { "times and weights of morph targets do not match", [](Scene& s) { morphOf(s).targets = 1; } },
    { "times and weights of morph targets do not match", [](Scene& s) { morphOf(s).weights[3] = notANumber; } },
    { "times and tangents of morph targets do not match", [](Scene& s) { morphOf(s).in.pop_back(); } },
    { "times and tangents of morph targets do not match", [](Scene& s) { morphOf(s).out.pop_back(); } },
    { "times and tangents of morph targets do not match", [](Scene& s) { morphOf(s).in[3] = notANumber; } },
    { "times and tangents of morph targets do not match", [](Scene& s) { morphOf(s).out[3] = notANumber; } },
    { "times and tangents of morph targets do not match",
      [](Scene& s) { morphOf(s).interpolation = Interpolation::Linear; } },
  });
}

TEST(AssimpCheck, CurvesAndLayersAreRefusedForEachListAndIndex)
{
  expectEachIsRefused({
    { "a key's time is not finite", [](Scene& s) { curveOf(s).times[0] = -infinite; } },
    { "keys are not in the order of time", [](Scene& s) { curveOf(s).times[0] = 1; } },
    { "times and values of keys do not match", [](Scene& s) { curveOf(s) = {}; } },
    { "times and values of keys do not match", [](Scene& s) { curveOf(s).values.pop_back(); } },
    { "times and values of keys do not match", [](Scene& s) { curveOf(s).segments.pop_back(); } },
    { "times and values of keys do not match", [](Scene& s) { curveOf(s).handles.pop_back(); } },
    { "a key's value is not finite", [](Scene& s) { curveOf(s).values[1] = notANumber; } },
    { "a key's value is not finite", [](Scene& s) { curveOf(s).slopes[1] = notANumber; } },
    { "a key's value is not finite", [](Scene& s) { curveOf(s).handles[1][3] = notANumber; } },
    { "an animation moves a node that does not exist", [](Scene& s) { animationOf(s).joints[0].node = noIndex; } },
    { "an animation moves a node that does not exist", [](Scene& s) { animationOf(s).joints[0].node = 3; } },
    { "a layer's value is not finite", [](Scene& s) { layerOf(s).values[2] = notANumber; } },
    { "a layer's value is not finite", [](Scene& s) { layerOf(s).weight = notANumber; } },
    { "a layer names a curve that does not exist", [](Scene& s) { layerOf(s).weightCurve = 1; } },
    { "a layer names a curve that does not exist", [](Scene& s) { layerOf(s).curves[2] = 1; } },
    { "blend shapes are not in order", [](Scene& s) { animationOf(s).blends[1].number = 0; } },
    { "a layer names a curve that does not exist", [](Scene& s) { animationOf(s).blends[1].layers[0].curves[0] = 1; } },
  });
}
