// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkComputeLayer_h
#define dgtkComputeLayer_h

#include "dgtkRepresentation.h"
#include "dgtkSyntheticScene.h"

#include <string>

namespace dgtk::test
{

/// Rows [y, y + height) of a layer of a buffer of a whole image.
inline Rows computeLayer(const std::string& layer, const SceneState& state, const View& view,
  const VisibilityBuffer& buffer, int y, int height)
{
  const auto representation = makeRepresentation(layer);
  const LayerSpec spec = representation->spec();
  const int width = buffer.rect.width;
  SurfaceRows surface;
  computeSurfaceRows(state, view, { 0, y, width, height }, buffer.hits.data() + std::size_t(y) * width,
    representation->needsBarycentrics(), surface);
  Rows rows(spec.type, spec.channels, width, y, height);
  representation->compute(surface, rows);
  return rows;
}

inline Rows computeLayer(
  const std::string& layer, const SceneState& state, const View& view, const VisibilityBuffer& buffer)
{
  return computeLayer(layer, state, view, buffer, 0, buffer.rect.height);
}

} // namespace dgtk::test

#endif
