// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewCopies_h
#define dgtkViewCopies_h

#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

class vtkActor;
class vtkDoubleArray;
class vtkGlyph3DMapper;
class vtkPoints;
class vtkPolyData;
class vtkProperty;
class vtkRenderer;
class vtkShaderProperty;
class vtkUnsignedCharArray;

namespace dgtk
{

class ViewLights;

/// Many copies of a part of a model in one view, drawn by one call of OpenGL: an actor for each takes the most of a
/// drawing's time, and VTK looks through all its actors for each that comes or goes.
class ViewCopies
{
public:
  struct Place
  {
    Eigen::Vector3d position;
    Eigen::Vector4d rotation; ///< quaternion w, x, y, z
    Eigen::Vector3d scale;    ///< along the own axes
    bool operator==(const Place& o) const
    {
      return this->position == o.position && this->rotation == o.rotation && this->scale == o.scale;
    }
  };
  /// Nothing for what is sheared or flat.
  static std::optional<Place> placeOf(const Affine3& world_from_object);

  /// `lights` must outlive them.
  ViewCopies(vtkRenderer* renderer, vtkPolyData* part, vtkProperty* property, ViewLights& lights);
  ~ViewCopies();
  ViewCopies(const ViewCopies&) = delete;
  ViewCopies& operator=(const ViewCopies&) = delete;

  /// In the order in which they are drawn.
  void show(const std::vector<Place>& places);
  void hide();
  vtkActor* actor() const { return this->Actor; }

private:
  vtkRenderer* Renderer;
  ViewLights& Lights;
  vtkSmartPointer<vtkShaderProperty> Shading;
  vtkNew<vtkPolyData> Data; ///< a point for each copy
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Rotations;
  vtkNew<vtkDoubleArray> Scales;
  vtkNew<vtkUnsignedCharArray> Colors; ///< all the same: VTK would mix the specular colour into it
  vtkNew<vtkGlyph3DMapper> Mapper;
  vtkNew<vtkActor> Actor;
  std::vector<Place> Shown;
};

} // namespace dgtk

#endif
