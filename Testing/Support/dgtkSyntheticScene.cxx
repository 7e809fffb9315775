// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSyntheticScene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace dgtk::test
{

namespace
{
constexpr double pi = 3.14159265358979323846;
using Point = std::array<long double, 3>;

double uniform(std::mt19937_64& random) { return double(random() >> 11) * 0x1p-53; }

/// A grid of (columns + 1) x (rows + 1) vertices, two triangles a cell.
template <typename Position>
std::shared_ptr<Model> makeGrid(int columns, int rows, const Position& position)
{
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  for (int r = 0; r <= rows; ++r)
  {
    for (int c = 0; c <= columns; ++c)
    {
      geometry->positions.push_back(position(c, r));
      model->uvs.emplace_back(double(c) / columns, double(r) / rows);
    }
  }
  const auto vertex = [&](int c, int r) { return std::uint32_t(r * (columns + 1) + c); };
  for (int r = 0; r < rows; ++r)
  {
    for (int c = 0; c < columns; ++c)
    {
      model->triangles.push_back({ vertex(c, r), vertex(c + 1, r), vertex(c + 1, r + 1) });
      model->triangles.push_back({ vertex(c, r), vertex(c + 1, r + 1), vertex(c, r + 1) });
    }
  }
  model->rest = geometry;
  return model;
}

std::shared_ptr<Model> finish(std::shared_ptr<Model> model)
{
  auto geometry = std::make_shared<Geometry>(*model->rest);
  geometry->normals.assign(geometry->positions.size(), Eigen::Vector3f(0, 0, 1));
  model->rest = geometry;
  model->format = "synthetic";
  model->materials.resize(1);
  model->parts = { Part{ "all", 0, 0, std::uint32_t(model->triangles.size()) } };
  model->sourceVertices = geometry->positions.size();
  for (std::uint32_t i = 0; i < geometry->positions.size(); ++i)
  {
    model->sourceVertex.push_back(i);
  }
  model->boundsMin.setConstant(std::numeric_limits<double>::infinity());
  model->boundsMax = -model->boundsMin;
  for (const Eigen::Vector3d& position : geometry->positions)
  {
    model->boundsMin = model->boundsMin.cwiseMin(position);
    model->boundsMax = model->boundsMax.cwiseMax(position);
  }
  return model;
}

Point transform(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, const Point& x)
{
  Point out;
  for (int i = 0; i < 3; ++i)
  {
    out[i] = translation[i];
    for (int j = 0; j < 3; ++j)
    {
      out[i] += static_cast<long double>(linear(i, j)) * x[j];
    }
  }
  return out;
}

void cornersInCamera(const SceneState& state, const View& view, const Hit& hit, Point corners[3])
{
  const Instance& instance = state.instances[hit.object - 1];
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& p = instance.geometry->positions[instance.model->triangles[hit.triangle][i]];
    const Affine3& world_from_object = instance.world_from_object;
    corners[i] = transform(view.camera_from_world.rotation, view.camera_from_world.translation,
      transform(world_from_object.linear, world_from_object.translation, { p.x(), p.y(), p.z() }));
  }
}

Point cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
long double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return { a[0] - b[0], a[1] - b[1], a[2] - b[2] }; }

/// The ray's parameter at a triangle (Moeller and Trumbore 1997), or -1.
long double meet(const Point corners[3], const CameraRay& ray, Eigen::Vector2d& barycentrics)
{
  const Point direction = { ray.direction.x(), ray.direction.y(), ray.direction.z() };
  const Point origin = { ray.origin.x(), ray.origin.y(), ray.origin.z() };
  const Point e1 = minus(corners[1], corners[0]);
  const Point e2 = minus(corners[2], corners[0]);
  const Point p = cross(direction, e2);
  const long double determinant = dot(e1, p);
  const Point s = minus(origin, corners[0]);
  const Point q = cross(s, e1);
  const long double u = dot(s, p) / determinant;
  const long double v = dot(direction, q) / determinant;
  barycentrics = { double(u), double(v) };
  return determinant != 0 && u >= 0 && v >= 0 && u + v <= 1 ? dot(e2, q) / determinant : -1;
}

/// Pixels of `rect` that a triangle can touch, a margin included.
PixelRect touched(const View& view, const Point corners[3], const PixelRect& rect)
{
  double low[2] = { 1e9, 1e9 };
  double high[2] = { -1e9, -1e9 };
  for (int i = 0; i < 3; ++i)
  {
    Eigen::Vector2d pixel;
    if (!view.model->linear() || corners[i][2] < 1e-3L * view.near ||
        !view.model->project({ double(corners[i][0]), double(corners[i][1]), double(corners[i][2]) }, pixel))
    {
      return rect;
    }
    for (int k = 0; k < 2; ++k)
    {
      low[k] = std::min(low[k], std::max(pixel[k], -1e8));
      high[k] = std::max(high[k], std::min(pixel[k], 1e8));
    }
  }
  const int x = std::max(rect.x, int(std::floor(low[0])) - 1);
  const int y = std::max(rect.y, int(std::floor(low[1])) - 1);
  return { x, y, std::max(0, std::min(rect.x + rect.width, int(high[0]) + 2) - x),
    std::max(0, std::min(rect.y + rect.height, int(high[1]) + 2) - y) };
}

