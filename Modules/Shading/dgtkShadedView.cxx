// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadedView.h"

#include "dgtkRaySource.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
/// Cofactors: they also exist where the matrix has no inverse. Scaled to about 1.
Eigen::Matrix3d normalMatrix(const Eigen::Matrix3d& m, double side)
{
  Eigen::Matrix3d cofactors;
  for (int c = 0; c < 3; ++c)
  {
    cofactors.col(c) = m.col((c + 1) % 3).cross(m.col((c + 2) % 3));
  }
  const double size = cofactors.cwiseAbs().maxCoeff();
  return cofactors * (side / (size > 0 ? size : 1.0));
}

} // namespace

ShadedView::ShadedView(std::shared_ptr<const SceneState> state, const View& view, ShadedMaterialLibrary& materials)
  : State(std::move(state))
  , TheView(view)
  , Light(*this->State, view)
{
  for (const Instance& instance : this->State->instances)
  {
    Placed placed;
    placed.materials = materials.of(instance);
    placed.camera_from_object = view.camera_from_world * instance.world_from_object;
    placed.side = placed.camera_from_object.linear.determinant() < 0 ? -1 : 1;
    placed.normals = Matrix3(normalMatrix(placed.camera_from_object.linear, placed.side));
    this->Translucent = this->Translucent || placed.materials->translucent;
    this->Objects.push_back(std::move(placed));
  }
  if (this->Light.castsShadows())
  {
    this->Shadows = makeShadowQuery(this->State, view.camera_from_world);
  }
}

void ShadedView::place(const PixelRay& ray, const Hit& hit, ShadedPoint& point) const
{
  const Instance& instance = this->State->instances[hit.object - 1];
  const Placed& placed = this->Objects[hit.object - 1];
  const Model& model = *instance.model;
  const Geometry& geometry = *instance.geometry;
  const auto& corners = model.triangles[hit.triangle];
  const Eigen::Vector3d a = placed.camera_from_object * geometry.positions[corners[0]];
  const Eigen::Vector3d b = placed.camera_from_object * geometry.positions[corners[1]];
  const Eigen::Vector3d c = placed.camera_from_object * geometry.positions[corners[2]];
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d n = ab.cross(ac);
  const double along = n.dot(ray.ray.direction);
  const double perAlong = along != 0 ? 1 / along : 0.0;
  const double t = n.dot(a - ray.ray.origin) * perAlong;
  const Eigen::Vector3d position = ray.ray.origin + t * ray.ray.direction;
  const double area = n.squaredNorm();
  const double perArea = area > 0 ? 1 / area : 0.0;
  const Eigen::Vector3d toB = ac.cross(n) * perArea; // gradients of the barycentric coordinates
  const Eigen::Vector3d toC = n.cross(ab) * perArea;
  const Eigen::Vector3d inside = position - a;
  const double second = toB.dot(inside);
  const double third = toC.dot(inside);

  point.object = hit.object;
  point.material = &placed.materials->of(hit.triangle);
  point.position = toFloat4(position);
  point.viewer = normalized(toFloat4(-ray.ray.direction));
  point.distance = float(t * ray.ray.direction.norm());
  const double side = along * placed.side < 0 ? 1 : -1; // what is seen from behind has its normal turned
  const auto u = float(second);
  const auto v = float(third);
  const Float4 normal = toFloat4(geometry.normals[corners[0]]) * (1 - u - v) +
                        toFloat4(geometry.normals[corners[1]]) * u + toFloat4(geometry.normals[corners[2]]) * v;
  point.normal = normalized(placed.normals * normal) * float(side);
  if (this->Shadows)
  {
    // Off the flat triangle to where the corners' tangent planes are: shadows end where smooth shading does (Hanika
    // 2021, Hacking the Shadow Terminator).
    point.outward = n * ((along < 0 ? 1 : -1) * std::sqrt(perArea));
    point.lifted = position;
    const Eigen::Vector3d* const at[3] = { &a, &b, &c };
    const double parts[3] = { 1 - second - third, second, third };
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Float4 own = normalized(placed.normals * toFloat4(geometry.normals[corners[i]])) * float(side);
      const Eigen::Vector3d tangent = toVector3d(own);
      point.lifted -= parts[i] * std::min(0.0, (position - *at[i]).dot(tangent)) * tangent;
    }
  }
  if (point.material->mapped)
  {
    const auto moved = [&](const CameraRay& by)
    {
      const Eigen::Vector3d across = by.origin + t * by.direction;
      return Eigen::Vector3d(across - n.dot(across) * perAlong * ray.ray.direction);
    };
    const Eigen::Vector3d right = moved(ray.right);
    const Eigen::Vector3d down = moved(ray.down);
    point.right = toFloat4(right);
    point.down = toFloat4(down);
    const Eigen::Vector2d& origin = model.uvs[corners[0]];
    const Eigen::Vector2d toSecond = model.uvs[corners[1]] - origin;
    const Eigen::Vector2d toThird = model.uvs[corners[2]] - origin;
    const auto coordinates = [&](double s, double r) { return Eigen::Vector2d(s * toSecond + r * toThird); };
    const Eigen::Vector2d uv = origin + coordinates(second, third);
    const Eigen::Vector2d uvRight = coordinates(toB.dot(right), toC.dot(right));
    const Eigen::Vector2d uvDown = coordinates(toB.dot(down), toC.dot(down));
    point.footprint = { uv.x(), uv.y(), float(uvRight.x()), float(uvRight.y()), float(uvDown.x()), float(uvDown.y()) };
    turnNormal(point);
  }
}

