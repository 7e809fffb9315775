// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceBody.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;
using Corners = std::array<Eigen::Vector3d, 3>;

fcl::Transform3d fclPose(const Rigid3& pose)
{
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.rotation;
  result.translation() = pose.translation;
  return result;
}
} // namespace

struct PlaceBody::Impl
{
  std::shared_ptr<FclMesh> mesh;
  TriangleTree tree;
  std::vector<TriangleTree> closed;

  explicit Impl(const SolidMesh& solid)
    : mesh(std::make_shared<FclMesh>())
    , tree(solid, 0, solid.triangles.size())
  {
    std::vector<fcl::Triangle> triangles;
    for (const auto& corners : solid.triangles)
    {
      triangles.emplace_back(corners[0], corners[1], corners[2]);
    }
    if (!triangles.empty())
    {
      this->mesh->beginModel(int(triangles.size()), int(solid.points.size()));
      this->mesh->addSubModel(solid.points, triangles);
      this->mesh->endModel();
    }
    for (const SolidMesh::Part& part : solid.parts)
    {
      if (part.closed)
      {
        this->closed.emplace_back(solid, part.first, part.count);
      }
    }
  }
};

PlaceBody::PlaceBody(Parameters parameters)
  : Is(std::move(parameters))
  , Self(std::make_unique<Impl>(*this->Is.mesh))
{
  for (const Eigen::Vector3d& p : this->Is.mesh->points)
  {
    this->Bounds.extend(p);
  }
  this->Size = this->Bounds.isEmpty() ? 0 : this->Bounds.sizes().maxCoeff();
  this->setPose(this->Is.world_from_body);
}

PlaceBody::~PlaceBody() = default;
PlaceBody::PlaceBody(PlaceBody&&) noexcept = default;

void PlaceBody::setPose(const Rigid3& world_from_body)
{
  this->Is.world_from_body = world_from_body;
  this->WorldPoints.clear();
  this->WorldBox.setEmpty();
  for (const Eigen::Vector3d& p : this->Is.mesh->points)
  {
    this->WorldPoints.push_back(world_from_body * p);
    this->WorldBox.extend(this->WorldPoints.back());
  }
}

void PlaceBody::move(const Eigen::Vector3d& by_in_world)
{
  this->setPose({ this->Is.world_from_body.rotation, this->Is.world_from_body.translation + by_in_world });
}

namespace
{
Corners cornersOf(const PlaceBody& body, std::size_t triangle)
{
  const auto& corners = body.mesh().triangles[triangle];
  return { body.points()[corners[0]], body.points()[corners[1]], body.points()[corners[2]] };
}

/// Where it is along an axis.
std::pair<double, double> range(const Corners& corners, const Eigen::Vector3d& axis)
{
  const double p = axis.dot(corners[0]);
  const double q = axis.dot(corners[1]);
  const double r = axis.dot(corners[2]);
  return { std::min({ p, q, r }), std::max({ p, q, r }) };
}

/// The shortest way by which triangle a leaves triangle b: along a normal, or across two edges.
Penetration apart(const Corners& a, const Corners& b)
{
  Penetration shortest;
  shortest.depth = std::numeric_limits<double>::max();
  const auto along = [&](const Eigen::Vector3d& direction)
  {
    const double length = direction.norm();
    if (length <= 1e-9 * (a[1] - a[0]).norm() * (b[1] - b[0]).norm())
    {
      return;
    }
    const Eigen::Vector3d axis = direction / length;
    const std::pair<double, double> ofA = range(a, axis);
    const std::pair<double, double> ofB = range(b, axis);
    const double up = ofB.second - ofA.first;
    const double down = ofA.second - ofB.first;
    if (std::min(up, down) < shortest.depth)
    {
      shortest = { std::min(up, down), up <= down ? axis : Eigen::Vector3d(-axis) };
    }
  };
  along((a[1] - a[0]).cross(a[2] - a[0]));
  along((b[1] - b[0]).cross(b[2] - b[0]));
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      along((a[(i + 1) % 3] - a[i]).cross(b[(j + 1) % 3] - b[j]));
    }
  }
  return shortest.depth == std::numeric_limits<double>::max() ? Penetration() : shortest;
}

/// The deepest vertex of a within a closed part of b.
Penetration deepestVertex(const PlaceBody& a, const PlaceBody& b)
{
  Penetration deepest;
  const Rigid3 b_from_world = b.pose().inverse();
  for (const Eigen::Vector3d& x : a.points())
  {
    if (!b.box().contains(x))
    {
      continue;
    }
    const Eigen::Vector3d x_in_b = b_from_world * x;
    for (const TriangleTree& tree : b.impl().closed)
    {
      if (!tree.holds(x_in_b))
      {
        continue;
      }
      const Eigen::Vector3d way = b.pose().rotation * (tree.nearest(x_in_b) - x_in_b);
      if (way.norm() > deepest.depth)
      {
        deepest = { way.norm(), way.normalized() };
      }
    }
  }
  return deepest;
}
} // namespace

