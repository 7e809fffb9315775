// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterModels_h
#define dgtkRasterModels_h

#include "dgtkMaterialMaps.h"
#include "dgtkPartMapper.h"
#include "dgtkSceneState.h"

#include <map>
#include <memory>
#include <vector>
#include <vtkSmartPointer.h>

class vtkFloatArray;
class vtkOpenGLProperty;
class vtkOpenGLRenderWindow;
class vtkOpenGLTexture;
class vtkPolyData;

namespace dgtk
{

/// A model's triangles, renumbered so that vertex t is the last vertex of triangle t and of no other; in this way a
/// triangle's number reaches the fragments.
struct RasterTopology
{
  std::vector<std::uint32_t> source; ///< vertex -> vertex of the model
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool numbered = true;
};
/// Where numbers are not wanted, the model's own vertices, fewer, with each triangle's corners in the same order: the
/// same pixels.
RasterTopology rasterTopology(const Model& model, bool numbered = true);

/// Geometry of a model at an instant.
struct RasterGeometry
{
  std::shared_ptr<const Model> model;
  std::shared_ptr<const RasterTopology> topology;
  std::shared_ptr<const Geometry> geometry;
  Eigen::Vector3d origin; ///< subtracted from the positions before they become float
  vtkSmartPointer<vtkFloatArray> points;
  vtkSmartPointer<vtkFloatArray> normals;
  vtkSmartPointer<vtkPolyData> data;
};

/// Part of a model, or a piece of a part of more triangles than ids count.
struct RasterChunk
{
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
  Eigen::Vector3d boxMin; ///< relative to RasterGeometry::origin
  Eigen::Vector3d boxMax;
  std::array<float, 3> emission{};
  SurfaceParameters surface;
  bool translucent = false;
  vtkSmartPointer<PartMapper> mapper;
  vtkSmartPointer<vtkOpenGLProperty> property;
  vtkSmartPointer<vtkOpenGLTexture> texture;
};

/// A geometry with a set of materials.
struct RasterModel
{
  std::shared_ptr<RasterGeometry> geometry;
  std::shared_ptr<const std::vector<Material>> materials;
  std::vector<RasterChunk> chunks;
  bool used = false;
};

/// VTK's objects for the models of a scene: made once for all instances of a model and kept from state to state. The
/// context must be current.
class RasterModels
{
public:
  static constexpr std::uint32_t mostTriangles = 1u << 24; ///< of a chunk: numbers are exact in float

  /// Mappers refer to the frame.
  RasterModels(vtkOpenGLRenderWindow* window, RasterFrame& frame);
  ~RasterModels();
  RasterModels(const RasterModels&) = delete;
  RasterModels& operator=(const RasterModels&) = delete;

  /// Whether triangles need numbers. To be called before the first state.
  void setNumbered(bool numbered) { this->Numbered = numbered; }
  /// To be called before the first of() of a state; drop() behind the last forgets what it does not use.
  void begin(const SceneState& state);
  const RasterModel& of(const Instance& instance);
  void drop();

private:
  /// Its triangles have the numbers that the state needs.
  bool fits(const RasterModel& made) const { return made.geometry->topology->numbered || !this->StateNumbered; }
  std::shared_ptr<RasterGeometry> geometryOf(const Instance& instance);
  std::shared_ptr<const RasterTopology> topologyOf(const std::shared_ptr<const Model>& model);
  std::unique_ptr<RasterModel> make(const Instance& instance);
  RasterChunk makeChunk(const RasterModel& made, const Part& part, std::uint32_t first, std::uint32_t count);
  vtkSmartPointer<vtkOpenGLTexture> textureOf(const std::shared_ptr<const Image>& image, bool cutOut);

  vtkOpenGLRenderWindow* Window;
  RasterFrame& Frame;
  std::vector<std::unique_ptr<RasterModel>> Models;
  std::map<std::weak_ptr<const Image>, vtkSmartPointer<vtkOpenGLTexture>, std::owner_less<>> Textures[2]; // cut out
  MaterialMaps Maps;
  std::shared_ptr<const Image> White; // a picture of one texel
  bool Numbered = true;
  bool StateNumbered = true; // or its translucent surfaces need numbers
};

} // namespace dgtk

#endif
