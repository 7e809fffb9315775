// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEnvironmentMap_h
#define dgtkEnvironmentMap_h

#include "dgtkEnvironmentLight.h"
#include "dgtkRasterCamera.h"
#include "dgtkSceneState.h"

#include <array>
#include <memory>

namespace dgtk
{

/// An environment in OpenGL's memory. The context must be current.
class EnvironmentMap
{
public:
  ~EnvironmentMap();
  /// Makes the textures of another environment; null for none.
  void set(const std::shared_ptr<const EnvironmentState>& environment);
  bool exists() const { return bool(this->State); }
  bool background() const { return this->State && this->State->background; }

  /// For a camera: what the shaders get.
  void aim(const Eigen::Matrix4d& view_from_world);
  void bind(int radianceUnit, int reflectanceUnit) const;
  const std::array<float, 27>& irradiance() const { return this->Irradiance; }
  const std::array<float, 9>& imageFromView() const { return this->ImageFromView; }

  /// Fills the bound framebuffer of width x height with what is seen of the environment; output 1 becomes 0. The
  /// picture is taken at the level of detail that fits the pixels. Depths are not tested.
  void drawBackground(const RasterCamera& camera, int width, int height, int unit);

private:
  void release();
  void makePicture();
  void makeProgram();

  std::shared_ptr<const EnvironmentState> State;
  std::array<float, 27> Irradiance{};
  std::array<float, 9> ImageFromView{}; // by columns
  unsigned int Radiance = 0;
  unsigned int Reflectance = 0;
  unsigned int Picture = 0;
  unsigned int Program = 0;
  unsigned int VertexArray = 0;
};

} // namespace dgtk

#endif
