// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModel_h
#define dgtkModel_h

#include "dgtkModelIOModule.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// A decoded picture: RGBA, 8 bits, sRGB, rows top to bottom.
struct Image
{
  int width = 0;
  int height = 0;
  bool hasAlpha = false; ///< some texel has alpha < 255
  std::vector<std::uint8_t> rgba;
};

/// A picture of light: linear radiance, R, G, B, rows top to bottom.
struct RadianceImage
{
  int width = 0;
  int height = 0;
  std::vector<float> rgb; ///< finite, >= 0
};

/// What a picture gives between its texels, and where it is minified.
enum class TextureFilter
{
  Smooth, ///< the mean of what a pixel covers: pyramid of pictures, anisotropic
  Linear, ///< interpolated between four texels, whatever a pixel covers
  Nearest ///< the texel
};

/// What there is of a picture outside [0, 1] of a texture coordinate.
enum class TextureWrap : std::uint8_t
{
  Repeat,
  Clamp, ///< its border goes on
  Mirror ///< it repeats, every second time the other way round
};
using TextureWraps = std::array<TextureWrap, 2>; ///< along u and v

/// A texture as the model names it. `image` is null when it was not found or cannot be decoded; a warning of the
/// model says what was tried. Texture coordinates: (0, 0) is the lower left corner of the picture, (1, 1) the upper
/// right.
struct Texture
{
  std::string name; ///< as written in the model
  std::string path; ///< file that was found, or empty
  std::shared_ptr<const Image> image;
  TextureFilter filter = TextureFilter::Smooth;
  TextureWraps wrap{};

  bool repeats() const { return this->wrap == TextureWraps{}; } ///< along both
};

/// Colours are display-referred (sRGB) in [0, 1], multiplied with the texture's.
struct Material
{
  std::string name;
  Eigen::Vector3d ambient{ 0.2, 0.2, 0.2 };
  Eigen::Vector3d diffuse{ 0.8, 0.8, 0.8 };
  Eigen::Vector3d specular{ 0, 0, 0 };
  Eigen::Vector3d emission{ 0, 0, 0 }; ///< of what is physical [0, 1000]: it may be brighter than white
  double shininess = 0;                ///< Phong exponent, [0, 128]
  double opacity = 1;                  ///< 1 opaque; below 1 translucent for colour only
  bool twoSided = false;               ///< as the file says; every surface is hit and drawn from both sides regardless
  int texture = -1;                    ///< index into Model::textures, or -1
  /// Texels of `texture` with alpha below 0.5 are not there.
  bool cutOut = false;

  /// Metal and roughness, as glTF 2 has them, whose base colour is `diffuse`; `specular` does not count then.
  struct Physical
  {
    double metallic = 0;  ///< [0, 1]
    double roughness = 1; ///< [0, 1], perceptual
    bool wanted = false;  ///< the scene asks for it; what a file says counts only in the light of an environment
  };
  std::optional<Physical> physical;
  // Indices into Model::textures, or -1. All use the texture coordinates of `texture`.
  int normalMap = -1;            ///< tangent-space normals, glTF's conventions (+y up in the picture)
  int bumpMap = -1;              ///< heights, black low
  int metallicRoughnessMap = -1; ///< blue times metallic, green times roughness
  int emissionMap = -1;          ///< times the emission, sRGB
  int occlusionMap = -1;         ///< red times the environment's light
  double normalScale = 1;        ///< times the x and y of normalMap
  double bumpScale = 1;          ///< scene units between black and white
  double occlusionStrength = 1;  ///< [0, 1]
  /// Of surfaces without texture coordinates, a copy of another: whatever a scene says, it has no pictures, and it does
  /// not glow where a picture says what of the other does.
  bool isBare = false;
  bool isDark = false;
};

/// The textures of a material, that of its colour first.
constexpr std::array<int Material::*, 6> materialTextures{ &Material::texture, &Material::normalMap, &Material::bumpMap,
  &Material::metallicRoughnessMap, &Material::emissionMap, &Material::occlusionMap };

/// Triangles [firstTriangle, firstTriangle + triangles) of the model, all of one material.
struct Part
{
  std::string name;
  int material = 0; ///< index into Model::materials
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
};

/// One named motion of a model, in the model's own frames.
struct Animation
{
  std::string name;
  int first = 0;   ///< first frame
  int last = 0;    ///< last frame, included
  double fps = 10; ///< frames a second
  /// Named in a file beside the model (.anm), not in the model itself.
  bool beside = false;
  double length = 0; ///< frames from the first one to the end, which may lie between two; 0: `last` is the end

  double span() const { return this->length > 0 ? this->length : std::max(0, this->last - this->first); }
};

