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
bool isFileOrStem(const fs::path& path, const std::string& name)
{
  return name == path.filename() || name == path.stem();
}

/// A texture is named by its whole name, its file name or its stem.
bool isCalled(const Texture& texture, const std::string& name)
{
  std::string written = texture.name;
  std::replace(written.begin(), written.end(), '\\', '/');
  return name == texture.name || name == written || isFileOrStem(written, name);
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

/// Whether surfaces that may get a picture have no texture coordinates beside others that have.
bool hasUnplaced(const Model& model)
{
  const auto& unplaced = model.unplaced;
  return !unplaced.empty() && std::any_of(model.parts.begin(), model.parts.end(),
                                [&](const Part& part)
                                {
                                  const auto first = unplaced.begin() + std::ptrdiff_t(part.firstTriangle);
                                  return !model.materials[std::size_t(part.material)].isBare &&
                                         std::find(first, first + std::ptrdiff_t(part.triangles), 1) !=
                                           first + std::ptrdiff_t(part.triangles);
                                });
}
} // namespace

void failObject(const SceneDescription& scene, const ObjectDescription& object, const std::string& what,
  const std::string& expected, const std::string& found)
{
  throw InputError(scene.title(), object.line, "object " + quoted(object.name) + ": " + what, expected, found);
}

StageModels::StageModels(const SceneDescription& scene, const Stage::WarningSink& warning, const ReadFiles& known)
  : Scene(scene)
  , Warning(warning)
  , Known(known)
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
  this->Read.environment = this->Names.of(path);
  if (this->Read.environment == this->Known.environment)
  {
    made->image = this->Known.light;
    this->Pictures->take(path, made->image->width, made->image->height, made->image->rgb.size() * sizeof(float));
  }
  else if (fs::is_regular_file(path, error))
  {
    made->image = decodeRadiance(path, problem, this->Pictures.get());
  }
  if (!made->image)
  {
    throw InputError(this->Scene.title(), "environment: " + quoted(from.image) + ' ' + problem);
  }
  this->addFile(path);
  made->intensity = from.intensity;
  made->background = from.background;
  const double angle = from.rotation * pi / 180;
  Eigen::Matrix3d unturn;
  unturn << portable::cos(angle), 0, -portable::sin(angle), 0, 1, 0, portable::sin(angle), 0, portable::cos(angle);
  Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  if (this->Scene.upAxis == UpAxis::Z)
  {
    upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  }
  made->image_from_world = unturn * upright;
  this->Environment = made;
  this->Read.light = made->image;
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

/// Models that are known may be missing.
void StageModels::requireUnread()
{
  SceneDescription unread = this->Scene;
  const auto isKnown = [this](const ObjectDescription& object)
  { return this->Known.models.count(this->Names.of(this->Scene.resolve(object.model))) != 0; };
  unread.objects.erase(std::remove_if(unread.objects.begin(), unread.objects.end(), isKnown), unread.objects.end());
  requireModels(unread);
}

/// Different files on as many threads as the machine has; what is said of them is said in the scene's order.
void StageModels::readModels()
{
  this->requireUnread();
  std::map<std::string, std::size_t> places;
  std::vector<const ObjectDescription*> first; ///< that wants a model
  for (const ObjectDescription& object : this->Scene.objects)
  {
    const auto [entry, isNew] = places.emplace(this->Names.of(this->Scene.resolve(object.model)), first.size());
    this->Uses.push_back(entry->second);
    if (isNew)
    {
      first.push_back(&object);
      this->Places.push_back(entry->first);
    }
  }
  ReadOptions options;
  options.textures = this->Pictures;
  options.sceneFolder = this->Scene.resolve(".");
  this->Models.resize(first.size());
  const auto read = [&](int i)
  {
    const auto place = static_cast<std::size_t>(i);
    const auto known = this->Known.models.find(this->Places[place]);
    if (known != this->Known.models.end())
    {
      this->Models[place] = known->second.model;
      return;
    }
    const ObjectDescription& object = *first[place];
    try
    {
      this->Models[place] = readModel(this->Scene.resolve(object.model), options);
    }
    catch (const InputError& error)
    {
      failObject(this->Scene, object, std::string("model: ") + error.what());
    }
  };
  const int models = static_cast<int>(first.size());
  const auto unread = std::count_if(this->Places.begin(), this->Places.end(),
    [this](const std::string& place) { return this->Known.models.count(place) == 0; });
  ThreadPool(machineThreads(std::max(static_cast<int>(unread), 1))).parallelFor(models, read);
  for (std::size_t i = 0; i < this->Models.size(); ++i)
  {
    const Model& model = *this->Models[i];
    for (const std::string& line : model.warnings)
    {
      this->warn(model.path + ": " + line);
    }
    if (model.triangles.empty())
    {
      this->warn(model.path + ": has no surfaces; its objects are not there and have no id");
    }
    const auto known = this->Known.models.find(this->Places[i]);
    const std::size_t own = known == this->Known.models.end() ? model.textures.size() : known->second.ownTextures;
    this->Read.models[this->Places[i]] = { this->Models[i], own, {} };
  }
  this->Read.folder = this->Names.of(this->Scene.resolve("."));
}

