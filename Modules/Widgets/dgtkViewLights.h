// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewLights_h
#define dgtkViewLights_h

// Private to Widgets.

#include "dgtkScenePlaces.h"

class vtkRenderer;

namespace dgtk
{

/// What lights a view: a light at its eye, or the scene's lights with a weak one at the eye, so that nothing is black.
/// VTK's ordinary shading: no shadows, no environment.
class ViewLights
{
public:
  explicit ViewLights(vtkRenderer* renderer);

  void show(const SceneDescription& scene, const ScenePlaces& places);
  /// Takes effect at the next show().
  void setSceneLights(bool on) { this->OfScene = on; }

private:
  void addHead(double intensity);
  void fillUp();
  void add(const LightDescription& light, const Eigen::Vector3d& position, double frame);

  vtkRenderer* Renderer;
  bool OfScene = false;
};

} // namespace dgtk

#endif
