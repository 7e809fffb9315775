// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelBuilder.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

Eigen::Vector3d polygonNormal(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < points.size(); ++i)
  {
    sum += (points[i - 1] - points[0]).cross(points[i] - points[0]);
  }
  return sum;
}

Eigen::Vector3d turnedNormal(const Eigen::Matrix3d& linear, const Eigen::Vector3d& normal)
{
  const auto cofactors = [&linear](int a, int b) { return linear.col(a).cross(linear.col(b)); };
  return cofactors(1, 2) * normal.x() + cofactors(2, 0) * normal.y() + cofactors(0, 1) * normal.z();
}

void areaNormals(const Model& model, const std::vector<Eigen::Vector3d>& positions,
  const std::vector<Eigen::Vector3f>* fallback, std::vector<Eigen::Vector3f>& normals)
{
  const std::vector<std::uint32_t>& group = model.normalGroup;
  const std::size_t groups =
    group.empty() ? positions.size() : std::size_t(*std::max_element(group.begin(), group.end())) + 1;
  std::vector<Eigen::Vector3d> sums(groups, Eigen::Vector3d::Zero());
  for (const std::array<std::uint32_t, 3>& triangle : model.triangles)
  {
    const Eigen::Vector3d& a = positions[triangle[0]];
    const Eigen::Vector3d area = (positions[triangle[1]] - a).cross(positions[triangle[2]] - a);
    std::uint32_t g[3];
    for (int i = 0; i < 3; ++i)
    {
      g[i] = group.empty() ? triangle[i] : group[triangle[i]];
      // a triangle with two corners of a group counts once there
      if ((i < 1 || g[i] != g[0]) && (i < 2 || g[i] != g[1]))
      {
        sums[g[i]] += area;
      }
    }
  }
  normals.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const Eigen::Vector3d& sum = sums[group.empty() ? i : group[i]];
    const double length = sum.stableNorm();
    if (length > 0)
    {
      normals[i] = (sum / length).cast<float>();
    }
    else
    {
      normals[i] = fallback ? (*fallback)[i] : Eigen::Vector3f(0, 0, 1);
    }
  }
}

} // namespace dgtk
