// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace dgtk
{

namespace
{
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A seen surface point.
struct GeometryPoint
{
  const Sight& sight;
  Hit hit;
  Eigen::Vector2d pixel;
  Eigen::Vector3d x_in_camera;
};

/// Writes the expected channels and returns the residual of the found ones; negative: left open.
using Measure = double (*)(const GeometryPoint& point, const double* found, double* expected);

struct GeometryLayer
{
  const char* name;
  int channels;
  double tolerance; ///< of float64 files
  double narrow;    ///< of float32 files
  const char* unit;
  double invalid; ///< where there is no surface
  Measure measure;
};

double largest(const double* found, const double* expected, int count)
{
  double most = 0;
  for (int i = 0; i < count; ++i)
  {
    most = larger(most, std::abs(found[i] - expected[i]));
  }
  return most;
}

void put(const Eigen::Vector3d& value, double* to) { Eigen::Map<Eigen::Vector3d>(to, 3) = value; }

double distanceOf(const GeometryPoint& p, const double* found, double* expected)
{
  *expected = p.x_in_camera.norm();
  return std::abs((*found - *expected) / *expected);
}

double inverseDepthOf(const GeometryPoint& p, const double* found, double* expected)
{
  *expected = 1 / p.x_in_camera.z();
  return std::abs((*found - *expected) / *expected);
}

double positionOf(const GeometryPoint& p, const double* found, double* expected)
{
  const Eigen::Vector3d world = p.sight.eye().toWorld(p.x_in_camera);
  put(world, expected);
  return largest(found, expected, 3) /
         std::max({ world.norm(), p.x_in_camera.norm(), p.sight.eye().record().t.norm() });
}

double objectCoordinatesOf(const GeometryPoint& p, const double* found, double* expected)
{
  const Affine3& camera_from_object = p.sight.cameraFromObject(p.hit.object);
  const Eigen::Matrix3d inverse = camera_from_object.linear.inverse();
  const Eigen::Vector3d own = inverse * (p.x_in_camera - camera_from_object.translation);
  put(own, expected);
  if (!own.allFinite()) // a flattened object
  {
    return -1;
  }
  // Compared in the camera's frame, where the depth is known.
  const Eigen::Vector3d back = camera_from_object * Eigen::Vector3d(found[0], found[1], found[2]);
  return (back - p.x_in_camera).norm() / std::max(p.x_in_camera.norm(), camera_from_object.translation.norm());
}

/// Sine of the smallest angle of a triangle below which its normal has no digits to compare.
constexpr double sliverSine = 1e-6;
/// Cosine between a normal and the ray below which the side that is seen is a matter of rounding.
constexpr double leastCosine = 1e-9;
/// Length of the sum of the corners' normals below which it has no direction to compare.
constexpr double leastNormal = 1e-3;

double normalOf(const GeometryPoint& p, const double* found, double* expected)
{
  Eigen::Vector3d corner[3];
  p.sight.corners(p.hit, corner);
  const Eigen::Vector3d n = p.sight.normal(p.hit);
  const double longest = std::max({ (corner[1] - corner[0]).squaredNorm(), (corner[2] - corner[0]).squaredNorm(),
    (corner[2] - corner[1]).squaredNorm() });
  const Eigen::Vector3d unit = n.stableNormalized();
  const Eigen::Vector3d direction = p.sight.eye().ray(p.pixel).direction.normalized();
  const double cosine = unit.dot(direction);
  put(cosine > 0 ? Eigen::Vector3d(-unit) : unit, expected);
  if (!(n.norm() > sliverSine * longest) || !(std::abs(cosine) > leastCosine))
  {
    return -1;
  }
  return largest(found, expected, 3);
}

double shadingNormalOf(const GeometryPoint& p, const double* found, double* expected)
{
  const Instance& instance = p.sight.instance(p.hit.object);
  const auto& triangle = instance.model->triangles[p.hit.triangle];
  const Eigen::Vector3d weight = p.sight.weights(p.hit, p.x_in_camera);
  Eigen::Vector3d sum(0, 0, 0);
  for (int i = 0; i < 3; ++i)
  {
    sum += weight[i] * instance.geometry->normals[triangle[i]].cast<double>();
  }
  const std::vector<Eigen::Vector3d>& x = instance.geometry->positions;
  const Eigen::Vector3d front = (x[triangle[1]] - x[triangle[0]]).cross(x[triangle[2]] - x[triangle[0]]);
  const Eigen::Matrix3d turn = p.sight.cameraFromObject(p.hit.object).linear.inverse().transpose();
  const Eigen::Vector3d unit = (turn * sum).stableNormalized();
  // The triangle decides which side is seen, by the order of its corners in the model: a mirror does not turn it.
  const double cosine = (turn * front).stableNormalized().dot(p.sight.eye().ray(p.pixel).direction.normalized());
  put(cosine > 0 ? Eigen::Vector3d(-unit) : unit, expected);
  // Normals that cancel each other, a flattened object, a triangle seen from its edge.
  if (!(sum.norm() > leastNormal) || !unit.allFinite() || !(std::abs(cosine) > leastCosine))
  {
    return -1;
  }
  return largest(found, expected, 3);
}

double uvOf(const GeometryPoint& p, const double* found, double* expected)
{
  const Model& model = *p.sight.instance(p.hit.object).model;
  if (!model.hasUvs(p.hit.triangle))
  {
    expected[0] = expected[1] = nan;
    return std::isnan(found[0]) && std::isnan(found[1]) ? 0 : infinite;
  }
  const auto& triangle = model.triangles[p.hit.triangle];
  const Eigen::Vector3d weight = p.sight.weights(p.hit, p.x_in_camera);
  const Eigen::Vector2d uv =
    weight[0] * model.uvs[triangle[0]] + weight[1] * model.uvs[triangle[1]] + weight[2] * model.uvs[triangle[2]];
  expected[0] = uv.x();
  expected[1] = uv.y();
  double size = 1;
  for (const std::uint32_t corner : triangle)
  {
    size = std::max(size, model.uvs[corner].cwiseAbs().maxCoeff());
  }
  return largest(found, expected, 2) / size;
}

double barycentricsOf(const GeometryPoint& p, const double* found, double* expected)
{
  put(p.sight.weights(p.hit, p.x_in_camera), expected);
  Eigen::Vector3d corner[3];
  p.sight.corners(p.hit, corner);
  const Eigen::Vector3d point = found[0] * corner[0] + found[1] * corner[1] + found[2] * corner[2];
  const double size = std::max({ p.x_in_camera.norm(), corner[0].norm(), corner[1].norm(), corner[2].norm() });
  return larger((point - p.x_in_camera).norm() / size, std::abs(found[0] + found[1] + found[2] - 1));
}

/// Of float64 files, as of depth. Of float32 files one rounding of 6e-8, or some of several channels, which the way
/// from an object's frame to the camera's adds up.
constexpr double wide = 1e-9;
constexpr double oneRounding = 1e-7;
constexpr double someRoundings = 1e-6;

constexpr GeometryLayer layers[] = {
  { "distance", 1, wide, oneRounding, "relative", infinite, distanceOf },
  { "inversedepth", 1, wide, oneRounding, "relative", 0, inverseDepthOf },
  { "position", 3, wide, oneRounding, "relative", nan, positionOf },
  { "objectcoords", 3, wide, someRoundings, "relative", nan, objectCoordinatesOf },
  { "normal", 3, oneRounding, oneRounding, "1", nan, normalOf },
  { "shadingnormal", 3, wide, oneRounding, "1", nan, shadingNormalOf },
  { "uv", 2, wide, oneRounding, "1", nan, uvOf },
  { "barycentrics", 3, wide, someRoundings, "relative", nan, barycentricsOf },
};

bool isInvalid(const double* found, const GeometryLayer& layer)
{
  for (int i = 0; i < layer.channels; ++i)
  {
    if (!(found[i] == layer.invalid || (std::isnan(found[i]) && std::isnan(layer.invalid))))
    {
      return false;
    }
  }
  return true;
}

void checkPixel(Picture& picture, const Surfaces& surfaces, const PictureFile& file, const GeometryLayer& layer, int x,
  int y, Meter& meter)
{
  const std::size_t i = surfaces.index(x, y);
  double found[3] = { 0, 0, 0 };
  double expected[3] = { layer.invalid, layer.invalid, layer.invalid };
  for (int c = 0; c < layer.channels; ++c)
  {
    found[c] = file.at(x, y, c);
  }
  const auto where = [&]
  { return file.offender(x, y, numbersText(found, layer.channels), numbersText(expected, layer.channels)); };
  const Hit& hit = surfaces.hits[i];
  if (hit.object == 0)
  {
    meter.equal(isInvalid(found, layer), where);
    return;
  }
  const auto measure = [&](const Hit& surface)
  {
    const Eigen::Vector3d point = picture.point(x, y);
    return layer.measure({ picture.sight(x, y), surface, centreOf(x, y), point }, found, expected) /
           (layer.measure == &inverseDepthOf ? picture.eye().farness(point.z()) : picture.eye().farness(point));
  };
  double error = measure(hit);
  if (!(error <= meter.Tolerance) && meter.Bad < usualPatience)
  {
    // Beside an edge the files may show the neighbour.
    for (const Hit& neighbour : picture.nearby(x, y))
    {
      error = neighbour.object == hit.object && measure(neighbour) <= meter.Tolerance ? -1 : error;
    }
    measure(hit);
  }
  if (error < 0)
  {
    meter.skip();
    return;
  }
  meter.add(error, where);
}
} // namespace

void checkGeometry(Picture& picture, Results& results)
{
  for (const GeometryLayer& layer : layers)
  {
    for (const char* suffix : { ".npy", ".exr", ".pfm" })
    {
      const PicturePointer file = picture.image(layer.name, { suffix });
      if (!file || file->channels() != layer.channels)
      {
        continue;
      }
      picture.preparePoints();
      const Surfaces& surfaces = picture.surfaces();
      const bool narrow = file->type() == PixelType::Float32;
      const Meter meter = meterRows(picture.pool(), picture.height(), narrow ? layer.narrow : layer.tolerance,
        [&](int y, Meter& row)
        {
          for (int x = 0; x < picture.width(); ++x)
          {
            checkPixel(picture, surfaces, *file, layer, x, y, row);
          }
        });
      const std::string name = std::string(layer.name) + (narrow && layer.narrow != layer.tolerance ? suffix : "");
      results.add({ name, layer.unit, { file->file() } }, meter);
    }
  }
}

} // namespace dgtk
