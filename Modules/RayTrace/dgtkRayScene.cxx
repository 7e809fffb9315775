// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayScene.h"

#include "dgtkSurfaceRows.h"
#include "dgtkWorkTime.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
/// Whether Embree can invert the matrix of an instance in single precision, and intersect triangles of such sizes.
bool fitsSingle(const Eigen::Matrix3d& linear, double reach, double sizes, double radius)
{
  const double determinant = std::abs(linear.determinant());
  const double volume = sizes * radius * radius;
  return determinant > 1e-35 && determinant < 1e35 && reach < 1e17 && (volume == 0 || volume > 1e-30) && volume < 1e36;
}

} // namespace

RayScene::RayScene(std::shared_ptr<RayDevice> device, bool bare)
  : Device(std::move(device))
  , Bare(bare)
{
  this->makeScene();
}

void RayScene::makeScene()
{
  this->Scene = embree().NewScene(this->Device->handle());
  this->Device->check();
  embree().SetSceneFlags(
    this->Scene, this->Bare ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  embree().SetSceneBuildQuality(this->Scene, RTC_BUILD_QUALITY_MEDIUM);
}

RayScene::~RayScene()
{
  for (const Placed& placed : this->Instances)
  {
    if (placed.geometry)
    {
      embree().ReleaseGeometry(placed.geometry);
    }
  }
  if (this->Scene)
  {
    embree().ReleaseScene(this->Scene);
  }
}

void RayScene::place(std::shared_ptr<const SceneState> state, const Rigid3& camera_from_world)
{
  const WorkTime build(WorkStage::Build);
  if (!this->Scene) // memory was missing for it
  {
    this->State = nullptr;
    this->Instances.clear(); // as the scene, they stay with Embree
    this->makeScene();
  }
  const bool newState = state != this->State;
  if (!newState && camera_from_world.rotation == this->Pose.rotation &&
      camera_from_world.translation == this->Pose.translation)
  {
    return;
  }
  const std::shared_ptr<const SceneState> kept = std::exchange(this->State, std::move(state));
  this->Pose = camera_from_world;
  while (this->Instances.size() > this->State->instances.size())
  {
    if (this->Instances.back().geometry)
    {
      embree().DetachGeometry(this->Scene, unsigned(this->Instances.size() - 1));
      embree().ReleaseGeometry(this->Instances.back().geometry);
    }
    this->Instances.pop_back();
  }
  this->Instances.resize(this->State->instances.size());
  this->Reach = 0;
  this->Fits = true;
  this->Exact = std::make_unique<ExactTree>();
  if (newState)
  {
    const std::vector<std::shared_ptr<const RayMesh>> meshes = this->Device->meshes(this->State->instances, this->Bare);
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      this->setMesh(i, meshes[i]);
    }
  }
  for (std::size_t i = 0; i < this->Instances.size(); ++i)
  {
    this->placeInstance(i);
    this->Reach = std::max(this->Reach, this->Instances[i].reach);
    this->Fits = this->Fits && (!this->Instances[i].mesh || this->Instances[i].fits);
  }
  this->Device->commit(this->Scene);
}

void RayScene::setMesh(std::size_t index, const std::shared_ptr<const RayMesh>& mesh)
{
  Placed& placed = this->Instances[index];
  if (!mesh && placed.geometry)
  {
    embree().DetachGeometry(this->Scene, unsigned(index));
    embree().ReleaseGeometry(placed.geometry);
    placed.geometry = nullptr;
  }
  if (mesh && mesh != placed.mesh)
  {
    if (!placed.geometry)
    {
      placed.geometry = embree().NewGeometry(this->Device->handle(), RTC_GEOMETRY_TYPE_INSTANCE);
      embree().AttachGeometryByID(this->Scene, placed.geometry, unsigned(index));
      placed.fits = true;
    }
    embree().SetGeometryInstancedScene(placed.geometry, mesh->scene);
  }
  placed.mesh = mesh;
}

