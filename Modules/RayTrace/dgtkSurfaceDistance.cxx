// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceDistance.h"

#include "dgtkRayMesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dgtk
{

namespace
{
double distanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const Eigen::Vector3d along = b - a;
  const double length2 = along.dot(along);
  const double u = length2 > 0 ? std::clamp(along.dot(x - a) / length2, 0.0, 1.0) : 0;
  return (x - a - u * along).norm();
}

/// One instance and the best of its triangles so far.
struct Search
{
  const Instance* instance;
  const RayMesh* mesh;
  Eigen::Vector3d x_in_world;
  double perUnit; ///< at least so much distance in the world has one of the mesh
  double best;
};

/// In the mesh, a little more than `best` in the world.
float radiusOf(const Search& search, const Eigen::Vector3d& x_in_mesh)
{
  const double size = x_in_mesh.cwiseAbs().maxCoeff() + double(search.mesh->radius);
  const double radius = search.best / search.perUnit * (1 + 1e-5) + 1e-5 * size;
  return radius < 1e30 ? float(radius) : std::numeric_limits<float>::infinity();
}

/// That no point of the triangle is nearer than `best`, from one corner and the longest side there: of most triangles.
bool isFarther(const Eigen::Vector3d& x, const std::array<Eigen::Vector3d, 3>& corners, double best)
{
  constexpr double slack = 1 + 1e-9;
  const double side =
    std::sqrt(std::max((corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[0]).squaredNorm()));
  const double reach = (best + side) * slack;
  return (x - corners[0]).squaredNorm() > reach * reach;
}

bool visit(RTCPointQueryFunctionArguments* arguments)
{
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const std::uint32_t triangle = search.mesh->firstTriangle[arguments->geomID] + arguments->primID;
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    corners[i] = search.instance->world_from_object *
                 search.instance->geometry->positions[search.instance->model->triangles[triangle][i]];
  }
  if (isFarther(search.x_in_world, corners, search.best))
  {
    return false;
  }
  const double distance = distanceToTriangle(search.x_in_world, corners);
  if (!(distance < search.best))
  {
    return false;
  }
  search.best = distance;
  arguments->query->radius =
    radiusOf(search, Eigen::Vector3d(arguments->query->x, arguments->query->y, arguments->query->z));
  return true;
}
} // namespace

double distanceToTriangle(const Eigen::Vector3d& x, const std::array<Eigen::Vector3d, 3>& corners)
{
  const auto& [a, b, c] = corners;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area2 = normal.dot(normal);
  const auto isInside = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q)
  { return (q - p).cross(x - p).dot(normal) >= 0; };
  if (area2 > 0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
  {
    return std::abs((x - a).dot(normal)) / std::sqrt(area2);
  }
  return std::min({ distanceToSegment(x, a, b), distanceToSegment(x, b, c), distanceToSegment(x, c, a) });
}

struct SurfaceDistance::Impl
{
  struct Placed
  {
    const Instance* instance = nullptr;
    std::shared_ptr<const RayMesh> mesh;
    Eigen::Matrix3d mesh_from_world;
    Eigen::Vector3d centre_in_world;
    double perUnit = 1;
  };
  std::shared_ptr<const SceneState> state;
  std::shared_ptr<RayDevice> device;
  std::vector<Placed> placed;
};

SurfaceDistance::SurfaceDistance(std::shared_ptr<const SceneState> state)
  : Self(std::make_unique<Impl>())
{
  this->Self->state = std::move(state);
  this->Self->device = RayDevice::shared();
  const std::vector<Instance>& instances = this->Self->state->instances;
  std::vector<std::shared_ptr<const RayMesh>> meshes = this->Self->device->meshes(instances, true);
  for (std::size_t i = 0; i < instances.size(); ++i)
  {
    if (!meshes[i]) // nothing of it is there
    {
      continue;
    }
    Impl::Placed one;
    one.instance = &instances[i];
    one.mesh = std::move(meshes[i]);
    one.centre_in_world = instances[i].world_from_object * one.mesh->centre;
    one.mesh_from_world.setIdentity();
    if (!one.mesh->baked)
    {
      const Eigen::Matrix3d& linear = instances[i].world_from_object.linear;
      one.mesh_from_world = linear.inverse();
      one.perUnit = 1 / one.mesh_from_world.norm(); // not above its smallest singular value
    }
    this->Self->placed.push_back(std::move(one));
  }
}

SurfaceDistance::~SurfaceDistance() = default;

double SurfaceDistance::at(const Eigen::Vector3d& x_in_world) const
{
  double best = std::numeric_limits<double>::infinity();
  for (const Impl::Placed& one : this->Self->placed)
  {
    Search search{ one.instance, one.mesh.get(), x_in_world, one.perUnit, best };
    const Eigen::Vector3d x = one.mesh_from_world * (x_in_world - one.centre_in_world);
    RTCPointQuery query;
    query.x = float(x.x());
    query.y = float(x.y());
    query.z = float(x.z());
    query.time = 0;
    query.radius = radiusOf(search, x);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    embree().PointQuery(one.mesh->scene, &query, &context, &visit, &search);
    best = search.best;
  }
  return best;
}

} // namespace dgtk
