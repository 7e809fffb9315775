// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewActors.h"

#include "dgtkViewLines.h"

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>

#include <algorithm>
#include <unordered_map>

namespace dgtk
{

namespace
{
constexpr std::size_t manyCopies = 16; // of a geometry; fewer have actors of their own
const Eigen::Vector3d cameraColor(1.0, 0.75, 0.2);
const Eigen::Vector3d boxColor(0.75, 0.75, 0.78);
const Eigen::Vector3d gridColor(0.42, 0.44, 0.47);

vtkSmartPointer<vtkMatrix4x4> matrixOf(const Affine3& target_from_source)
{
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(row, column, target_from_source.linear(row, column));
    }
    matrix->SetElement(row, 3, target_from_source.translation[row]);
  }
  return matrix;
}
} // namespace

ViewActors::ViewActors(vtkRenderer* renderer, ViewKind kind)
  : Renderer(renderer)
  , Lighting(renderer)
  , Shading(this->Lighting.makeShading(false))
  , Kind(kind)
{
  this->GridLines = std::make_unique<LineActor>(renderer, gridColor, 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d color = 0.25 * Eigen::Vector3d::Ones() + 0.65 * Eigen::Vector3d::Unit(axis);
    this->Axes[axis] = std::make_unique<LineActor>(renderer, color, 2);
  }
  this->BoxLines = std::make_unique<LineActor>(renderer, boxColor, 1);
  this->CameraLines = std::make_unique<LineActor>(renderer, cameraColor, 1.5);
}

ViewActors::~ViewActors() = default;

void ViewActors::remove(Shown& shown)
{
  for (const auto& actor : shown.actors)
  {
    if (actor != nullptr)
    {
      this->Renderer->RemoveActor(actor);
    }
  }
  for (Surface* const surface : shown.surfaces)
  {
    --surface->users;
  }
  shown.actors.clear();
  shown.surfaces.clear();
  shown.level = 0;
}

ViewActors::Surface& ViewActors::surface(const Instance& instance, std::size_t part, ViewMeshes& meshes)
{
  const Material& material = (*instance.materials)[std::size_t(instance.model->parts[part].material)];
  vtkPolyData* const data = meshes.part(instance, part);
  Surface& surface = this->Surfaces[{ data, &material }];
  if (surface.property == nullptr)
  {
    surface.geometry = instance.geometry;
    surface.model = instance.model;
    surface.part = part;
    surface.materials = instance.materials;
    surface.mappers[0] = mapperOf(data);
    surface.property = vtkSmartPointer<vtkProperty>::New();
    this->Lighting.fill(material, *surface.property);
    const auto texture = std::size_t(material.texture);
    const bool isSeen = material.texture >= 0 && data->GetPointData()->GetTCoords() != nullptr;
    surface.texture = isSeen ? meshes.texture(instance.model->textures[texture].image, material.cutOut) : nullptr;
    if (surface.texture != nullptr)
    {
      surface.texture->InterpolateOn();
      surface.texture->SetMaximumAnisotropicFiltering(1); // more is forty times slower without a graphics card
      const TextureWrap wrap = instance.model->textures[texture].wrap[0]; // VTK has one for both axes
      surface.texture->SetWrap(wrap == TextureWrap::Repeat  ? vtkTexture::Repeat
                               : wrap == TextureWrap::Clamp ? vtkTexture::ClampToEdge
                                                            : vtkTexture::MirroredRepeat);
    }
  }
  return surface;
}

void ViewActors::applyStyle(const Surface& surface, vtkActor* actor) const
{
  actor->SetTexture(this->Style == ViewStyle::Textured ? surface.texture.Get() : nullptr);
  if (this->Style == ViewStyle::Wireframe)
  {
    surface.property->SetRepresentationToWireframe();
  }
  else
  {
    surface.property->SetRepresentationToSurface();
  }
}

vtkSmartPointer<vtkActor> ViewActors::makeActor(Surface& surface)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(surface.mappers[0]);
  actor->SetProperty(surface.property);
  actor->SetShaderProperty(this->Shading);
  actor->SetForceOpaque(surface.property->GetOpacity() >= 1); // cut-outs are opaque where they are
  this->applyStyle(surface, actor);
  this->Renderer->AddActor(actor);
  return actor;
}

