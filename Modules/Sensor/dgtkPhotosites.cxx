// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPhotosites.h"

#include "dgtkMosaic.h"

#include <algorithm>
#include <cmath>

namespace dgtk::sensor
{

Photosites::Photosites(const ImageSensorSetup& setup)
  : Setup(setup)
  , Texture(setup.parameters.texture,
      setup.parameters.texture.fixed ? setup.key.fixed(NoiseKey::Texture) : setup.key.random(NoiseKey::Texture))
  , Shot(setup.key.random(NoiseKey::Shot))
  , Fixed(setup.key.fixed(NoiseKey::FixedPattern))
  , RowPattern(setup.key.fixed(NoiseKey::RowPattern))
  , Read(setup.key.random(NoiseKey::Read))
  , Columns(static_cast<std::size_t>(setup.width), 0.0)
{
  const CounterRandom columns = setup.key.fixed(NoiseKey::ColumnPattern);
  for (std::size_t x = 0; x < this->Columns.size() && setup.parameters.columnNoise > 0; ++x)
  {
    this->Columns[x] = setup.parameters.columnNoise * columns.normal(static_cast<std::uint32_t>(x), 0, 0);
  }
}

double Photosites::vignetting(int x, int y) const
{
  const VignettingParameters& v = this->Setup.parameters.vignetting;
  double factor = 1;
  if (v.cos4 > 0 && this->Setup.fieldCosine)
  {
    const double c = this->Setup.fieldCosine(x, y);
    factor = 1 - v.cos4 + v.cos4 * (c * c) * (c * c);
  }
  if (v.polynomial != std::array<double, 3>{ { 0, 0, 0 } })
  {
    const double w = this->Setup.width;
    const double h = this->Setup.height;
    const double dx = x + 0.5 - w / 2;
    const double dy = y + 0.5 - h / 2;
    const double rr = (dx * dx + dy * dy) / ((w * w + h * h) / 4);
    factor *= 1 + rr * (v.polynomial[0] + rr * (v.polynomial[1] + rr * v.polynomial[2]));
  }
  return std::max(factor, 0.0);
}

double Photosites::reading(double light, int x, int y, int channel, double offset) const
{
  const ColorSensorParameters& p = this->Setup.parameters;
  const auto px = static_cast<std::uint32_t>(x);
  const auto py = static_cast<std::uint32_t>(y);
  const auto draw = static_cast<std::uint32_t>(channel);
  double electrons = light * p.exposure * p.fullWell + p.darkSignal;
  if (p.shotNoise)
  {
    electrons = this->Shot.poisson(electrons, px, py, draw);
  }
  if (p.prnu > 0 || p.dsnu > 0)
  {
    const std::array<double, 2> pattern = this->Fixed.normals(px, py, draw);
    electrons *= 1 + p.prnu * pattern[0];
    offset += p.dsnu * pattern[1];
  }
  electrons = std::min(electrons, p.fullWell) + offset;
  if (p.readNoise > 0)
  {
    electrons += p.readNoise * this->Read.normal(px, py, draw);
  }
  double value = electrons * p.gain / p.fullWell + p.blackLevel;
  if (p.bits > 0)
  {
    const double top = std::ldexp(1.0, p.bits) - 1;
    value = std::floor(value * top + 0.5) / top;
  }
  return std::min(std::max(value, 0.0), 1.0);
}

std::vector<float> Photosites::expose(int y, const std::vector<float>& light) const
{
  const ColorSensorParameters& p = this->Setup.parameters;
  const bool mosaic = p.bayer != BayerPattern::None;
  const double rowOffset =
    p.rowNoise > 0 ? p.rowNoise * this->RowPattern.normal(0, static_cast<std::uint32_t>(y), 0) : 0;
  const int width = this->Setup.width;
  std::vector<float> out(std::size_t(width) * (mosaic ? 1 : 3));
  for (int x = 0; x < width; ++x)
  {
    const double factor = this->vignetting(x, y);
    const double texture = this->Texture.none() ? 0 : this->Texture.at(x, y);
    const double offset = rowOffset + this->Columns[static_cast<std::size_t>(x)];
    const int first = mosaic ? bayerChannel(p.bayer, x, y) : 0;
    const int last = mosaic ? first : 2;
    for (int c = first; c <= last; ++c)
    {
      double l = light[std::size_t(x) * 3 + c] * factor;
      l = p.texture.multiplicative ? l * (1 + texture) : l + texture;
      out[mosaic ? std::size_t(x) : std::size_t(x) * 3 + c] =
        static_cast<float>(this->reading(std::max(l, 0.0), x, y, c, offset));
    }
  }
  return out;
}

} // namespace dgtk::sensor
