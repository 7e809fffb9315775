// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceBody.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace dgtk
{

namespace
{
/// The point of a triangle that is nearest to x (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3d nearestOfTriangle(
  const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = ab.dot(x - a);
  const double d2 = ac.dot(x - a);
  if (d1 <= 0 && d2 <= 0)
  {
    return a;
  }
  const double d3 = ab.dot(x - b);
  const double d4 = ac.dot(x - b);
  if (d3 >= 0 && d4 <= d3)
  {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
  {
    return a + ab * (d1 / (d1 - d3));
  }
  const double d5 = ab.dot(x - c);
  const double d6 = ac.dot(x - c);
  if (d6 >= 0 && d5 <= d6)
  {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
  {
    return a + ac * (d2 / (d2 - d6));
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
  {
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}
} // namespace

TriangleTree::TriangleTree(const SolidMesh& mesh, std::size_t first, std::size_t count)
  : Mesh(mesh)
  , Order(count)
{
  std::iota(this->Order.begin(), this->Order.end(), std::uint32_t(first));
  if (count > 0)
  {
    this->build(0, std::uint32_t(count));
  }
  else
  {
    this->Nodes.emplace_back();
    this->Nodes.back().box.setEmpty();
  }
}

Eigen::AlignedBox3d TriangleTree::boxOf(std::uint32_t triangle) const
{
  Eigen::AlignedBox3d box;
  for (const std::uint32_t corner : this->Mesh.triangles[triangle])
  {
    box.extend(this->Mesh.points[corner]);
  }
  return box;
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t count)
{
  const std::uint32_t at = std::uint32_t(this->Nodes.size());
  this->Nodes.emplace_back();
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = first; i < first + count; ++i)
  {
    box.extend(this->boxOf(this->Order[i]));
  }
  this->Nodes[at].box = box;
  if (count <= 4)
  {
    this->Nodes[at].first = first;
    this->Nodes[at].count = count;
    return at;
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = [&](std::uint32_t t)
  {
    const auto& corners = this->Mesh.triangles[t];
    return this->Mesh.points[corners[0]][axis] + this->Mesh.points[corners[1]][axis] +
           this->Mesh.points[corners[2]][axis];
  };
  const auto begin = this->Order.begin() + first;
  std::sort(begin, begin + count,
    [&](std::uint32_t a, std::uint32_t b)
    {
      const double x = middle(a);
      const double y = middle(b);
      return x != y ? x < y : a < b;
    });
  this->build(first, count / 2);
  const std::uint32_t right = this->build(first + count / 2, count - count / 2);
  this->Nodes[at].first = right;
  return at;
}

bool TriangleTree::holds(const Eigen::Vector3d& x) const
{
  // Along no plane or edge that a model is likely to have.
  static const Eigen::Vector3d direction = Eigen::Vector3d(0.3141592, 0.8660254, 0.3882211).normalized();
  const auto meets = [&](const Eigen::AlignedBox3d& box)
  {
    double near = 0;
    double far = std::numeric_limits<double>::max();
    for (int i = 0; i < 3; ++i)
    {
      near = std::max(near, (box.min()[i] - x[i]) / direction[i]);
      far = std::min(far, (box.max()[i] - x[i]) / direction[i]);
    }
    return near <= far * (1 + 1e-12);
  };
  bool inside = false;
  this->visit(0, meets,
    [&](std::uint32_t triangle)
    {
      const auto& corners = this->Mesh.triangles[triangle];
      const Eigen::Vector3d a = this->Mesh.points[corners[0]];
      const Eigen::Vector3d ab = this->Mesh.points[corners[1]] - a;
      const Eigen::Vector3d ac = this->Mesh.points[corners[2]] - a;
      const Eigen::Vector3d p = direction.cross(ac);
      const double det = ab.dot(p);
      if (det == 0)
      {
        return;
      }
      const Eigen::Vector3d s = x - a;
      const double u = s.dot(p) / det;
      const Eigen::Vector3d q = s.cross(ab);
      const double v = direction.dot(q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && ac.dot(q) / det > 0)
      {
        inside = !inside;
      }
    });
  return inside;
}

Eigen::Vector3d TriangleTree::nearest(const Eigen::Vector3d& x) const
{
  double least = std::numeric_limits<double>::max();
  Eigen::Vector3d best = x;
  this->visit(
    0, [&](const Eigen::AlignedBox3d& box) { return box.squaredExteriorDistance(x) < least; },
    [&](std::uint32_t triangle)
    {
      const auto& corners = this->Mesh.triangles[triangle];
      const Eigen::Vector3d near = nearestOfTriangle(
        x, this->Mesh.points[corners[0]], this->Mesh.points[corners[1]], this->Mesh.points[corners[2]]);
      const double distance = (near - x).squaredNorm();
      if (distance < least)
      {
        least = distance;
        best = near;
      }
    });
  return best;
}

} // namespace dgtk
