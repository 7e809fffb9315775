// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"
#include "dgtkPortableMath.h"

#include "dgtkRayPictures.h"
#include "dgtkThreadPool.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace dgtk::test
{
namespace
{

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * ab).norm();
}
} // namespace

ModelBuilder::ModelBuilder()
  : Made(std::make_shared<Model>())
  , Rest(std::make_shared<Geometry>())
{
}

Material& ModelBuilder::part(const Material& material)
{
  Part part;
  part.name = "part";
  part.material = int(this->Made->materials.size());
  part.firstTriangle = std::uint32_t(this->Made->triangles.size());
  this->Made->parts.push_back(part);
  this->Made->materials.push_back(material);
  return this->Made->materials.back();
}

int ModelBuilder::texture(std::shared_ptr<const Image> image, const TextureWraps& wrap)
{
  Texture texture;
  texture.image = std::move(image);
  texture.wrap = wrap;
  this->Made->textures.push_back(texture);
  return int(this->Made->textures.size()) - 1;
}

void ModelBuilder::triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const auto first = std::uint32_t(this->Rest->positions.size());
  const Eigen::Vector3f normal = (b - a).cross(c - a).normalized().cast<float>();
  const Eigen::Vector3d* corners[3] = { &a, &b, &c };
  const double uvs[3][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 } };
  for (int i = 0; i < 3; ++i)
  {
    this->Rest->positions.push_back(*corners[i]);
    this->Rest->normals.push_back(normal);
    this->Made->uvs.emplace_back(uvs[i][0], uvs[i][1]);
  }
  this->Made->triangles.push_back({ first, first + 1, first + 2 });
  ++this->Made->parts.back().triangles;
}

void ModelBuilder::quad(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d, double repeat)
{
  const auto first = std::uint32_t(this->Rest->positions.size());
  const Eigen::Vector3f normal = (b - a).cross(c - a).normalized().cast<float>();
  for (const Eigen::Vector3d& x : { a, b, c, d })
  {
    this->Rest->positions.push_back(x);
    this->Rest->normals.push_back(normal);
  }
  for (const auto& uv : { Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1), Eigen::Vector2d(0, 1) })
  {
    this->Made->uvs.push_back(uv * repeat);
  }
  this->Made->triangles.push_back({ first, first + 1, first + 2 });
  this->Made->triangles.push_back({ first, first + 2, first + 3 });
  this->Made->parts.back().triangles += 2;
}

void ModelBuilder::box(const Eigen::Vector3d& l, const Eigen::Vector3d& h)
{
  const auto at = [&](int x, int y, int z)
  { return Eigen::Vector3d(x ? h.x() : l.x(), y ? h.y() : l.y(), z ? h.z() : l.z()); };
  this->quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
  this->quad(at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0));
  this->quad(at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1));
  this->quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
  this->quad(at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0));
  this->quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
}

