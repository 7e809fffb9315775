// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRendererCamera_h
#define dgtkRendererCamera_h

#include "dgtkSceneDescription.h"

#include <vtkSmartPointer.h>

#include <utility>

class vtkCamera;
class vtkRenderer;

namespace dgtk
{

/// A renderer's camera, in an image of a size.
struct RendererCamera
{
  vtkSmartPointer<vtkCamera> camera; ///< which the renderer uses, or would
  CameraDescription description;     ///< posed, of this size, with K
  bool drawn = false;                ///< the window has drawn: its near and far are those of the picture
  double nearPlane = 0;              ///< as the matrices have it; not a number where it leans
  double farPlane = 0;
};

/// What VTK would draw with next: the active camera, or one that sees all props where none was ever made. The
/// camera's matrices decide: window centre, aspect, view angles, shear and transforms are in them. Throws InputError
/// for what a matrix K and a pose are not: mirrors, parallel views that lean.
RendererCamera rendererCamera(vtkRenderer& renderer, int width, int height);

/// Near and far: those of the picture that was drawn; otherwise around what there is, between two depths.
void setRange(RendererCamera& view, double nearest, double farthest);

/// Size of the renderer's picture, pixels; as VTK opens a window, 300 x 300, where there is none.
std::pair<int, int> rendererSize(vtkRenderer& renderer);

} // namespace dgtk

#endif
