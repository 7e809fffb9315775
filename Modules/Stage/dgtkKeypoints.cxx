// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeypoints.h"

#include "dgtkStageModels.h"

#include <optional>

namespace dgtk
{

void checkKeypoints(const SceneDescription& scene, const ObjectDescription& object, const Model& model)
{
  for (const KeypointDescription& point : object.keypoints)
  {
    if (point.vertex && !model.isNumbered)
    {
      failObject(scene, object,
        "keypoints." + point.name + " is the number of a vertex: those of " + object.model + " are not numbered",
        "a point [x, y, z]", std::to_string(*point.vertex));
    }
    if (point.vertex && *point.vertex >= model.fileVertices())
    {
      failObject(scene, object, "keypoints." + point.name + " is no vertex of " + object.model,
        "a whole number below " + std::to_string(model.fileVertices()), std::to_string(*point.vertex));
    }
    if (point.vertex && !model.splitVertexOf(*point.vertex))
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
    const std::optional<std::size_t> vertex = point.vertex ? model.splitVertexOf(*point.vertex) : std::nullopt;
    if (vertex || !point.vertex)
    {
      points.push_back({ point.name, vertex ? geometry.positions[*vertex] : point.position });
    }
  }
  return points;
}

} // namespace dgtk
