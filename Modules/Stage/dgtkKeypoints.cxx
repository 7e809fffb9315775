// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeypoints.h"

#include "dgtkStageModels.h"

#include <algorithm>
#include <optional>

namespace dgtk
{

namespace
{
/// The first of the split vertices that stand for a vertex of the file.
std::optional<std::size_t> splitVertexOf(const Model& model, std::uint32_t vertex)
{
  const auto found = std::find(model.sourceVertex.begin(), model.sourceVertex.end(), vertex);
  return found == model.sourceVertex.end() ? std::nullopt
                                           : std::optional<std::size_t>(found - model.sourceVertex.begin());
}
} // namespace

void checkKeypoints(const SceneDescription& scene, const ObjectDescription& object, const Model& model)
{
  for (const KeypointDescription& point : object.keypoints)
  {
    if (point.vertex && *point.vertex >= model.sourceVertices)
    {
      failObject(scene, object, "keypoints." + point.name + " is no vertex of " + object.model,
        "a whole number below " + std::to_string(model.sourceVertices), std::to_string(*point.vertex));
    }
    if (point.vertex && !splitVertexOf(model, *point.vertex))
    {
      failObject(scene, object, "keypoints." + point.name + " is a vertex of no triangle of " + object.model,
        "a vertex of a surface", std::to_string(*point.vertex));
    }
  }
}

std::vector<KeypointState> keypointsAt(const ObjectDescription& object, const Model& model, const Geometry& geometry)
{
  std::vector<KeypointState> points;
  for (const KeypointDescription& point : object.keypoints)
  {
    const std::optional<std::size_t> vertex = point.vertex ? splitVertexOf(model, *point.vertex) : std::nullopt;
    if (vertex || !point.vertex)
    {
      points.push_back({ point.name, vertex ? geometry.positions[*vertex] : point.position });
    }
  }
  return points;
}

} // namespace dgtk
