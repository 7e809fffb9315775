// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelBuilder_h
#define dgtkModelBuilder_h

#include "dgtkModelContents.h"
#include "dgtkModelReader.h"
#include "dgtkTriangulate.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// A corner of a surface as a file gives it.
struct Corner
{
  std::uint32_t vertex = 0; ///< as returned by ModelBuilder::addVertex, of the current object
  std::int32_t normal = -1; ///< as returned by ModelBuilder::addNormal, of the current object; -1: computed
  float u = NAN;            ///< a surface none of whose corners has a texture coordinate is drawn without pictures
  float v = NAN;
  std::array<std::uint8_t, 4> color{ 255, 255, 255, 255 }; ///< R, G, B, A; see ModelBuilder::setHasColors()
};

/// The bytes of a colour of 3 or 4 numbers, white at 1; what is none of these is cut off.
std::array<std::uint8_t, 4> colorBytes(const double* rgb, double alpha = 1);

/// How the normals of a surface are computed where its corners name none.
enum class Shading : std::uint8_t
{
  Flat,   ///< the surface's own
  Crease, ///< mean of the object's Crease surfaces at the vertex whose normals differ by at most the crease angle
  Groups, ///< area-weighted mean of the object's surfaces at the vertex that share a bit of the smoothing mask
  Area    ///< area-weighted mean of all Area surfaces of the object at the vertex
};

/// What every triangle of a surface shares.
struct SurfaceStyle
{
  int material = 0; ///< as returned by ModelBuilder::addMaterial
  Shading shading = Shading::Flat;
  std::uint32_t groups = 0; ///< smoothing mask of Shading::Groups; 0 is flat
  bool twoSided = false;    ///< the file marks the surface as two-sided
};

struct ModelObject;

/// Collects what a reader finds, and makes a Model of it: triangulates polygons, computes normals, splits vertices,
/// groups triangles into parts by (object, material) in file order, and fills counts and bounds.
///
///   ModelBuilder builder(path, "ac3d", bytes, options);
///   const int material = builder.addMaterial(m);
///   builder.beginObject("hull");
///   const std::uint32_t v = builder.addVertex(p); ...
///   builder.addSurface({ { v, -1, 0, 0 }, ... }, style);
///   builder.endObject();
///   return builder.finish();
///
/// Surfaces that cannot be drawn (fewer than three corners, a vertex that does not exist or is not finite) are left
/// out and counted in a warning. Working memory is that of the current object.
class ModelBuilder
{
public:
  /// `fileBytes`: size of everything that was read, for the bound on memory.
  ModelBuilder(const std::string& path, const std::string& format, std::size_t fileBytes, const ReadOptions& options);
  ~ModelBuilder();
  ModelBuilder(const ModelBuilder&) = delete;
  ModelBuilder& operator=(const ModelBuilder&) = delete;

  /// The model under construction; for format-specific fields and counts.
  Model& model() { return *this->Contents.model; }
  /// One line; at most `mostModelWarnings` are kept, the rest is counted.
  void warn(const std::string& text);
  /// What the model depends on beside its file. Without this call, it is not kept for other runs.
  void keep(std::vector<ModelDependency> dependencies, std::uint64_t fromBytes);

  /// Adds a material and returns its index. Colours are clamped to [0, 1], values that are not finite replaced;
  /// withPictures() settles `cutOut` and what alpha means.
  int addMaterial(const Material& material, const MaterialAlpha& alpha = {});
  /// Changes a material that addMaterial returned and nothing uses yet.
  void setMaterial(int index, const Material& material);
  std::size_t materials() const { return this->Contents.model->materials.size(); }
  /// Index of the picture of that name, or -1 for "". When it is not found, `alternative` is looked for, or before it
  /// where that is the name in another folder, as it is written; `unescaped` is what it is called when not found.
  int addTexture(const std::string& name, const std::string& alternative = {}, const std::string& unescaped = {},
    const TextureWraps& wrap = {});
  /// The same for a picture that the model's file holds.
  int addEmbedded(ModelPicture picture);
  /// Index of a material that is `material` with that texture: shared by all calls with the same arguments.
  int withTexture(int material, int texture);
  /// Index of a grey material for surfaces that name none.
  int defaultMaterial();

