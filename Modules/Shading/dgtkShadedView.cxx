// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadedView.h"

#include "dgtkColorMap.h"
#include "dgtkRaySource.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
Float4 tintOf(const std::array<std::uint8_t, 4>& color)
{
  const Float4 bytes = { float(color[0]), float(color[1]), float(color[2]), float(color[3]) };
  return bytes * (1 / 255.0F);
}
} // namespace

ShadedView::ShadedView(std::shared_ptr<const SceneState> state, const View& view)
  : State(std::move(state))
  , TheView(view)
  , Pinhole(view.model->linear() && view.model->linear()->perspective)
  , Light(*this->State, view)
{
  for (const Instance& instance : this->State->instances)
  {
    Placed placed;
    placed.materials = ShadedMaterialLibrary::shared().of(instance);
    placed.camera_from_object = view.camera_from_world * instance.world_from_object;
    placed.side = placed.camera_from_object.linear.determinant() < 0 ? -1 : 1;
    placed.normals = Matrix3(normalMatrix(placed.camera_from_object.linear));
    this->Translucent = this->Translucent || (instance.visible && placed.materials->translucent);
    this->Objects.push_back(std::move(placed));
  }
  if (this->Light.castsShadows())
  {
    this->Shadows = makeShadowQuery(this->State, view.camera_from_world);
  }
}

void ShadedView::prepare(const Hit& hit, const RayDifferentials& rays, Triangle& triangle) const
{
  const Instance& instance = this->State->instances[hit.object - 1];
  const Placed& placed = this->Objects[hit.object - 1];
  const Model& model = *instance.model;
  const Geometry& geometry = *instance.geometry;
  const auto& corners = model.triangles[hit.triangle];
  const Eigen::Vector3d a = placed.camera_from_object * geometry.positions[corners[0]];
  const Eigen::Vector3d ab = placed.camera_from_object * geometry.positions[corners[1]] - a;
  const Eigen::Vector3d ac = placed.camera_from_object * geometry.positions[corners[2]] - a;
  triangle.hit = hit;
  triangle.material = &placed.materials->of(hit.triangle);
  triangle.side = placed.side;
  triangle.corner = a;
  triangle.normal = ab.cross(ac);
  const double area = triangle.normal.squaredNorm();
  const double perArea = area > 0 ? 1 / area : 0.0;
  triangle.plane.row(0) = ac.cross(triangle.normal) * perArea;
  triangle.plane.row(1) = triangle.normal.cross(ab) * perArea;
  if (this->Pinhole)
  {
    triangle.toCorner = triangle.across(a);
    triangle.toRight = triangle.across(rays.right().direction);
    triangle.toBelow = triangle.across(rays.down().direction);
  }
  Float4 normals[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    normals[i] = placed.normals * toFloat4(geometry.normals[corners[i]]);
  }
  triangle.shading = normals[0];
  triangle.shadingSecond = normals[1] - normals[0];
  triangle.shadingThird = normals[2] - normals[0];
  if (triangle.material->mapped)
  {
    triangle.uv = model.uvs[corners[0]];
    triangle.uvMore.col(0) = model.uvs[corners[1]] - triangle.uv;
    triangle.uvMore.col(1) = model.uvs[corners[2]] - triangle.uv;
  }
  prepareTint(model, corners, triangle);
  if (this->Shadows)
  {
    const Float4 more[3] = { float4(0), triangle.shadingSecond, triangle.shadingThird };
    for (std::size_t i = 0; i < 3; ++i)
    {
      triangle.corners[i] = placed.camera_from_object * geometry.positions[corners[i]];
      triangle.tangents[i] = toVector3d(normalized(triangle.shading + more[i]));
    }
    triangle.outward = triangle.normal.normalized();
  }
}

