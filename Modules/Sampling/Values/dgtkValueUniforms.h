// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkValueUniforms_h
#define dgtkValueUniforms_h

#include "dgtkSampleDraws.h"

#include <cstdint>
#include <string>

namespace dgtk
{

/// The uniforms in [0, 1) of one value of a scene.
class DGTKSAMPLING_EXPORT ValueUniforms
{
public:
  /// Numbers of a value that are stratified together; further ones are independent.
  static constexpr std::uint32_t stratified = 4;

  /// `stratify`: over the sample's numbers the first uniforms of a value are an Owen-scrambled Sobol sequence (Sobol
  /// 1967 with the numbers of Joe and Kuo, SIAM J. Sci. Comput. 30, 2008; nested uniform scrambling: Owen 1995) in an
  /// order that is scrambled in the same way, both keyed by seed and path: of 2^m samples from a multiple of 2^m on,
  /// one is in each interval of length 2^-m. Further attempts are independent draws.
  ValueUniforms(const SampleDraws& draws, std::string path, std::uint32_t attempt, bool stratify)
    : Draws(&draws)
    , Path(std::move(path))
    , Attempt(attempt)
    , Stratify(stratify && attempt == 0)
  {
  }

  double operator()(std::uint32_t dimension) const;
  const std::string& path() const { return this->Path; }

private:
  const SampleDraws* Draws;
  std::string Path;
  std::uint32_t Attempt;
  bool Stratify;
};

} // namespace dgtk

#endif
