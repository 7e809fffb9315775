// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRendererProps.h"

#include <vtkActor.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace dgtk
{

namespace
{
/// Props that draw what their mapper has, and nothing else.
bool isPlain(vtkActor& actor)
{
  const std::string name = classOf(actor);
  return name == "vtkActor" || name == "vtkFollower" || name == "vtkLODActor" || name == "vtkQuadricLODActor";
}

std::string numbered(const std::string& name, std::size_t number)
{
  return name + " (prop " + std::to_string(number) + ')';
}

bool isAffine(const vtkMatrix4x4& matrix)
{
  return matrix.GetElement(3, 0) == 0 && matrix.GetElement(3, 1) == 0 && matrix.GetElement(3, 2) == 0 &&
         matrix.GetElement(3, 3) != 0;
}

bool isFinite(const vtkMatrix4x4& matrix)
{
  return std::all_of(*matrix.Element, *matrix.Element + 16, [](double v) { return std::isfinite(v); });
}

Affine3 affineOf(const vtkMatrix4x4* matrix)
{
  Affine3 affine;
  if (matrix != nullptr)
  {
    const double w = matrix->GetElement(3, 3);
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        affine.linear(i, j) = matrix->GetElement(i, j) / w;
      }
      affine.translation[i] = matrix->GetElement(i, 3) / w;
    }
  }
  return affine;
}

/// The leaves of one prop of the renderer.
class Leaves
{
public:
  Leaves(std::vector<ViewActor>& actors, Unsupported& unsupported)
    : Actors(actors)
    , Out(unsupported)
  {
  }

  void add(vtkProp& prop)
  {
    ++this->Props;
    vtkAssemblyPath* path = nullptr;
    for (prop.InitPathTraversal(); (path = prop.GetNextPath()) != nullptr;)
    {
      vtkAssemblyNode* const node = path->GetLastNode();
      vtkProp* const leaf = node->GetViewProp();
      if (leaf != nullptr && leaf->GetVisibility() != 0)
      {
        this->addLeaf(*leaf, node->GetMatrix(), path->GetNumberOfItems() > 1);
      }
    }
  }

private:
  void addLeaf(vtkProp& leaf, const vtkMatrix4x4* matrix, bool isPart)
  {
    vtkActor* const actor = vtkActor::SafeDownCast(&leaf);
    if (actor == nullptr || !isPlain(*actor))
    {
      this->Out.add(numbered(classOf(leaf), this->Props));
      return;
    }
    if (actor->GetMapper() == nullptr)
    {
      return; // nothing is drawn
    }
    if (matrix != nullptr && !isAffine(*matrix))
    {
      this->Out.add(numbered(classOf(leaf), this->Props) +
                    (isFinite(*matrix) ? " with a projective matrix" : " with a matrix that is no numbers"));
      return;
    }
    if (isPart && leaf.IsA("vtkFollower") != 0)
    {
      this->Out.add(numbered(classOf(leaf), this->Props) + " in an assembly"); // VTK turns it once more
      return;
    }
    ViewActor found;
    found.actor = actor;
    found.occurrence = this->Seen[actor]++;
    found.name = "actor-" + std::to_string(this->Actors.size() + 1);
    found.world_from_object = affineOf(matrix);
    this->Actors.push_back(found);
  }

  std::vector<ViewActor>& Actors;
  Unsupported& Out;
  std::size_t Props = 0;
  std::map<vtkActor*, std::size_t> Seen;
};
} // namespace

std::string classOf(vtkObject& object)
{
  const std::string name = object.GetClassName();
  const std::string opengl = "vtkOpenGL";
  return name.compare(0, opengl.size(), opengl) == 0 ? "vtk" + name.substr(opengl.size()) : name;
}

std::vector<ViewActor> rendererActors(vtkRenderer& renderer, Unsupported& unsupported)
{
  std::vector<ViewActor> actors;
  Leaves leaves(actors, unsupported);
  vtkPropCollection* const props = renderer.GetViewProps();
  vtkCollectionSimpleIterator at = nullptr;
  props->InitTraversal(at);
  while (vtkProp* const prop = props->GetNextProp(at))
  {
    if (prop->GetVisibility() != 0)
    {
      leaves.add(*prop);
    }
  }
  return actors;
}

} // namespace dgtk
