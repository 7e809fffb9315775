// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSampler.h"

#include "dgtkFailure.h"
#include "dgtkInterpreterPause.h"
#include "dgtkSampleDraws.h"
#include "dgtkSampler.h"
#include "dgtkScene.h"
#include "dgtkUtf8.h"

#include "vtkObjectFactory.h"

#include <functional>
#include <optional>

vtkStandardNewMacro(dgtkSceneSampler);

struct dgtkSceneSampler::Internal
{
  std::shared_ptr<const dgtk::RandomScene> scene;
  std::unique_ptr<dgtk::Sampler> sampler; ///< of `seed`
  long long seed = -1;
  std::string description;
  std::string leftOut; ///< a line each
  dgtk::Failure failure;

  bool attempt(const std::function<void()>& work)
  {
    this->failure.clear();
    try
    {
      const dgtk::InterpreterPause pause;
      work();
    }
    catch (...)
    {
      this->failure.take();
    }
    return !this->failure;
  }
};

dgtkSceneSampler::dgtkSceneSampler()
  : Self(new Internal)
{
}

dgtkSceneSampler::~dgtkSceneSampler() = default;

void dgtkSceneSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Seed: " << this->Seed << "\n";
}

bool dgtkSceneSampler::Load(const std::string& path)
{
  this->Self->sampler.reset();
  return this->Self->attempt([&] { this->Self->scene = dgtk::RandomScene::read(path); });
}

bool dgtkSceneSampler::LoadText(const std::string& json, const std::string& folder)
{
  this->Self->sampler.reset();
  return this->Self->attempt([&] { this->Self->scene = dgtk::RandomScene::ofText(json, folder); });
}

bool dgtkSceneSampler::Draw(int sample, const std::string& folder)
{
  this->Self->description.clear();
  this->Self->leftOut.clear();
  return this->Self->attempt(
    [&]
    {
      if (!this->Self->scene || sample < 0 || sample > dgtk::largestSample)
      {
        throw dgtk::UsageError(this->Self->scene ? "number: expected 0 to 999999" : "there is no scene");
      }
      dgtkScene::UseModelCache();
      if (!this->Self->sampler || this->Self->seed != this->Seed)
      {
        const std::optional<std::uint64_t> own =
          this->Seed < 0 ? std::nullopt : std::optional(std::uint64_t(this->Seed));
        this->Self->sampler = std::make_unique<dgtk::Sampler>(this->Self->scene, own);
        this->Self->seed = this->Seed;
      }
      const dgtk::SceneSample drawn = this->Self->sampler->draw(std::uint64_t(sample));
      this->Self->description = toJson(drawn.scene, folder);
      for (const dgtk::SampleNote& note : drawn.notes)
      {
        this->Self->leftOut += note.kept ? "" : dgtk::printable(note.path + ": " + note.why) + '\n';
      }
    });
}

std::string dgtkSceneSampler::GetDescription() const { return this->Self->description; }

std::string dgtkSceneSampler::GetLeftOut() const { return this->Self->leftOut; }

std::string dgtkSceneSampler::GetErrorMessage() const { return this->Self->failure.message; }

int dgtkSceneSampler::GetErrorCode() const { return this->Self->failure.code; }

double dgtkSceneSampler::Uniform(long long seed, long long sample, const std::string& path, int draw)
{
  return dgtk::SampleDraws(std::uint64_t(seed), std::uint64_t(sample)).uniform(path, std::uint32_t(draw));
}
