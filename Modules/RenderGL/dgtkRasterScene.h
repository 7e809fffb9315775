// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterScene_h
#define dgtkRasterScene_h

#include "dgtkIdPrograms.h"
#include "dgtkPieceDraw.h"
#include "dgtkRasterCamera.h"
#include "dgtkRasterLighting.h"
#include "dgtkRasterModels.h"
#include "dgtkVisibility.h"

#include <memory>
#include <vector>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkOpenGLRenderer;
class vtkOpenGLRenderWindow;
class vtkOpenGLShaderProperty;

namespace dgtk
{

/// Which draws.
enum class Surfaces
{
  All,
  Opaque,
  Translucent
};

/// VTK's objects for a scene state; an instance that moves only gets other matrices.
class RasterScene
{
public:
  explicit RasterScene(vtkOpenGLRenderWindow* window);
  ~RasterScene();
  RasterScene(const RasterScene&) = delete;
  RasterScene& operator=(const RasterScene&) = delete;

  /// Without numbers of triangles, hits and layers cannot be drawn; colours are, with fewer vertices. To be called
  /// before the first state.
  void setNumbered(bool numbered) { this->Models.setNumbered(numbered); }
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
  /// A chunk of an instance.
  struct Draw
  {
    std::size_t instance = 0;
    const RasterModel* model = nullptr;
    const RasterChunk* chunk = nullptr;
    vtkSmartPointer<PartActor> actor;
    std::unique_ptr<PieceDraw> pieces;
    bool visible = false;
    bool cut = false; ///< `pieces` are to be drawn
  };

  void place(const RasterCamera& camera);
  void cutDraw(Draw& draw, const RasterCamera& camera, const Eigen::Matrix4d& view_from_local);
  void drawShadows(const RasterCamera& camera, int size);
  void drawAllIds(bool translucent);
  void drawIdsOf(PartMapper& mapper, PartActor& actor, const RasterChunk& chunk);
  void makeDraws();
  void setUpState();
  void drawAll(Surfaces surfaces);

  vtkOpenGLRenderWindow* Window;
  vtkNew<vtkOpenGLRenderer> Renderer;
  vtkNew<vtkOpenGLShaderProperty> ShaderProperty;
  RasterFrame Frame;
  RasterModels Models;
  RasterLighting Lighting;
  std::shared_ptr<const SceneState> State;
  std::vector<Draw> Draws;
  std::vector<std::size_t> Order; ///< of the visible draws, see drawOrder()
  Pieces Cut;                     // of the draw at hand
  const IdPrograms::Program* CurrentIds = nullptr;
  std::shared_ptr<std::vector<Hit>> FirstHits;
  IdPrograms Ids;
  RasterCamera Camera;
  int Width = 0;
  int Height = 0;
  unsigned int Layer = 0;
  bool Translucent = false;
};

} // namespace dgtk

#endif