Penetration penetration(const PlaceBody& a, const PlaceBody& b)
{
  Penetration deepest;
  if (!a.box().intersects(b.box()))
  {
    return deepest;
  }
  fcl::CollisionRequestd request(100000, true);
  fcl::CollisionResultd result;
  fcl::collide<double>(a.impl().mesh.get(), fclPose(a.pose()), b.impl().mesh.get(), fclPose(b.pose()), request, result);
  for (std::size_t i = 0; i < result.numContacts(); ++i)
  {
    const fcl::Contactd& contact = result.getContact(i);
    const Penetration pair = apart(cornersOf(a, std::size_t(contact.b1)), cornersOf(b, std::size_t(contact.b2)));
    deepest = pair.depth > deepest.depth ? pair : deepest;
  }
  const Penetration ofA = deepestVertex(a, b);
  deepest = ofA.depth > deepest.depth ? ofA : deepest;
  const Penetration ofB = deepestVertex(b, a);
  return ofB.depth > deepest.depth ? Penetration{ ofB.depth, -ofB.out } : deepest;
}

double distance(const PlaceBody& a, const PlaceBody& b, double most)
{
  if (a.mesh().triangles.empty() || b.mesh().triangles.empty() || a.box().exteriorDistance(b.box()) >= most)
  {
    return most;
  }
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  const double found = fcl::distance<double>(
    a.impl().mesh.get(), fclPose(a.pose()), b.impl().mesh.get(), fclPose(b.pose()), request, result);
  return std::clamp(found, 0.0, most);
}

