// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampler_h
#define dgtkSampler_h

#include "dgtkSamplingModule.h"

#include "dgtkRandomScene.h"
#include "dgtkSampleModels.h"
#include "dgtkSampleRule.h"
#include "dgtkSceneDescription.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dgtk
{

/// Samples are numbered from 0 to this: files have six digits.
constexpr int largestSample = 999999;

/// One plain scene of a random one.
struct SceneSample
{
  SceneDescription scene;        ///< `file` and `folder` are those of the random scene
  std::vector<SampleNote> notes; ///< objects that were placed, cameras that had a path or a requirement, in their order
};

/// What somebody who watches a draw wants to know and says; either may be absent.
struct SampleWatch
{
  /// Takes the parameters and the random values in the order in which they are drawn first, of a camera those of its
  /// last attempt; also of a sample that is refused then. Points that geometry decides are not among them.
  std::vector<SampleValue>* values = nullptr;
  /// Asked between steps and attempts; true throws SampleStopped.
  std::function<bool()> outdated;
};

/// Makes plain scenes of a random one. Immutable but for the models that it keeps; thread-safe.
class DGTKSAMPLING_EXPORT Sampler
{
public:
  /// `seed` below 2^53: instead of the scene's. The cache of models is shared by all samples.
  explicit Sampler(std::shared_ptr<const RandomScene> scene, std::optional<std::uint64_t> seed = {});

  const RandomScene& scene() const { return *this->Scene; }
  std::uint64_t seed() const { return this->Seed; }

  /// A function of the scene, its files, the seed and the number alone. Throws InputError with the place of the value
  /// that cannot be used; SampleRefused for a sample whose rules cannot be kept.
  SceneSample draw(std::uint64_t sample, const SampleWatch& watch = {}) const;

private:
  std::shared_ptr<const RandomScene> Scene;
  std::uint64_t Seed;
  std::shared_ptr<SampleModels> Models;
};

/// The scene's seed of a sample, below 2^53: for what else is random in pictures of it.
DGTKSAMPLING_EXPORT std::uint64_t seedOfSample(std::uint64_t seed, std::uint64_t sample);

} // namespace dgtk

#endif
