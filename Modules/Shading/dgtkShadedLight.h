// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadedLight_h
#define dgtkShadedLight_h

// Private to Shading.

#include "dgtkShadedMaterials.h"

#include "dgtkEnvironmentLight.h"
#include "dgtkLightLaw.h"

#include <array>
#include <memory>
#include <vector>

namespace dgtk
{

/// A surface at a pixel, in the frame of the camera.
struct ShadedPoint
{
  Float4 position;
  Float4 normal; ///< unit, of the side that is seen
  Float4 viewer; ///< unit, towards the eye
  Float4 right;  ///< where pictures turn the normal: how the position changes to the pixel on the right, on the
                 ///< triangle's plane ...
  Float4 down;   ///< ... and to that below
  Footprint footprint;
  Float4 texture; ///< of the material's picture, where it has one
  Float4 tint;    ///< of the vertices: times ambient and diffuse colour, and opacity
  const ShadedMaterial* material = nullptr;
  float distance = 0; ///< from the eye
  // Of the paths to lights that cast shadows.
  std::uint32_t object = 0;
  Eigen::Vector3d lifted;  ///< position, off flat triangles towards the surface that they stand for
  Eigen::Vector3d outward; ///< unit normal of the triangle, of the side that is seen
};

/// Whether turnNormal() does anything.
bool turnsNormals(const ShadedMaterial& material);

/// Turns the normal, which is that of the front, as the material's pictures say.
void turnNormal(ShadedPoint& point);

/// What the pictures of points show, before they are shaded.
void lookUp(ShadedPoint* points, std::size_t count);

/// A number of each of the points that are shaded together.
using Lanes = std::array<Float4, LightPoints::count / 4>;
inline float of(const Lanes& lanes, std::size_t i) { return lanes[i / 4][i % 4]; }

/// What lights ask of the points that are shaded together: 1 to LightPoints::count.
struct PointLanes
{
  PointLanes(const ShadedPoint* points, std::size_t many);
  LightPoints places;
  std::array<Lanes, 3> normal;
  std::array<Lanes, 3> viewer;
  Lanes shininess;
  bool shines = false; ///< some do
};

/// What a light does to points that are shaded together.
struct LightLanes
{
  std::array<Lanes, 3> toLight; ///< unit
  Lanes cosine;
  Lanes strength;
  Lanes shine; ///< of Phong's highlight, where the material has one
  Lanes lit;   ///< 0 in its shadow, else 1

  Float4 toLightOf(std::size_t i) const
  {
    return float4(of(this->toLight[0], i), of(this->toLight[1], i), of(this->toLight[2], i));
  }
};

/// The light of a scene at one instant in the frame of a camera, and what surfaces make of it. VTK's renderer computes
/// the same (image_formation.md). Immutable.
class ShadedLight
{
public:
  ShadedLight(const SceneState& state, const View& view);

  std::size_t lights() const { return this->Lights.size(); }
  bool castsShadows(std::size_t light) const { return this->Lights[light].shadows; }
  bool castsShadows() const { return this->Shadows; }
  void light(std::size_t light, const PointLanes& points, LightLanes& to) const;
  /// Along the way of a path: how far a light is; infinite for parallel light.
  double distanceTo(std::size_t light, const Eigen::Vector3d& position) const;

  /// The display-referred colour of a point that is lit so by lights(), in its lane; not cut off at white.
  Float4 shade(const ShadedPoint& point, const LightLanes* lit, std::size_t lane) const;
  /// Whether the viewer and the distance of a point are asked for.
  bool needsViewer(const ShadedMaterial& material) const
  {
    return this->Always || material.shines || material.physical;
  }
  bool seesEnvironment() const { return this->SeesEnvironment; }
  Float4 background() const { return this->Background; }
  /// The environment where nothing is in front of it; `angle` between neighbouring pixels, radians.
  Float4 sky(Float4 direction, float angle) const;

private:
  struct Light
  {
    void (*rays)(const LightShape& light, const LightPoints& points, LightRays& rays);
    LightShape shape;
    Float4 ambient;
    Float4 diffuse;
    Float4 specular;
    bool shadows;
    bool near;     ///< at its place
    bool atViewer; ///< head light of a camera whose view has no one direction
  };
  Float4 phong(const ShadedPoint& point, const LightLanes* lit, std::size_t lane) const;
  Float4 physical(const ShadedPoint& point, const LightLanes* lit, std::size_t lane) const;
  Float4 surroundings(const ShadedPoint& point, Float4 albedo, Float4 f0, float nv, float rough) const;
  Float4 fogged(Float4 color, float distance) const;

  std::vector<Light> Lights;
  bool HeadOnly;
  bool Shadows = false;
  bool Always = false; ///< every material is seen from somewhere: for fog, environment, shadows or a light at the eye
  Float4 Background;
  Float4 Fog;
  float FogDensity;
  float FogStart;
  bool SeesEnvironment = false;
  float Intensity = 1;
  float TexelAngle = 1;
  Matrix3 ImageFromCamera;
  std::array<Float4, 9> Irradiance{};
  std::shared_ptr<const RadiancePyramid> Reflected; ///< null without environment
  std::shared_ptr<const RadiancePyramid> Picture;
  std::shared_ptr<const std::vector<float>> Reflectance;
};

} // namespace dgtk

#endif
