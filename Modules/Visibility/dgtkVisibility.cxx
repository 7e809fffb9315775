// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkVisibility.h"

#include "dgtkColorMap.h"
#include "dgtkError.h"
#include "dgtkSurfaceRows.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int maximumSide = 1 << 20;
constexpr int singleTileSide = 4096;
constexpr long singleTilePixels = 4L << 20;
constexpr int largeTileWidth = 2048;
constexpr int largeTileHeight = 512;
constexpr int halfAlpha = 128;
} // namespace

TileGrid::TileGrid(int width, int height)
  : Width(width)
  , Height(height)
{
  if (width < 1 || height < 1 || width > maximumSide || height > maximumSide)
  {
    throw UsageError("image size out of range (expected 1 to " + std::to_string(maximumSide) +
                     " pixels a side, found " + std::to_string(width) + " x " + std::to_string(height) + ")");
  }
  const bool single = width <= singleTileSide && height <= singleTileSide && long(width) * height <= singleTilePixels;
  this->TileWidth = single ? width : largeTileWidth;
  this->TileHeight = single ? height : largeTileHeight;
  this->Columns = (width + this->TileWidth - 1) / this->TileWidth;
  this->RowCount = (height + this->TileHeight - 1) / this->TileHeight;
}

PixelRect TileGrid::tile(int column, int row) const
{
  if (column < 0 || row < 0 || column >= this->Columns || row >= this->RowCount)
  {
    throw UsageError("no tile " + std::to_string(column) + ", " + std::to_string(row) + " in a grid of " +
                     std::to_string(this->Columns) + " x " + std::to_string(this->RowCount));
  }
  const int x = column * this->TileWidth;
  const int y = row * this->TileHeight;
  return { x, y, std::min(this->TileWidth, this->Width - x), std::min(this->TileHeight, this->Height - y) };
}

void triangleInWorld(const SceneState& state, const Hit& hit, Eigen::Vector3d corners[3])
{
  const Instance& instance = state.instances.at(std::size_t(hit.object) - 1);
  const auto& triangle = instance.model->triangles.at(hit.triangle);
  for (int i = 0; i < 3; ++i)
  {
    corners[i] = instance.world_from_object * instance.geometry->positions[triangle[i]];
  }
}

bool isCutOut(const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics)
{
  const Model& model = *instance.model;
  const std::vector<Material>& materials = instance.materials ? *instance.materials : model.materials;
  if (model.uvs.empty() || materials.empty())
  {
    return false;
  }
  const Material& material = materials[model.parts[model.partOf(triangle)].material];
  const std::uint8_t* const texel =
    material.cutOut ? nearestTexel(model, triangle, barycentrics, material.texture) : nullptr;
  return texel != nullptr && texel[3] < halfAlpha;
}

} // namespace dgtk