void ViewActors::build(Shown& shown, const ObjectPlace& place, ViewMeshes& meshes)
{
  this->remove(shown);
  this->Fresh = true;
  shown.geometry = place.instance.geometry;
  shown.materials = place.instance.materials;
  shown.world_from_object = {};
  for (std::size_t part = 0; place.instance.model != nullptr && part < place.instance.model->parts.size(); ++part)
  {
    if (place.instance.model->parts[part].triangles == 0)
    {
      continue;
    }
    Surface& surface = this->surface(place.instance, part, meshes);
    const bool alone = !shown.copy || surface.property->GetOpacity() < 1; // what is seen through is sorted by VTK
    shown.actors.push_back(alone ? this->makeActor(surface) : nullptr);
    shown.surfaces.push_back(&surface);
    ++surface.users;
  }
}

void ViewActors::showObjects(const ScenePlaces& places, ViewMeshes& meshes)
{
  for (std::size_t i = places.objects.size(); i < this->Objects.size(); ++i)
  {
    this->remove(this->Objects[i]);
  }
  this->Objects.resize(places.objects.size());
  std::unordered_map<const Geometry*, std::size_t> numbers;
  for (const ObjectPlace& place : places.objects)
  {
    ++numbers[place.instance.geometry.get()];
  }
  for (std::size_t i = 0; i < places.objects.size(); ++i)
  {
    const ObjectPlace& place = places.objects[i];
    Shown& shown = this->Objects[i];
    const bool moved = !(shown.world_from_object == place.instance.world_from_object);
    const bool wasCopy = shown.copy.has_value();
    const bool isMany = numbers[place.instance.geometry.get()] >= manyCopies;
    if (!isMany)
    {
      shown.copy.reset();
    }
    else if (moved || !wasCopy)
    {
      shown.copy = ViewCopies::placeOf(place.instance.world_from_object);
    }
    if (shown.geometry != place.instance.geometry || shown.materials != place.instance.materials ||
        wasCopy != shown.copy.has_value())
    {
      this->build(shown, place, meshes);
    }
    const vtkSmartPointer<vtkMatrix4x4> matrix = shown.world_from_object == place.instance.world_from_object
                                                   ? nullptr
                                                   : matrixOf(place.instance.world_from_object);
    for (const auto& actor : shown.actors)
    {
      if (actor != nullptr)
      {
        if (matrix != nullptr)
        {
          actor->SetUserMatrix(matrix);
        }
        actor->SetVisibility(place.visible && !this->Coarse);
      }
    }
    shown.world_from_object = place.instance.world_from_object;
    shown.visible = place.visible;
    shown.box = place.box;
  }
  this->forgetSurfaces();
}

void ViewActors::forgetSurfaces()
{
  for (auto at = this->Surfaces.begin(); at != this->Surfaces.end();)
  {
    at = at->second.users > 0 ? std::next(at) : this->Surfaces.erase(at);
  }
}

void ViewActors::showLights(const SceneDescription& scene, const ScenePlaces& places)
{
  while (this->Lights.size() > places.lights.size())
  {
    this->Renderer->RemoveActor(this->Lights.back());
    this->Lights.pop_back();
  }
  while (this->Lights.size() < places.lights.size())
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1);
    sphere->SetThetaResolution(16);
    sphere->SetPhiResolution(12);
    sphere->Update();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(sphere->GetOutput());
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->SetAmbient(0.6);
    actor->GetProperty()->SetDiffuse(0.4);
    this->Renderer->AddActor(actor);
    this->Lights.push_back(actor);
  }
  for (std::size_t i = 0; i < places.lights.size(); ++i)
  {
    const LightDescription& light = scene.lights[i];
    const Eigen::Vector3d diffuse = boundedAt(light.diffuse, places.frame);
    Eigen::Vector3d color = diffuse / std::max(diffuse.maxCoeff(), 1e-9);
    color = light.enabled.at(places.frame) ? color : Eigen::Vector3d(0.35, 0.35, 0.35);
    this->Lights[i]->GetProperty()->SetColor(color.x(), color.y(), color.z());
    this->Lights[i]->SetScale(lightRadius(places));
    Eigen::Vector3d position = places.lights[i];
    this->Lights[i]->SetPosition(position.data());
    this->Lights[i]->SetVisibility(traitsOf(light.kind).placed);
  }
}

