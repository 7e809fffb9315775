// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceWorld.h"

#include "dgtkObjectPoses.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double touch = 1e-6; ///< of the size: what counts as touching

/// How far up a meeting may lie that holds a body: what it does not go into holds it from below alone, as a surface
/// that it touches from below or from the side does not.
double heldFrom(double depth, const PlaceBody& body) { return depth > 0 ? depth + 2 * touch * body.size() : 0; }

bool isThere(const SceneDescription& scene, std::size_t object)
{
  return isEver(scene.objects[object].visible) && !scene.objects[object].model.empty();
}

void add(SolidMesh& to, const SolidMesh& from, const Affine3& body_from_object)
{
  const std::uint32_t point = std::uint32_t(to.points.size());
  const std::size_t triangle = to.triangles.size();
  for (const Eigen::Vector3d& p : from.points)
  {
    to.points.push_back(body_from_object * p);
  }
  const bool mirrored = body_from_object.linear.determinant() < 0;
  for (const auto& t : from.triangles)
  {
    to.triangles.push_back({ t[0] + point, t[mirrored ? 2 : 1] + point, t[mirrored ? 1 : 2] + point });
  }
  for (const SolidMesh::Part& part : from.parts)
  {
    to.parts.push_back({ part.first + triangle, part.count, part.closed });
  }
}

std::vector<Eigen::Vector3d> moved(const std::vector<Eigen::Vector3d>& points, const Affine3& body_from_object)
{
  std::vector<Eigen::Vector3d> result;
  result.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
  {
    result.push_back(body_from_object * p);
  }
  return result;
}

void add(std::vector<ConvexHull>& to, const std::vector<ConvexHull>& from, const Affine3& body_from_object)
{
  constexpr double most = 0.1; // of the size; more may be left off a thin piece that the scale makes thick
  Eigen::AlignedBox3d box;
  const std::size_t first = to.size();
  for (const ConvexHull& piece : from)
  {
    to.push_back(convexHull(moved(piece.points, body_from_object)));
    to.back().left = piece.left * body_from_object.linear.colwise().norm().maxCoeff();
    for (const Eigen::Vector3d& p : to.back().points)
    {
      box.extend(p);
    }
  }
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    if (to[first + i].left > most * box.sizes().maxCoeff())
    {
      to[first + i] = fewCorners(convexHull(moved(from[i].whole, body_from_object)), box.sizes().maxCoeff());
    }
  }
}
} // namespace

PlaceWorld::PlaceWorld(const SceneDescription& scene, const std::vector<PlaceRule>& rules, SampleModels& models)
  : BodyOf(scene.objects.size(), 0)
  , Up(scene.upAxis == UpAxis::Y ? 1 : 2)
{
  const double frame = scene.firstFrame();
  const ObjectPoses poses(scene);
  const std::vector<Affine3> at = poses.at(frame);
  std::vector<std::vector<std::size_t>> hanging(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    std::size_t root = i;
    while (poses.parentOf(root) != ObjectPoses::noParent)
    {
      root = poses.parentOf(root);
    }
    hanging[root].push_back(i);
  }
  std::vector<const PlaceRule*> ruled(scene.objects.size(), nullptr);
  for (const PlaceRule& rule : rules)
  {
    ruled[rule.object] = &rule;
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    if (hanging[i].empty())
    {
      continue;
    }
    PlaceBody::Parameters made;
    made.name = scene.objects[i].name;
    made.world_from_body = { scene.objects[i].orientation.at(frame).matrix(), scene.objects[i].position.at(frame) };
    const Rigid3 body_from_world = made.world_from_body.inverse();
    SolidMesh mesh;
    for (const std::size_t object : hanging[i])
    {
      if (!isThere(scene, object))
      {
        continue;
      }
      const std::string path = scene.resolve(scene.objects[object].model);
      const Affine3 body_from_object = body_from_world * at[object];
      add(mesh, *solidOf(models, path), body_from_object);
      if (ruled[i] != nullptr && ruled[i]->drop)
      {
        const bool stoodInFor = object == i && !ruled[i]->proxy.empty();
        add(made.pieces, *piecesOf(models, stoodInFor ? ruled[i]->proxy : path), body_from_object);
      }
    }
    made.mesh = std::make_shared<const SolidMesh>(std::move(mesh));
    this->BodyOf[i] = this->Bodies.size();
    this->Bodies.emplace_back(std::move(made));
    this->In.push_back(ruled[i] == nullptr);
  }
}

std::vector<const PlaceBody*> PlaceWorld::others(const std::vector<std::size_t>& but) const
{
  std::vector<char> in = this->In;
  for (const std::size_t object : but)
  {
    in[this->BodyOf[object]] = 0;
  }
  std::vector<const PlaceBody*> found;
  for (std::size_t i = 0; i < this->Bodies.size(); ++i)
  {
    if (in[i] && !this->Bodies[i].mesh().triangles.empty())
    {
      found.push_back(&this->Bodies[i]);
    }
  }
  return found;
}

PlaceMeasure measurePlace(
  const PlaceBody& body, const std::vector<const PlaceBody*>& others, const Eigen::Vector3d& down, double most)
{
  PlaceMeasure measure;
  measure.gap = most;
  for (const PlaceBody* other : others)
  {
    const double depth = penetration(body, *other).depth;
    measure.penetration = std::max(measure.penetration, depth);
    measure.gap = std::min(measure.gap, wayDown(body, *other, down, measure.gap, heldFrom(depth, body)));
  }
  return measure;
}

namespace
{
Penetration deepestOf(const PlaceBody& body, const std::vector<const PlaceBody*>& others)
{
  Penetration deepest;
  for (const PlaceBody* other : others)
  {
    const Penetration one = penetration(body, *other);
    deepest = one.depth > deepest.depth ? one : deepest;
  }
  return deepest;
}

/// Moves a body out of others by the shortest ways; where they lead into one another, as far out as it came.
void pushOut(PlaceBody& body, const std::vector<const PlaceBody*>& others)
{
  Rigid3 best = body.pose();
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < 40 && least > 0; ++i)
  {
    const Penetration deepest = deepestOf(body, others);
    if (deepest.depth < least)
    {
      least = deepest.depth;
      best = body.pose();
    }
    body.move(deepest.out * (deepest.depth + touch * body.size()));
  }
  body.setPose(best);
}
} // namespace

void layDown(PlaceBody& body, const std::vector<const PlaceBody*>& others, const Eigen::Vector3d& down, double most)
{
  pushOut(body, others);
  double way = most;
  for (const PlaceBody* other : others)
  {
    way = std::min(way, wayDown(body, *other, down, way, heldFrom(penetration(body, *other).depth, body)));
  }
  if (way < most)
  {
    body.move(down * std::max(0.0, way - touch * body.size()));
  }
}

bool stands(const PlaceBody& body, const PlaceBody& support, const Eigen::Vector3d& down, double tolerance)
{
  int up = 0;
  down.cwiseAbs().maxCoeff(&up);
  const std::array<int, 2> level = { up == 0 ? 1 : 0, up == 2 ? 1 : 2 };
  // The middle is held exactly when what touches does not lie on one side of a line through it.
  const Eigen::Vector3d middle = body.middle();
  std::vector<double> angles;
  for (const Eigen::Vector3d& x : touches(body, support, down, tolerance))
  {
    angles.push_back(portable::atan2(x[level[1]] - middle[level[1]], x[level[0]] - middle[level[0]]));
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * pi;
    if (next - angles[i] > pi * (1 - 1e-6))
    {
      return false;
    }
  }
  return !angles.empty();
}

} // namespace dgtk
