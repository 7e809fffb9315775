// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewLights_h
#define dgtkViewLights_h

#include "dgtkEnvironmentLight.h"
#include "dgtkModel.h"
#include "dgtkSceneState.h"
#include "dgtkViewCamera.h"

#include <vtkSmartPointer.h>

#include <memory>
#include <set>

class vtkProperty;
class vtkRenderer;
class vtkShaderProperty;
class vtkSkybox;

namespace dgtk
{

/// What a view is lit by and stands before: the scene's lights, background and environment, as the renderer has them;
/// or a light at the view's eye before the view's own background. VTK's ordinary shading, with an environment's light
/// from all sides added: no shadows, reflections, fog.
class ViewLights
{
public:
  explicit ViewLights(vtkRenderer* renderer);
  ~ViewLights();
  ViewLights(const ViewLights&) = delete;
  ViewLights& operator=(const ViewLights&) = delete;

  /// Takes effect at the next show().
  void setSceneLights(bool on) { this->OfScene = on; }
  /// `environment` of the surroundings' one; `usual`: an eye of the view's kind. True when materials look otherwise
  /// now: fill() is to be called for all.
  bool show(
    const SceneState& surroundings, std::shared_ptr<const EnvironmentLight> environment, const ViewCamera& usual);
  /// Colours of a material in this light.
  void fill(const Material& material, vtkProperty& property) const;

  /// What shades an actor: `glows` where its ambient colour is not its property's (see setGlow()). Belongs to it until
  /// the next show() that is true.
  vtkSmartPointer<vtkShaderProperty> makeShading(bool glows);
  static void setGlow(vtkShaderProperty& shading, vtkProperty& property);
  void forget(vtkShaderProperty* shading) { this->Shadings.erase(shading); }
  /// Before each drawing.
  void aim(const ViewCamera& camera);

private:
  struct Look ///< what fill() and makeShading() depend on
  {
    bool ofScene = false;
    Eigen::Vector3d ambient{ 0, 0, 0 }; ///< light from everywhere, of the lights and the world
    double shine = 1; ///< of the lights' specular colours beside their diffuse ones, which VTK takes for both
    std::shared_ptr<const EnvironmentLight> environment;
    bool operator==(const Look& o) const
    {
      return this->ofScene == o.ofScene && this->ambient == o.ambient && this->shine == o.shine &&
             this->environment == o.environment;
    }
  };

  void addHead();
  void add(const LightState& light);
  void fillUp();
  void showBackground(const SceneState& surroundings, const ViewCamera& usual);
  void showSky(const SceneState& surroundings);

  vtkRenderer* Renderer;
  Eigen::Vector3d OwnBackground[2]; ///< bottom and top
  bool OfScene = true;
  Look Now;
  Eigen::Matrix3d image_from_world = Eigen::Matrix3d::Identity();
  std::set<vtkShaderProperty*> Shadings; ///< that need to know where the view looks
  vtkSmartPointer<vtkSkybox> Sky;
  std::shared_ptr<const EnvironmentState> SkyOf;
};

} // namespace dgtk

#endif
