// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSolidModel.h"

#include "dgtkDisjointSets.h"
#include "dgtkModel.h"
#include "dgtkPlaceBody.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double pieceTolerance = 0.02; ///< of the model's size
constexpr double cornerTolerance = 0.01;
constexpr std::size_t mostPieces = 24; ///< of a model

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Number of each position among the different ones, which go to `points`.
std::vector<std::uint32_t> welded(const std::vector<Eigen::Vector3d>& positions, std::vector<Eigen::Vector3d>& points)
{
  const auto less = [&](std::uint32_t a, std::uint32_t b)
  {
    const Eigen::Vector3d& p = positions[a];
    const Eigen::Vector3d& q = positions[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> number(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == 0 || less(order[i - 1], order[i]))
    {
      points.push_back(positions[order[i]]);
    }
    number[order[i]] = std::uint32_t(points.size() - 1);
  }
  return number;
}

bool isClosed(const SolidMesh& mesh, const SolidMesh::Part& part)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = part.first; t < part.first + part.count; ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges[std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3])]++;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; });
}

/// Turns the triangles of a closed part to the outside.
void turnOut(SolidMesh& mesh, const SolidMesh::Part& part)
{
  const TriangleTree tree(mesh, part.first, part.count);
  for (std::size_t t = part.first; t < part.first + part.count; ++t)
  {
    auto& corners = mesh.triangles[t];
    const Eigen::Vector3d& a = mesh.points[corners[0]];
    const Eigen::Vector3d& b = mesh.points[corners[1]];
    const Eigen::Vector3d& c = mesh.points[corners[2]];
    const double length = std::sqrt((b - a).squaredNorm() + (c - a).squaredNorm());
    const Eigen::Vector3d out = 1e-4 * length * (b - a).cross(c - a).normalized();
    const Eigen::Vector3d middle = (a + b + c) / 3;
    if (tree.holds(middle + out) && !tree.holds(middle - out))
    {
      std::swap(corners[1], corners[2]);
    }
  }
}

double sizeOf(const SolidMesh& mesh)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return mesh.points.empty() ? 0 : (high - low).maxCoeff();
}
} // namespace

SolidMesh solidMesh(const std::vector<Eigen::Vector3d>& positions, const Triangles& triangles)
{
  SolidMesh mesh;
  std::vector<std::uint32_t> used;
  std::vector<Eigen::Vector3d> corners;
  for (const auto& triangle : triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      corners.push_back(positions[corner]);
    }
  }
  used = welded(corners, mesh.points);
  Triangles kept;
  DisjointSets sets(mesh.points.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const std::array<std::uint32_t, 3> triangle = { used[3 * t], used[3 * t + 1], used[3 * t + 2] };
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
    {
      kept.push_back(triangle);
      sets.join(triangle[0], triangle[1]);
      sets.join(triangle[0], triangle[2]);
    }
  }
  std::map<std::uint32_t, std::size_t> numbers;
  std::vector<Triangles> parts;
  for (const auto& triangle : kept)
  {
    const auto entry = numbers.emplace(sets.find(triangle[0]), parts.size());
    if (entry.second)
    {
      parts.emplace_back();
    }
    parts[entry.first->second].push_back(triangle);
  }
  for (const Triangles& part : parts)
  {
    mesh.parts.push_back({ mesh.triangles.size(), part.size(), false });
    mesh.triangles.insert(mesh.triangles.end(), part.begin(), part.end());
    mesh.parts.back().closed = isClosed(mesh, mesh.parts.back());
    if (mesh.parts.back().closed)
    {
      turnOut(mesh, mesh.parts.back());
    }
  }
  return mesh;
}

std::shared_ptr<const SolidMesh> solidOf(SampleModels& models, const std::string& path)
{
  return models.kept<SolidMesh>("solid\n" + path,
    [&]
    {
      const std::shared_ptr<const Model> model = models.model(path);
      return std::make_shared<const SolidMesh>(solidMesh(model->rest->positions, model->triangles));
    });
}

ConvexHull fewCorners(const ConvexHull& piece, double size)
{
  return simplifiedHull(piece, std::min(cornerTolerance * size, 0.05 * std::cbrt(piece.volume)));
}

std::shared_ptr<const std::vector<ConvexHull>> piecesOf(SampleModels& models, const std::string& path)
{
  return models.kept<std::vector<ConvexHull>>("pieces\n" + path,
    [&]
    {
      const std::shared_ptr<const SolidMesh> mesh = solidOf(models, path);
      const double tolerance = pieceTolerance * sizeOf(*mesh);
      auto pieces = std::make_shared<std::vector<ConvexHull>>();
      std::vector<SolidMesh::Part> parts = mesh->parts;
      if (parts.size() > mostPieces)
      {
        parts = { { 0, mesh->triangles.size(), false } }; // leaves of a tree: what is near is one
      }
      for (const SolidMesh::Part& part : parts)
      {
        const TriangleTree tree(*mesh, part.first, part.count);
        const auto inside = [&](const Eigen::Vector3d& x) { return part.closed && tree.holds(x); };
        const auto first = mesh->triangles.begin() + std::ptrdiff_t(part.first);
        const std::vector<ConvexHull> some =
          convexPieces(mesh->points, Triangles(first, first + std::ptrdiff_t(part.count)), tolerance,
            std::max<std::size_t>(1, mostPieces / parts.size()), inside);
        for (const ConvexHull& piece : some)
        {
          pieces->push_back(fewCorners(piece, sizeOf(*mesh)));
        }
      }
      return std::shared_ptr<const std::vector<ConvexHull>>(pieces);
    });
}

} // namespace dgtk
