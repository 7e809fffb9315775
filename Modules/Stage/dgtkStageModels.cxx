// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStageModels.h"

#include "dgtkError.h"
#include "dgtkMissingModels.h"
#include "dgtkPortableMath.h"
#include "dgtkSystem.h"
#include "dgtkTextureFile.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>

namespace dgtk
{

namespace fs = std::filesystem;

namespace
{
/// A texture is named by its whole name, its file name or its stem.
bool isCalled(const Texture& texture, const std::string& name)
{
  std::string written = texture.name;
  std::replace(written.begin(), written.end(), '\\', '/');
  const fs::path path(written);
  return name == texture.name || name == written || name == path.filename() || name == path.stem();
}

std::string namesOf(const std::vector<Texture>& textures)
{
  std::string text;
  for (std::size_t i = 0; i < textures.size() && i < 20; ++i)
  {
    text += (i == 0 ? "" : ", ") + textures[i].name;
  }
  return text.empty() ? "none" : text;
}
} // namespace

void failObject(const SceneDescription& scene, const ObjectDescription& object, const std::string& what,
  const std::string& expected, const std::string& found)
{
  throw InputError(scene.title(), object.line, "object " + quoted(object.name) + ": " + what, expected, found);
}

StageModels::StageModels(const SceneDescription& scene, const Stage::WarningSink& warning)
  : Scene(scene)
  , Warning(warning)
  , Pictures(std::make_shared<TextureStore>())
{
  this->readModels();
  this->addTextures();
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    this->Materials.push_back(this->makeMaterials(i));
  }
  if (!scene.file.empty())
  {
    this->Files.push_back(scene.file);
  }
  this->addFile(scene.resolve(scene.classFile));
  for (const CameraDescription& camera : scene.cameras)
  {
    for (const auto& [name, value] : camera.parameters)
    {
      this->addFile(scene.resolve(value.file));
    }
  }
  for (const std::shared_ptr<const Model>& model : this->Models)
  {
    this->addFile(model->path);
    for (const std::string& companion : model->companions)
    {
      this->addFile(companion);
    }
    for (const Texture& texture : model->textures)
    {
      this->addFile(texture.path);
    }
  }
  this->readEnvironment();
}

ObjectLook StageModels::lookOf(const SceneDescription& scene, const ObjectDescription& object) const
{
  const auto index = static_cast<std::size_t>(&object - scene.objects.data());
  return { this->modelOf(index), this->Materials[index], false };
}

void StageModels::readEnvironment()
{
  const EnvironmentDescription& from = this->Scene.environment;
  if (from.image.empty())
  {
    return;
  }
  const std::string path = this->Scene.resolve(from.image);
  std::string problem = "not found";
  std::error_code error;
  auto made = std::make_shared<EnvironmentState>();
  if (fs::is_regular_file(path, error))
  {
    made->image = decodeRadiance(path, problem, this->Pictures.get());
  }
  if (!made->image)
  {
    throw InputError(this->Scene.title(), 0, "environment: " + quoted(from.image) + ' ' + problem);
  }
  this->addFile(path);
  made->intensity = from.intensity;
  made->background = from.background;
  const double angle = from.rotation * pi / 180;
  Eigen::Matrix3d unturn;
  unturn << std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0, std::cos(angle);
  Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  if (this->Scene.upAxis == UpAxis::Z)
  {
    upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  }
  made->image_from_world = unturn * upright;
  this->Environment = made;
}

void StageModels::warn(const std::string& line) const
{
  if (this->Warning)
  {
    this->Warning(line);
  }
}

void StageModels::addFile(const std::string& path)
{
  if (!path.empty() && std::find(this->Files.begin(), this->Files.end(), path) == this->Files.end())
  {
    this->Files.push_back(path);
  }
}

/// Different files on as many threads as the machine has; what is said of them is said in the scene's order.
void StageModels::readModels()
{
  requireModels(this->Scene);
  std::map<std::string, std::size_t> known;
  std::vector<const ObjectDescription*> first; ///< that wants a model
  for (const ObjectDescription& object : this->Scene.objects)
  {
    const auto [entry, isNew] = known.emplace(canonicalPath(this->Scene.resolve(object.model)), first.size());
    this->Uses.push_back(entry->second);
    if (isNew)
    {
      first.push_back(&object);
    }
  }
  ReadOptions options;
  options.textures = this->Pictures;
  options.sceneFolder = this->Scene.resolve(".");
  this->Models.resize(first.size());
  const auto read = [&](int i)
  {
    const ObjectDescription& object = *first[static_cast<std::size_t>(i)];
    try
    {
      this->Models[static_cast<std::size_t>(i)] = readModel(this->Scene.resolve(object.model), options);
    }
    catch (const InputError& error)
    {
      failObject(this->Scene, object, std::string("model: ") + error.what());
    }
  };
  const int models = static_cast<int>(first.size());
  ThreadPool(machineThreads(std::max(models, 1))).parallelFor(models, read);
  for (const std::shared_ptr<const Model>& model : this->Models)
  {
    for (const std::string& line : model->warnings)
    {
      this->warn(model->path + ": " + line);
    }
    if (model->triangles.empty())
    {
      this->warn(model->path + ": has no surfaces; its objects are not there and have no id");
    }
  }
}

