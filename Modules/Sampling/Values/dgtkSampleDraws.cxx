// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleDraws.h"

#include "dgtkHash.h"

namespace dgtk
{

PhiloxCounter SampleDraws::block(const std::string& path, std::uint32_t draw, std::uint32_t attempt) const
{
  Sha256 hash;
  const std::string seed = std::to_string(this->Seed) + '\n';
  hash.update(seed.data(), seed.size());
  hash.update(path.data(), path.size());
  const std::string hex = hash.hex();
  const PhiloxKey key{ std::uint32_t(std::stoul(hex.substr(0, 8), nullptr, 16)),
    std::uint32_t(std::stoul(hex.substr(8, 8), nullptr, 16)) };
  return philox({ std::uint32_t(this->Sample), std::uint32_t(this->Sample >> 32), draw, attempt }, key);
}

std::array<double, 2> SampleDraws::uniforms(const std::string& path, std::uint32_t draw, std::uint32_t attempt) const
{
  const PhiloxCounter bits = this->block(path, draw, attempt);
  const auto uniform = [](std::uint32_t high, std::uint32_t low)
  { return double((std::uint64_t(high) << 21) ^ (low >> 11)) * 0x1p-53; };
  return { uniform(bits[0], bits[1]), uniform(bits[2], bits[3]) };
}

} // namespace dgtk
