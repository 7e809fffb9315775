// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrozenView.h"

#include "dgtkGlyphCopies.h"
#include "dgtkModelSource.h"
#include "dgtkRendererCamera.h"
#include "dgtkRendererLights.h"
#include "dgtkRendererProps.h"
#include "dgtkSharedModels.h"
#include "dgtkSurfaceModel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double skewed = 1e-12;

/// Models in memory, under the names that objects have for them.
class FrozenModels : public ModelSource
{
public:
  ObjectLook lookOf(const SceneDescription&, const ObjectDescription& object) const override
  {
    const auto& [model, copies] = this->Models.at(object.model);
    return { model, std::shared_ptr<const std::vector<Material>>(model, &model->materials), false, copies };
  }
  std::shared_ptr<const EnvironmentState> environment(const SceneDescription&) const override { return nullptr; }
  bool cutsAtWhite() const override { return true; }
  std::shared_ptr<GeometryCache> geometries() const override { return this->Geometries; }

  std::map<std::string, std::pair<std::shared_ptr<const Model>, std::shared_ptr<const std::vector<ModelCopy>>>> Models;

private:
  std::shared_ptr<GeometryCache> Geometries = std::make_shared<GeometryCache>();
};

/// An object's place: position, orientation and scale where the matrix is made of them; what it is not is baked into
/// the points.
struct Placement
{
  Affine3 bake;
  Affine3 world_from_object;
  Eigen::Vector3d scale{ 1, 1, 1 };
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

Placement placementOf(const Affine3& world)
{
  Placement place;
  Eigen::Matrix3d turn;
  for (int i = 0; i < 3; ++i)
  {
    place.scale[i] = world.linear.col(i).norm();
    turn.col(i) = world.linear.col(i) / place.scale[i];
  }
  if (turn.determinant() < 0)
  {
    turn.col(0) = -turn.col(0);
    place.scale[0] = -place.scale[0];
  }
  const bool made =
    turn.allFinite() && (turn.transpose() * turn - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < skewed;
  if (made)
  {
    place.orientation = Eigen::Quaterniond(turn);
    place.world_from_object = world;
    return place;
  }
  place.scale.setOnes();
  place.bake = world;
  return place;
}

/// Whether VTK draws polygons of one mapper nearer or farther than those of others.
bool hasOffset(vtkMapper& mapper)
{
  double factor = 0;
  double units = 0;
  mapper.GetRelativeCoincidentTopologyPolygonOffsetParameters(factor, units);
  return vtkMapper::GetResolveCoincidentTopology() == VTK_RESOLVE_POLYGON_OFFSET && (factor != 0 || units != 0);
}

class Freezer
{
public:
  Freezer(vtkRenderer& renderer, int width, int height)
    : Renderer(renderer)
    , Size(width > 0 ? std::make_pair(width, height) : rendererSize(renderer))
    , Lit(isLit(renderer))
  {
  }

  FrozenView run(bool skip)
  {
    for (const ViewActor& actor : rendererActors(this->Renderer, this->Out))
    {
      this->addActor(actor);
    }
    this->lookAround();
    this->lookAtPhysical();
    if (!skip)
    {
      this->Out.refuse();
    }
    RendererCamera camera = rendererCamera(this->Renderer, this->Size.first, this->Size.second);
    this->fitCamera(camera);
    for (std::size_t i = 0; i < this->View.actors.size(); ++i)
    {
      this->show(this->View.actors[i], camera.description);
      this->describe(this->View.actors[i], i);
    }
    this->Scene.cameras.push_back(camera.description);
    this->Scene.lights = rendererLights(this->Renderer, *camera.camera);
    this->softenForPhysical(camera);
    const double* const background = this->Renderer.GetBackground();
    this->Scene.background = Eigen::Vector3d(background[0], background[1], background[2]);
    this->View.stage = Stage::make(std::move(this->Scene), this->Models);
    this->View.state = this->View.stage->at(0);
    this->countCopies();
    this->View.trees = keptTrees(this->View.state, this->surfaces());
    this->View.left = this->Out.lines();
    return std::move(this->View);
  }

private:
  void addActor(const ViewActor& actor)
  {
    vtkProperty& property = *actor.actor->GetProperty();
    if (property.GetRepresentation() != VTK_SURFACE)
    {
      this->Out.add(actor.name + ": drawn as " + property.GetRepresentationAsString());
      return;
    }
    const DrawnSurface drawn = surfacePieces(actor, this->Out);
    const Placement place = placementOf(actor.world_from_object);
    const bool mirrored = place.scale.prod() < 0;
    const ActorStyle style{ place.bake, this->Lit, mirrored };
    const bool copies = canBeCopies(*actor.actor, drawn.pieces, place.bake);
    const auto make = copies ? glyphCopies : surfaceModel;
    const std::shared_ptr<const SurfaceModel> surface = sharedSurface(
      surfaceKey(*actor.actor, drawn.pieces, style, copies), [&] { return make(*actor.actor, drawn.pieces, style); });
    for (const std::string& line : surface->left.lines())
    {
      this->Out.add(actor.name + ": " + line);
    }
    if (surface->model->triangles.empty())
    {
      return;
    }
    if (hasOffset(*actor.actor->GetMapper()))
    {
      this->Out.add(actor.name + ": a relative offset of its polygons, which decides between coincident ones");
    }
    FrozenActor frozen;
    frozen.actor = actor.actor;
    frozen.occurrence = actor.occurrence;
    frozen.name = actor.name;
    frozen.whole = surface;
    frozen.inputCells = drawn.cells;
    frozen.world_from_object = place.world_from_object;
    this->View.actors.push_back(std::move(frozen));
    this->Places.push_back(place);
  }

  /// Copies come after all objects, in their order.
  void countCopies()
  {
    auto next = std::uint32_t(this->View.actors.size()) + 1;
    for (FrozenActor& actor : this->View.actors)
    {
      actor.firstCopy = next;
      next += actor.whole->copies ? std::uint32_t(actor.whole->copies->size()) : 0;
    }
  }

  std::vector<std::shared_ptr<const SurfaceModel>> surfaces() const
  {
    std::vector<std::shared_ptr<const SurfaceModel>> all;
    for (const FrozenActor& actor : this->View.actors)
    {
      all.push_back(actor.whole);
    }
    return all;
  }

  /// What is in a picture beside its actors.
  void lookAround()
  {
    const std::pair<bool, const char*> parts[] = { { this->Renderer.GetGradientBackground(), "a gradient background" },
      { this->Renderer.GetTexturedBackground(), "a textured background" },
      { this->Renderer.GetUseImageBasedLighting(), "image based lighting" },
      { this->Renderer.GetUseSSAO(), "ambient occlusion of screen space" },
      { this->Renderer.GetPass() != nullptr, "a render pass" },
      { this->Renderer.GetDraw() == 0, "a renderer that does not draw" } };
    for (const auto& [there, what] : parts)
    {
      if (there)
      {
        this->Out.add(what);
      }
    }
  }

  /// Near and far planes around all points, which only a view that was not drawn has to look at.
  void fitCamera(RendererCamera& camera) const
  {
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    const Eigen::Vector3d eye = camera.description.position.at(0);
    const Eigen::Vector3d ahead = camera.description.orientation.at(0).matrix().col(2);
    const auto look = [&](const Model& model, const Affine3& world)
    {
      const Eigen::Vector3d own = world.linear.transpose() * ahead; // depth is own . point + start
      const double start = ahead.dot(world.translation - eye);
      for (const Eigen::Vector3d& point : model.rest->positions)
      {
        const double depth = own.dot(point) + start;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
      }
    };
    for (std::size_t i = 0; !camera.drawn && i < this->View.actors.size(); ++i)
    {
      const FrozenActor& actor = this->View.actors[i];
      if (!actor.whole->copies)
      {
        look(*actor.whole->model, actor.world_from_object);
        continue;
      }
      for (const ModelCopy& copy : *actor.whole->copies)
      {
        look(*copy.model, actor.world_from_object * copy.object_from_model);
      }
    }
    setRange(camera, std::isfinite(nearest) ? nearest : 0.0, farthest);
  }

  void show(FrozenActor& actor, const CameraDescription& camera)
  {
    const Affine3& world = actor.world_from_object;
    if (vtkPlaneCollection* const planes = actor.actor->GetMapper()->GetClippingPlanes())
    {
      for (int i = 0; i < planes->GetNumberOfItems(); ++i)
      {
        vtkPlane& plane = *planes->GetItem(i);
        const Eigen::Vector3d normal(plane.GetNormal());
        const Eigen::Vector3d origin(plane.GetOrigin());
        Eigen::Vector4d own;
        own << world.linear.transpose() * normal, normal.dot(world.translation - origin);
        actor.shown.planes.push_back(own);
      }
    }
    const bool back = actor.actor->GetProperty()->GetBackfaceCulling() != 0;
    const bool front = !back && actor.actor->GetProperty()->GetFrontfaceCulling() != 0; // as VTK has it
    if (back || front)
    {
      const bool perspective = camera.model == "pinhole";
      actor.shown.isCulled = [back, front, perspective, world, eye = Eigen::Vector3d(camera.position.at(0)),
                               ahead = Eigen::Vector3d(camera.orientation.at(0).matrix().col(2))](
                               const Eigen::Vector3d corners[3])
      {
        const Eigen::Vector3d a = world * corners[0];
        const Eigen::Vector3d normal = (world * corners[1] - a).cross(world * corners[2] - a);
        const double towards = -normal.dot(perspective ? Eigen::Vector3d(a - eye) : ahead);
        return towards > 0 ? front : back;
      };
    }
    ShownModel shown = shownModel(actor.whole->model, actor.shown);
    actor.model = actor.shown.isAll() ? shown.model : sharedModel(shown.model);
    actor.parents = std::move(shown.parents);
  }

  void describe(const FrozenActor& actor, std::size_t index)
  {
    ObjectDescription object;
    object.name = actor.name;
    object.model = "models/" + actor.name + ".obj";
    const Placement& place = this->Places[index];
    object.position = Eigen::Vector3d(actor.world_from_object.translation);
    object.orientation =
      Quaternion{ place.orientation.w(), place.orientation.x(), place.orientation.y(), place.orientation.z() };
    object.scale = place.scale;
    this->Models.Models[object.model] = { actor.model, actor.whole->copies };
    this->Scene.objects.push_back(object);
  }

  /// A physically based surface of VTK shows 1 / pi of the light, ours all of it.
  void lookAtPhysical()
  {
    std::size_t physical = 0;
    std::size_t all = 0;
    for (const FrozenActor& actor : this->View.actors)
    {
      for (const Material& material : actor.whole->model->materials)
      {
        ++all;
        physical += material.physical ? 1 : 0;
      }
    }
    this->Physical = physical > 0 && physical == all;
    if (physical > 0 && physical < all)
    {
      this->Out.add("physically based surfaces beside others, of which VTK shows 1 / pi of the light");
    }
  }

  void softenForPhysical(const RendererCamera& camera)
  {
    std::vector<LightDescription>& lights = this->Scene.lights;
    if (!this->Physical)
    {
      return;
    }
    if (lights.empty() && this->Lit)
    {
      lights.push_back(headLight());
    }
    if (lights.size() == 1 && lights.front().kind == LightKind::Head && camera.description.model == "pinhole")
    {
      lights.front().kind = LightKind::Point; // a head light alone is in the eye for them, and far away for others
      lights.front().position = camera.description.position.at(0);
    }
    for (LightDescription& light : lights)
    {
      light.intensity = light.intensity.at(0) / EIGEN_PI;
    }
  }

  vtkRenderer& Renderer;
  std::pair<int, int> Size;
  bool Lit;
  bool Physical = false; ///< all surfaces are
  Unsupported Out;
  FrozenView View;
  std::vector<Placement> Places; ///< one an actor
  SceneDescription Scene;
  FrozenModels Models;
};
} // namespace

FrozenView freeze(vtkRenderer& renderer, int width, int height, bool skip)
{
  return Freezer(renderer, width, height).run(skip);
}

} // namespace dgtk
