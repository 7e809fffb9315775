// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpStream_h
#define dgtkAssimpStream_h

#include "dgtkImportMotion.h"
#include "dgtkStream.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// What the helper program dgtk-import hands to the library (dgtkStream.h).
namespace dgtk::import
{

using Matrix = std::array<double, 16>; ///< row-major, target_from_source on column vectors
using Float3 = std::array<float, 3>;

constexpr std::int32_t noIndex = -1;

enum class AlphaMode : std::int32_t
{
  Unsaid,
  Opaque,
  Mask,
  Blend
};

enum class Wrap : std::int32_t
{
  Repeat,
  Clamp,
  Mirror
};

/// A picture as a material uses it.
struct Map
{
  std::string name;           ///< file name, "*N" for embedded texture N, or ""
  std::array<Wrap, 2> wrap{}; ///< along u and v
};

struct Material
{
  std::string name;
  std::array<double, 3> ambient{ 0.2, 0.2, 0.2 };
  std::array<double, 3> diffuse{ 0.8, 0.8, 0.8 };
  std::array<double, 3> specular{ 0, 0, 0 };
  std::array<double, 3> emission{ 0, 0, 0 };
  double shininess = 0;
  double opacity = 1;
  std::int32_t twoSided = 0;
  AlphaMode alpha = AlphaMode::Unsaid;
  double alphaCutoff = 0.5;
  Map texture;
  std::int32_t physical = 0; ///< metallic and roughness count
  double metallic = 0;
  double roughness = 1;
  double normalScale = 1;
  double occlusionStrength = 1;
  Map normalMap;
  Map metallicRoughnessMap;
  Map emissionMap;
  Map occlusionMap;
  Map mask;                         ///< how much is there: its alpha where it has one, its luminance otherwise
  std::int32_t maskIsLuminance = 0; ///< whatever its alpha
  double maskInverse = 0;           ///< above 0: how much is not there, times this
};

constexpr std::array<Map Material::*, 6> mapsOfMaterials{ &Material::texture, &Material::normalMap,
  &Material::metallicRoughnessMap, &Material::emissionMap, &Material::occlusionMap, &Material::mask };

/// `height` is 0 for an encoded picture (PNG, JPEG), whose bytes are `data`; else RGBA rows, top to bottom.
struct Texture
{
  std::string name;
  std::string type; ///< "png", "jpg", or ""
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<std::uint8_t> data;
};

struct Bone
{
  std::int32_t node = noIndex;
  Matrix bone_from_mesh{};
  std::vector<std::uint32_t> vertices;
  std::vector<float> weights;
};

/// A morph target: positions that replace the mesh's at weight 1.
struct Target
{
  double weight = 0; ///< when no animation says otherwise
  std::vector<Float3> positions;
};

struct Mesh
{
  std::string name;
  std::int32_t material = 0;
  std::vector<Float3> positions;
  std::vector<Float3> normals;                     ///< one per position, or none
  std::vector<Float3> restNormals;                 ///< those at the weights of targets; none: as `normals`
  std::vector<std::array<float, 2>> uvs;           ///< one per position, or none; origin lower left
  std::vector<std::array<std::uint8_t, 4>> colors; ///< one per position, or none: R, G, B (sRGB), A
  std::vector<std::uint32_t> faceSizes;            ///< corners of each face: 1 point, 2 line, 3 or more polygon
  std::vector<std::uint32_t> faceVertices;         ///< all faces, one after the other
  std::vector<Bone> bones;
  std::vector<Target> targets;
  std::vector<Blend> blends;           ///< when there are some, they give the targets' weights
  std::vector<double> dualQuaternions; ///< share of dual quaternions in the skinning, one a vertex, or none
};

/// Parents stand before their children; node 0 is the root.
struct Node
{
  std::string name;
  std::int32_t parent = noIndex;
  Matrix parent_from_node{};
  std::vector<std::uint32_t> meshes;
  std::vector<Joint> joint{}; ///< at most one: it says where the node is, instead of the matrix
};

/// What happens between two keys.
enum class Interpolation : std::int32_t
{
  Linear, ///< rotations: slerp
  Step,   ///< a value holds until the next key
  Cubic   ///< Hermite spline with the keys' tangents
};

template <std::size_t N>
struct Keys
{
  std::vector<double> times; ///< seconds, increasing
  std::vector<std::array<double, N>> values;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<std::array<double, N>> in;  ///< tangents, one a key, when cubic
  std::vector<std::array<double, N>> out; ///< the same on the other side
};

struct Channel
{
  std::int32_t node = noIndex;
  Keys<3> translation;
  Keys<4> rotation; ///< w, x, y, z
  Keys<3> scale;
};

/// Weights of the morph targets of all meshes of a node.
struct MorphChannel
{
  std::int32_t node = noIndex;
  std::vector<double> times; ///< seconds
  std::uint32_t targets = 0;
  std::vector<double> weights; ///< times.size() rows of `targets`
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> in; ///< tangents, as many as weights, when cubic
  std::vector<double> out;
};

struct Animation
{
  std::string name;
  double duration = 0; ///< seconds
  std::vector<Channel> channels;
  std::vector<MorphChannel> morphs;
  std::vector<Curve> curves;
  std::vector<JointChannel> joints;
  std::vector<BlendChannel> blends;
};

struct Scene
{
  std::uint64_t bytesRead = 0; ///< of all files
  std::string error;           ///< when not empty, nothing else counts
  std::string errorFile;       ///< the file it is in, as the importer named it; "" where that is not known
  std::uint64_t errorLine = 0; ///< from 1; 0 where that is not known
  std::vector<std::string> warnings;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Animation> animations;
  std::int64_t declaredMaterials = -1; ///< in the file, used or not; -1: `materials`
};

template <class A>
void io(A& a, Map& m)
{
  a(m.name), a(m.wrap);
}
template <class A>
void io(A& a, Material& m)
{
  a(m.name), a(m.ambient), a(m.diffuse), a(m.specular), a(m.emission), a(m.shininess), a(m.opacity), a(m.twoSided);
  a(m.alpha), a(m.alphaCutoff), a(m.texture);
  a(m.physical), a(m.metallic), a(m.roughness), a(m.normalScale), a(m.occlusionStrength);
  a(m.normalMap), a(m.metallicRoughnessMap), a(m.emissionMap), a(m.occlusionMap), a(m.mask), a(m.maskIsLuminance),
    a(m.maskInverse);
}
template <class A>
void io(A& a, Texture& t)
{
  a(t.name), a(t.type), a(t.width), a(t.height), a(t.data);
}
template <class A>
void io(A& a, Bone& b)
{
  a(b.node), a(b.bone_from_mesh), a(b.vertices), a(b.weights);
}
template <class A>
void io(A& a, Target& t)
{
  a(t.weight), a(t.positions);
}
template <class A>
void io(A& a, Mesh& m)
{
  a(m.name), a(m.material), a(m.positions), a(m.normals), a(m.restNormals), a(m.uvs), a(m.colors), a(m.faceSizes),
    a(m.faceVertices);
  a(m.bones), a(m.targets), a(m.blends), a(m.dualQuaternions);
}
template <class A>
void io(A& a, Node& n)
{
  a(n.name), a(n.parent), a(n.parent_from_node), a(n.meshes), a(n.joint);
}
template <class A, std::size_t N>
void io(A& a, Keys<N>& k)
{
  a(k.times), a(k.values), a(k.interpolation), a(k.in), a(k.out);
}
template <class A>
void io(A& a, Channel& c)
{
  a(c.node), a(c.translation), a(c.rotation), a(c.scale);
}
template <class A>
void io(A& a, MorphChannel& c)
{
  a(c.node), a(c.times), a(c.targets), a(c.weights), a(c.interpolation), a(c.in), a(c.out);
}
template <class A>
void io(A& a, Animation& n)
{
  a(n.name), a(n.duration), a(n.channels), a(n.morphs), a(n.curves), a(n.joints), a(n.blends);
}
constexpr std::uint32_t streamBegin = 0x31494744;
constexpr std::uint32_t streamEnd = 0x45494744;
template <class A>
void io(A& a, Scene& s)
{
  a.mark(streamBegin);
  a(s.bytesRead), a(s.error), a(s.errorFile), a(s.errorLine), a(s.warnings), a(s.materials), a(s.textures), a(s.meshes),
    a(s.nodes), a(s.animations), a(s.declaredMaterials);
  a.mark(streamEnd);
}

} // namespace dgtk::import

#endif
