// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceShading.h"

#include "dgtkPortableMath.h"

#include "dgtkAlbedo.h"
#include "dgtkRepresentation.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double leastRough = 0.03;  // as in the shaders, like what follows
constexpr double leastCosine = 1e-4; // between normal and viewer
constexpr double leastMasking = 1e-7;

Eigen::Vector3d toLinear(const Eigen::Vector3d& display) { return display.unaryExpr(&portable::linearFromSrgb); }

Eigen::Vector3d toDisplay(const Eigen::Vector3d& linear) { return linear.unaryExpr(&portable::srgbFromLinear); }

/// What the GGX lobe sends from a light to the viewer, times pi and the cosine of the light; `h` is between them.
Eigen::Vector3d reflected(
  const Eigen::Vector3d& f0, double a2, double nl, double nv, double nh, double vh, Eigen::Vector3d& fresnel)
{
  const double d = nh * nh * (a2 - 1) + 1;
  const double masking = nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2);
  fresnel = f0 + (Eigen::Vector3d::Ones() - f0) * std::pow(std::clamp(1 - vh, 0.0, 1.0), 5);
  return fresnel * (a2 / (d * d) * 0.5 / std::max(masking, leastMasking));
}
} // namespace

/// Of the nearest cell.
Eigen::Vector2d reflectanceOf(double cosine, double roughness)
{
  static const std::vector<float> table = reflectanceTable();
  constexpr int size = EnvironmentLight::reflectanceSize;
  const int column = std::clamp(int(cosine * size), 0, size - 1);
  const int row = std::clamp(int(roughness * size), 0, size - 1);
  const float* const cell = &table[2 * (std::size_t(row) * size + std::size_t(column))];
  return { cell[0], cell[1] };
}

Eigen::Vector3d backgroundOf(const SceneState& state, const Eigen::Vector3d& direction)
{
  const EnvironmentState* const environment = state.environment.get();
  return environment != nullptr && environment->background
           ? toDisplay(
               environment->intensity * radianceFrom(*environment->image, environment->image_from_world * direction))
           : state.background;
}

Eigen::Vector3d SurfaceShading::Point::texel(int texture) const
{
  return texelAt(this->instance, this->triangle, this->barycentrics, texture);
}

SurfaceShading::SurfaceShading(
  const SceneState& state, const View& view, std::shared_ptr<const EnvironmentLight> environment)
  : State(state)
  , Parallel(view.model->linear() && !view.model->linear()->perspective)
  , Environment(std::move(environment))
  , world_from_camera(view.camera_from_world.rotation.transpose())
{
  const Eigen::Matrix3d& rotation = view.camera_from_world.rotation;
  for (const LightState& light : state.lights)
  {
    const LightShape shape = lightShape(light, rotation, view.camera_from_world.translation, Eigen::Vector3d(0, 0, 1));
    this->Lights.push_back({ &light, &lightLaw(lightLawOf(light)), shape });
  }
  if (state.environment != nullptr)
  {
    this->image_from_camera = state.environment->image_from_world * this->world_from_camera;
  }
}

Eigen::Vector3d SurfaceShading::phong(const Point& point) const
{
  const Material& material = point.material;
  // A head light alone takes the viewer to be where it is.
  const bool headOnly = this->Lights.size() == 1 && this->Lights.front().state->kind == LightKind::Head;
  Eigen::Vector3d ambient = Eigen::Vector3d::Constant(worldAmbient);
  Eigen::Vector3d diffuse = Eigen::Vector3d::Zero();
  Eigen::Vector3d specular = Eigen::Vector3d::Zero();
  for (const Light& light : this->Lights)
  {
    const LightRay ray = light.law->ray(light.shape, point.position);
    const double cosine = point.normal.dot(ray.toLight);
    const double strength = ray.strength * light.state->intensity;
    ambient += strength * light.state->ambient;
    diffuse += strength * std::max(cosine, 0.0) * light.state->diffuse;
    if (cosine > 0)
    {
      const Eigen::Vector3d mirrored = 2 * cosine * point.normal - ray.toLight;
      const double toViewer = headOnly ? cosine : std::max(0.0, mirrored.dot(point.viewer));
      specular += strength * std::pow(toViewer, material.shininess) * light.state->specular;
    }
  }
  const bool ownEmission = material.emissionMap >= 0;
  const Eigen::Vector3d lit = ambient.cwiseProduct(material.ambient) + diffuse.cwiseProduct(material.diffuse) +
                              specular.cwiseProduct(material.specular) + (ownEmission ? 0.0 : 1.0) * material.emission;
  const Eigen::Vector3d own =
    (ownEmission ? 1.0 : 0.0) * material.emission.cwiseProduct(point.texel(material.emissionMap));
  return lit.cwiseProduct(point.texel(material.texture)) + own;
}

