// SPDX-License-Identifier: BSD-3-Clause
// Layered depth images: every surface along the ray through a pixel's centre.
#include "dgtkInstantSource.h"
#include "dgtkLayeredDepth.h"
#include "dgtkLayers.h"
#include "dgtkStrips.h"

#include <algorithm>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool; the records of a batch of jobs are held at once.
constexpr int ldiStrip = 1 << 14;

/// What was peeled of pixels of a band, full-width rows or a part of one row.
class Peeled
{
public:
  Peeled(const Band& band, const PixelRect& rows)
  {
    if (band.peeled.size() == 1)
    {
      const SurfaceLists& all = band.peeled.front();
      this->Begins =
        all.first.data() + std::size_t(rows.y - all.rect.y) * std::size_t(all.rect.width) + (rows.x - all.rect.x);
      this->point(all.hits.data() + *this->Begins, all.rgba.data() + 4 * std::size_t(*this->Begins));
      return;
    }
    this->Own.first.push_back(0);
    for (int y = rows.y; y < rows.y + rows.height; ++y)
    {
      for (const SurfaceLists& tile : band.peeled)
      {
        this->add(tile, rows, y);
      }
    }
    this->Begins = this->Own.first.data();
    this->point(this->Own.hits.data(), this->Own.rgba.data());
  }

  void giveTo(LayeredInput& in) const
  {
    in.begins = this->Begins;
    in.hits = this->Hits;
    in.rgba = this->Rgba;
  }

private:
  void point(const Hit* hits, const float* rgba)
  {
    this->Hits = hits;
    this->Rgba = rgba;
  }

  /// What a tile has of row `y` of `rows`.
  void add(const SurfaceLists& tile, const PixelRect& rows, int y)
  {
    const int begin = std::max(tile.rect.x, rows.x);
    const int end = std::min(tile.rect.x + tile.rect.width, rows.x + rows.width);
    const std::size_t row = std::size_t(y - tile.rect.y) * std::size_t(tile.rect.width);
    for (int x = begin; x < end; ++x)
    {
      const std::uint32_t* const first = tile.first.data() + row + std::size_t(x - tile.rect.x);
      this->Own.hits.insert(this->Own.hits.end(), tile.hits.begin() + first[0], tile.hits.begin() + first[1]);
      this->Own.rgba.insert(this->Own.rgba.end(), tile.rgba.begin() + 4 * std::ptrdiff_t(first[0]),
        tile.rgba.begin() + 4 * std::ptrdiff_t(first[1]));
      this->Own.first.push_back(std::uint32_t(this->Own.hits.size()));
    }
  }

  SurfaceLists Own; ///< of several tiles
  const std::uint32_t* Begins = nullptr;
  const Hit* Hits = nullptr;
  const float* Rgba = nullptr;
};

class LdiPass : public LayerPass
{
public:
  explicit LdiPass(const JobContext& context)
    : Context(context)
  {
    const CameraDescription& camera = context.queries.stage().description().cameras[context.job.camera];
    const LayerRequest& request = context.plan.request;
    this->OwnColor = option::samples().of(request.options) == 1 && drawsItself(request) && !camera.blurs();
  }

  void band(const Band& band, LayerSink& sink) override
  {
    forStrips(
      band, ldiStrip, 2 * this->Context.pool.threads(), this->Context.pool,
      [&](const PixelRect& rect, const Hit* hits) { return this->derive(band, rect, hits); },
      [&sink](const LdiRows& rows) { sink.surfaces(0, rows); });
  }

private:
  LdiRows derive(const Band& band, const PixelRect& rect, const Hit* hits) const
  {
    LdiRows rows;
    rows.y = rect.y;
    rows.height = rect.height;
    const View& view = this->Context.view;
    if (!view.instants)
    {
      this->addPart(*this->Context.state, view, { band, rect, hits }, rows);
      return rows;
    }
    for (const TimedRect& run : timedRuns(*view.model, rect))
    {
      const SeenInstant now = instantOf(view, run.time);
      const std::ptrdiff_t first = std::ptrdiff_t(run.rect.y - rect.y) * rect.width + (run.rect.x - rect.x);
      this->addPart(*now.state, now.view, { band, run.rect, hits + first }, rows);
    }
    return rows;
  }

  /// Pixels of a band, whole rows or a run of one row, with their hits.
  struct Part
  {
    const Band& band;
    PixelRect rect;
    const Hit* hits;
  };

  void addPart(const SceneState& state, const View& view, const Part& part, LdiRows& rows) const
  {
    LayeredInput in;
    in.rect = part.rect;
    in.first = part.hits;
    in.rgb = this->OwnColor && !part.band.rgb.empty() ? part.band.rgb.data() + 3 * (part.hits - part.band.hits.data())
                                                      : nullptr;
    const Peeled peeled(part.band, in.rect);
    peeled.giveTo(in);
    LayeredRows layered;
    layeredDepthRows(state, view, in, layered);
    rows.counts.insert(rows.counts.end(), layered.counts.begin(), layered.counts.end());
    for (const LayeredSurface& surface : layered.surfaces)
    {
      const Instance& instance = state.instances[surface.hit.object - 1];
      const std::uint32_t of = instance.model->partOf(surface.hit.triangle);
      rows.surfaces.push_back(
        { surface.rgba, surface.depth, surface.splatIndex, state.objectOf(surface.hit.object), instance.firstPart + of,
          instance.firstInPart + surface.hit.triangle - instance.model->parts[of].firstTriangle });
    }
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
