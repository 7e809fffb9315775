// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterScene_h
#define dgtkRasterScene_h

// Private to RenderGL.

#include "dgtkEnvironmentMap.h"
#include "dgtkIdPrograms.h"
#include "dgtkMaterialMaps.h"
#include "dgtkPartMapper.h"
#include "dgtkPieces.h"
#include "dgtkRasterCamera.h"
#include "dgtkShadowMaps.h"
#include "dgtkVisibility.h"

#include <map>
#include <memory>
#include <vector>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkFloatArray;
class vtkOpenGLProperty;
class vtkOpenGLRenderer;
class vtkOpenGLRenderWindow;
class vtkOpenGLShaderProperty;
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
};
/// Where numbers are not wanted, the model's own vertices, fewer, with each triangle's corners in the same order: the
/// same pixels.
RasterTopology rasterTopology(const Model& model, bool numbered = true);

/// Which draws.
enum class Surfaces
{
  All,
  Opaque,
  Translucent
};

/// VTK's objects for a scene state. Geometry, textures and materials are made once for all instances of a model and
/// kept from state to state; an instance that moves only gets other matrices.
class RasterScene
{
public:
  explicit RasterScene(vtkOpenGLRenderWindow* window);
  ~RasterScene();
  RasterScene(const RasterScene&) = delete;
  RasterScene& operator=(const RasterScene&) = delete;

  /// Without numbers of triangles, hits and layers cannot be drawn; colours are, with fewer vertices. To be called
  /// before the first state.
  void setNumbered(bool numbered) { this->Numbered = numbered; }
  void setState(std::shared_ptr<const SceneState> state, const View& view);
  const SceneState& state() const { return *this->State; }
  bool hasTranslucent() const { return this->Translucent; }

  /// Makes what colours need beside the draws: the environment, and shadow maps for the view's whole image. Binds other
  /// framebuffers. To be called before aim() when colours are drawn; does nothing when all is there.
  void prepareLight(bool zeroToOne);
  /// Sets the matrices and lights of the draws to come, to a target of width x height pixels.
  void aim(const RasterCamera& camera, int width, int height);
  /// Draws colour and ids to the bound framebuffer.
  void drawColor(Surfaces surfaces);
  /// Draws ids only, at the same positions.
  void drawIds();
  /// Appends every fragment of all surfaces within rows [first, last) of the target, from the bottom, to the bound
  /// FragmentList; writes nothing else.
  void drawFragments(int width, int first, int last);
  /// Draws only what lies behind the layer in texture `layer` (0: everything).
  void peelBehind(unsigned int layer);

  /// First triangle of each draw by its number, nothing for number 0: with a fragment's number of the triangle added,
  /// the fragment's hit. Valid also when the scene has changed.
  std::shared_ptr<const std::vector<Hit>> firstHits() const { return this->FirstHits; }
  bool translucent(float number) const
  {
    return number != 0 && this->Draws[std::size_t(number) - 1].chunk->translucent;
  }

private:
  /// Geometry of a model at an instant.
  struct Shared
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
  struct Chunk
  {
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangles = 0;
    Eigen::Vector3d boxMin; ///< relative to Shared::origin
    Eigen::Vector3d boxMax;
    std::array<float, 3> emission{};
    SurfaceParameters surface;
    bool translucent = false;
    vtkSmartPointer<PartMapper> mapper;
    vtkSmartPointer<vtkOpenGLProperty> property;
    vtkSmartPointer<vtkOpenGLTexture> texture;
  };
  /// A geometry with a set of materials.
  struct Variant
  {
    std::shared_ptr<Shared> shared;
    std::shared_ptr<const std::vector<Material>> materials;
    std::vector<Chunk> chunks;
    bool used = false;
  };
  /// What draws the cut triangles of a chunk.
  struct PieceDraw
  {
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<PartMapper> mapper;
    vtkSmartPointer<PartActor> actor;
  };
  /// A chunk of an instance.
  struct Draw
  {
    std::size_t instance = 0;
    const Variant* variant = nullptr;
    const Chunk* chunk = nullptr;
    vtkSmartPointer<PartActor> actor;
    std::unique_ptr<PieceDraw> pieces;
    bool visible = false;
    bool cut = false; ///< `pieces` are to be drawn
  };

  std::shared_ptr<Shared> sharedOf(const Instance& instance);
  std::shared_ptr<const RasterTopology> topologyOf(const std::shared_ptr<const Model>& model);
  Variant& variantOf(const Instance& instance);
  std::unique_ptr<Variant> makeVariant(const Instance& instance);
  Chunk makeChunk(const Variant& variant, const Part& part, std::uint32_t first, std::uint32_t count);
  static void fill(Shared& shared, std::shared_ptr<const Geometry> geometry);
  static void measure(const Shared& shared, Chunk& chunk);
  vtkSmartPointer<vtkOpenGLTexture> textureOf(const std::shared_ptr<const Image>& image, bool cutOut);
  void dropUnused();
  void cutDraw(Draw& draw, const RasterCamera& camera, const Eigen::Matrix4d& view_from_local);
  void fillPieces(Draw& draw, const RasterCamera& camera);
  void setView(const View& view);
  void place(const RasterCamera& camera);
  void drawShadows(const RasterCamera& camera, int size);
  void drawAllIds(bool translucent);
  void drawIdsOf(PartMapper& mapper, PartActor& actor, const Chunk& chunk);
  void makeDraws();
  void setUpState();
  void drawAll(Surfaces surfaces);
  void uploadLights();

  vtkOpenGLRenderWindow* Window;
  vtkNew<vtkOpenGLRenderer> Renderer;
  vtkNew<vtkOpenGLShaderProperty> ShaderProperty;
  RasterFrame Frame;
  std::shared_ptr<const SceneState> State;
  std::vector<std::unique_ptr<Variant>> Variants;
  std::map<std::pair<std::shared_ptr<const Image>, bool>, vtkSmartPointer<vtkOpenGLTexture>> Textures;
  std::vector<Draw> Draws;
  std::vector<std::size_t> Order; ///< of the visible draws, see drawOrder()
  Pieces Cut;                     // of the draw at hand
  const IdPrograms::Program* CurrentIds = nullptr;
  std::shared_ptr<std::vector<Hit>> FirstHits;
  IdPrograms Ids;
  EnvironmentMap Environment;
  MaterialMaps Maps;
  std::shared_ptr<const Image> White; // a picture of one texel
  ShadowMaps Shadows;
  std::vector<int> FirstShadows; // of each light
  bool EnvironmentReady = false;
  bool ShadowsReady = false;
  View Seen; ///< what the shadow maps are for
  RasterCamera Camera;
  int Width = 0;
  int Height = 0;
  unsigned int LightBuffer = 0;
  unsigned int LightTexture = 0;
  unsigned int Layer = 0;
  bool Translucent = false;
  bool Numbered = true;
};

} // namespace dgtk

#endif
