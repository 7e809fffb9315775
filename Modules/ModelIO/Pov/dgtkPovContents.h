// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovContents_h
#define dgtkPovContents_h

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// What a pigment says, as far as a Material can hold it.
struct PovPigment
{
  Eigen::Vector3d color{ 1, 1, 1 };
  double filter = 0;
  double transmit = 0;
  bool hasColor = false;
  std::string image; ///< of an image_map, or ""
  bool uvMapping = false;
  int mapType = 0; ///< of the image_map; 0 is planar
  /// Where the image lies: point of the pattern from a point of the object (or from (u, v, 0)).
  Eigen::Affine3d object_from_pattern = Eigen::Affine3d::Identity();
};

struct PovFinish
{
  double ambient = -1; ///< below 0: not said
  double diffuse = -1;
  double specular = 0;
  double roughness = 0.05;
  double phong = 0;
  double phongSize = 40;
  double emission = 0;
};

struct PovTexture
{
  PovPigment pigment;
  PovFinish finish;
  std::string name;
};
using PovTexturePointer = std::shared_ptr<const PovTexture>;

/// Triangles of a mesh, a mesh2, or a run of bare triangles.
struct PovMesh
{
  struct Face
  {
    std::array<std::uint32_t, 3> vertex{};
    std::array<std::int32_t, 3> normal{ -1, -1, -1 };
    std::array<std::int32_t, 3> uv{ -1, -1, -1 };
    std::int32_t texture = -1; ///< index of `textures`, or -1: the object's
  };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Face> faces;
  std::vector<PovTexturePointer> textures;
  bool isNumbered = true; ///< the vertices are a list in the file
};

/// A mesh where it stands.
struct PovInstance
{
  std::shared_ptr<const PovMesh> mesh;
  Eigen::Affine3d scene_from_mesh = Eigen::Affine3d::Identity();
  Eigen::Affine3d texture_from_mesh = Eigen::Affine3d::Identity(); ///< what happened before its texture was given
  PovTexturePointer texture;                                       ///< null: the default texture
  std::string name;
};
using PovShape = std::vector<PovInstance>;

/// What a scene file leaves.
struct PovContents
{
  PovShape shape;
  PovTexturePointer defaultTexture;
  bool rightHanded = false; ///< the camera's `right` has a negative x
  std::vector<std::string> warnings;
  std::uint64_t bytesRead = 0;
  std::vector<std::string> files; ///< all that were read, the scene itself first
};

/// Reads the subset of POV-Ray's language that says where triangles are and how they look: literals, constant
/// arithmetic, declarations, inclusions and conditions are followed; loops, macros and functions are not. What a mesh
/// depends on is then refused, everything else skipped with a warning. Throws InputError.
PovContents readPovContents(const std::string& path);

} // namespace dgtk

#endif
