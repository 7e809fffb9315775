// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleDrawer.h"

#include "dgtkError.h"
#include "dgtkSceneRandom.h"

#include <exception>
#include <filesystem>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t mostLooks = 1000; ///< models with their materials that are kept for further samples
} // namespace

bool isRandomScene(const std::string& path)
{
  try
  {
    return firstRandom(RandomScene::read(path)->document()).has_value();
  }
  catch (const std::exception&)
  {
    return false;
  }
}

SampleDrawer::SampleDrawer(const std::string& path)
  : Path(std::filesystem::absolute(path).lexically_normal().string())
{
}

void SampleDrawer::read(std::optional<std::uint64_t> seed)
{
  std::shared_ptr<const RandomScene> scene = RandomScene::read(this->Path);
  if (this->Source == nullptr || this->Source->scene().sha256() != scene->sha256() || this->Seed != seed)
  {
    this->Source = std::make_unique<Sampler>(std::move(scene), seed);
    this->Seed = seed;
  }
}

std::optional<DrawnSample> SampleDrawer::draw(
  int number, std::optional<std::uint64_t> seed, const std::function<bool()>& outdated)
{
  DrawnSample drawn;
  drawn.number = number;
  try
  {
    this->read(seed);
    drawn.seed = this->Source->seed();
    SceneSample sample = this->Source->draw(std::uint64_t(number), { &drawn.values, outdated });
    drawn.notes = std::move(sample.notes);
    LoadedScene loaded;
    loaded.scene = std::move(sample.scene);
    loaded.scene.file.clear(); // it is another scene than that of the file
    loaded.models = this->Models.size() < mostLooks ? this->Models : ModelLibrary();
    const auto goesOn = [&outdated](std::size_t, std::size_t) { return !outdated || !outdated(); };
    if (!loaded.models.load(loaded.scene, goesOn, AbsentModel::Box))
    {
      return std::nullopt;
    }
    this->Models = loaded.models;
    drawn.scene = std::move(loaded);
  }
  catch (const SampleStopped&)
  {
    return std::nullopt;
  }
  catch (const SampleRefused& refused)
  {
    drawn.refused = true;
    drawn.notes = { { refused.path(), false, refused.why(), refused.attempts(), {} } };
    drawn.fault = refused.what();
  }
  catch (const std::exception& error)
  {
    drawn.fault = error.what();
  }
  return drawn;
}

} // namespace dgtk
