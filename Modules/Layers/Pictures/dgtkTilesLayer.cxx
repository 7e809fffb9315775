// SPDX-License-Identifier: BSD-3-Clause
// The thesis's tile images: the picture cut into files.
#include "dgtkColorRows.h"

#include <algorithm>
#include <cstdio>

namespace dgtk
{

namespace
{
constexpr const char* tilesName = "tiles";
constexpr int largestTile = 1 << 20;
const SizeOption tileOption("tile", 640, 480, largestTile,
  "size of the images of the tiles layer, pixels; may exceed the picture and need not divide it");
// Rows that are cut at once.
constexpr int tilesBlock = 1 << 18;

/// Tiles from left to right, row by row.
class TilesPass : public LayerPass
{
public:
  TilesPass(const LayerRequest& request, const CameraModel& model)
    : Spec(colorSpec(request, "png"))
    , Curve(request)
    , Width(model.width())
    , TileWidth(std::min(tileOption.width(request.options), model.width()))
    , TileHeight(std::min(tileOption.height(request.options), model.height()))
  {
  }

  void band(const Band& band, LayerSink& sink) override
  {
    const int end = band.rect.y + band.rect.height;
    for (int y = band.rect.y; y < end;)
    {
      const int row = y / this->TileHeight;
      const int stop = std::min({ end, (row + 1) * this->TileHeight, y + std::max(1, tilesBlock / this->Width) });
      this->cut(quantise(band, this->Spec, y, stop - y, &Band::rgb, this->Curve), row, sink);
      y = stop;
    }
  }

private:
  void cut(const Rows& rows, int tileRow, LayerSink& sink) const
  {
    const std::size_t pixelBytes = rows.rowBytes() / rows.width();
    const int columns = (this->Width + this->TileWidth - 1) / this->TileWidth;
    for (int column = 0; column < columns; ++column)
    {
      const int x = column * this->TileWidth;
      const int width = std::min(this->TileWidth, this->Width - x);
      Rows part(rows.type(), rows.channels(), width, rows.y() - tileRow * this->TileHeight, rows.height());
      for (int r = 0; r < rows.height(); ++r)
      {
        std::copy_n(
          rows.data() + r * rows.rowBytes() + x * pixelBytes, part.rowBytes(), part.data() + r * part.rowBytes());
      }
      sink.rows(std::size_t(tileRow) * columns + column, part);
    }
  }

  LayerSpec Spec;
  PictureCurve Curve;
  int Width;
  int TileWidth;
  int TileHeight;
};

class TilesLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { tilesName, { "png" }, "the picture cut into tiles", false, "it is color cut into files" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofColor(); }
  /// The manifest knows them by the picture.
  std::vector<LayerRecord> records(const WorkPlan&, const std::string&) const override { return {}; }
  std::vector<const OptionRow*> options() const override { return { &tileOption }; }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    const LayerOutput whole = imageOutput(plan, stage, job, colorSpec(plan.request, "png"), planned.formats);
    const std::string stem = WorkPlan::stem(stage.description().cameras[job.camera].name, tilesName, job.frame);
    const int tileWidth = tileOption.width(plan.request.options);
    const int tileHeight = tileOption.height(plan.request.options);
    std::vector<LayerOutput> tiles;
    for (int y = 0; y < whole.height; y += tileHeight)
    {
      for (int x = 0; x < whole.width; x += tileWidth)
      {
        LayerOutput tile = whole;
        tile.layer = tilesName;
        tile.name = tilesName;
        tile.isOneOfMany = true;
        tile.path = stem + '_' + std::to_string(y / tileHeight) + '_' + std::to_string(x / tileWidth);
        tile.width = std::min(tileWidth, whole.width - x);
        tile.height = std::min(tileHeight, whole.height - y);
        tiles.push_back(tile);
      }
    }
    return tiles;
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<TilesPass>(context.plan.request, *context.view.model);
  }
};
} // namespace

LayerList tilesLayers() { return { std::make_shared<TilesLayer>() }; }

} // namespace dgtk
