// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleModels.h"

#include "dgtkModelLibrary.h"
#include "dgtkModelReader.h"

#include <map>
#include <mutex>
#include <utility>

namespace dgtk
{

namespace
{
/// What takes part in visibility.
SceneDescription geometryOf(const SceneDescription& scene)
{
  SceneDescription bare = scene;
  bare.lights.clear();
  bare.environment = {};
  bare.fog = {};
  bare.order.clear();
  for (ObjectDescription& object : bare.objects)
  {
    std::vector<MaterialOverride> cut;
    for (const MaterialOverride& material : object.materials)
    {
      if (material.texture)
      {
        cut.emplace_back();
        cut.back().material = material.material;
        cut.back().texture = material.texture;
      }
    }
    object.materials = std::move(cut);
  }
  return bare;
}
} // namespace

struct SampleModels::Impl
{
  struct Kept
  {
    std::mutex lock;
    bool made = false;
    std::shared_ptr<const void> value;
  };
  std::mutex lock; ///< of the map
  std::map<std::string, std::shared_ptr<Kept>> all;
  std::mutex libraryLock;
  ModelLibrary library;
};

SampleModels::SampleModels()
  : Self(std::make_unique<Impl>())
{
}

SampleModels::~SampleModels() = default;

std::shared_ptr<const Model> SampleModels::model(const std::string& path)
{
  return this->kept<Model>("model\n" + path,
    [&path]
    {
      ReadOptions options;
      options.decodeTextures = false;
      return readModel(path, options);
    });
}

std::shared_ptr<const Stage> SampleModels::stage(const SceneDescription& scene)
{
  const SceneDescription bare = geometryOf(scene);
  const std::lock_guard<std::mutex> guard(this->Self->libraryLock);
  if (this->Self->library.size() > mostLooks)
  {
    this->Self->library = ModelLibrary(); // stages that are in use keep what they have
  }
  this->Self->library.load(bare);
  return Stage::make(bare, this->Self->library);
}

std::size_t SampleModels::looks() const
{
  const std::lock_guard<std::mutex> guard(this->Self->libraryLock);
  return this->Self->library.size();
}

std::shared_ptr<const void> SampleModels::keptAny(
  const std::string& key, const std::function<std::shared_ptr<const void>()>& make)
{
  std::shared_ptr<Impl::Kept> entry;
  {
    const std::lock_guard<std::mutex> guard(this->Self->lock);
    std::shared_ptr<Impl::Kept>& place = this->Self->all[key];
    place = place != nullptr ? place : std::make_shared<Impl::Kept>();
    entry = place;
  }
  const std::lock_guard<std::mutex> guard(entry->lock);
  if (!entry->made)
  {
    entry->value = make();
    entry->made = true;
  }
  return entry->value;
}

} // namespace dgtk