void ShadedView::findShadows(const ShadedPoint* points, std::size_t count, PointLight* lit) const
{
  const std::size_t lights = this->Light.lights();
  for (std::size_t light = 0; light < lights; ++light)
  {
    if (!this->Light.castsShadows(light))
    {
      continue;
    }
    LightPath paths[lanes];
    std::size_t ofPath[lanes];
    std::size_t asked = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const PointLight& own = lit[i * lights + light];
      if (own.cosine > 0 && own.strength > 0)
      {
        const ShadedPoint& p = points[i];
        const Eigen::Vector3d toLight = toVector3d(own.toLight);
        const double off = this->Shadows->precision(p.object, double(p.distance));
        paths[asked] = { p.lifted + off * p.outward, toLight, this->Light.distanceTo(light, p.lifted) - off };
        ofPath[asked++] = i;
      }
    }
    const unsigned int blocked = asked > 0 ? this->Shadows->blocked(paths, asked) : 0;
    for (std::size_t k = 0; k < asked; ++k)
    {
      lit[ofPath[k] * lights + light].lit = (blocked >> k & 1U) != 0 ? 0.0F : 1.0F;
    }
  }
}

void ShadedView::shadeRow(int x, int y, int count, const std::vector<Surface>& surfaces, float* rgba) const
{
  RayDifferentials source(*this->TheView.model);
  this->shade(source.row(y, x, count), surfaces, rgba);
}

void ShadedView::shade(const std::vector<PixelRay>& rays, const std::vector<Surface>& surfaces, float* rgba) const
{
  const std::size_t lights = this->Light.lights();
  ShadedPoint points[lanes];
  thread_local std::vector<PointLight> lit;
  lit.resize(lanes * lights + 1);
  for (std::size_t first = 0; first < surfaces.size(); first += lanes)
  {
    const std::size_t many = std::min(surfaces.size() - first, lanes);
    for (std::size_t i = 0; i < many; ++i)
    {
      this->place(rays[std::size_t(surfaces[first + i].pixel)], surfaces[first + i].hit, points[i]);
      for (std::size_t light = 0; light < lights; ++light)
      {
        lit[i * lights + light] = this->Light.of(light, points[i]);
      }
    }
    if (this->Shadows)
    {
      this->findShadows(points, many, lit.data());
    }
    for (std::size_t i = 0; i < many; ++i)
    {
      Float4 color = atLeast(this->Light.shade(points[i], &lit[i * lights]), 0);
      color[3] = points[i].material->opacity;
      std::memcpy(rgba + 4 * (first + i), &color, sizeof color);
    }
  }
}

