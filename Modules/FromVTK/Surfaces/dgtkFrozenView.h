// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrozenView_h
#define dgtkFrozenView_h

#include "dgtkShownModel.h"
#include "dgtkStage.h"
#include "dgtkSurfaceModel.h"
#include "dgtkVisibility.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkRenderer;

namespace dgtk
{

/// An actor's surface as it was.
struct FrozenActor
{
  vtkSmartPointer<vtkActor> actor;
  std::size_t occurrence = 0;                ///< of the same actor, in assemblies that share it
  std::string name;                          ///< of its object
  std::shared_ptr<const SurfaceModel> whole; ///< all triangles, and the cells of the mapper's input that they are of
  std::int64_t inputCells = 0;               ///< how many that input has
  ShownSurface shown;                        ///< what the camera sees of them
  std::shared_ptr<const Model> model;        ///< that, in the stage
  std::vector<std::uint32_t> parents;        ///< triangles of `whole` by triangle of `model`; empty: the same
  std::uint32_t firstCopy = 0;               ///< what hits of the first copy have as their object
  Affine3 world_from_object;

  /// The triangle of `whole` that a hit of the stage is of.
  std::uint32_t wholeTriangle(const Hit& hit) const
  {
    return this->whole->copies     ? (*this->whole->copies)[hit.object - this->firstCopy].firstTriangle + hit.triangle
           : this->parents.empty() ? hit.triangle
                                   : this->parents[hit.triangle];
  }
  std::int64_t cell(const Hit& hit) const
  {
    return this->whole->cells[this->whole->copies ? hit.object - this->firstCopy : this->wholeTriangle(hit)];
  }
};

/// A renderer's view, taken apart.
struct FrozenView
{
  std::shared_ptr<const Stage> stage;
  std::shared_ptr<const SceneState> state; ///< of the stage
  std::vector<FrozenActor> actors;         ///< by object id - 1
  std::shared_ptr<const OcclusionQuery> trees;
  /// Index of the actor of a hit; hit.object != 0.
  std::size_t actorOf(const Hit& hit) const { return this->state->objectOf(hit.object) - 1; }

  std::vector<std::string> left; ///< what is no surface or could not be honoured, and was left out
};

/// Takes the view of a renderer, in an image of a size (0, 0: its own). What cannot be honoured is left out if `skip`,
/// else refused. Throws InputError. The renderer's objects keep their states, pipelines apart, which are brought up to
/// date. What changes afterwards does not change the result.
FrozenView freeze(vtkRenderer& renderer, int width, int height, bool skip);

} // namespace dgtk

#endif
