// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadedLight.h"

#include "dgtkPortableMath.h"

#include "dgtkSurfaceMaterial.h"

#include <mutex>

namespace dgtk
{

namespace
{
constexpr float leastRough = 0.03F;
constexpr float leastCosine = 1e-4F; ///< between normal and viewer
constexpr float leastMasking = 1e-7F;

/// What is made of an environment once.
struct EnvironmentPictures
{
  std::weak_ptr<const EnvironmentState> environment;
  std::shared_ptr<const EnvironmentLight> light;
  std::shared_ptr<const RadiancePyramid> reflected;
  std::shared_ptr<const RadiancePyramid> picture;
};

EnvironmentPictures picturesOf(const std::shared_ptr<const EnvironmentState>& environment)
{
  static std::mutex mutex;
  static EnvironmentPictures last;
  const std::lock_guard<std::mutex> lock(mutex);
  if (last.environment.lock() != environment)
  {
    last.light = environmentLight(environment);
    last.reflected =
      std::make_shared<RadiancePyramid>(last.light->radiance.data(), EnvironmentLight::levels, EnvironmentLight::width);
    last.picture = environment->background ? std::make_shared<RadiancePyramid>(*environment->image) : nullptr;
    last.environment = environment;
  }
  return last;
}

std::shared_ptr<const std::vector<float>> sharedReflectance()
{
  static const auto table = std::make_shared<const std::vector<float>>(reflectanceTable());
  return table;
}

/// Scale and bias between the centres of the cells.
std::array<float, 2> reflectanceAt(const std::vector<float>& table, float nv, float rough)
{
  constexpr int size = EnvironmentLight::reflectanceSize;
  const auto place = [](float at) { return std::min(std::max(at * size - 0.5F, 0.0F), float(size - 1)); };
  const float x = place(nv);
  const float y = place(rough);
  const int column = std::min(int(x), size - 2);
  const int row = std::min(int(y), size - 2);
  const float right = x - float(column);
  const float down = y - float(row);
  std::array<float, 2> result{};
  for (std::size_t c = 0; c < 2; ++c)
  {
    const float* const cell = &table[2 * (std::size_t(row) * size + std::size_t(column)) + c];
    const float above = cell[0] + (cell[2] - cell[0]) * right;
    const float below = cell[2 * size] + (cell[2 * size + 2] - cell[2 * size]) * right;
    result[c] = above + (below - above) * down;
  }
  return result;
}

float fifthPower(float v) { return v * v * (v * v) * v; }

/// Tangent and bitangent at a point, of unit length: where v is the same, and where it grows (Mikkelsen 2008).
void textureFrame(const ShadedPoint& p, Float4& t, Float4& s)
{
  const Float4 up = -p.down;
  const Float4 a = cross(up, p.normal);
  const Float4 b = cross(p.normal, p.right);
  const float side = dot(cross(p.right, up), p.normal) < 0 ? -1.0F : 1.0F;
  s = a * p.footprint.rightV - b * p.footprint.downV;
  const float size = dot(s, s);
  s *= size > 0 ? side / std::sqrt(size) : 0.0F;
  t = cross(s, p.normal);
  const float along = side * dot(t, a * p.footprint.rightU - b * p.footprint.downU);
  t *= along > 0 ? 1.0F : along < 0 ? -1.0F : 0.0F;
}

void turnByMap(ShadedPoint& p)
{
  const ShadedMaterial& m = *p.material;
  const Float4 turn = m.normalMap->at(p.footprint) * (255.0F / 127) - 128.0F / 127;
  Float4 t;
  Float4 s;
  textureFrame(p, t, s);
  const Float4 turned = t * (turn[0] * m.normalScale) + s * (turn[1] * m.normalScale) + p.normal * turn[2];
  const float size = dot(turned, turned);
  p.normal = size > 0 ? turned / std::sqrt(size) : p.normal;
}

/// Blinn 1978; central differences of the height over a texel, or over a pixel where that is larger.
void turnByBump(ShadedPoint& p)
{
  const ShadedMaterial& m = *p.material;
  const Footprint& f = p.footprint;
  const auto width = float(m.bumpMap->width());
  const auto height = float(m.bumpMap->height());
  const auto length = [&](float u, float v) { return std::sqrt(u * width * (u * width) + v * height * (v * height)); };
  const float texels = std::max({ 1.0F, length(f.rightU, f.rightV), length(f.downU, f.downV) });
  const float stepU = texels / width;
  const float stepV = texels / height;
  const auto heightAt = [&](float u, float v)
  {
    Footprint moved = f;
    moved.u += double(u);
    moved.v += double(v);
    return m.bumpMap->at(moved)[0];
  };
  const float slopeU = m.bumpScale / (2 * stepU) * (heightAt(stepU, 0) - heightAt(-stepU, 0));
  const float slopeV = m.bumpScale / (2 * stepV) * (heightAt(0, stepV) - heightAt(0, -stepV));
  const float toRight = slopeU * f.rightU + slopeV * f.rightV;
  const float toUp = -(slopeU * f.downU + slopeV * f.downV);
  const Float4 a = cross(-p.down, p.normal);
  const Float4 b = cross(p.normal, p.right);
  const float area = dot(p.right, a);
  const float sign = area > 0 ? 1.0F : area < 0 ? -1.0F : 0.0F;
  const Float4 turned = std::abs(area) * p.normal - sign * (toRight * a + toUp * b);
  const float size = dot(turned, turned);
  p.normal = size > 0 ? turned / std::sqrt(size) : p.normal;
}
} // namespace

bool turnsNormals(const ShadedMaterial& material)
{
  return material.bumpMap != nullptr || material.normalMap != nullptr;
}

void turnNormal(ShadedPoint& point)
{
  if (point.material->bumpMap != nullptr)
  {
    turnByBump(point);
  }
  if (point.material->normalMap != nullptr)
  {
    turnByMap(point);
  }
}

void lookUp(ShadedPoint* points, std::size_t count)
{
  for (std::size_t first = 0; first < count; first += 4)
  {
    std::array<const Footprint*, 4> footprints{};
    Float4 widths = float4(1);
    Float4 heights = float4(1);
    bool any = false;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const ShadedPoint& p = points[std::min(first + i, count - 1)];
      footprints[i] = &p.footprint;
      if (const TexturePyramid* texture = p.material->texture)
      {
        widths[i] = float(texture->width());
        heights[i] = float(texture->height());
        any = true;
      }
    }
    if (any)
    {
      const Extents extents(footprints, widths, heights);
      for (std::size_t i = first; i < std::min(first + 4, count); ++i)
      {
        if (const TexturePyramid* texture = points[i].material->texture)
        {
          points[i].texture = texture->at(points[i].footprint, extents, i - first);
        }
      }
    }
  }
}