Eigen::Vector3d SurfaceShading::surroundings(const Point& point, const Eigen::Vector3d& albedo,
  const Eigen::Vector3d& f0, double roughness, double occlusion) const
{
  const Eigen::Vector2d table = reflectanceOf(std::max(point.normal.dot(point.viewer), leastCosine), roughness);
  const Eigen::Vector3d mirrored = f0 * table.x() + Eigen::Vector3d::Constant(table.y());
  const Eigen::Vector3d away = 2 * point.normal.dot(point.viewer) * point.normal - point.viewer;
  const Eigen::Vector3d irradiance = this->Environment->irradianceOn(this->image_from_camera * point.normal);
  const Eigen::Vector3d seen = this->Environment->reflectedFrom(this->image_from_camera * away, roughness);
  return occlusion * (albedo.cwiseProduct(Eigen::Vector3d::Ones() - mirrored).cwiseProduct(irradiance) +
                       mirrored.cwiseProduct(seen));
}

Eigen::Vector3d SurfaceShading::physical(const Point& point) const
{
  const Material& material = point.material;
  const FacetedSurface facets = facetsOf(material);
  const Eigen::Vector3d map = point.texel(material.metallicRoughnessMap);
  const double metallic = facets.metallic * map.z();
  const double rough = std::clamp(facets.roughness * map.y(), leastRough, 1.0);
  const double a2 = std::pow(rough, 4);
  const Eigen::Vector3d base = toLinear(material.diffuse.cwiseProduct(point.texel(material.texture)));
  const Eigen::Vector3d f0 = (1 - metallic) * facets.f0 + metallic * base;
  const Eigen::Vector3d albedo = (1 - metallic) * base;
  const double nv = std::max(point.normal.dot(point.viewer), leastCosine);
  Eigen::Vector3d ambient = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = toLinear(material.emission.cwiseProduct(point.texel(material.emissionMap)));
  for (const Light& light : this->Lights)
  {
    const LightRay ray = light.law->ray(light.shape, point.position);
    const double cosine = point.normal.dot(ray.toLight);
    const double strength = ray.strength * light.state->intensity;
    ambient += strength * light.state->ambient;
    if (cosine > 0)
    {
      const Eigen::Vector3d h = (ray.toLight + point.viewer).normalized();
      Eigen::Vector3d fresnel;
      const Eigen::Vector3d shine =
        reflected(f0, a2, cosine, nv, std::max(point.normal.dot(h), 0.0), std::max(point.viewer.dot(h), 0.0), fresnel);
      const Eigen::Vector3d spread = albedo.cwiseProduct(Eigen::Vector3d::Ones() - fresnel);
      sum +=
        strength * cosine * (spread.cwiseProduct(light.state->diffuse) + shine.cwiseProduct(light.state->specular));
    }
  }
  const double occlusion = 1 + material.occlusionStrength * (point.texel(material.occlusionMap).x() - 1);
  if (this->Environment != nullptr)
  {
    return sum + this->surroundings(point, albedo, f0, rough, occlusion) + ambient.cwiseProduct(albedo);
  }
  const Eigen::Vector3d world = toLinear(ambient + Eigen::Vector3d::Constant(worldAmbient));
  return sum + occlusion * world.cwiseProduct(albedo + f0);
}

Eigen::Vector3d SurfaceShading::color(const Point& point) const
{
  const FogState& fog = this->State.fog;
  const double distance = this->Parallel ? point.position.z() : point.position.norm();
  const double clear = fog.density > 0 ? std::exp(-fog.density * std::max(distance - fog.start, 0.0)) : 1.0;
  if (this->Environment != nullptr || (point.material.physical && point.material.physical->wanted))
  {
    return toDisplay(clear * this->physical(point) + (1 - clear) * toLinear(fog.color));
  }
  return clear * this->phong(point) + (1 - clear) * fog.color;
}

std::vector<Eigen::Vector3d> SurfaceShading::colors(const SurfaceRows& in) const
{
  const std::vector<double> normals = shadingNormals(in);
  const double* n = normals.data();
  const Material plain;
  std::vector<Eigen::Vector3d> colors;
  colors.reserve(in.t.size());
  for (std::size_t i = 0; i < in.t.size(); ++i, n += 3)
  {
    const Eigen::Vector2d pixel(in.rect.x + double(i % std::size_t(in.rect.width)) + 0.5,
      in.rect.y + double(i / std::size_t(in.rect.width)) + 0.5);
    const CameraRay ray = in.view->model->rayThrough(pixel);
    const Eigen::Vector3d direction = ray.direction.normalized();
    if (!std::isfinite(in.t[i]))
    {
      colors.push_back(
        ray.exists() ? backgroundOf(this->State, this->world_from_camera * direction) : this->State.background);
      continue;
    }
    const Hit& hit = in.hits[i];
    const Instance& instance = in.state->instances[hit.object - 1];
    const Material* const material = materialOf(instance, hit.triangle);
    colors.push_back(this->color({ ray.origin + in.t[i] * ray.direction, Eigen::Vector3d(n[0], n[1], n[2]), -direction,
      material != nullptr ? *material : plain, instance, hit.triangle,
      { in.barycentrics[2 * i], in.barycentrics[2 * i + 1] } }));
  }
  return colors;
}

} // namespace dgtk