class Unsaid final : public CameraModel
{
public:
  explicit Unsaid(std::shared_ptr<const CameraModel> inner)
    : CameraModel(inner->width(), inner->height())
    , Inner(std::move(inner))
  {
  }
  std::string name() const override { return "unsaid"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override { return this->Inner->rayThrough(pixel); }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    return this->Inner->project(x, pixel);
  }

private:
  std::shared_ptr<const CameraModel> Inner;
};

} // namespace

std::shared_ptr<Model> makeQuad(const QuadOptions& options)
{
  return finish(makeGrid(options.cellsU, options.cellsV,
    [&](int c, int r) -> Eigen::Vector3d {
      return options.corner + double(c) / options.cellsU * options.sideU + double(r) / options.cellsV * options.sideV;
    }));
}

std::shared_ptr<Model> makeSphere(const SphereOptions& options)
{
  auto model = makeGrid(options.segments, options.rings,
    [&](int c, int r) -> Eigen::Vector3d
    {
      const double polar = pi * r / options.rings;
      const double around = 2 * pi * (c % options.segments) / options.segments;
      const double ring = r % options.rings == 0 ? 0 : std::sin(polar);
      return options.centre +
             options.radius * Eigen::Vector3d(ring * std::cos(around), -std::cos(polar), -ring * std::sin(around));
    });
  const auto& positions = model->rest->positions;
  const auto last = std::remove_if(model->triangles.begin(), model->triangles.end(),
    [&](const std::array<std::uint32_t, 3>& t)
    {
      return positions[t[0]] == positions[t[1]] || positions[t[1]] == positions[t[2]] ||
             positions[t[2]] == positions[t[0]];
    });
  model->triangles.erase(last, model->triangles.end());
  return finish(model);
}

std::shared_ptr<Model> makeBox(const BoxOptions& options)
{
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const std::uint32_t first = std::uint32_t(geometry->positions.size());
      for (int k = 0; k < 4; ++k)
      {
        const bool farU = k == 1 || k == 2, farV = k >= 2;
        Eigen::Vector3d p;
        p[axis] = side ? options.max[axis] : options.min[axis];
        p[u] = farU ? options.max[u] : options.min[u];
        p[v] = farV ? options.max[v] : options.min[v];
        geometry->positions.push_back(p);
        model->uvs.emplace_back(farU, farV);
      }
      const std::uint32_t second = side ? 1 : 2, third = side ? 2 : 1;
      model->triangles.push_back({ first, first + second, first + third });
      model->triangles.push_back({ first, first + (side ? 2 : 3), first + (side ? 3 : 2) });
    }
  }
  model->rest = geometry;
  return finish(model);
}

std::shared_ptr<Model> makeTerrain(const TerrainOptions& options)
{
  std::mt19937_64 random(options.seed);
  return finish(makeGrid(options.cells, options.cells,
    [&](int c, int r)
    {
      return Eigen::Vector3d((double(c) / options.cells - 0.5) * options.size, uniform(random) * options.height,
        (0.5 - double(r) / options.cells) * options.size);
    }));
}

std::shared_ptr<Model> makeSoup(const SoupOptions& options)
{
  std::mt19937_64 random(options.seed);
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  const auto cube = [&](double extent)
  {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Eigen::Vector3d((2 * x - 1) * extent, (2 * y - 1) * extent, (2 * z - 1) * extent);
  };
  for (int i = 0; i < options.triangles; ++i)
  {
    const Eigen::Vector3d centre = cube(options.extent);
    const std::uint32_t first = std::uint32_t(3 * i);
    for (int k = 0; k < 3; ++k)
    {
      geometry->positions.push_back(centre + cube(options.size));
      model->uvs.emplace_back(k == 1, k == 2);
    }
    model->triangles.push_back({ first, first + 1, first + 2 });
  }
  model->rest = geometry;
  return finish(model);
}

void addCutOut(Model& model, int size, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  auto image = std::make_shared<Image>();
  image->width = image->height = size;
  image->hasAlpha = true;
  for (int i = 0; i < size * size; ++i)
  {
    const std::uint64_t bits = random();
    for (int k = 0; k < 4; ++k)
    {
      image->rgba.push_back(std::uint8_t(bits >> (8 * k)));
    }
  }
  Texture texture;
  texture.name = "random";
  texture.image = image;
  model.textures = { texture };
  model.materials[0].texture = 0;
  model.materials[0].cutOut = true;
}

SceneBuilder& SceneBuilder::add(
  std::shared_ptr<const Model> model, const Affine3& world_from_object, const std::string& name)
{
  Instance instance;
  instance.name = name.empty() ? "object" + std::to_string(this->State.instances.size() + 1) : name;
  instance.geometry = model->rest;
  instance.materials = std::shared_ptr<const std::vector<Material>>(model, &model->materials);
  instance.world_from_object = world_from_object;
  instance.model = std::move(model);
  this->State.instances.push_back(std::move(instance));
  return *this;
}

