// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRandom_h
#define dgtkRandom_h

#include "dgtkCoreModule.h"

#include <array>
#include <cstdint>

namespace dgtk
{

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011: 128 random
/// bits that are a function of counter and key.
inline PhiloxCounter philox(PhiloxCounter c, PhiloxKey key)
{
  for (int round = 0; round < 10; ++round)
  {
    const std::uint64_t p0 = std::uint64_t(0xD2511F53u) * c[0];
    const std::uint64_t p1 = std::uint64_t(0xCD9E8D57u) * c[2];
    c = { std::uint32_t(p1 >> 32) ^ c[1] ^ key[0], std::uint32_t(p1), std::uint32_t(p0 >> 32) ^ c[3] ^ key[1],
      std::uint32_t(p0) };
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return c;
}

/// The standard normal quantile: Wichura, algorithm AS 241 (PPND16), Applied Statistics 37, 1988. p in (0, 1).
DGTKCORE_EXPORT double normalQuantile(double p);

/// Random numbers without state: each is a function of (seed, stream, camera, frame) and of (x, y, draw), and the same
/// on every machine and in every order of asking. Of one block of 128 bits, uniforms() gives two numbers; normals() and
/// poisson() at the same (x, y, draw) are functions of the same bits, so ask for one kind of each. draw < 2^24.
class DGTKCORE_EXPORT CounterRandom
{
public:
  static constexpr std::int32_t anyFrame = -1; ///< for what is the same in every frame

  /// The 64-bit key is Philox of (stream, camera, frame) under the seed.
  CounterRandom(std::uint64_t seed, std::uint32_t stream, std::uint32_t camera, std::int32_t frame);

  /// 128 bits; attempt < 256 counts further blocks of the same draw.
  PhiloxCounter block(std::uint32_t x, std::uint32_t y, std::uint32_t draw, std::uint32_t attempt = 0) const
  {
    return philox({ x, y, draw, attempt }, this->Key);
  }
  /// Two independent uniforms in [0, 1), multiples of 2^-53.
  std::array<double, 2> uniforms(std::uint32_t x, std::uint32_t y, std::uint32_t draw, std::uint32_t attempt = 0) const;
  double uniform(std::uint32_t x, std::uint32_t y, std::uint32_t draw) const { return this->uniforms(x, y, draw)[0]; }
  /// Two independent standard normals.
  std::array<double, 2> normals(std::uint32_t x, std::uint32_t y, std::uint32_t draw) const;
  double normal(std::uint32_t x, std::uint32_t y, std::uint32_t draw) const;
  /// A Poisson number of that mean, 0 <= mean <= 1e12 (0 for a smaller or NaN one): sequential inversion below 10,
  /// above Hoermann's transformed rejection PTRS, "The transformed rejection method for generating Poisson random
  /// variables", Insurance: Mathematics and Economics 12, 1993.
  double poisson(double mean, std::uint32_t x, std::uint32_t y, std::uint32_t draw) const;

private:
  PhiloxKey Key;
};

} // namespace dgtk

#endif