void RayScene::placeInstance(std::size_t index)
{
  const Instance& instance = this->State->instances[index];
  Placed& placed = this->Instances[index];
  if (!placed.mesh)
  {
    placed.reach = 0;
    return;
  }
  placed.camera_from_object = this->Pose * instance.world_from_object;
  const Eigen::Matrix3d linear =
    withoutRoundings<Eigen::Matrix3d>(placed.mesh->baked ? this->Pose.rotation : placed.camera_from_object.linear);
  const Eigen::Vector3d translation = placed.camera_from_object * placed.mesh->centre;
  const Eigen::Matrix3d inverse = linear.inverse();
  const double radius = placed.mesh->radius;
  placed.reach = translation.norm() + linear.norm() * radius;
  const bool fits = fitsSingle(linear, placed.reach, (inverse * translation).norm() + radius, radius);
  if (fits != placed.fits)
  {
    (fits ? embree().EnableGeometry : embree().DisableGeometry)(placed.geometry);
    placed.fits = fits;
  }
  if (!fits)
  {
    return;
  }
  float matrix[12];
  for (int i = 0; i < 12; ++i)
  {
    matrix[i] = float(i < 9 ? linear.data()[i] : translation[i - 9]);
  }
  embree().SetGeometryTransform(placed.geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
  embree().CommitGeometry(placed.geometry);
  for (int i = 0; i < 9; ++i)
  {
    placed.mesh_from_camera[i] = float(inverse(i / 3, i % 3));
  }
  placed.sizes = float((inverse * translation).norm()) + placed.mesh->radius;
}

TriangleFrom RayScene::triangleFrom(const Eigen::Vector3d& origin, const Hit& hit) const
{
  const Placed& placed = this->Instances[hit.object - 1];
  const Eigen::Vector3d* positions = placed.mesh->geometry->positions.data();
  const auto& triangle = placed.mesh->model->triangles[hit.triangle];
  const Eigen::Vector3d corners[3] = { placed.camera_from_object * positions[triangle[0]],
    placed.camera_from_object * positions[triangle[1]], placed.camera_from_object * positions[triangle[2]] };
  return { origin, corners };
}

ExactHit RayScene::intersectTriangle(const ExactRay& ray, const Hit& hit) const
{
  const TriangleFrom triangle = this->triangleFrom(ray.origin, hit);
  return intersectExactly(ray, SeenTriangle(ray, triangle));
}

bool RayScene::isThere(const ExactRay& ray, const Hit& hit, const ExactHit& exact) const
{
  return exact.inside && exact.t >= ray.least && exact.t <= ray.most &&
         !(this->Instances[hit.object - 1].mesh->hasCutOuts &&
           isCutOut(this->State->instances[hit.object - 1], hit.triangle, exact.barycentrics));
}

double RayScene::slackAt(const ExactRay& ray, const Hit& hit, double t) const
{
  return rayPrecision * (std::abs(t) * ray.direction.norm() + this->Instances[hit.object - 1].reach);
}

ExactHit RayScene::intersect(const ExactRay& ray, const Hit& hit) const
{
  ExactHit exact = this->intersectTriangle(ray, hit);
  exact.inside = this->isThere(ray, hit, exact);
  return exact;
}

ExactHit RayScene::intersect(const ExactRay& ray, const Hit& hit, bool& uncertain, SeenTriangles* triangles) const
{
  TriangleFrom own;
  const TriangleFrom& from = triangles ? triangles->from(ray.origin, hit) : (own = this->triangleFrom(ray.origin, hit));
  const SeenTriangle seen(ray, from);
  ExactHit exact = intersectExactly(ray, seen);
  uncertain = marginalEdges(ray, seen, this->slackAt(ray, hit, exact.t)) != 0;
  exact.inside = this->isThere(ray, hit, exact);
  return exact;
}

namespace
{
struct FanQuery
{
  const RayMesh* mesh;
  std::uint32_t object;
  std::vector<Hit>* hits;
};

bool addToFan(RTCPointQueryFunctionArguments* arguments)
{
  const FanQuery& fan = *static_cast<FanQuery*>(arguments->userPtr);
  fan.hits->push_back({ fan.object, fan.mesh->firstTriangle[arguments->geomID] + arguments->primID });
  return false;
}
} // namespace

void RayScene::addFans(const ExactRay& ray, std::vector<Hit>& hits) const
{
  std::vector<std::pair<std::uint32_t, Eigen::Vector3d>> known;
  for (std::size_t i = 0, count = hits.size(); i < count; ++i)
  {
    const Hit hit = hits[i];
    const TriangleFrom from = this->triangleFrom(ray.origin, hit);
    const SeenTriangle seen(ray, from);
    const unsigned int edges = marginalEdges(ray, seen, this->slackAt(ray, hit, intersectExactly(ray, seen).t));
    for (int corner = 0; corner < 3; ++corner)
    {
      const unsigned int both = 1U << corner | 1U << (corner + 2) % 3;
      const std::pair<std::uint32_t, Eigen::Vector3d> key(hit.object, from.x[corner]);
      if ((edges & both) != both || std::find(known.begin(), known.end(), key) != known.end())
      {
        continue;
      }
      known.push_back(key);
      const RayMesh& mesh = *this->Instances[hit.object - 1].mesh;
      Eigen::Vector3d x = mesh.geometry->positions[mesh.model->triangles[hit.triangle][corner]] - mesh.centre;
      x = mesh.baked ? Eigen::Vector3d(this->State->instances[hit.object - 1].world_from_object.linear * x) : x;
      RTCPointQuery query{ float(x.x()), float(x.y()), float(x.z()), 0, float(rayPrecision) * mesh.radius };
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      FanQuery fan{ &mesh, hit.object, &hits };
      embree().PointQuery(mesh.scene, &query, &context, &addToFan, &fan);
    }
  }
}

double RayScene::errorInPixels(const View& view) const
{
  if (!this->Fits)
  {
    return std::numeric_limits<double>::infinity();
  }
  const CameraModel& model = *view.model;
  double finest = std::numeric_limits<double>::infinity(); // pixel at the farthest point
  for (const double part :
    model.linear() ? std::vector<double>{ 0.5 } : std::vector<double>{ 0.2, 0.35, 0.5, 0.65, 0.8 })
  {
    const Eigen::Vector2d pixel(part * model.width(), 0.5 * model.height());
    const CameraRay ray = model.rayThrough(pixel);
    const CameraRay next = model.rayThrough({ pixel.x() + 1, pixel.y() });
    if (ray.exists() && next.exists())
    {
      finest = std::min(finest, (next.origin - ray.origin).norm() +
                                  this->Reach * (next.direction - ray.direction).norm() / ray.direction.norm());
    }
  }
  return this->Reach > 0 ? 2 * rayPrecision * this->Reach / finest : 0;
}

ExactRay rayOf(const View& view, const Eigen::Vector2d& pixel)
{
  const CameraRay ray = view.model->rayThrough(pixel);
  return ray.exists() ? ExactRay{ ray.origin, ray.direction, view.near, view.far }
                      : ExactRay{ ray.origin, Eigen::Vector3d(0, 0, 1), view.near, 0 };
}

bool comesBefore(double ta, const Hit& a, double tb, const Hit& b)
{
  if (std::abs(ta - tb) > sameDistance * std::min(ta, tb))
  {
    return ta < tb;
  }
  return a.object != b.object ? a.object < b.object : a.triangle < b.triangle;
}

RTCRayHit makeQuery(const ExactRay& ray)
{
  RTCRayHit query{};
  query.ray.org_x = float(ray.origin.x());
  query.ray.org_y = float(ray.origin.y());
  query.ray.org_z = float(ray.origin.z());
  const Eigen::Vector3d direction = withoutRoundings(ray.direction);
  query.ray.dir_x = float(direction.x());
  query.ray.dir_y = float(direction.y());
  query.ray.dir_z = float(direction.z());
  query.ray.tnear = float(ray.least) * (1 - rangeSlack);
  query.ray.tfar = float(ray.most) * (1 + rangeSlack);
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

namespace
{

void trace(const RayScene& scene, const ExactRay& ray, std::vector<Hit>& found)
{
  RayContext context;
  rtcInitIntersectContext(&context.context);
  context.scene = &scene;
  context.mode = RayContext::Mode::Collect;
  context.context.filter = rayFilter;
  context.found = &found;
  traceRays(scene, &ray, 1, context);
}

/// Traces rays around `ray`, `offset` away at the origin and `turn` per unit of t.
void traceAround(const RayScene& scene, const ExactRay& ray, double offset, double turn, std::vector<Hit>& found)
{
  const Eigen::Vector3d d = ray.direction.normalized();
  const Eigen::Vector3d axis = std::abs(d.x()) < 0.6 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 1, 0);
  const Eigen::Vector3d u = exact::cross(d, axis).normalized();
  const Eigen::Vector3d v = exact::cross(d, u);
  for (const Eigen::Vector3d& side : { u, v, Eigen::Vector3d(-u), Eigen::Vector3d(-v) })
  {
    ExactRay beside = ray;
    beside.origin += offset * side;
    beside.direction += turn * side;
    trace(scene, beside, found);
  }
}

} // namespace

void collectHits(const RayScene& scene, const ExactRay& ray, bool nearby, std::vector<RayHit>& hits)
{
  thread_local std::vector<Hit> found;
  found.clear();
  trace(scene, ray, found);
  settleHits(scene, ray, nearby, nullptr, found, hits);
}

void settleHits(const RayScene& scene, const ExactRay& ray, bool nearby, SeenTriangles* triangles,
  std::vector<Hit>& found, std::vector<RayHit>& hits)
{
  hits.clear();
  for (const Hit& hit : found)
  {
    bool uncertain = false;
    const ExactHit exactly = scene.intersect(ray, hit, uncertain, triangles);
    nearby = nearby || uncertain;
    if (exactly.inside)
    {
      hits.push_back({ exactly.t, hit });
    }
  }
  if (nearby)
  {
    const double turn = 4 * rayPrecision * ray.direction.norm();
    traceAround(scene, ray, 0, turn, found);
    traceAround(scene, ray, 4 * rayPrecision * scene.reach(), turn, found);
    scene.addFans(ray, found);
    std::sort(found.begin(), found.end(),
      [](const Hit& a, const Hit& b) { return a.object != b.object ? a.object < b.object : a.triangle < b.triangle; });
    found.erase(std::unique(found.begin(), found.end()), found.end());
    hits.clear();
    for (const Hit& hit : found)
    {
      const ExactHit exactly = scene.intersect(ray, hit);
      if (exactly.inside)
      {
        hits.push_back({ exactly.t, hit });
      }
    }
  }
  sortHits(hits);
}

void traceRays(const RayScene& scene, const ExactRay* rays, unsigned int active, RayContext& context)
{
  for (unsigned int left = active; left != 0; left &= left - 1)
  {
    const auto lane = unsigned(__builtin_ctz(left));
    active ^= isTraceable(rays[lane].origin, rays[lane].direction) ? 0U : 1U << lane;
  }
  if ((active & (active - 1)) == 0)
  {
    if (active != 0)
    {
      const auto lane = unsigned(__builtin_ctz(active));
      alignas(16) RTCRayHit query = makeQuery(rays[lane]);
      query.ray.id = lane;
      embree().Intersect1(scene.handle(), &context.context, &query);
    }
    return;
  }
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[16];
  for (unsigned int i = 0; i < 16; ++i)
  {
    valid[i] = (active >> i & 1U) != 0 ? -1 : 0;
    const RTCRayHit query = valid[i] != 0 ? makeQuery(rays[i]) : RTCRayHit{};
    packet.ray.org_x[i] = query.ray.org_x;
    packet.ray.org_y[i] = query.ray.org_y;
    packet.ray.org_z[i] = query.ray.org_z;
    packet.ray.dir_x[i] = query.ray.dir_x;
    packet.ray.dir_y[i] = query.ray.dir_y;
    packet.ray.dir_z[i] = query.ray.dir_z;
    packet.ray.tnear[i] = query.ray.tnear;
    packet.ray.tfar[i] = query.ray.tfar;
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0U;
    packet.ray.id[i] = i;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  embree().Intersect16(valid, scene.handle(), &context.context, &packet);
}

bool isCoherent(const View& view)
{
  const std::optional<LinearProjection> linear = view.model->linear();
  return linear && linear->perspective;
}

} // namespace dgtk
