// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewActors_h
#define dgtkViewActors_h

#include "dgtkLineActor.h"
#include "dgtkScenePlaces.h"
#include "dgtkViewCamera.h"
#include "dgtkViewCopies.h"
#include "dgtkViewLights.h"
#include "dgtkViewMeshes.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkProperty;
class vtkRenderer;
class vtkShaderProperty;
class vtkTexture;

namespace dgtk
{

enum class ViewStyle
{
  Wireframe,
  Shaded,
  Textured
};

/// The actors of one view: objects, cameras as frusta, lights as spheres, grid and axes.
class ViewActors
{
public:
  ViewActors(vtkRenderer* renderer, ViewKind kind);
  ~ViewActors();
  ViewActors(const ViewActors&) = delete;
  ViewActors& operator=(const ViewActors&) = delete;

  /// `environment` of the places' surroundings.
  void show(const SceneDescription& scene, const ScenePlaces& places,
    const std::shared_ptr<const EnvironmentLight>& environment, ViewMeshes& meshes);
  void setStyle(ViewStyle style);
  void showGrid(bool on);
  /// Before each drawing.
  void aim(const ViewCamera& camera) { this->Lighting.aim(camera); }
  /// Takes effect at the next show().
  void setSceneLights(bool on) { this->Lighting.setSceneLights(on); }
  /// World units of a square of it.
  double gridStep() const;
  /// Boxes in place of objects, as far as these places go; and objects again.
  void showCoarse(const ScenePlaces& places);
  void showFine();
  /// As much detail as can be seen in a view of that size.
  /// That is less than usual where there would be more triangles than `most`.
  void chooseDetail(const ViewCamera& camera, double width, double height, std::size_t most);
  /// Triangles in sight, since then.
  std::size_t triangles() const { return this->Triangles; }
  /// Whether since the latest takeFresh() meshes came that were not drawn before: such a drawing takes longer.
  bool takeFresh() { return std::exchange(this->Fresh, false); }
  int actors() const;        ///< also of lines; of what is drawn together there is one
  int coarserMeshes() const; ///< that were made for this view, with fewer triangles than the models

private:
  struct Surface ///< what actors of the same part with the same material share
  {
    std::shared_ptr<const Geometry> geometry;
    std::shared_ptr<const Model> model;
    std::size_t part = 0;
    std::shared_ptr<const std::vector<Material>> materials;
    vtkSmartPointer<vtkPolyDataMapper> mappers[ViewMeshes::levels];
    vtkSmartPointer<vtkProperty> property;
    vtkSmartPointer<vtkTexture> texture;
    std::size_t users = 0; ///< objects
    std::unique_ptr<ViewCopies> copies[ViewMeshes::levels];
    std::vector<ViewCopies::Place> wanted[ViewMeshes::levels]; ///< while it is chosen what is drawn
  };
  struct Shown
  {
    std::shared_ptr<const Geometry> geometry;
    std::shared_ptr<const std::vector<Material>> materials;
    Affine3 world_from_object;
    bool visible = true;
    WorldBox box;
    int level = 0;                                 ///< of detail
    double pixels = 0;                             ///< from corner to corner of its box; 0: out of sight
    std::optional<ViewCopies::Place> copy;         ///< drawn with others like it
    std::vector<Surface*> surfaces;                ///< of each part
    std::vector<vtkSmartPointer<vtkActor>> actors; ///< of each part; null for what is drawn by its surface's copies
  };

  static vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkPolyData* data);
  Surface& surface(const Instance& instance, std::size_t part, ViewMeshes& meshes);
  void build(Shown& shown, const ObjectPlace& place, ViewMeshes& meshes);
  vtkSmartPointer<vtkActor> makeActor(Surface& surface);
  vtkPolyDataMapper* mapper(Surface& surface, int level);
  ViewCopies& copies(Surface& surface, int level);
  /// Chooses the level of all that may be seen; the number of triangles. `coarser`: as if it were so many times
  /// smaller.
  std::size_t chooseLevels(double coarser);
  void remove(Shown& shown);
  void applyStyle(const Surface& surface, vtkActor* actor) const;
  void showObjects(const ScenePlaces& places, ViewMeshes& meshes);
  void showLights(const SceneDescription& scene, const ScenePlaces& places);
  void showGridFor(const WorldBox& box, UpAxis upAxis);
  void forgetSurfaces();
  void rebuild();
  void showActors(bool on);

  vtkRenderer* Renderer;
  ViewLights Lighting;                        ///< before what it lights
  vtkSmartPointer<vtkShaderProperty> Shading; ///< of all actors but copies
  ViewMeshes* Meshes = nullptr;
  ViewKind Kind;
  ViewStyle Style = ViewStyle::Textured;
  bool Grid = true;
  bool Coarse = false;
  bool Fresh = false;
  double GridExtent = 0;
  UpAxis GridUp = UpAxis::Y;
  std::size_t Triangles = 0;
  std::map<std::pair<vtkPolyData*, const Material*>, Surface> Surfaces;
  std::vector<Shown> Objects;
  std::vector<vtkSmartPointer<vtkActor>> Lights;
  std::unique_ptr<LineActor> CameraLines;
  std::unique_ptr<LineActor> BoxLines;
  std::unique_ptr<LineActor> GridLines;
  std::unique_ptr<LineActor> Axes[3];
};

} // namespace dgtk

#endif
