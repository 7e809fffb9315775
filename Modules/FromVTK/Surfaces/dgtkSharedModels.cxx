// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSharedModels.h"

#include "dgtkInterpreterPause.h"
#include "dgtkRaySource.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
bool equalMaterials(const Material& a, const Material& b)
{
  const auto physical = [](const Material& m)
  {
    return m.physical ? std::make_tuple(true, m.physical->metallic, m.physical->roughness, m.physical->wanted)
                      : std::make_tuple(false, 0.0, 0.0, false);
  };
  const auto numbers = [](const Material& m)
  { return std::tie(m.shininess, m.opacity, m.cutOut, m.normalScale, m.bumpScale, m.occlusionStrength, m.twoSided); };
  const bool sameTextures = std::all_of(
    materialTextures.begin(), materialTextures.end(), [&](auto texture) { return a.*texture == b.*texture; });
  return sameTextures && a.name == b.name && a.ambient == b.ambient && a.diffuse == b.diffuse &&
         a.specular == b.specular && a.emission == b.emission && numbers(a) == numbers(b) && physical(a) == physical(b);
}

bool equalImages(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b)
{
  return a == b || (a && b && a->width == b->width && a->height == b->height && a->rgba == b->rgba);
}

bool equalTextures(const Texture& a, const Texture& b)
{
  return a.filter == b.filter && a.wrap == b.wrap && equalImages(a.image, b.image);
}

bool equalParts(const Part& a, const Part& b)
{
  return a.firstTriangle == b.firstTriangle && a.triangles == b.triangles && a.material == b.material;
}

template <class Items, class Equal>
bool equalAll(const Items& a, const Items& b, const Equal& equal)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

bool equalModels(const Model& a, const Model& b)
{
  return a.triangles == b.triangles && a.rest->positions == b.rest->positions && a.rest->normals == b.rest->normals &&
         a.uvs == b.uvs && a.unplaced == b.unplaced && a.colors == b.colors && a.colorMapAt == b.colorMapAt &&
         equalImages(a.colorMap, b.colorMap) && equalAll(a.parts, b.parts, equalParts) &&
         equalAll(a.materials, b.materials, equalMaterials) && equalAll(a.textures, b.textures, equalTextures);
}
} // namespace

std::shared_ptr<const Model> sharedModel(std::shared_ptr<const Model> model)
{
  static std::mutex lock;
  static std::vector<std::weak_ptr<const Model>> known;
  const std::lock_guard<std::mutex> guard(lock);
  known.erase(std::remove_if(known.begin(), known.end(), [](const auto& one) { return one.expired(); }), known.end());
  for (const std::weak_ptr<const Model>& one : known)
  {
    std::shared_ptr<const Model> other = one.lock();
    if (other && (other == model || equalModels(*other, *model)))
    {
      return other;
    }
  }
  known.push_back(model);
  return model;
}

std::shared_ptr<const SurfaceModel> sharedSurface(const SurfaceKey& key, const std::function<SurfaceModel()>& make)
{
  static std::mutex lock;
  static std::map<SurfaceKey, std::weak_ptr<const SurfaceModel>> known;
  {
    const std::lock_guard<std::mutex> guard(lock);
    for (auto one = known.begin(); one != known.end();)
    {
      one = one->second.expired() ? known.erase(one) : std::next(one);
    }
    const auto found = known.find(key);
    if (std::shared_ptr<const SurfaceModel> surface = found != known.end() ? found->second.lock() : nullptr)
    {
      return surface;
    }
  }
  auto made = std::make_shared<SurfaceModel>(make());
  made->model = made->copies ? made->model : sharedModel(made->model);
  const std::lock_guard<std::mutex> guard(lock);
  known[key] = made;
  return made;
}

std::shared_ptr<const OcclusionQuery> keptTrees(
  const std::shared_ptr<const SceneState>& state, std::vector<std::shared_ptr<const SurfaceModel>> surfaces)
{
  static std::mutex lock;
  static std::pair<std::shared_ptr<const OcclusionQuery>, std::vector<std::shared_ptr<const SurfaceModel>>> latest;
  const std::shared_ptr<OcclusionQuery> made = makeOcclusionQuery();
  {
    const InterpreterPause pause;
    made->setScene(state);
  }
  std::pair<std::shared_ptr<const OcclusionQuery>, std::vector<std::shared_ptr<const SurfaceModel>>> next(
    made, std::move(surfaces));
  const std::lock_guard<std::mutex> guard(lock);
  latest.swap(next);
  return made;
}

} // namespace dgtk