ShadedLight::ShadedLight(const SceneState& state, const View& view)
  : HeadOnly(state.lights.size() == 1 && state.lights[0].kind == LightKind::Head)
  , Background(toFloat4(state.background))
  , Fog(toFloat4(state.fog.color))
  , FogDensity(float(state.fog.density))
  , FogStart(float(state.fog.start))
{
  const Rigid3& pose = view.camera_from_world;
  for (const LightState& from : state.lights)
  {
    const LightTraits& traits = traitsOf(from.kind);
    Light light;
    light.rays = lightLaw(lightLawOf(from)).rays;
    light.shape = lightShape(from, pose.rotation, pose.translation, Eigen::Vector3d(0, 0, 1));
    light.ambient = toFloat4(from.ambient * from.intensity);
    light.diffuse = toFloat4(from.diffuse * from.intensity);
    light.specular = toFloat4(from.specular * from.intensity);
    light.shadows = from.shadows && traits.shadows;
    light.near = traits.near;
    light.atViewer = !traits.placed && !view.model->linear();
    this->Shadows = this->Shadows || light.shadows;
    this->Always = this->Always || light.atViewer || light.shadows;
    this->Lights.push_back(light);
  }
  this->Always = this->Always || state.environment || state.fog.density > 0;
  if (state.environment)
  {
    const EnvironmentState& environment = *state.environment;
    const EnvironmentPictures pictures = picturesOf(state.environment);
    this->Reflected = pictures.reflected;
    this->Picture = pictures.picture;
    this->Reflectance = sharedReflectance();
    this->SeesEnvironment = environment.background;
    this->Intensity = float(environment.intensity);
    this->TexelAngle = float(pi / environment.image->height);
    this->ImageFromCamera = Matrix3(environment.image_from_world * pose.rotation.transpose());
    for (std::size_t i = 0; i < this->Irradiance.size(); ++i)
    {
      this->Irradiance[i] = toFloat4(pictures.light->irradiance[i]);
    }
  }
}

