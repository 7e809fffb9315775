// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRendererProps_h
#define dgtkRendererProps_h

#include "dgtkUnsupported.h"

#include "dgtkRigid3.h"

#include <string>
#include <vector>

class vtkActor;
class vtkObject;
class vtkRenderer;

namespace dgtk
{

/// A visible actor of a renderer, by itself or as a part of an assembly.
struct ViewActor
{
  vtkActor* actor = nullptr;
  std::size_t occurrence = 0; ///< of the same actor: assemblies may share parts
  std::string name;           ///< for messages and as the object's name: "actor-1"
  Affine3 world_from_object;
};

/// The visible actors with a mapper in the order in which the renderer has its props, assemblies flattened. What else
/// is visible is unsupported.
std::vector<ViewActor> rendererActors(vtkRenderer& renderer, Unsupported& unsupported);

/// How messages call something of VTK: its class without the prefix of its OpenGL implementation.
std::string classOf(vtkObject& object);

} // namespace dgtk

#endif