void ShadedView::prepareTint(const Model& model, const std::array<std::uint32_t, 3>& corners, Triangle& triangle)
{
  triangle.tint = float4(1);
  triangle.tintSecond = triangle.tintThird = float4(0);
  triangle.map = nullptr;
  if (!model.colors.empty())
  {
    triangle.tint = dgtk::tintOf(model.colors[corners[0]]);
    triangle.tintSecond = dgtk::tintOf(model.colors[corners[1]]) - triangle.tint;
    triangle.tintThird = dgtk::tintOf(model.colors[corners[2]]) - triangle.tint;
  }
  else if (model.colorMap)
  {
    triangle.map = &model;
    triangle.mapAt = model.colorMapAt[corners[0]];
    triangle.mapSecond = model.colorMapAt[corners[1]] - triangle.mapAt;
    triangle.mapThird = model.colorMapAt[corners[2]] - triangle.mapAt;
  }
}

Float4 ShadedView::tintOf(const Triangle& triangle, double second, double third)
{
  if (triangle.map == nullptr)
  {
    return triangle.tint + triangle.tintSecond * float(second) + triangle.tintThird * float(third);
  }
  const Eigen::Vector2d at = triangle.mapAt + second * triangle.mapSecond + third * triangle.mapThird;
  return dgtk::tintOf(colorMapTexel(*triangle.map->colorMap, at));
}

void ShadedView::place(const PixelRay& ray, const Triangle& triangle, ShadedPoint& point) const
{
  const CameraRay& own = *ray.own;
  const Across d = triangle.across(own.direction);
  const Across from = this->Pinhole ? triangle.toCorner : triangle.across(triangle.corner - own.origin);
  const double perOff = d.off != 0 ? 1 / d.off : 0.0;
  const double t = from.off * perOff;
  const Eigen::Vector3d position = own.origin + t * own.direction;
  const Eigen::Vector2d inside = t * d.along - from.along;
  const double second = inside.x();
  const double third = inside.y();
  const bool front = d.off * triangle.side < 0;
  const ShadedMaterial& material = *triangle.material;

  point.object = triangle.hit.object;
  point.material = &material;
  point.position = toFloat4(position);
  point.viewer = float4(0);
  if (this->Light.needsViewer(material))
  {
    const double length = own.direction.norm();
    point.viewer = toFloat4(own.direction * (-1 / length));
    point.distance = float(t * length);
  }
  const Float4 normal =
    normalized(triangle.shading + triangle.shadingSecond * float(second) + triangle.shadingThird * float(third));
  point.normal = normal;
  point.tint = tintOf(triangle, second, third);
  if (this->Shadows)
  {
    const double parts[3] = { 1 - second - third, second, third };
    lift(triangle, position, parts, front, point);
  }
  if (material.mapped)
  {
    // Along the triangle's plane: what leads off it is taken back along the ray.
    const auto footprint = [&](const Across& fixed, const CameraRay& by) -> Eigen::Vector2d
    {
      Across to{ t * fixed.off, t * fixed.along };
      if (!this->Pinhole)
      {
        to = triangle.across(by.origin + t * by.direction);
      }
      return triangle.uvMore * (to.along - to.off * perOff * d.along);
    };
    const Eigen::Vector2d uv = triangle.uv + triangle.uvMore * inside;
    const Eigen::Vector2d right = footprint(triangle.toRight, *ray.right);
    const Eigen::Vector2d down = footprint(triangle.toBelow, *ray.down);
    point.footprint = { uv.x(), uv.y(), float(right.x()), float(right.y()), float(down.x()), float(down.y()) };
    if (turnsNormals(material))
    {
      const auto moved = [&](const CameraRay& by)
      {
        const Eigen::Vector3d across = by.origin + t * by.direction;
        return toFloat4(Eigen::Vector3d(across - triangle.normal.dot(across) * perOff * own.direction));
      };
      point.right = moved(*ray.right);
      point.down = moved(*ray.down);
      turnNormal(point);
    }
  }
  point.normal = front ? point.normal : -point.normal;
}