namespace
{
/// The way along `down` from x to a triangle, or infinity.
double wayToTriangle(const Eigen::Vector3d& x, const Eigen::Vector3d& down, const Corners& t)
{
  const Eigen::Vector3d ab = t[1] - t[0];
  const Eigen::Vector3d ac = t[2] - t[0];
  const Eigen::Vector3d p = down.cross(ac);
  const double det = ab.dot(p);
  if (std::abs(det) <= 1e-12 * ab.norm() * ac.norm() * down.norm())
  {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector3d s = x - t[0];
  const double u = s.dot(p) / det;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = down.dot(q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? ac.dot(q) / det : std::numeric_limits<double>::infinity();
}

/// The way along `down` from the segment p, p + e to the segment q, q + f, or infinity.
double wayToEdge(const Eigen::Vector3d& p, const Eigen::Vector3d& e, const Eigen::Vector3d& q, const Eigen::Vector3d& f,
  const Eigen::Vector3d& down)
{
  // p + u e + t down = q + v f
  const Eigen::Vector3d normal = e.cross(f);
  const double det = normal.dot(down);
  if (std::abs(det) <= 1e-9 * e.norm() * f.norm())
  {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector3d w = q - p;
  const double u = down.dot(w.cross(f)) / det;
  const double v = down.dot(w.cross(e)) / det;
  return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? normal.dot(w) / det : std::numeric_limits<double>::infinity();
}

/// Calls found(way along `down`, point of a) for all points in which triangle a meets triangle b on that way, those
/// that are ends of the common polygon.
template <typename Found>
void meetings(const Corners& a, const Corners& b, const Eigen::Vector3d& down, const Found& found)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    found(wayToTriangle(a[i], down, b), a[i]);
    const double up = wayToTriangle(b[i], -down, a);
    found(up, b[i] - up * down);
    for (std::size_t j = 0; j < 3; ++j)
    {
      const Eigen::Vector3d f = b[(j + 1) % 3] - b[j];
      const double way = wayToEdge(a[i], a[(i + 1) % 3] - a[i], b[j], f, down);
      if (std::isfinite(way))
      {
        const Eigen::Vector3d e = a[(i + 1) % 3] - a[i];
        found(way, a[i] + e * (down.dot((b[j] - a[i]).cross(f)) / e.cross(f).dot(down)));
      }
    }
  }
}

/// The triangles of a body, those first that come down furthest: what is near is found early.
std::vector<std::size_t> lowestFirst(const PlaceBody& body, const Eigen::Vector3d& down)
{
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < body.mesh().triangles.size(); ++t)
  {
    order.emplace_back(-range(cornersOf(body, t), down).second, t);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> triangles;
  triangles.reserve(order.size());
  for (const auto& one : order)
  {
    triangles.push_back(one.second);
  }
  return triangles;
}

/// Calls visit(triangle of a, triangle of b, down) in the frame of b for those that meet where `a` moves along `down`
/// from -`depth` to `reach`(), which may become less on the way.
template <typename Reach, typename Visit>
void pairsBelow(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double depth, const Reach& reach,
  const Visit& visit)
{
  Eigen::AlignedBox3d swept = a.box();
  swept.extend(Eigen::Vector3d(a.box().min() + reach() * down)).extend(Eigen::Vector3d(a.box().max() + reach() * down));
  swept.extend(Eigen::Vector3d(a.box().min() - depth * down)).extend(Eigen::Vector3d(a.box().max() - depth * down));
  if (a.mesh().triangles.empty() || !swept.intersects(b.box()))
  {
    return;
  }
  const Rigid3 b_from_world = b.pose().inverse();
  const Eigen::Vector3d down_in_b = b_from_world.rotation * down;
  for (const std::size_t t : lowestFirst(a, down))
  {
    Corners corners = cornersOf(a, t);
    Eigen::AlignedBox3d inWorld;
    for (const Eigen::Vector3d& x : corners)
    {
      inWorld.extend(Eigen::Vector3d(x - depth * down)).extend(Eigen::Vector3d(x + reach() * down));
    }
    if (!inWorld.intersects(b.box()))
    {
      continue;
    }
    Eigen::AlignedBox3d box;
    for (Eigen::Vector3d& x : corners)
    {
      x = b_from_world * x;
      box.extend(Eigen::Vector3d(x - depth * down_in_b)).extend(Eigen::Vector3d(x + reach() * down_in_b));
    }
    const double lowest = range(corners, down_in_b).second;
    b.impl().tree.within(box,
      [&](std::uint32_t other)
      {
        const auto& of = b.mesh().triangles[other];
        const Corners q = { b.mesh().points[of[0]], b.mesh().points[of[1]], b.mesh().points[of[2]] };
        if (range(q, down_in_b).first - lowest <= reach() &&
            Eigen::AlignedBox3d(q[0]).extend(q[1]).extend(q[2]).intersects(box))
        {
          visit(corners, q, down_in_b);
        }
      });
  }
}

/// Whether what is just below the middle of a triangle of a closed part of `a` is in one of `b`.
bool isBelowSurface(const PlaceBody& a, const PlaceBody& b, double touch)
{
  const Rigid3 b_from_world = b.pose().inverse();
  for (const SolidMesh::Part& part : a.mesh().parts)
  {
    for (std::size_t t = part.first; part.closed && t < part.first + part.count; ++t)
    {
      const Corners c = cornersOf(a, t);
      const Eigen::Vector3d out = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
      const Eigen::Vector3d x = (c[0] + c[1] + c[2]) / 3 - touch * out;
      if (b.box().contains(x) && std::any_of(b.impl().closed.begin(), b.impl().closed.end(),
                                   [&](const TriangleTree& tree) { return tree.holds(b_from_world * x); }))
      {
        return true;
      }
    }
  }
  return false;
}

bool isOpen(const PlaceBody& body)
{
  const std::vector<SolidMesh::Part>& parts = body.mesh().parts;
  return std::any_of(parts.begin(), parts.end(), [](const SolidMesh::Part& part) { return !part.closed; });
}

/// Whether surfaces lie on one another, over some area.
bool isLevel(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double touch)
{
  bool found = false;
  pairsBelow(
    a, b, down, touch, [&] { return touch; },
    [&](const Corners& p, const Corners& q, const Eigen::Vector3d& down_in_b)
    {
      std::vector<Eigen::Vector3d> common; // what is common of their pictures along that way
      meetings(p, q, down_in_b,
        [&](double t, const Eigen::Vector3d& x)
        {
          if (std::abs(t) <= touch)
          {
            common.push_back(x);
          }
        });
      for (std::size_t i = 1; i < common.size(); ++i)
      {
        for (std::size_t j = 1; j < i; ++j)
        {
          const double area = down_in_b.dot((common[i] - common[0]).cross(common[j] - common[0]));
          found = found || std::abs(area) > touch * a.size();
        }
      }
    });
  return found;
}
} // namespace

bool coincide(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double touch)
{
  return a.box().exteriorDistance(b.box()) <= touch && (isBelowSurface(a, b, touch) || isBelowSurface(b, a, touch) ||
                                                         (isOpen(a) && isOpen(b) && isLevel(a, b, down, touch)));
}

double wayDown(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double most, double depth)
{
  double way = most;
  pairsBelow(
    a, b, down, depth, [&] { return way; },
    [&](const Corners& p, const Corners& q, const Eigen::Vector3d& down_in_b)
    {
      meetings(p, q, down_in_b,
        [&](double t, const Eigen::Vector3d&) { way = t >= -depth ? std::min(way, std::max(t, 0.0)) : way; });
    });
  return way;
}

std::vector<Eigen::Vector3d> touches(
  const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double tolerance)
{
  std::vector<Eigen::Vector3d> points;
  pairsBelow(
    a, b, down, tolerance, [&] { return tolerance; },
    [&](const Corners& p, const Corners& q, const Eigen::Vector3d& down_in_b)
    {
      meetings(p, q, down_in_b,
        [&](double t, const Eigen::Vector3d& x)
        {
          if (std::abs(t) <= tolerance)
          {
            points.push_back(b.pose() * x);
          }
        });
    });
  return points;
}

} // namespace dgtk
