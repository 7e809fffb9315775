// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLikeScene.h"

#include "dgtkPathNames.h"
#include "dgtkStageModels.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
/// A model's path as it was read, and the pictures that a scene in this folder gives it.
using Variant = std::tuple<std::string, std::vector<ScenePicture>, std::string>;

std::uint64_t bytesOf(const Image& image) { return image.rgba.size(); }

std::uint64_t bytesOf(const Model& model)
{
  std::uint64_t bytes = model.triangles.size() * sizeof(model.triangles.front()) +
                        model.uvs.size() * sizeof(Eigen::Vector2d) + model.sourceVertex.size() * sizeof(std::uint32_t) +
                        model.rest->positions.size() * (sizeof(Eigen::Vector3d) + sizeof(Eigen::Vector3f));
  bytes *= model.deformation ? std::uint64_t(std::max(model.frames, 1)) : 1;
  for (const Texture& texture : model.textures)
  {
    bytes += texture.image ? bytesOf(*texture.image) : 0;
  }
  return bytes;
}
} // namespace

struct SceneSeries::Impl
{
  template <typename T>
  struct Kept
  {
    T what;
    std::uint64_t bytes = 0;
    std::uint64_t used = 0; ///< number of the scene that used it last
  };

  std::uint64_t Limit;
  std::uint64_t Scene = 0;
  std::map<Variant, Kept<ReadFiles::File>> Models;
  std::map<ScenePicture, Kept<std::shared_ptr<const Image>>> Images;
  std::string Environment;
  std::shared_ptr<const RadianceImage> Light;

  ReadFiles knownFor(const SceneDescription& scene);
  void take(const ReadFiles& read);
  void bound();
  template <typename Map>
  std::uint64_t oldest(const Map& map) const;
  template <typename Map>
  static std::uint64_t drop(Map& map, std::uint64_t used);
};

/// Of each model the one with the scene's pictures, else any.
ReadFiles SceneSeries::Impl::knownFor(const SceneDescription& scene)
{
  ReadFiles known;
  PathNames names;
  known.folder = names.of(scene.resolve("."));
  known.environment = this->Environment;
  known.light = this->Light;
  struct Wanted
  {
    std::string path;
    std::vector<ScenePicture> pictures;
  };
  std::map<std::string, Wanted> wanted;      ///< by PathNames::of()
  std::map<std::string, std::string> places; ///< of models as written
  for (const ObjectDescription& object : scene.objects)
  {
    const auto [place, isNew] = places.try_emplace(object.model);
    place->second = isNew ? names.of(scene.resolve(object.model)) : place->second;
    Wanted& one = wanted[place->second];
    one.path = one.path.empty() ? scene.resolve(object.model) : one.path; // it is in messages and documents
    addPictures(object, one.pictures);
  }
  for (const auto& [place, one] : wanted)
  {
    auto found = this->Models.find({ one.path, one.pictures, one.pictures.empty() ? std::string() : known.folder });
    found = found != this->Models.end() ? found : this->Models.lower_bound({ one.path, {}, {} });
    if (found != this->Models.end() && std::get<0>(found->first) == one.path)
    {
      known.models[place] = found->second.what;
    }
  }
  for (const auto& [path, image] : this->Images)
  {
    known.images[path] = image.what;
  }
  return known;
}

void SceneSeries::Impl::take(const ReadFiles& read)
{
  ++this->Scene;
  for (const auto& [place, file] : read.models)
  {
    const Variant variant{ file.model->path, file.pictures, file.pictures.empty() ? std::string() : read.folder };
    Kept<ReadFiles::File>& kept = this->Models[variant];
    kept = { file, bytesOf(*file.model), this->Scene };
  }
  for (const auto& [path, image] : read.images)
  {
    this->Images[path] = { image, bytesOf(*image), this->Scene };
  }
  this->Environment = read.environment;
  this->Light = read.light;
  this->bound();
}

template <typename Map>
std::uint64_t SceneSeries::Impl::oldest(const Map& map) const
{
  std::uint64_t oldest = this->Scene;
  for (const auto& [key, kept] : map)
  {
    oldest = std::min(oldest, kept.used);
  }
  return oldest;
}

template <typename Map>
std::uint64_t SceneSeries::Impl::drop(Map& map, std::uint64_t used)
{
  std::uint64_t bytes = 0;
  for (auto it = map.begin(); it != map.end();)
  {
    const bool goes = it->second.used == used;
    bytes += goes ? it->second.bytes : 0;
    it = goes ? map.erase(it) : std::next(it);
  }
  return bytes;
}

/// Never what the last scene has used.
void SceneSeries::Impl::bound()
{
  std::uint64_t bytes = 0;
  for (const auto& [key, kept] : this->Models)
  {
    bytes += kept.bytes;
  }
  for (const auto& [key, kept] : this->Images)
  {
    bytes += kept.bytes;
  }
  while (bytes > this->Limit)
  {
    const std::uint64_t used = std::min(this->oldest(this->Models), this->oldest(this->Images));
    if (used == this->Scene)
    {
      break;
    }
    bytes -= drop(this->Models, used) + drop(this->Images, used);
  }
}

SceneSeries::SceneSeries(std::uint64_t bytes)
  : Self(new Impl)
{
  this->Self->Limit = bytes;
}

SceneSeries::~SceneSeries() = default;

std::shared_ptr<const Stage> SceneSeries::load(SceneDescription scene, const Stage::WarningSink& warning)
{
  const ReadFiles known = this->Self->knownFor(scene);
  const StageWithFiles loaded = loadLike(std::move(scene), &known, warning);
  this->Self->take(*loaded.files);
  return loaded.stage;
}

} // namespace dgtk
