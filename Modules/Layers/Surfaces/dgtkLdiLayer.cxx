// SPDX-License-Identifier: BSD-3-Clause
// Layered depth images: every surface along the ray through a pixel's centre.
#include "dgtkLayeredDepth.h"
#include "dgtkLayers.h"
#include "dgtkStrips.h"

#include <algorithm>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool; the records of a batch of jobs are held at once.
constexpr int stripPixels = 1 << 14;

/// Full-width rows of the ranks of a band; ranks of several tiles are put side by side.
class Ranks
{
public:
  Ranks(const Band& band, const PixelRect& rows)
  {
    const bool whole = band.peeled.size() == 1;
    std::size_t count = 0;
    for (const auto& tile : band.peeled)
    {
      count = std::max(count, tile.size());
    }
    const std::size_t pixels = std::size_t(rows.width) * rows.height;
    this->Hits.resize(whole ? 0 : count * pixels);
    this->Colors.resize(whole ? 0 : count * pixels * 4);
    for (std::size_t r = 0; r < count; ++r)
    {
      if (whole)
      {
        const SurfaceLayer& layer = band.peeled[0][r];
        const std::size_t first = std::size_t(rows.y - layer.rect.y) * layer.rect.width;
        this->Rows.push_back({ layer.hits.data() + first, layer.rgba.data() + 4 * first });
      }
      else
      {
        this->gather(band, rows, r, pixels);
      }
    }
  }

  const std::vector<PeeledRows>& rows() const { return this->Rows; }

private:
  void gather(const Band& band, const PixelRect& rows, std::size_t rank, std::size_t pixels)
  {
    Hit* hits = this->Hits.data() + rank * pixels;
    float* colors = this->Colors.data() + rank * pixels * 4;
    this->Rows.push_back({ hits, colors });
    for (const auto& tile : band.peeled)
    {
      if (rank >= tile.size())
      {
        continue;
      }
      const PixelRect& rect = tile[rank].rect;
      for (int y = 0; y < rows.height; ++y)
      {
        const std::size_t from = std::size_t(rows.y + y - rect.y) * rect.width;
        const std::size_t to = std::size_t(y) * rows.width + rect.x;
        std::copy_n(tile[rank].hits.data() + from, rect.width, hits + to);
        std::copy_n(tile[rank].rgba.data() + 4 * from, 4 * std::size_t(rect.width), colors + 4 * to);
      }
    }
  }

  std::vector<PeeledRows> Rows;
  std::vector<Hit> Hits;
  std::vector<float> Colors;
};

class LdiPass : public LayerPass
{
public:
  explicit LdiPass(const JobContext& context)
    : Context(context)
  {
    const CameraDescription& camera = context.queries.stage().description().cameras[context.job.camera];
    const LayerRequest& request = context.plan.request;
    this->OwnColor = option::samples().of(request.options) == 1 && drawsItself(request) && !camera.shutter.blurs() &&
                     !camera.lens.blurs();
  }

  void band(const Band& band, LayerSink& sink) override
  {
    forStrips(
      band, stripPixels, 2 * this->Context.pool.threads(), this->Context.pool,
      [&](const PixelRect& rect, const Hit* hits) { return this->derive(band, rect, hits); },
      [&sink](const LdiRows& rows) { sink.surfaces(0, rows); });
  }

private:
  LdiRows derive(const Band& band, const PixelRect& rect, const Hit* hits) const
  {
    LayeredInput in;
    in.rect = rect;
    in.first = hits;
    in.rgb = this->OwnColor && !band.rgb.empty() ? band.rgb.data() + 3 * (hits - band.hits.data()) : nullptr;
    const Ranks ranks(band, in.rect);
    in.ranks = ranks.rows();
    LayeredRows layered;
    layeredDepthRows(*this->Context.state, this->Context.view, in, layered);

    LdiRows rows;
    rows.y = in.rect.y;
    rows.height = in.rect.height;
    rows.counts = std::move(layered.counts);
    rows.surfaces.reserve(layered.surfaces.size());
    for (const LayeredSurface& surface : layered.surfaces)
    {
      const Model& model = *this->Context.state->instances[surface.hit.object - 1].model;
      const std::uint32_t part = model.partOf(surface.hit.triangle);
      rows.surfaces.push_back({ surface.rgba, surface.depth, surface.splatIndex, surface.hit.object, part,
        surface.hit.triangle - model.parts[part].firstTriangle });
    }
    return rows;
  }

  JobContext Context;
  bool OwnColor = true; ///< the picture's colour is that of the first surfaces: one sample, the built-in renderer
};

class LdiLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "ldi", { "ldi", "exr" }, "layered depth image: every surface along each ray, with colour and depth" };
  }

  LayerNeeds needs(const LayerRequest&, const Stage&) const override
  {
    LayerNeeds needs;
    needs.hits = true;
    needs.peeled = true;
    return needs;
  }

  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    if (format == "exr")
    {
      return { { { "ldi", PixelType::Float32, 8, "linear sRGB, scene units, id", "camera", "no sample",
                   "deep image of every surface along the ray through the pixel's centre, near to far: R, G, B, A "
                   "(premultiplied), Z (depth), id, part, triangle (uint32)",
                   Meaning::Surfaces },
        format } };
    }
    return { { { "ldi", PixelType::Float64, 1, "scene units", "camera", "no record",
                 "for each pixel a count and for every surface along the ray through the pixel's centre, near to far, "
                 "R, G, B, A (uint8, sRGB), depth (float64) and splat index (uint32)",
                 Meaning::Surfaces },
      format } };
  }

  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    const LayerSpec spec = this->records(plan, planned.formats.front()).front().spec;
    return { imageOutput(plan, stage, job, spec, planned.formats) };
  }

  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<LdiPass>(context);
  }
};
} // namespace

LayerList ldiLayers() { return { std::make_shared<LdiLayer>() }; }

} // namespace dgtk
