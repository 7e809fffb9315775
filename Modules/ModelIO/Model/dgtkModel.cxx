// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModel.h"

#include "dgtkModelBuilder.h"

#include <algorithm>

namespace dgtk
{

std::optional<std::size_t> Model::splitVertexOf(std::uint32_t fileVertex) const
{
  if (fileVertex >= this->fileVertices())
  {
    return std::nullopt;
  }
  const std::uint32_t source = this->sourceOf.empty() ? fileVertex : this->sourceOf[fileVertex];
  const auto found = std::find(this->sourceVertex.begin(), this->sourceVertex.end(), source);
  return found == this->sourceVertex.end() ? std::nullopt
                                           : std::optional<std::size_t>(found - this->sourceVertex.begin());
}

std::uint32_t Model::partOf(std::uint32_t triangle) const
{
  const auto after = std::upper_bound(this->parts.begin(), this->parts.end(), triangle,
    [](std::uint32_t value, const Part& part) { return value < part.firstTriangle; });
  return static_cast<std::uint32_t>(after - this->parts.begin()) - 1;
}

bool Model::reachesBeyondPictures(const Part& part) const
{
  constexpr double rounding = 1e-6;
  const auto isOutside = [this](std::uint32_t vertex)
  { return (this->uvs[vertex].array() < -rounding).any() || (this->uvs[vertex].array() > 1 + rounding).any(); };
  const auto first = this->triangles.begin() + std::ptrdiff_t(part.firstTriangle);
  return !this->uvs.empty() &&
         std::any_of(first, first + std::ptrdiff_t(part.triangles),
           [&](const auto& corners) { return std::any_of(corners.begin(), corners.end(), isOutside); });
}

std::shared_ptr<const Geometry> geometryAt(const Model& model, int animation, double frame)
{
  if (!model.deformation)
  {
    return model.rest;
  }
  std::vector<Eigen::Vector3d> source;
  model.deformation->positionsAt(animation, frame, source);
  auto geometry = std::make_shared<Geometry>();
  geometry->positions.reserve(model.sourceVertex.size());
  for (const std::uint32_t vertex : model.sourceVertex)
  {
    geometry->positions.push_back(source[vertex]);
  }
  areaNormals(model, geometry->positions, model.rest ? &model.rest->normals : nullptr, geometry->normals);
  return geometry;
}

} // namespace dgtk
