// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkActorMaterial_h
#define dgtkActorMaterial_h

#include "dgtkUnsupported.h"

#include "dgtkModel.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

class vtkActor;
class vtkImageData;

namespace dgtk
{

struct SurfacePiece;

/// The material of a piece of an actor, with its texture among the model's. Its ambient colour is what VTK adds without
/// a light, for the renderer's worldAmbient; without lights that is all of it.
Material actorMaterial(vtkActor& actor, const SurfacePiece& piece, bool lit, const std::string& name, Model& model,
  Unsupported& unsupported);

/// Whether a surface is lit as VTK's physically based kind.
bool isPhysical(vtkActor& actor, bool lit);

/// What VTK does to an actor's texture coordinates beside the transform of its texture; empty: nothing.
std::string changeOfCoordinates(vtkActor& actor);

/// The colours of scalars on such a surface, which VTK takes as linear, as ours are.
void toDisplay(std::array<std::uint8_t, 4>& color);
void toDisplay(Image& picture);

/// The texels of an image of 1 to 4 components, rows top to bottom; null for what is no picture of bytes.
std::shared_ptr<const Image> imageOf(vtkImageData& data);

} // namespace dgtk

#endif
