// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorRows.h"

#include "dgtkPortableMath.h"

#include <algorithm>
#include <emmintrin.h>
#include <limits>

namespace dgtk
{

namespace
{
template <typename T>
void round(const float* from, T* to, std::size_t count)
{
  constexpr float top = std::numeric_limits<T>::max();
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = static_cast<T>(std::min(std::max(from[i], 0.0f), 1.0f) * top + 0.5f);
  }
}

/// The same, 16 values at a time.
void round(const float* from, std::uint8_t* to, std::size_t count)
{
  constexpr std::size_t many = 16;
  const auto rounded = [](const float* four)
  {
    const __m128 cut = _mm_min_ps(_mm_max_ps(_mm_loadu_ps(four), _mm_setzero_ps()), _mm_set1_ps(1));
    return _mm_cvttps_epi32(_mm_add_ps(_mm_mul_ps(cut, _mm_set1_ps(255)), _mm_set1_ps(0.5F)));
  };
  std::size_t i = 0;
  for (; i + many <= count; i += many)
  {
    const __m128i low = _mm_packs_epi32(rounded(from + i), rounded(from + i + 4));
    const __m128i high = _mm_packs_epi32(rounded(from + i + 8), rounded(from + i + 12));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i), _mm_packus_epi16(low, high));
  }
  round<std::uint8_t>(from + i, to + i, count - i);
}

// Rows that are encoded at once.
constexpr int blockPixels = 1 << 18;

class ColorPass : public LayerPass
{
public:
  ColorPass(const JobContext& context, const std::vector<PassLayer>& layers, std::vector<float> Band::*rgb)
    : Pool(context.pool)
    , Rgb(rgb)
    , Curve(context.plan.request)
  {
    for (const PassLayer& layer : layers)
    {
      for (const LayerOutput& output : layer.outputs)
      {
        this->Specs.push_back(output.spec);
      }
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    const int rows = std::max(1, blockPixels / band.rect.width);
    this->Pool.parallelFor(static_cast<int>(this->Specs.size()),
      [&](int i)
      {
        const auto output = static_cast<std::size_t>(i);
        for (int y = 0; y < band.rect.height; y += rows)
        {
          const int height = std::min(rows, band.rect.height - y);
          sink.rows(output, quantise(band, this->Specs[output], band.rect.y + y, height, this->Rgb, this->Curve));
        }
      });
  }

private:
  ThreadPool& Pool;
  std::vector<float> Band::*Rgb;
  PictureCurve Curve;
  std::vector<LayerSpec> Specs; // one an output
};
} // namespace

Rows quantise(
  const Band& band, const LayerSpec& spec, int y, int height, std::vector<float> Band::*rgb, const PictureCurve& curve)
{
  const std::size_t rowValues = std::size_t(band.rect.width) * 3;
  const std::size_t count = rowValues * height;
  const float* from = (band.*rgb).data() + std::size_t(y - band.rect.y) * rowValues;
  std::vector<float> curved;
  if (curve.changes())
  {
    curved.resize(count);
    std::transform(from, from + count, curved.begin(), curve);
    from = curved.data();
  }
  Rows rows(spec.type, 3, band.rect.width, y, height);
  switch (spec.type)
  {
    case PixelType::UInt8:
      round(from, rows.row<std::uint8_t>(y), count);
      break;
    case PixelType::UInt16:
      round(from, rows.row<std::uint16_t>(y), count);
      break;
    default:
      std::transform(from, from + count, rows.row<float>(y), portable::linearFromEncoded);
  }
  return rows;
}

LayerSpec colorSpec(const LayerRequest& request, const std::string& format)
{
  LayerSpec spec;
  spec.name = pictureLayer;
  spec.channels = 3;
  spec.frame = "image";
  spec.invalid = "none";
  spec.meaning = Meaning::Picture;
  if (format == "exr")
  {
    spec.type = PixelType::Float32;
    spec.unit = "linear sRGB";
    spec.description = "The picture in linear light, primaries of sRGB; red, green, blue.";
  }
  else
  {
    spec.type = option::colorBits().of(request.options) == "16" ? PixelType::UInt16 : PixelType::UInt8;
    spec.unit = "sRGB";
    spec.description = "The picture as it is displayed, sRGB-encoded; red, green, blue.";
  }
  return spec;
}

std::unique_ptr<LayerPass> makeColorPass(
  const JobContext& context, const std::vector<PassLayer>& layers, std::vector<float> Band::*rgb)
{
  return std::make_unique<ColorPass>(context, layers, rgb);
}

std::vector<LayerOutput> colorOutputs(const WorkPlan& plan, const Stage& stage, const Job& job,
  const PlannedLayer& planned, LayerSpec (*specOf)(const LayerRequest& request, const std::string& format))
{
  std::vector<LayerOutput> outputs;
  for (const std::string& format : planned.formats)
  {
    outputs.push_back(imageOutput(plan, stage, job, specOf(plan.request, format), { format }));
  }
  return outputs;
}

} // namespace dgtk