void ModelBuilder::sphere(int steps)
{
  const auto first = std::uint32_t(this->Rest->positions.size());
  for (int i = 0; i <= steps; ++i)
  {
    for (int j = 0; j <= 2 * steps; ++j)
    {
      const double theta = pi * i / steps;
      const double phi = pi * j / steps;
      const Eigen::Vector3d x(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      this->Rest->positions.push_back(x);
      this->Rest->normals.push_back(x.cast<float>());
      this->Made->uvs.emplace_back(0.5 * j / steps, 1 - double(i) / steps);
    }
  }
  const std::uint32_t stride = 2 * std::uint32_t(steps) + 1;
  for (std::uint32_t i = 0; i < std::uint32_t(steps); ++i)
  {
    for (std::uint32_t j = 0; j + 1 < stride; ++j)
    {
      const std::uint32_t a = first + i * stride + j;
      this->Made->triangles.push_back({ a, a + stride, a + stride + 1 });
      this->Made->triangles.push_back({ a, a + stride + 1, a + 1 });
      this->Made->parts.back().triangles += 2;
    }
  }
}

std::shared_ptr<const Model> ModelBuilder::finish(bool uvs)
{
  if (!uvs)
  {
    this->Made->uvs.clear();
  }
  this->Made->rest = this->Rest;
  return this->Made;
}

Instance instanceOf(std::shared_ptr<const Model> model, const Eigen::Vector3d& at, const Eigen::Matrix3d& linear)
{
  Instance instance;
  instance.geometry = model->rest;
  instance.materials = std::shared_ptr<const std::vector<Material>>(model, &model->materials);
  instance.model = std::move(model);
  instance.world_from_object.linear = linear;
  instance.world_from_object.translation = at;
  return instance;
}

Material flat(const Eigen::Vector3d& color)
{
  Material material;
  material.emission = color;
  material.ambient.setZero();
  material.diffuse.setZero();
  return material;
}

Material matte(const Eigen::Vector3d& color)
{
  Material material;
  material.ambient.setZero();
  material.diffuse = color;
  return material;
}

View viewOf(std::shared_ptr<const CameraModel> model, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
  double near, double far)
{
  View view;
  view.name = "camera";
  view.model = std::move(model);
  view.camera_from_world = lookAtPose(eye, target, Eigen::Vector3d(0, 1, 0));
  view.near = near;
  view.far = far;
  return view;
}

PixelRect whole(const View& view) { return { 0, 0, view.model->width(), view.model->height() }; }

RayCaster::RayCaster(const SceneState& state, const View& view)
  : Seen(view)
{
  for (std::size_t o = 0; o < state.instances.size(); ++o)
  {
    const Instance& instance = state.instances[o];
    const Affine3 camera_from_object = view.camera_from_world * instance.world_from_object;
    for (std::size_t t = 0; t < instance.model->triangles.size(); ++t)
    {
      Corners corners;
      corners.hit = { std::uint32_t(o + 1), std::uint32_t(t) };
      corners.low.setConstant(1e300);
      corners.high.setConstant(-1e300);
      corners.boxed = true;
      for (std::size_t i = 0; i < 3; ++i)
      {
        corners.at[i] = camera_from_object * instance.geometry->positions[instance.model->triangles[t][i]];
        Eigen::Vector2d pixel(0, 0);
        corners.boxed = corners.boxed && corners.at[i].z() > view.near && view.model->project(corners.at[i], pixel);
        corners.low = corners.low.cwiseMin(pixel);
        corners.high = corners.high.cwiseMax(pixel);
      }
      this->Triangles.push_back(corners);
    }
  }
}

View frontView(int width, int height)
{
  return viewOf(makeOrthographic(width, height, 2, 0), { 0, 0, 10 }, { 0, 0, 0 }, 0.1, 100);
}

std::shared_ptr<SceneState> stateOf(std::vector<std::shared_ptr<const Model>> models)
{
  auto state = std::make_shared<SceneState>();
  for (auto& model : models)
  {
    state->instances.push_back(instanceOf(std::move(model)));
  }
  return state;
}

namespace
{
/// Distance of a pixel from the triangle's outline, where that is in front of the camera.
double marginOf(const View& view, const Eigen::Vector2d& pixel, const Eigen::Vector3d (&corners)[3])
{
  double margin = std::numeric_limits<double>::infinity();
  const double least = 0.5 * view.near;
  for (int i = 0; i < 3; ++i)
  {
    Eigen::Vector3d a = corners[i];
    Eigen::Vector3d b = corners[(i + 1) % 3];
    if (a.z() < least && b.z() < least)
    {
      continue;
    }
    const Eigen::Vector3d a0 = a;
    a = a.z() < least ? Eigen::Vector3d(a + (b - a) * ((least - a.z()) / (b.z() - a.z()))) : a;
    b = b.z() < least ? Eigen::Vector3d(b + (a0 - b) * ((least - b.z()) / (a0.z() - b.z()))) : b;
    Eigen::Vector2d pa;
    Eigen::Vector2d pb;
    if (view.model->project(a, pa) && view.model->project(b, pb))
    {
      margin = std::min(margin, distanceToSegment(pixel, pa, pb));
    }
  }
  return margin;
}
} // namespace

Reference RayCaster::cast(int x, int y) const
{
  const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
  const CameraRay ray = this->Seen.model->rayThrough(pixel);
  Reference best;
  best.depth = std::numeric_limits<double>::infinity();
  best.margin = std::numeric_limits<double>::infinity();
  for (const Corners& corners : this->Triangles)
  {
    if (corners.boxed &&
        ((pixel.array() < corners.low.array() - 1).any() || (pixel.array() > corners.high.array() + 1).any()))
    {
      continue;
    }
    Eigen::Matrix3d m;
    m << corners.at[1] - corners.at[0], corners.at[2] - corners.at[0], -ray.direction;
    if (std::abs(m.determinant()) < 1e-30)
    {
      continue;
    }
    const Eigen::Vector3d s = m.inverse() * (ray.origin - corners.at[0]);
    if (s.z() < this->Seen.near || s.z() > this->Seen.far)
    {
      continue;
    }
    const double margin = marginOf(this->Seen, pixel, corners.at);
    const bool inside = s.x() >= 0 && s.y() >= 0 && s.x() + s.y() <= 1;
    if (inside || margin < 0.1)
    {
      best.margin = std::min(best.margin, margin);
    }
    if (inside && s.z() < best.depth)
    {
      best.depth = s.z();
      best.hit = corners.hit;
    }
  }
  return best;
}

RasterSource& source()
{
  static std::unique_ptr<RasterSource> one = makeRasterSource();
  return *one;
}

namespace
{
bool byRays = false;
}

PictureSource& pictures()
{
  static ThreadPool pool(2);
  static const std::unique_ptr<PictureSource> rays = makeRayPictures(pool);
  return byRays ? *rays : source();
}

void usePictures(const std::string& renderer) { byRays = renderer == "ray"; }

VisibilityBuffer render(std::shared_ptr<const SceneState> state, const View& view)
{
  VisibilityBuffer hits;
  source().setScene(std::move(state), view);
  source().render(whole(view), hits);
  return hits;
}

ColorBuffer renderColor(std::shared_ptr<const SceneState> state, const View& view, int samples, VisibilityBuffer* hits)
{
  ColorBuffer colors;
  pictures().setScene(std::move(state), view);
  pictures().renderColor(whole(view), samples, colors, hits);
  return colors;
}

Eigen::Vector3d colorAt(const ColorBuffer& colors, int x, int y)
{
  const float* rgb = colors.rgb.data() + (std::size_t(y) * std::size_t(colors.rect.width) + std::size_t(x)) * 3;
  return { rgb[0], rgb[1], rgb[2] };
}

int comparedWithRays(const SceneState& state, const View& view, const VisibilityBuffer& hits, int step)
{
  int differing = 0;
  const RayCaster rays(state, view);
  for (int y = 0; y < hits.rect.height; y += step)
  {
    for (int x = 0; x < hits.rect.width; x += step)
    {
      const Reference expected = rays.cast(hits.rect.x + x, hits.rect.y + y);
      const Hit found = hits.at(hits.rect.x + x, hits.rect.y + y);
      if (found != expected.hit)
      {
        ++differing;
        EXPECT_LT(expected.margin, edgeTolerance)
          << "pixel " << x << ", " << y << ": object " << found.object << " triangle " << found.triangle
          << ", expected " << expected.hit.object << ' ' << expected.hit.triangle << " at depth " << expected.depth;
      }
    }
  }
  return differing;
}

namespace
{
void save(const std::string& name, int width, int height, const std::vector<unsigned char>& rgb)
{
  if (std::getenv("DGTK_SAVE_PICTURES"))
  {
    std::ofstream file(std::filesystem::temp_directory_path() / (name + ".ppm"), std::ios::binary);
    file << "P6\n" << width << ' ' << height << "\n255\n";
    file.write(reinterpret_cast<const char*>(rgb.data()), std::streamsize(rgb.size()));
  }
}
} // namespace

void savePicture(const std::string& name, const ColorBuffer& colors)
{
  std::vector<unsigned char> rgb;
  for (const float value : colors.rgb)
  {
    rgb.push_back(static_cast<unsigned char>(std::lround(value * 255)));
  }
  save(name, colors.rect.width, colors.rect.height, rgb);
}

void savePicture(const std::string& name, const VisibilityBuffer& hits)
{
  std::vector<unsigned char> rgb;
  for (const Hit& hit : hits.hits)
  {
    const std::uint32_t mixed = hit.object == 0 ? 0 : (hit.object * 2654435761u) ^ (hit.triangle * 40503u + 1);
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(static_cast<unsigned char>(mixed >> (8 * c)));
    }
  }
  save(name, hits.rect.width, hits.rect.height, rgb);
}

} // namespace dgtk::test