Float4 ShadedView::skyAt(const PixelRay& ray) const
{
  const Eigen::Vector3d& d = ray.ray.direction;
  const double square = d.squaredNorm();
  const double angle = std::sqrt(d.cross(ray.right.direction).norm() * d.cross(ray.down.direction).norm()) / square;
  return this->Light.sky(toFloat4(d / std::sqrt(square)), float(angle));
}

void ShadedView::row(int x, int y, int count, const Hit* hits, float* rgb) const
{
  thread_local std::vector<Surface> surfaces;
  thread_local std::vector<float> colors;
  std::vector<int> translucent;
  RayDifferentials source(*this->TheView.model);
  const std::vector<PixelRay>& rays = source.row(y, x, count);
  const auto put = [rgb](int pixel, Float4 color)
  {
    float* const to = rgb + 3 * std::size_t(pixel);
    to[0] = color[0];
    to[1] = color[1];
    to[2] = color[2];
  };
  surfaces.clear();
  for (int i = 0; i < count; ++i)
  {
    if (hits[i].object == 0)
    {
      put(i, this->skyAt(rays[std::size_t(i)]));
    }
    else if (this->Translucent && this->materialOf(hits[i]).opacity < 1)
    {
      translucent.push_back(i);
    }
    else
    {
      surfaces.push_back({ i, hits[i] });
    }
  }
  colors.resize(4 * surfaces.size());
  this->shade(rays, surfaces, colors.data());
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    put(surfaces[i].pixel, loadFloat4(&colors[4 * i]));
  }
  if (!translucent.empty())
  {
    this->seeThrough(x, y, rays, translucent, rgb);
  }
}

void ShadedView::allHits(int x, int y, int count, std::vector<Hit>* hits) const
{
  std::call_once(this->QueryMade,
    [this]
    {
      this->Query = makeOcclusionQuery();
      this->Query->setScene(this->State);
    });
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i)
  {
    pixels.emplace_back(x + i + 0.5, y + 0.5);
  }
  this->Query->allHits(this->TheView, pixels.data(), pixels.size(), hits);
}

/// Surfaces in order, nearest first, until one is opaque.
void ShadedView::seeThrough(
  int x, int y, const std::vector<PixelRay>& rays, const std::vector<int>& pixels, float* rgb) const
{
  std::vector<std::vector<Hit>> hits(1);
  std::vector<Surface> surfaces;
  std::vector<float> colors;
  for (const int pixel : pixels)
  {
    this->allHits(x + pixel, y, 1, hits.data());
    surfaces.clear();
    bool closed = false;
    for (std::size_t i = 0; i < hits[0].size() && !closed; ++i)
    {
      surfaces.push_back({ pixel, hits[0][i] });
      closed = this->materialOf(hits[0][i]).opacity >= 1;
    }
    Float4 over = float4(0);
    float through = 1;
    colors.resize(4 * surfaces.size());
    this->shade(rays, surfaces, colors.data());
    for (std::size_t i = 0; i < surfaces.size(); ++i)
    {
      const float opacity = std::min(std::max(colors[4 * i + 3], 0.0F), 1.0F);
      over += through * opacity * loadFloat4(&colors[4 * i]);
      through *= 1 - opacity;
    }
    if (!closed)
    {
      over += through * this->skyAt(rays[std::size_t(pixel)]);
    }
    for (std::size_t c = 0; c < 3; ++c)
    {
      rgb[3 * std::size_t(pixel) + c] = over[c];
    }
  }
}

} // namespace dgtk
