// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJsonRows.h"

namespace dgtk::scenefile
{

namespace
{
void readKeypoints(const JsonCursor& at, ObjectDescription& object)
{
  for (std::size_t i = 0, n = at.memberCount(); i < n; ++i)
  {
    KeypointDescription point;
    point.name = at.key(i);
    const JsonCursor member = at.member(i);
    const std::string fault = faultOfText(point.name, false);
    if (!fault.empty())
    {
      member.fail("has a name that cannot be used", fault);
    }
    if (member.node().type == JsonNode::Type::Number)
    {
      point.vertex = static_cast<std::uint32_t>(member.wholeNumber(rules::vertex));
    }
    else if (member.node().type == JsonNode::Type::Array)
    {
      point.position = member.vector(rules::coordinate);
    }
    else
    {
      member.failType("[x, y, z] in object coordinates, or the number of a vertex");
    }
    object.keypoints.push_back(point);
  }
}

void writeKeypoints(const ObjectDescription& object, const char* key, JsonNode& node)
{
  JsonNode points(JsonNode::Type::Object);
  for (const KeypointDescription& point : object.keypoints)
  {
    points.add(point.name, point.vertex ? JsonNode::of(double(*point.vertex)) : writeValue(point.position));
  }
  if (!points.children.empty())
  {
    node.add(key, std::move(points));
  }
}
} // namespace

JsonField<ObjectDescription> keypointsRow() { return { "keypoints", readKeypoints, writeKeypoints }; }

} // namespace dgtk::scenefile
