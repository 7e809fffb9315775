// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlacement.h"

#include "dgtkJson.h"

namespace dgtk
{

std::vector<PlacedObject> placeObjects(
  SceneDescription&, const std::vector<SampleRule>& rules, const SampleDraws&, SampleModels&)
{
  if (!rules.empty())
  {
    JsonCursor(rules.front().rule).fail("cannot be done by this version");
  }
  return {};
}

SurfacePoint pointOnSurface(
  const SceneDescription& scene, std::size_t object, double, const std::array<double, 3>&, SampleModels&)
{
  const ObjectDescription& it = scene.objects[object];
  throw InputError(
    scene.title(), it.line, "points on the surface of " + quoted(it.name) + " cannot be drawn by this version");
}

} // namespace dgtk
