// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampler.h"

#include "dgtkSampleDraws.h"
#include "dgtkSampleMaker.h"

namespace dgtk
{

Sampler::Sampler(std::shared_ptr<const RandomScene> scene, std::optional<std::uint64_t> seed)
  : Scene(std::move(scene))
  , Seed(seed.value_or(this->Scene->seed()))
  , Models(std::make_shared<SampleModels>())
{
}

SceneSample Sampler::draw(std::uint64_t sample, const SampleWatch& watch) const
{
  return SampleMaker(*this->Scene, this->Seed, sample, *this->Models, watch).make();
}

std::uint64_t seedOfSample(std::uint64_t seed, std::uint64_t sample)
{
  const PhiloxCounter bits = SampleDraws(seed, sample).block("seed");
  return ((std::uint64_t(bits[0]) << 32) | bits[1]) >> 11;
}

} // namespace dgtk