/// Off the flat triangle to where the corners' tangent planes are: shadows end where smooth shading does (Hanika 2021,
/// Hacking the Shadow Terminator).
void ShadedView::lift(
  const Triangle& triangle, const Eigen::Vector3d& position, const double parts[3], bool front, ShadedPoint& point)
{
  const double towards = front == (triangle.side > 0) ? 1 : -1; // of the flat normal, to the side that is seen
  point.outward = triangle.outward * towards;
  point.lifted = position;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d tangent = triangle.tangents[i] * (front ? 1.0 : -1.0);
    const Eigen::Vector3d above = position - triangle.corners[i];
    point.lifted -= parts[i] * std::min(0.0, above.dot(tangent)) * tangent;
  }
}

void ShadedView::findShadows(const ShadedPoint* points, std::size_t count, LightLanes* lit) const
{
  const std::size_t lights = this->Light.lights();
  for (std::size_t light = 0; light < lights; ++light)
  {
    if (!this->Light.castsShadows(light))
    {
      continue;
    }
    LightLanes& own = lit[light];
    LightPath paths[lanes];
    std::size_t ofPath[lanes];
    std::size_t asked = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (of(own.cosine, i) > 0 && of(own.strength, i) > 0)
      {
        const ShadedPoint& p = points[i];
        const Eigen::Vector3d toLight = toVector3d(own.toLightOf(i));
        const double off = this->Shadows->precision(p.object, double(p.distance));
        paths[asked] = { p.lifted + off * p.outward, toLight, this->Light.distanceTo(light, p.lifted) - off };
        ofPath[asked++] = i;
      }
    }
    const unsigned int blocked = asked > 0 ? this->Shadows->blocked(paths, asked) : 0;
    for (std::size_t k = 0; k < asked; ++k)
    {
      own.lit[ofPath[k] / 4][ofPath[k] % 4] = (blocked >> k & 1U) != 0 ? 0.0F : 1.0F;
    }
  }
}

void ShadedView::shadeRow(
  Worker& worker, int x, int y, int count, const std::vector<Surface>& surfaces, float* rgba) const
{
  this->shade(worker, worker.Rays.row(y, x, count), surfaces.data(), surfaces.size(),
    [rgba](std::size_t i, Float4 color) { std::memcpy(rgba + 4 * i, &color, sizeof color); });
}

template <typename Sink>
void ShadedView::shade(
  Worker& worker, const std::vector<PixelRay>& rays, const Surface* surfaces, std::size_t count, const Sink& sink) const
{
  const std::size_t lights = this->Light.lights();
  ShadedPoint points[lanes];
  LightLanes* const lit = worker.Lit.data();
  for (std::size_t first = 0; first < count; first += lanes)
  {
    const std::size_t many = std::min(count - first, lanes);
    for (std::size_t i = 0; i < many; ++i)
    {
      const Surface& surface = surfaces[first + i];
      this->place(rays[std::size_t(surface.pixel)], worker.triangle(*this, surface.hit), points[i]);
    }
    lookUp(points, many);
    const PointLanes together(points, many);
    for (std::size_t light = 0; light < lights; ++light)
    {
      this->Light.light(light, together, lit[light]);
    }
    if (this->Shadows)
    {
      this->findShadows(points, many, lit);
    }
    for (std::size_t i = 0; i < many; ++i)
    {
      Float4 color = atLeast(this->Light.shade(points[i], lit, i), 0);
      color[3] = points[i].material->opacity * points[i].tint[3];
      sink(first + i, color);
    }
  }
}

Float4 ShadedView::skyAt(const PixelRay& ray) const
{
  if (!this->Light.seesEnvironment())
  {
    return this->Light.background();
  }
  const Eigen::Vector3d& d = ray.own->direction;
  const double square = d.squaredNorm();
  const double angle = std::sqrt(d.cross(ray.right->direction).norm() * d.cross(ray.down->direction).norm()) / square;
  return this->Light.sky(toFloat4(d / std::sqrt(square)), float(angle));
}

