// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleDraws_h
#define dgtkSampleDraws_h

#include "dgtkSamplingModule.h"

#include "dgtkRandom.h"

#include <array>
#include <cstdint>
#include <string>

namespace dgtk
{

/// The random numbers of one sample. Each is a function of the seed, the sample's number and the path of the value in
/// the scene ("objects/cup#3/scale"), and of `draw` and `attempt` where one value needs several; of nothing else, so
/// that what else a scene has, or which samples are drawn, changes none. Immutable; thread-safe.
class DGTKSAMPLING_EXPORT SampleDraws
{
public:
  SampleDraws(std::uint64_t seed, std::uint64_t sample)
    : Seed(seed)
    , Sample(sample)
  {
  }

  std::uint64_t seed() const { return this->Seed; }
  std::uint64_t sample() const { return this->Sample; }
  /// Philox under the key (SHA-256 of seed and path): counter (sample, draw, attempt).
  PhiloxCounter block(const std::string& path, std::uint32_t draw = 0, std::uint32_t attempt = 0) const;
  /// Two independent uniforms in [0, 1), multiples of 2^-53.
  std::array<double, 2> uniforms(const std::string& path, std::uint32_t draw = 0, std::uint32_t attempt = 0) const;
  double uniform(const std::string& path, std::uint32_t draw = 0, std::uint32_t attempt = 0) const
  {
    return this->uniforms(path, draw, attempt)[0];
  }

private:
  std::uint64_t Seed;
  std::uint64_t Sample;
};

} // namespace dgtk

#endif