PointLanes::PointLanes(const ShadedPoint* points, std::size_t many)
{
  for (std::size_t i = 0; i < LightPoints::count; ++i)
  {
    const ShadedPoint& p = points[std::min(i, many - 1)];
    this->places.x[i] = double(p.position[0]);
    this->places.y[i] = double(p.position[1]);
    this->places.z[i] = double(p.position[2]);
    this->shininess[i / 4][i % 4] = p.material->shines ? p.material->shininess : 0;
    this->shines = this->shines || p.material->shines;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->normal[axis][i / 4][i % 4] = p.normal[axis];
      this->viewer[axis][i / 4][i % 4] = p.viewer[axis];
    }
  }
}

void ShadedLight::light(std::size_t light, const PointLanes& p, LightLanes& to) const
{
  const Light& from = this->Lights[light];
  if (from.atViewer)
  {
    to.toLight = p.viewer;
    to.strength.fill(float4(1));
  }
  else
  {
    LightRays rays;
    from.rays(from.shape, p.places, rays);
    for (std::size_t i = 0; i < LightPoints::count; ++i)
    {
      to.toLight[0][i / 4][i % 4] = float(rays.x[i]);
      to.toLight[1][i / 4][i % 4] = float(rays.y[i]);
      to.toLight[2][i / 4][i % 4] = float(rays.z[i]);
      to.strength[i / 4][i % 4] = float(rays.strength[i]);
    }
  }
  to.lit.fill(float4(1));
  for (std::size_t k = 0; k < to.cosine.size(); ++k)
  {
    const Float4 cosine =
      p.normal[0][k] * to.toLight[0][k] + p.normal[1][k] * to.toLight[1][k] + p.normal[2][k] * to.toLight[2][k];
    to.cosine[k] = cosine;
    if (p.shines)
    {
      // A head light alone takes the viewer to be where it is.
      const auto mirrored = [&](std::size_t axis)
      { return (p.normal[axis][k] * (2 * cosine) - to.toLight[axis][k]) * p.viewer[axis][k]; };
      const Float4 toViewer = this->HeadOnly ? cosine : mirrored(0) + mirrored(1) + mirrored(2);
      to.shine[k] = portable::pow(atLeast(toViewer, 0), p.shininess[k]);
    }
  }
}

double ShadedLight::distanceTo(std::size_t light, const Eigen::Vector3d& position) const
{
  const Light& from = this->Lights[light];
  return from.near ? (from.shape.position - position).norm() : std::numeric_limits<double>::infinity();
}

Float4 ShadedLight::phong(const ShadedPoint& p, const LightLanes* lit, std::size_t lane) const
{
  const ShadedMaterial& m = *p.material;
  Float4 ambient = float4(float(worldAmbient));
  Float4 diffuse = float4(0);
  Float4 specular = float4(0);
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const float cosine = of(lit[i].cosine, lane);
    const float unhidden = of(lit[i].strength, lane);
    const float strength = unhidden * of(lit[i].lit, lane);
    ambient += light.ambient * unhidden;
    if (cosine > 0)
    {
      diffuse += light.diffuse * (cosine * strength);
      if (m.shines && strength > 0)
      {
        specular += light.specular * (strength * of(lit[i].shine, lane));
      }
    }
  }
  Float4 color = (ambient * m.ambient + diffuse * m.diffuse) * p.tint + specular * m.specular;
  if (m.emissionMap == nullptr)
  {
    color += m.emission;
  }
  if (m.texture != nullptr)
  {
    color *= p.texture;
  }
  if (m.emissionMap != nullptr)
  {
    color += m.emission * m.emissionMap->at(p.footprint);
  }
  return this->FogDensity > 0 ? this->fogged(color, p.distance) : color;
}

Float4 ShadedLight::fogged(Float4 color, float distance) const
{
  const float clear = portable::exp(-this->FogDensity * std::max(distance - this->FogStart, 0.0F));
  return this->Fog + (color - this->Fog) * clear;
}

