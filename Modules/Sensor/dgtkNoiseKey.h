// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNoiseKey_h
#define dgtkNoiseKey_h

#include "dgtkRandom.h"

#include <cstdint>

namespace dgtk
{

/// What the noise of a picture is a function of, besides its pixels.
struct NoiseKey
{
  std::uint64_t seed = 0;
  std::uint32_t camera = 0; ///< index
  std::int32_t frame = 0;

  /// One stream a source of noise; written down in Documentation/Formats/sensor.md, never renumbered.
  enum Stream : std::uint32_t
  {
    Shot = 1,
    FixedPattern = 2,
    RowPattern = 3,
    ColumnPattern = 4,
    Read = 5,
    SaltAndPepper = 6,
    Texture = 7,
    DepthLateral = 16,
    DepthAxial = 17,
    DepthDisparity = 18,
    DepthDropout = 19
  };
  CounterRandom random(Stream stream) const { return { this->seed, stream, this->camera, this->frame }; }
  /// The same in every frame.
  CounterRandom fixed(Stream stream) const { return { this->seed, stream, this->camera, CounterRandom::anyFrame }; }
};

} // namespace dgtk

#endif