Affine3 placement(const Eigen::Vector3d& translation, double scale, const Eigen::Vector3d& axis, double angle)
{
  return { scale * Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), translation };
}

View makeView(const ViewOptions& options)
{
  View view;
  view.name = "camera";
  view.model = makePinholeFromFov(options.width, options.height, options.fovY, 0);
  view.camera_from_world = lookAtPose(options.eye, options.lookAt, options.up);
  view.near = options.near;
  view.far = options.far;
  return view;
}

std::shared_ptr<const CameraModel> hideLinear(std::shared_ptr<const CameraModel> model)
{
  return std::make_shared<Unsaid>(std::move(model));
}

namespace
{
class Equidistant final : public CameraModel
{
public:
  Equidistant(int width, int height, double pixelsPerRadian)
    : CameraModel(width, height)
    , Focal(pixelsPerRadian)
    , Middle(width / 2.0, height / 2.0)
  {
  }
  std::string name() const override { return "equidistant"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = (pixel - this->Middle) / this->Focal;
    const double angle = p.norm();
    const double across = angle > 0 ? std::sin(angle) / angle : 1;
    return { { 0, 0, 0 }, { across * p.x(), across * p.y(), std::cos(angle) } };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double across = std::hypot(x.x(), x.y());
    if (across == 0 && !(x.z() > 0))
    {
      return false;
    }
    pixel = this->Middle;
    pixel += across > 0 ? Eigen::Vector2d(this->Focal * std::atan2(across, x.z()) / across * x.head<2>())
                        : Eigen::Vector2d(0, 0);
    return true;
  }

private:
  double Focal;
  Eigen::Vector2d Middle;
};
} // namespace

std::shared_ptr<const CameraModel> makeEquidistant(int width, int height, double pixelsPerRadian)
{
  return std::make_shared<Equidistant>(width, height, pixelsPerRadian);
}

VisibilityBuffer bruteForce(const SceneState& state, const View& view, const PixelRect& rect)
{
  constexpr long double same = 1e-12L;
  VisibilityBuffer buffer;
  buffer.resize(rect);
  std::vector<CameraRay> rays;
  for (int y = 0; y < rect.height; ++y)
  {
    for (int x = 0; x < rect.width; ++x)
    {
      rays.push_back(view.model->rayThrough({ rect.x + x + 0.5, rect.y + y + 0.5 }));
    }
  }
  std::vector<long double> nearest(rays.size(), std::numeric_limits<long double>::infinity());
  for (Hit hit{ 1, 0 }; hit.object <= state.instances.size(); ++hit.object)
  {
    const Instance& instance = state.instances[hit.object - 1];
    for (hit.triangle = 0; hit.triangle < instance.model->triangles.size(); ++hit.triangle)
    {
      Point corners[3];
      cornersInCamera(state, view, hit, corners);
      const PixelRect box = touched(view, corners, rect);
      for (int y = box.y; y < box.y + box.height; ++y)
      {
        for (int x = box.x; x < box.x + box.width; ++x)
        {
          const std::size_t index = std::size_t(y - rect.y) * rect.width + (x - rect.x);
          Eigen::Vector2d barycentrics;
          const CameraRay& ray = rays[index];
          const long double t = meet(corners, ray, barycentrics);
          const double depth = ray.origin.z() + double(t) * ray.direction.z();
          if (t > 0 && depth >= view.near && depth <= view.far && t < nearest[index] * (1 - same) &&
              !isCutOut(instance, hit.triangle, barycentrics))
          {
            nearest[index] = t;
            buffer.hits[index] = hit;
          }
        }
      }
    }
  }
  return buffer;
}

VisibilityBuffer bruteForce(const SceneState& state, const View& view)
{
  return bruteForce(state, view, { 0, 0, view.model->width(), view.model->height() });
}

double edgeDistance(const SceneState& state, const View& view, const Hit& hit, const Eigen::Vector2d& pixel)
{
  Point corners[3];
  cornersInCamera(state, view, hit, corners);
  const long double clip = 1e-6L * view.near;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    Point a = corners[i];
    Point b = corners[(i + 1) % 3];
    if (a[2] > b[2])
    {
      std::swap(a, b);
    }
    if (b[2] <= clip)
    {
      continue;
    }
    if (a[2] < clip)
    {
      const long double s = (clip - a[2]) / (b[2] - a[2]);
      a = { a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), clip };
    }
    Eigen::Vector2d p, q;
    if (view.model->project({ double(a[0]), double(a[1]), double(a[2]) }, p) &&
        view.model->project({ double(b[0]), double(b[1]), double(b[2]) }, q))
    {
      const Eigen::Vector2d along = q - p;
      const double length = along.squaredNorm();
      const double s = length > 0 ? std::min(1.0, std::max(0.0, (pixel - p).dot(along) / length)) : 0;
      least = std::min(least, (p + s * along - pixel).norm());
    }
  }
  return least;
}

} // namespace dgtk::test
