// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSamples.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int leastRows = 8;
constexpr int mostSamples = 1 << 22; // of a strip, unless it has the least rows

} // namespace

View sampleView(const View& view, int i, int j, int count)
{
  View shifted = view;
  shifted.model = resampledCamera(
    view.model, view.model->width(), view.model->height(), 1, { sampleOffset(i, count), sampleOffset(j, count) });
  return shifted;
}

void SampledRows::gather(std::size_t pixel, std::uint32_t* ids, double* depths) const
{
  for (int k = 0; k < this->samples; ++k)
  {
    ids[k] = this->idOf(k, pixel);
    depths[k] = this->depth[k][pixel];
  }
}

PixelSampler::PixelSampler(std::shared_ptr<const SceneState> state, const View& view, int side,
  std::unique_ptr<VisibilitySource> source, ThreadPool& pool)
  : State(std::move(state))
  , Side(side)
  , Width(view.model->width())
  , Pool(pool)
  , Source(std::move(source))
{
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      this->Views.push_back(sampleView(view, i, j, side));
    }
  }
}

PixelSampler::~PixelSampler() = default;

int PixelSampler::stripRows() const
{
  return std::max(leastRows, mostSamples / (this->Side * this->Side) / this->Width / leastRows * leastRows);
}

void PixelSampler::sample(const PixelRect& rect, const Hit* own, SampledRows& rows)
{
  rows.rect = rect;
  rows.state = this->State;
  rows.samples = this->Side * this->Side;
  this->trace(rows, own);
  this->findMixed(rows);
  if (rows.anyMixed)
  {
    this->findDepths(rows);
  }
}

int PixelSampler::withoutRay(int x, int y) const
{
  return static_cast<int>(std::count_if(this->Views.begin(), this->Views.end(),
    [&](const View& view) {
      return !view.model->rayThrough({ x + 0.5, y + 0.5 }).exists();
    }));
}

void PixelSampler::trace(SampledRows& rows, const Hit* own)
{
  rows.hits.resize(this->Views.size());
  const std::size_t middle = this->Views.size() % 2 == 1 ? this->Views.size() / 2 : this->Views.size();
  for (std::size_t k = 0; k < this->Views.size(); ++k)
  {
    if (k == middle)
    {
      rows.hits[k].resize(rows.rect);
      std::copy_n(own, rows.hits[k].hits.size(), rows.hits[k].hits.begin());
      continue;
    }
    this->Source->setScene(this->State, this->Views[k]);
    this->Source->render(rows.rect, rows.hits[k]);
  }
}

void PixelSampler::findMixed(SampledRows& rows) const
{
  rows.mixed.assign(std::size_t(rows.rect.width) * rows.rect.height, 0);
  std::atomic<bool> any{ false };
  this->Pool.parallelFor(rows.rect.height,
    [&](int y)
    {
      const std::size_t first = std::size_t(y) * rows.rect.width;
      bool found = false;
      for (std::size_t k = 1; k < rows.hits.size(); ++k)
      {
        const Hit* one = rows.hits[0].hits.data() + first;
        const Hit* other = rows.hits[k].hits.data() + first;
        for (int x = 0; x < rows.rect.width; ++x)
        {
          const bool differs = one[x].object != other[x].object;
          rows.mixed[first + x] |= differs;
          found = found || differs;
        }
      }
      if (found)
      {
        any = true;
      }
    });
  rows.anyMixed = any;
}

void PixelSampler::findDepths(SampledRows& rows) const
{
  rows.depth.resize(this->Views.size());
  this->Pool.parallelFor(static_cast<int>(this->Views.size()),
    [&](int k)
    {
      std::vector<Hit> wanted = rows.hits[k].hits;
      for (std::size_t i = 0; i < wanted.size(); ++i)
      {
        wanted[i] = rows.mixed[i] ? wanted[i] : Hit{};
      }
      std::vector<double>& depth = rows.depth[k];
      depth.resize(wanted.size());
      forSurfaceRows(*this->State, this->Views[k], rows.rect, wanted.data(), false,
        [&](const SurfaceRows& surface)
        {
          const PixelRect& part = surface.rect;
          for (int y = 0; y < part.height; ++y)
          {
            std::copy_n(surface.t.data() + std::size_t(y) * part.width, part.width,
              depth.data() + std::size_t(part.y - rows.rect.y + y) * rows.rect.width + (part.x - rows.rect.x));
          }
        });
    });
}

Rows alphaRows(const SampledRows& samples, ThreadPool& pool)
{
  const PixelRect& rect = samples.rect;
  Rows rows(PixelType::UInt8, 4, rect.width, rect.y, rect.height);
  pool.parallelFor(rect.height,
    [&](int y)
    {
      std::vector<std::uint32_t> ids(samples.samples);
      std::vector<double> depths(samples.samples);
      std::uint8_t* out = rows.row<std::uint8_t>(rect.y + y);
      const std::size_t first = std::size_t(y) * rect.width;
      for (std::size_t i = first; i < first + rect.width; ++i, out += 4)
      {
        SampleCount found{ samples.idOf(0, i), std::uint32_t(samples.samples) };
        if (samples.mixed[i])
        {
          samples.gather(i, ids.data(), depths.data());
          found = nearestCoverage(ids.data(), depths.data(), samples.samples);
        }
        out[0] = static_cast<std::uint8_t>(found.id >> 16);
        out[1] = static_cast<std::uint8_t>(found.id >> 8);
        out[2] = static_cast<std::uint8_t>(found.id);
        out[3] = static_cast<std::uint8_t>(std::lround(255.0 * found.count / samples.samples));
      }
    });
  return rows;
}

} // namespace dgtk