/// Positions of the vertices of a model over time. The topology never changes.
class DGTKMODELIO_EXPORT Deformation
{
public:
  virtual ~Deformation() = default;
  /// Writes the position of every source vertex (Model::sourceVertices of them), in the model's axes, at a model
  /// frame; fractions interpolate between neighbouring frames of the same animation, values outside are clamped to
  /// its span. `animation` indexes Model::animations. Thread-safe.
  virtual void positionsAt(int animation, double frame, std::vector<Eigen::Vector3d>& sourcePositions) const = 0;
  /// Whether an animation is known to leave everything as at its first frame, whatever the frame.
  virtual bool holds(int animation) const
  {
    static_cast<void>(animation);
    return false;
  }
  /// All of it as bytes, for models that are kept for other runs.
  virtual std::string saved() const { return {}; }
};

/// Geometry of a model at one instant. Vertices are split so that each has one normal and one texture coordinate.
struct Geometry
{
  std::vector<Eigen::Vector3d> positions; ///< model axes, file units
  std::vector<Eigen::Vector3f> normals;   ///< unit length, one per position; the shading normal
};

/// What a reader returns. Immutable once loaded and shared by all instances.
struct Model
{
  std::string format; ///< "ac3d", "md2", "3ds", "pov", "obj", "stl", "ply", "gltf", "collada", "fbx", "off", "blend"
  std::string path;
  std::vector<std::string> warnings;   ///< one line each
  std::vector<std::string> companions; ///< paths of other files that were read for it, its textures apart

  std::vector<Material> materials; ///< never empty when there are parts
  std::vector<Texture> textures;
  std::vector<Part> parts;
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices of split vertices, counter-clockwise from outside

  std::shared_ptr<const Geometry> rest; ///< geometry of the first frame; never null
  std::vector<Eigen::Vector2d> uvs;     ///< one per split vertex, or empty when no part has a texture coordinate
  std::vector<std::uint8_t> unplaced;   ///< 1 for triangles whose `uvs` are not of the file but 0; empty: none of them
  /// Colours of the split vertices, R, G, B, A, 8 bits, sRGB, interpolated: times the ambient and diffuse colour, A
  /// times the opacity. Empty: none.
  std::vector<std::array<std::uint8_t, 4>> colors;
  /// Instead of `colors`, places in this picture, (0, 0) its lower left corner: the nearest texel at the interpolated
  /// place is the colour.
  std::shared_ptr<const Image> colorMap;
  std::vector<Eigen::Vector2d> colorMapAt;
  /// Split vertex -> source vertex: a vertex of the file, or all those of it that are one, as they lie at one place.
  std::vector<std::uint32_t> sourceVertex;
  std::size_t sourceVertices = 0;
  std::vector<std::uint32_t> sourceOf; ///< vertex of the file -> source vertex; empty where they are the same
  bool isNumbered = true;              ///< the file has one numbering of its vertices, and these are its numbers
  /// Split vertex -> smoothing group; on deformation a group's normal is the normalised sum of its triangles'
  /// area-weighted normals. Empty for models without deformation.
  std::vector<std::uint32_t> normalGroup;

  std::shared_ptr<const Deformation> deformation; ///< null for rigid models
  std::vector<Animation> animations;
  int frames = 1; ///< number of frames in the file

  // Counted as `dgtk info` prints them.
  std::size_t lines = 0; ///< line segments of the file; they are not surfaces and not drawn
  /// Triangles of the meshes as written, each once, where a file draws a mesh more than once; else 0.
  std::size_t declaredTriangles = 0;
  std::size_t twoSidedTriangles = 0; ///< triangles marked two-sided
  std::size_t twoSidedSurfaces = 0;  ///< surfaces (polygons) marked two-sided, where the format has them
  std::size_t declaredMaterials = 0; ///< materials defined in the file, used or not
  /// [min, max] of the referenced vertices at the first frame, file axes; an empty model has min > max. Lines count.
  Eigen::Vector3d boundsMin{ 1, 1, 1 };
  Eigen::Vector3d boundsMax{ -1, -1, -1 };

  /// Vertices of the file: what `dgtk info` counts.
  std::size_t fileVertices() const { return this->sourceOf.empty() ? this->sourceVertices : this->sourceOf.size(); }
  /// The first split vertex that stands for a vertex of the file; none for one of no triangle.
  DGTKMODELIO_EXPORT std::optional<std::size_t> splitVertexOf(std::uint32_t fileVertex) const;
  bool hasUvs(std::uint32_t triangle) const
  {
    return !this->uvs.empty() && (this->unplaced.empty() || this->unplaced[triangle] == 0);
  }
  /// Part of a triangle of the model, by binary search. triangle < triangles.size().
  DGTKMODELIO_EXPORT std::uint32_t partOf(std::uint32_t triangle) const;
  /// Whether the picture of one of `textures` is in no file of its own.
  bool holds(const Texture& texture) const { return texture.path.empty() || texture.path == this->path; }
  /// Whether some texture coordinate of a part is outside [0, 1] by more than rounding.
  DGTKMODELIO_EXPORT bool reachesBeyondPictures(const Part& part) const;
};

/// Geometry of a deforming model at a model frame; `model.rest` for a rigid one.
DGTKMODELIO_EXPORT std::shared_ptr<const Geometry> geometryAt(const Model& model, int animation, double frame);

} // namespace dgtk

#endif