void ViewActors::showGridFor(const WorldBox& box, UpAxis upAxis)
{
  // A grid grows by doubling, so that it does not change with every drag.
  const double wanted = 2 * std::max({ std::max(box.diagonal(), 1.0) / 2, box.min.norm(), box.max.norm(), 5.0 });
  const bool fits = this->GridExtent >= wanted && this->GridExtent < 4 * wanted;
  if (fits && upAxis == this->GridUp)
  {
    return;
  }
  this->GridUp = upAxis;
  this->GridExtent = fits ? this->GridExtent : 1.5 * wanted;
  const ViewCamera camera(this->Kind, upAxis);
  const Eigen::Vector3d forward = (camera.focus() - camera.eye()).normalized();
  const Eigen::Vector3d worldUp = upAxis == UpAxis::Z ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d u = this->Kind == ViewKind::Perspective ? Eigen::Vector3d::UnitX() : forward.cross(camera.up());
  const Eigen::Vector3d v = this->Kind == ViewKind::Perspective ? worldUp.cross(u) : camera.up();
  // Parallel views have theirs behind everything.
  const Eigen::Vector3d origin =
    this->Kind == ViewKind::Perspective ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(this->GridExtent * forward);
  LineList lines;
  addGrid(lines, origin, u, v, this->GridExtent);
  this->GridLines->set(lines);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Axes[axis]->set({ { origin, origin + 2 * this->gridStep() * Eigen::Vector3d::Unit(axis) } });
  }
  this->showGrid(this->Grid);
}

double ViewActors::gridStep() const { return dgtk::gridStep(this->GridExtent); }

void ViewActors::showGrid(bool on)
{
  this->Grid = on;
  this->GridLines->show(on);
  for (const auto& axis : this->Axes)
  {
    axis->show(on);
  }
}

void ViewActors::showCoarse(const ScenePlaces& places)
{
  this->Coarse = true;
  this->showActors(false);
  LineList boxes;
  for (const ObjectPlace& place : places.objects)
  {
    if (place.visible && !place.box.empty())
    {
      addBox(boxes, place.box);
    }
  }
  this->BoxLines->set(boxes);
}

void ViewActors::showFine()
{
  if (this->Coarse)
  {
    this->Coarse = false;
    this->BoxLines->set({});
    this->showActors(true);
  }
}

void ViewActors::showActors(bool on)
{
  for (const Shown& shown : this->Objects)
  {
    for (const auto& actor : shown.actors)
    {
      if (actor != nullptr)
      {
        actor->SetVisibility(on && shown.visible);
      }
    }
  }
  for (auto& [key, surface] : this->Surfaces)
  {
    for (const auto& copies : surface.copies)
    {
      if (!on && copies != nullptr)
      {
        copies->hide(); // chooseDetail() shows them
      }
    }
  }
}

void ViewActors::setStyle(ViewStyle style)
{
  this->Style = style;
  this->rebuild();
}

/// By the next show().
void ViewActors::rebuild()
{
  for (Shown& shown : this->Objects)
  {
    shown.geometry = nullptr;
  }
  for (auto& [key, surface] : this->Surfaces)
  {
    for (std::unique_ptr<ViewCopies>& copies : surface.copies)
    {
      copies.reset();
    }
  }
}

void ViewActors::show(const SceneDescription& scene, const ScenePlaces& places,
  const std::shared_ptr<const EnvironmentLight>& environment, ViewMeshes& meshes)
{
  this->Meshes = &meshes;
  if (this->Lighting.show(*places.surroundings, environment, ViewCamera(this->Kind, scene.upAxis)))
  {
    this->Shading = this->Lighting.makeShading(false);
    this->rebuild();
    for (auto& [key, surface] : this->Surfaces)
    {
      this->Lighting.fill(*key.second, *surface.property);
    }
  }
  this->showObjects(places, meshes);
  this->showLights(scene, places);
  this->showGridFor(places.box, scene.upAxis);
  LineList cameras;
  for (const CameraPlace& camera : places.cameras)
  {
    addFrustum(cameras, camera, frustumLength(places));
  }
  this->CameraLines->set(cameras);
}

} // namespace dgtk
