// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRendererLights_h
#define dgtkRendererLights_h

#include "dgtkSceneDescription.h"

#include <vector>

class vtkCamera;
class vtkRenderer;

namespace dgtk
{

/// Whether the renderer would light its actors; without lights VTK shows their colours as they are.
bool isLit(vtkRenderer& renderer);

/// The lights that are on, in the world: head lights and camera lights where the camera carries them. None stands for
/// the head light that a renderer makes itself.
std::vector<LightDescription> rendererLights(vtkRenderer& renderer, vtkCamera& camera);

/// The light that a renderer makes where it has none.
LightDescription headLight();

} // namespace dgtk

#endif
