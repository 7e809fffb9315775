// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkValueUniforms.h"

#include <array>

namespace dgtk
{

namespace
{
constexpr int digits = 32;

/// The place of the next point in dimension d of Sobol's sequence, by bits.
std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension)
{
  struct Polynomial
  {
    unsigned degree;
    unsigned coefficients;
    std::array<std::uint32_t, 3> first;
  };
  static constexpr Polynomial polynomials[] = { { 1, 0, { 1, 0, 0 } }, { 2, 1, { 1, 3, 0 } }, { 3, 1, { 1, 3, 1 } } };
  std::array<std::uint32_t, digits> directions{};
  for (unsigned i = 0; i < digits; ++i)
  {
    if (dimension == 0)
    {
      directions[i] = 1U << (31 - i);
      continue;
    }
    const Polynomial& p = polynomials[dimension - 1];
    if (i < p.degree)
    {
      directions[i] = p.first[i] << (31 - i);
      continue;
    }
    std::uint32_t v = directions[i - p.degree] ^ (directions[i - p.degree] >> p.degree);
    for (unsigned k = 1; k < p.degree; ++k)
    {
      v ^= ((p.coefficients >> (p.degree - 1 - k)) & 1U) * directions[i - k];
    }
    directions[i] = v;
  }
  std::uint32_t place = 0;
  for (unsigned i = 0; i < digits; ++i)
  {
    place ^= ((index >> i) & 1U) * directions[i];
  }
  return place;
}

/// Each binary digit is changed or not as the digits before it decide.
std::uint32_t nested(std::uint32_t place, PhiloxKey key, std::uint32_t purpose)
{
  std::uint32_t out = 0;
  for (std::uint32_t level = 0; level < digits; ++level)
  {
    const std::uint32_t before = level == 0 ? 0 : place >> (digits - level);
    const std::uint32_t flip = philox({ before, level, purpose, 0 }, key)[0] & 1U;
    const std::uint32_t digit = (place >> (digits - 1 - level)) & 1U;
    out = (out << 1) | (digit ^ flip);
  }
  return out;
}
} // namespace

double ValueUniforms::operator()(std::uint32_t dimension) const
{
  if (!this->Stratify || dimension >= stratified)
  {
    return this->Draws->uniform(this->Path, dimension, this->Attempt);
  }
  const PhiloxCounter bits = SampleDraws(this->Draws->seed(), 0).block(this->Path + "\nstratify");
  const PhiloxKey key{ bits[0], bits[1] };
  const auto sample = std::uint32_t(this->Draws->sample());
  const std::uint32_t index = nested(sample, key, 0);
  const std::uint32_t place = sobol(index, dimension);
  const std::uint32_t high = nested(place, key, 1 + dimension);
  const std::uint32_t low = philox({ place, digits, 1 + dimension, 0 }, key)[0] >> 11;
  return double((std::uint64_t(high) << 21) | low) * 0x1p-53;
}

} // namespace dgtk