  void beginObject(const std::string& name);
  /// Room for what the current object is going to hold; the caller has checked the numbers against the file's size.
  void reserve(std::size_t vertices, std::size_t surfaces, std::size_t corners);
  std::uint32_t addVertex(const Eigen::Vector3d& position);
  std::int32_t addNormal(const Eigen::Vector3d& normal);
  /// A planar polygon, convex or not, counter-clockwise; n corners make n - 2 triangles. False when it is left out.
  bool addSurface(const Corner* corners, std::size_t count, const SurfaceStyle& style);
  bool addSurface(const std::vector<Corner>& corners, const SurfaceStyle& style)
  {
    return this->addSurface(corners.data(), corners.size(), style);
  }
  /// A line segment between two vertices of the object: counts for Model::lines and the bounds.
  void addLine(std::uint32_t a, std::uint32_t b);
  void setObjectName(const std::string& name); ///< of the current object, for files that name it late
  void setCrease(double degrees);              ///< of the current object; default 61
  /// Makes the current object's surfaces part of the model.
  void endObject();

  /// Makes the model deform: vertices are the file's vertices in the order of addVertex.
  void setDeformation(std::shared_ptr<const Deformation> deformation)
  {
    this->Contents.model->deformation = std::move(deformation);
  }
  /// Makes Model::uvs be filled also when all texture coordinates are 0.
  void setHasUvs() { this->HasUvs = true; }
  /// Makes Model::colors be filled, from here on; comes before the first endObject().
  void setHasColors() { this->HasColors = true; }

  /// All of the model but its pictures; the builder is empty afterwards.
  ModelContents finish();

private:
  std::vector<Eigen::Vector3f> smooth();
  std::vector<std::uint32_t> addSplitVertices(const std::vector<Eigen::Vector3f>& normals);
  void addParts(const std::vector<std::uint32_t>& splitOf);
  bool addCorners(const Corner* corners, std::size_t count);
  void growBounds(const Eigen::Vector3d& position);
  bool usable(const Corner* corners, std::size_t count);
  bool hasPictures(int material) const;
  int withoutPictures(int material);
  void settleUnplaced();

  ModelContents Contents;
  std::shared_ptr<Geometry> Rest;
  bool WantsPictures;
  std::map<std::string, std::map<TextureWraps, int>> Pictures; ///< by name, in its folder
  std::unique_ptr<ModelObject> Current;
  std::uint64_t MemoryLimit;
  std::uint64_t WorkLimit; ///< of ear clipping and smoothing together
  std::uint64_t Work = 0;
  std::size_t SourceVertices = 0;
  std::size_t Warnings = 0; ///< kept
  std::size_t BadIndexSurfaces = 0;
  std::size_t NotFiniteSurfaces = 0;
  std::size_t SmallSurfaces = 0;
  int DefaultMaterial = -1;
  bool HasUvs = false;
  bool HasColors = false;
  bool GaveUpFlat = false;
  bool GaveUpShape = false;
  std::map<std::pair<int, int>, int> Textured; ///< (material, texture) -> material
};

/// Sets Model::sourceOf, where some vertex is not its own.
void setSourceOf(Model& model, std::vector<std::uint32_t> sourceOf);

/// A normal, not of unit length, where points go by `linear`: by its cofactors, which are the inverse transpose times
/// the determinant, also where a scale is 0.
Eigen::Vector3d turnedNormal(const Eigen::Matrix3d& linear, const Eigen::Vector3d& normal);

/// Newell's normal of a polygon: twice its area long.
Eigen::Vector3d polygonNormal(const std::vector<Eigen::Vector3d>& points);

/// Fills Model::normalGroup: split vertices of one file vertex that have the same normal at rest share a group.
void groupNormals(Model& model);

/// Unit normals of split vertices from area-weighted triangle normals summed over groups (Model::normalGroup; one group
/// a vertex when it is empty). Vertices without an area get `fallback`'s normal, or +z.
void areaNormals(const Model& model, const std::vector<Eigen::Vector3d>& positions,
  const std::vector<Eigen::Vector3f>* fallback, std::vector<Eigen::Vector3f>& normals);

} // namespace dgtk

#endif