/// Cook-Torrance with the GGX distribution and Smith's joint masking (Walter et al. 2007; Heitz 2014), Schlick's
/// Fresnel term, Lambert's diffuse part for what is not reflected. Times pi: a light of strength 1 shows a white
/// diffuse surface white.
Float4 ShadedLight::physical(const ShadedPoint& p, const LightLanes* lit, std::size_t lane) const
{
  const ShadedMaterial& m = *p.material;
  const Footprint& f = p.footprint;
  const Float4 tinted = m.diffuse * p.tint;
  const Float4 base = toLinear(m.texture != nullptr ? tinted * p.texture : tinted);
  float metallic = m.metallic;
  float rough = m.roughness;
  if (m.metallicRoughnessMap != nullptr)
  {
    const Float4 map = m.metallicRoughnessMap->at(f);
    metallic *= map[2];
    rough *= map[1];
  }
  rough = std::min(std::max(rough, leastRough), 1.0F);
  const float a2 = rough * rough * (rough * rough);
  const Float4 f0 = m.f0 + (base - m.f0) * metallic;
  const Float4 albedo = base * (1 - metallic);
  const float nv = std::max(dot(p.normal, p.viewer), leastCosine);
  Float4 ambient = float4(0);
  Float4 sum = float4(0);
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const float nl = of(lit[i].cosine, lane);
    const float unhidden = of(lit[i].strength, lane);
    const float strength = unhidden * of(lit[i].lit, lane) * nl;
    ambient += light.ambient * unhidden;
    if (strength > 0 && nl > 0)
    {
      const Float4 h = normalized(lit[i].toLightOf(lane) + p.viewer);
      const float nh = std::max(dot(p.normal, h), 0.0F);
      const float vh = std::max(dot(p.viewer, h), 0.0F);
      const float d = nh * nh * (a2 - 1) + 1;
      const float masking = nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2);
      const Float4 fresnel = f0 + (1 - f0) * fifthPower(std::min(std::max(1 - vh, 0.0F), 1.0F));
      const Float4 shine = fresnel * (a2 / (d * d) * 0.5F / std::max(masking, leastMasking));
      sum += strength * (albedo * (1 - fresnel) * light.diffuse + shine * light.specular);
    }
  }
  float occlusion = 1;
  if (m.occlusionMap != nullptr)
  {
    occlusion += m.occlusionStrength * (m.occlusionMap->at(f)[0] - 1);
  }
  if (this->Reflected)
  {
    sum += occlusion * this->surroundings(p, albedo, f0, nv, rough) + ambient * albedo;
  }
  else
  {
    sum += toLinear(ambient + float(worldAmbient)) * occlusion * (albedo + f0);
  }
  sum += toLinear(m.emissionMap != nullptr ? m.emission * m.emissionMap->at(f) : m.emission);
  if (this->FogDensity > 0)
  {
    const float clear = portable::exp(-this->FogDensity * std::max(p.distance - this->FogStart, 0.0F));
    const Float4 fog = toLinear(this->Fog);
    sum = fog + (sum - fog) * clear;
  }
  return toDisplay(sum);
}

Float4 ShadedLight::surroundings(const ShadedPoint& p, Float4 albedo, Float4 f0, float nv, float rough) const
{
  const std::array<float, 2> reflectance = reflectanceAt(*this->Reflectance, nv, rough);
  const Float4 mirrored = f0 * reflectance[0] + reflectance[1];
  const Float4 away = this->ImageFromCamera * (p.normal * (2 * dot(p.normal, p.viewer)) - p.viewer);
  const Float4 seen = this->Reflected->at(away, rough * (EnvironmentLight::levels - 1));
  const Float4 d = this->ImageFromCamera * p.normal;
  const std::array<Float4, 9>& k = this->Irradiance;
  const Float4 irradiance =
    atLeast(k[0] + k[1] * d[1] + k[2] * d[2] + k[3] * d[0] + k[4] * (d[0] * d[1]) + k[5] * (d[1] * d[2]) +
              k[6] * (3 * d[2] * d[2] - 1) + k[7] * (d[0] * d[2]) + k[8] * (d[0] * d[0] - d[1] * d[1]),
      0);
  return albedo * (1 - mirrored) * irradiance + mirrored * seen;
}

Float4 ShadedLight::shade(const ShadedPoint& point, const LightLanes* lit, std::size_t lane) const
{
  return point.material->physical || this->Reflected ? this->physical(point, lit, lane) : this->phong(point, lit, lane);
}

Float4 ShadedLight::sky(Float4 direction, float angle) const
{
  const float ratio = std::max(angle / this->TexelAngle, 1.0F);
  return toDisplay(this->Picture->at(this->ImageFromCamera * direction, portable::log2(ratio)) * this->Intensity);
}

} // namespace dgtk