/// Those of a model that was read before take as much memory as others.
void StageModels::countPictures(const Model& model, std::size_t textures)
{
  for (std::size_t i = 0; i < textures; ++i)
  {
    const Image* const image = model.textures[i].image.get();
    if (image && this->Counted.insert(image).second)
    {
      this->Pictures->take(model.textures[i].path, image->width, image->height, image->rgba.size());
    }
  }
}

void addPictures(const ObjectDescription& object, std::vector<ScenePicture>& listed)
{
  static_assert(materialPictures.size() == materialTextures.size());
  for (const MaterialOverride& material : object.materials)
  {
    for (std::size_t i = 0; i < materialPictures.size(); ++i)
    {
      const ScenePicture picture{ (material.*materialPictures[i]).value_or(""), useOf(materialTextures[i]) };
      if (!picture.first.empty() && std::find(listed.begin(), listed.end(), picture) == listed.end())
      {
        listed.push_back(picture);
      }
    }
  }
}

void StageModels::listPictures()
{
  for (std::size_t i = 0; i < this->Scene.objects.size(); ++i)
  {
    addPictures(this->Scene.objects[i], this->Read.models[this->Places[this->Uses[i]]].pictures);
  }
}

/// Textures that the scene gives are appended to the textures of the model, for all its instances.
void StageModels::addTextures()
{
  this->listPictures();
  for (std::size_t i = 0; i < this->Models.size(); ++i)
  {
    ReadFiles::File& file = this->Read.models[this->Places[i]];
    const bool isRead = this->Known.models.count(this->Places[i]) == 0;
    const bool has = isRead ? file.pictures.empty() : this->hasPictures(this->Places[i], file);
    if (!isRead)
    {
      this->countPictures(*file.model, has ? file.model->textures.size() : file.ownTextures);
    }
    file.model = has ? file.model : this->withPictures(file);
    this->Models[i] = file.model;
    for (std::size_t k = 0; k < file.pictures.size(); ++k)
    {
      this->Textures[{ file.model.get(), file.pictures[k] }] = static_cast<int>(file.ownTextures + k);
      const bool none = file.model->uvs.empty();
      if ((none || hasUnplaced(*file.model)) && file.model->textures[file.ownTextures + k].image)
      {
        this->warn(this->Scene.title() + ": texture " + quoted(file.pictures[k].first) + ": " + file.model->path +
                   (none ? " has no texture coordinates" : " has surfaces without texture coordinates"));
      }
    }
  }
}

/// Whether a known model has the scene's pictures, all of them found, and no others.
bool StageModels::hasPictures(const std::string& place, const ReadFiles::File& file) const
{
  const std::vector<Texture>& textures = file.model->textures;
  return this->Known.models.at(place).pictures == file.pictures &&
         (file.pictures.empty() || this->Known.folder == this->Read.folder) &&
         std::all_of(textures.begin() + std::ptrdiff_t(file.ownTextures), textures.end(),
           [](const Texture& texture) { return texture.image != nullptr; });
}

std::shared_ptr<const Model> StageModels::withPictures(const ReadFiles::File& file)
{
  auto copy = std::make_shared<Model>(*file.model);
  copy->textures.resize(file.ownTextures);
  for (const ScenePicture& written : file.pictures)
  {
    copy->textures.push_back(this->makeTexture(written));
  }
  return copy;
}

Texture StageModels::makeTexture(const ScenePicture& picture)
{
  const auto& [written, use] = picture;
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
    const auto known = this->Known.images.find({ texture.path, use });
    texture.image = known != this->Known.images.end() ? known->second
                                                      : decodeTexture(texture.path, problem, this->Pictures.get(), use);
    if (known != this->Known.images.end() && this->Counted.insert(texture.image.get()).second)
    {
      this->Pictures->take(texture.path, texture.image->width, texture.image->height, texture.image->rgba.size());
    }
  }
  if (texture.image)
  {
    this->Read.images[{ texture.path, use }] = texture.image;
  }
  if (!texture.image)
  {
    this->warn(this->Scene.title() + ": texture " + quoted(written) + ": " + problem);
  }
  return texture;
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
  if (found == model.textures.end()) // a name in the model may have another extension, or none behind a dot
  {
    found = std::find_if(begin, model.textures.end(),
      [&](const Texture& texture) { return !model.holds(texture) && isFileOrStem(texture.path, object.skin); });
  }
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

int StageModels::textureOf(const Model& model, const ScenePicture& written) const
{
  return written.first.empty() ? -1 : this->Textures.at({ &model, written });
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
    if (material.isBare && change.emissionMap)
    {
      material.isDark = !change.emissionMap->empty();
      material.emission = material.isDark ? Eigen::Vector3d(0, 0, 0) : material.emission;
    }
    overrideNumbers(change, 0, material); // of those that move, MaterialNumbers has the frame's
    if (material.isBare)
    {
      continue;
    }
    if (change.texture)
    {
      setTexture(material, model, this->textureOf(model, { *change.texture, TextureUse::Color }));
    }
    for (std::size_t i = 1; i < materialPictures.size(); ++i) // all but the one that is set above
    {
      const std::optional<std::string>& picture = change.*materialPictures[i];
      int& texture = material.*materialTextures[i];
      texture = picture ? this->textureOf(model, { *picture, useOf(materialTextures[i]) }) : texture;
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