/// Textures that the scene gives are appended to the textures of the model, for all its instances.
void StageModels::addTextures()
{
  std::map<std::size_t, std::shared_ptr<Model>> changed;
  for (std::size_t i = 0; i < this->Scene.objects.size(); ++i)
  {
    for (const MaterialOverride& material : this->Scene.objects[i].materials)
    {
      for (const std::optional<std::string>* picture : { &material.texture, &material.normalMap, &material.bump,
             &material.metallicRoughnessMap, &material.emissionMap, &material.occlusionMap })
      {
        if (!*picture || (*picture)->empty())
        {
          continue;
        }
        std::shared_ptr<Model>& copy = changed[this->Uses[i]];
        copy = copy ? copy : std::make_shared<Model>(*this->modelOf(i));
        const auto [entry, isNew] = this->Textures.emplace(std::make_pair(copy.get(), **picture), -1);
        if (isNew)
        {
          entry->second = this->addTexture(*copy, **picture);
        }
      }
    }
  }
  for (const auto& [index, model] : changed)
  {
    this->Models[index] = model;
  }
}

int StageModels::addTexture(Model& model, const std::string& written)
{
  Texture texture;
  texture.name = written;
  const std::string path = this->Scene.resolve(written);
  std::string tried = "as written";
  std::error_code error;
  texture.path = fs::is_regular_file(path, error) ? path
                 : written[0] == '/'              ? std::string()
                                                  : locateTexture(this->Scene.resolve("scene"), written, &tried);
  std::string problem = "not found (tried: " + tried + ')';
  if (!texture.path.empty())
  {
    texture.image = decodeTexture(texture.path, problem, this->Pictures.get());
  }
  if (!texture.image)
  {
    this->warn(this->Scene.title() + ": texture " + quoted(written) + ": " + problem);
  }
  else if (model.uvs.empty())
  {
    this->warn(
      this->Scene.title() + ": texture " + quoted(written) + ": " + model.path + " has no texture coordinates");
  }
  model.textures.push_back(texture);
  return static_cast<int>(model.textures.size()) - 1;
}

namespace
{
void setTexture(Material& material, const Model& model, int texture)
{
  material.texture = texture;
  const Image* image = texture < 0 ? nullptr : model.textures[std::size_t(texture)].image.get();
  material.cutOut = image && isCutOut(*image);
}
} // namespace

void StageModels::applySkin(const ObjectDescription& object, const Model& model, std::vector<Material>& materials) const
{
  const auto begin = model.textures.begin();
  auto found =
    std::find_if(begin, model.textures.end(), [&](const Texture& texture) { return isCalled(texture, object.skin); });
  if (found == model.textures.end() && object.skin.size() <= 6 &&
      object.skin.find_first_not_of("0123456789") == std::string::npos)
  {
    const std::size_t number = std::stoul(object.skin);
    found = number < model.textures.size() ? begin + std::ptrdiff_t(number) : found;
  }
  if (found == model.textures.end())
  {
    failObject(this->Scene, object, "skin is no texture of " + object.model, "one of " + namesOf(model.textures),
      quoted(object.skin));
  }
  for (Material& material : materials)
  {
    if (material.texture >= 0)
    {
      setTexture(material, model, static_cast<int>(found - begin));
    }
  }
}

int StageModels::textureOf(const Model& model, const std::string& written) const
{
  return written.empty() ? -1 : this->Textures.at({ &model, written });
}

void StageModels::applyOverride(const ObjectDescription& object, const Model& model, const MaterialOverride& change,
  std::vector<Material>& materials) const
{
  bool used = false;
  for (Material& material : materials)
  {
    if (!isFor(change, material))
    {
      continue;
    }
    used = true;
    overrideNumbers(change, 0, material); // of those that move, MaterialNumbers has the frame's
    if (change.texture)
    {
      setTexture(material, model, this->textureOf(model, *change.texture));
    }
    const std::pair<const std::optional<std::string>*, int*> maps[] = { { &change.normalMap, &material.normalMap },
      { &change.bump, &material.bumpMap }, { &change.metallicRoughnessMap, &material.metallicRoughnessMap },
      { &change.emissionMap, &material.emissionMap }, { &change.occlusionMap, &material.occlusionMap } };
    for (const auto& [picture, texture] : maps)
    {
      *texture = *picture ? this->textureOf(model, **picture) : *texture;
    }
  }
  if (!used && change.material != "*")
  {
    std::set<std::string> names;
    std::string listed;
    for (const Material& material : materials)
    {
      if (names.insert(material.name).second && names.size() <= 20)
      {
        listed += (listed.empty() ? "" : ", ") + material.name;
      }
    }
    failObject(this->Scene, object, "materials: no material of " + object.model + " has this name",
      listed.empty() ? "*" : "* or one of " + listed, quoted(change.material));
  }
}

MaterialList StageModels::makeMaterials(std::size_t index) const
{
  const ObjectDescription& object = this->Scene.objects[index];
  const std::shared_ptr<const Model>& model = this->modelOf(index);
  if (object.skin.empty() && object.materials.empty())
  {
    return { model, &model->materials };
  }
  auto materials = std::make_shared<std::vector<Material>>(model->materials);
  if (!object.skin.empty())
  {
    this->applySkin(object, *model, *materials);
  }
  for (const MaterialOverride& change : object.materials)
  {
    this->applyOverride(object, *model, change, *materials);
  }
  return materials;
}

} // namespace dgtk