void ShadedView::row(Worker& worker, int x, int y, int count, const Hit* hits, float* rgb) const
{
  const std::vector<PixelRay>& rays = worker.Rays.row(y, x, count);
  const auto put = [rgb](int pixel, Float4 color)
  {
    float* const to = rgb + 3 * std::size_t(pixel);
    to[0] = color[0];
    to[1] = color[1];
    to[2] = color[2];
  };
  std::vector<Surface>& surfaces = worker.Surfaces;
  surfaces.resize(std::max(surfaces.size(), std::size_t(count)));
  std::size_t seen = 0;
  worker.Translucent.clear();
  for (int i = 0; i < count; ++i)
  {
    if (hits[i].object == 0)
    {
      const PixelRay& ray = rays[std::size_t(i)];
      put(i, ray.own->exists() ? this->skyAt(ray) : float4(0)); // no light comes to where the lens does not reach
    }
    else if (this->Translucent && !this->isOpaque(hits[i]))
    {
      worker.Translucent.push_back(i);
    }
    else
    {
      surfaces[seen].pixel = i; // member by member: what is read is what was written
      surfaces[seen++].hit = hits[i];
    }
  }
  this->shade(worker, rays, surfaces.data(), seen, [&](std::size_t i, Float4 color) { put(surfaces[i].pixel, color); });
  if (!worker.Translucent.empty())
  {
    this->seeThrough(worker, x, y, rays, rgb);
  }
}

void ShadedView::allHits(const std::vector<Eigen::Vector2d>& pixels, std::vector<Hit>* hits) const
{
  std::call_once(this->QueryMade,
    [this]
    {
      this->Query = makeOcclusionQuery();
      this->Query->setScene(this->State);
    });
  this->Query->allHits(this->TheView, pixels.data(), pixels.size(), hits);
}

/// Light as it is blended.
Float4 ShadedView::blended(Float4 color) const
{
  const Float4 light = atLeast(color, 0);
  return this->State->cutsAtWhite ? 1 - atLeast(1 - light, 0) : light;
}

/// Surfaces in order, nearest first, until one is opaque.
void ShadedView::seeThrough(Worker& worker, int x, int y, const std::vector<PixelRay>& rays, float* rgb) const
{
  std::vector<Surface>& surfaces = worker.Behind;
  worker.SeenThrough.clear();
  for (const int pixel : worker.Translucent)
  {
    worker.SeenThrough.emplace_back(x + pixel + 0.5, y + 0.5);
  }
  worker.Hits.resize(std::max(worker.Hits.size(), worker.SeenThrough.size()));
  this->allHits(worker.SeenThrough, worker.Hits.data());
  for (std::size_t k = 0; k < worker.Translucent.size(); ++k)
  {
    const int pixel = worker.Translucent[k];
    const std::vector<Hit>& hits = worker.Hits[k];
    surfaces.clear();
    bool closed = false;
    for (std::size_t i = 0; i < hits.size() && !closed; ++i)
    {
      surfaces.push_back({ pixel, hits[i] });
      closed = this->isOpaque(hits[i]);
    }
    Float4 over = float4(0);
    float through = 1;
    this->shade(worker, rays, surfaces.data(), surfaces.size(),
      [&](std::size_t, Float4 color)
      {
        const float opacity = std::min(std::max(color[3], 0.0F), 1.0F);
        over += through * opacity * this->blended(color);
        through *= 1 - opacity;
      });
    if (!closed)
    {
      over += through * this->blended(this->skyAt(rays[std::size_t(pixel)]));
    }
    for (std::size_t c = 0; c < 3; ++c)
    {
      rgb[3 * std::size_t(pixel) + c] = over[c];
    }
  }
}

} // namespace dgtk
