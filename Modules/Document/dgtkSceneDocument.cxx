// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDocument.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelReader.h"

#include <filesystem>
#include <limits>
#include <set>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t unreachable = std::numeric_limits<std::size_t>::max();
constexpr std::size_t mostItemsKept = 400000; ///< objects, lights and cameras in steps that hold whole scenes

std::string currentFolder() { return std::filesystem::current_path().generic_string(); }

std::size_t sizeOf(const SceneDescription& scene)
{
  return scene.objects.size() + scene.lights.size() + scene.cameras.size();
}

/// "" for a file that cannot be read.
std::string hashIfAny(const std::string& path)
{
  try
  {
    return hashOfFile(path);
  }
  catch (const InputError&)
  {
    return {};
  }
}

/// Of a scene's JSON, which has no slash but in them and in strings.
bool hasComments(const std::string& json)
{
  bool isString = false;
  for (std::size_t i = 0; i < json.size(); ++i)
  {
    if (json[i] == '"')
    {
      isString = !isString;
    }
    else if (json[i] == '\\' && isString)
    {
      ++i;
    }
    else if (json[i] == '/' && !isString)
    {
      return true;
    }
  }
  return false;
}

std::set<std::string> modelFiles(const SceneDescription& scene)
{
  std::set<std::string> files;
  for (const ObjectDescription& object : scene.objects)
  {
    files.insert(scene.resolve(object.model));
  }
  return files;
}

void addAges(std::map<std::string, FileAge>& ages, const SceneDescription& scene)
{
  for (const std::string& file : modelFiles(scene))
  {
    ages.try_emplace(file, file);
  }
}
} // namespace

SceneDocument::SceneDocument() { this->Scene.folder = currentFolder(); }

void SceneDocument::notify() const
{
  for (const std::function<void()>& listener : this->Listeners)
  {
    listener();
  }
}

void SceneDocument::reset(SceneDescription scene, const std::string& path, std::size_t clean)
{
  this->Path = path;
  this->put(std::move(scene));
  this->Known = this->Models.size();
  addAges(this->Read, this->Scene);
  ++this->Opened;
  this->Done.clear();
  this->Undone.clear();
  this->Clean = clean;
  this->notify();
}

void SceneDocument::clear()
{
  this->Models = ModelLibrary();
  this->Read.clear();
  SceneDescription scene;
  scene.folder = currentFolder();
  this->reset(std::move(scene), {}, 0);
}

std::optional<LoadedScene> SceneDocument::read(const std::string& path, const LoadProgress& progress)
{
  LoadedScene loaded;
  loaded.path = std::filesystem::absolute(path).lexically_normal().string();
  loaded.hash = hashIfAny(loaded.path);
  loaded.scene = readScene(loaded.path);
  addAges(loaded.read, loaded.scene);
  return loaded.models.load(loaded.scene, progress, AbsentModel::Box) ? std::make_optional(std::move(loaded))
                                                                      : std::nullopt;
}

void SceneDocument::install(LoadedScene loaded)
{
  this->Models = std::move(loaded.models);
  this->Read = std::move(loaded.read);
  this->Hash = loaded.hash;
  this->reset(std::move(loaded.scene), loaded.path, 0);
}

void SceneDocument::open(const std::string& path) { this->install(*read(path)); }

void SceneDocument::recover(LoadedScene loaded, const std::string& origin)
{
  this->Models = std::move(loaded.models);
  this->Read = std::move(loaded.read);
  this->Hash = hashIfAny(origin);
  this->reset(std::move(loaded.scene), origin, unreachable);
}

void SceneDocument::saveAs(const std::string& path)
{
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  writeScene(this->Scene, absolute);
  this->Path = absolute;
  this->Hash = hashIfAny(absolute);
  this->Scene.file = absolute;
  this->finishMerging();
  this->Clean = this->Done.size();
  this->notify();
}

bool SceneDocument::isReplaced() const { return !this->Path.empty() && hashIfAny(this->Path) != this->Hash; }

bool SceneDocument::losesComments() const
{
  try
  {
    return std::filesystem::path(this->Path).extension() == ".json" && hasComments(readFile(this->Path));
  }
  catch (const InputError&)
  {
    return false;
  }
}

std::vector<std::string> SceneDocument::takeReplacedModels()
{
  std::vector<std::string> files;
  for (const std::string& file : modelFiles(this->Scene))
  {
    const auto read = this->Read.find(file);
    const FileAge now(file);
    if (read != this->Read.end() && !(read->second == now))
    {
      files.push_back(file);
      read->second = now;
    }
  }
  return files;
}

void SceneDocument::loadModels(const SceneDescription& scene)
{
  this->Models.load(scene);
  if (this->Models.size() != this->Known)
  {
    this->Known = this->Models.size();
    addAges(this->Read, scene);
  }
}

void SceneDocument::writeCopy(const std::string& path) const
{
  writeScene(this->Scene, std::filesystem::absolute(path).lexically_normal().string());
}

std::string SceneDocument::json() const { return toJson(this->Scene, this->Scene.folder); }

SceneDocument::ItemState SceneDocument::stateOf(const SceneDescription& scene, const SceneItem& item)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
      return scene.objects.at(item.index);
    case SceneItem::Kind::Light:
      return scene.lights.at(item.index);
    default:
      return scene.cameras.at(item.index);
  }
}

void SceneDocument::putState(SceneDescription& scene, const SceneItem& item, const ItemState& state)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
      scene.objects.at(item.index) = std::get<ObjectDescription>(state);
      break;
    case SceneItem::Kind::Light:
      scene.lights.at(item.index) = std::get<LightDescription>(state);
      break;
    default:
      scene.cameras.at(item.index) = std::get<CameraDescription>(state);
  }
}

void SceneDocument::edit(
  const std::string& text, const std::function<void(SceneDescription&)>& change, const std::string& merge)
{
  SceneDescription after = this->Scene;
  change(after);
  validate(after);
  this->loadModels(after);
  Step step;
  step.text = text;
  step.merge = merge;
  step.whole = true;
  step.before = std::exchange(this->Scene, after);
  step.after = std::move(after);
  this->accept(std::move(step));
}

void SceneDocument::editItem(const std::string& text, const SceneItem& item,
  const std::function<void(SceneDescription&)>& change, const std::string& merge)
{
  Step step;
  step.text = text;
  step.merge = merge;
  step.item = item;
  step.itemBefore = stateOf(this->Scene, item);
  try
  {
    change(this->Scene);
    validate(this->Scene);
    this->loadModels(this->Scene);
  }
  catch (...)
  {
    putState(this->Scene, item, step.itemBefore);
    throw;
  }
  step.itemAfter = stateOf(this->Scene, item);
  this->accept(std::move(step));
}

void SceneDocument::accept(Step step)
{
  if (!step.merge.empty() && (this->Done.empty() || this->Done.back().merge != step.merge))
  {
    this->Before = std::move(this->Undone);
    this->CleanBefore = this->Clean;
  }
  // Steps after the saved one are gone for good.
  if (this->Clean != unreachable && this->Clean > this->Done.size())
  {
    this->Clean = unreachable;
  }
  this->Undone.clear();
  Step* last = this->Done.empty() || this->Clean == this->Done.size() ? nullptr : &this->Done.back();
  if (last != nullptr && !step.merge.empty() && last->merge == step.merge && last->whole == step.whole &&
      last->item == step.item)
  {
    last->after = std::move(step.after);
    last->itemAfter = std::move(step.itemAfter);
  }
  else
  {
    this->Done.push_back(std::move(step));
    this->forget();
  }
  this->notify();
}

void SceneDocument::forget()
{
  std::size_t items = 0;
  for (std::size_t i = this->Done.size(); i-- > 0;)
  {
    items += this->Done[i].whole ? sizeOf(this->Done[i].before) + sizeOf(this->Done[i].after) : 2;
    if (items > mostItemsKept && i + 1 < this->Done.size())
    {
      this->Done.erase(this->Done.begin(), this->Done.begin() + std::ptrdiff_t(i) + 1);
      for (std::size_t* const clean : { &this->Clean, &this->CleanBefore })
      {
        *clean = *clean == unreachable || *clean <= i ? unreachable : *clean - i - 1;
      }
      return;
    }
  }
}

bool SceneDocument::lastChangesNothing() const
{
  const Step& last = this->Done.back();
  SceneDescription before = last.whole ? last.before : this->Scene;
  if (!last.whole)
  {
    putState(before, last.item, last.itemBefore);
  }
  return toJson(before, before.folder) == this->json();
}

void SceneDocument::finishMerging()
{
  if (this->Done.empty() || this->Done.back().merge.empty())
  {
    return;
  }
  if (this->lastChangesNothing())
  {
    this->abandon();
  }
  else
  {
    this->Done.back().merge.clear();
  }
}

void SceneDocument::abandon()
{
  if (this->Done.empty() || this->Done.back().merge.empty())
  {
    return;
  }
  const Step step = std::move(this->Done.back());
  this->Done.pop_back();
  this->putBack(step);
  this->Undone = std::move(this->Before);
  this->Clean = this->CleanBefore;
  this->notify();
}

void SceneDocument::putBack(const Step& step)
{
  if (step.whole)
  {
    this->put(step.before);
  }
  else
  {
    putState(this->Scene, step.item, step.itemBefore);
  }
}

void SceneDocument::put(SceneDescription scene)
{
  this->Scene = std::move(scene);
  this->Scene.file = this->Path;
}

void SceneDocument::undo()
{
  if (!this->canUndo())
  {
    return;
  }
  Step step = std::move(this->Done.back());
  this->Done.pop_back();
  step.merge.clear();
  this->putBack(step);
  this->Undone.push_back(std::move(step));
  if (!this->Done.empty())
  {
    this->Done.back().merge.clear();
  }
  this->notify();
}

void SceneDocument::redo()
{
  if (!this->canRedo())
  {
    return;
  }
  Step step = std::move(this->Undone.back());
  this->Undone.pop_back();
  if (step.whole)
  {
    this->put(step.after);
  }
  else
  {
    putState(this->Scene, step.item, step.itemAfter);
  }
  this->Done.push_back(std::move(step));
  this->notify();
}

SceneDescription SceneDocument::descriptionOf(const std::string& path) const
{
  namespace fs = std::filesystem;
  ObjectDescription object;
  object.name = fs::path(path).stem().string() + "-1"; // as .scene files imply
  object.model = fs::absolute(path).lexically_normal().lexically_relative(this->Scene.folder).generic_string();
  SceneDescription part;
  part.file = this->Scene.file;
  part.folder = this->Scene.folder;
  part.objects.push_back(std::move(object));
  return part;
}

std::function<std::optional<ModelLibrary>(const LoadProgress&)> SceneDocument::modelReader(
  const std::string& path) const
{
  return [part = this->descriptionOf(path), models = this->Models](const LoadProgress& progress)
  {
    ModelLibrary more = models;
    return more.load(part, progress) ? std::make_optional(std::move(more)) : std::nullopt;
  };
}

std::shared_ptr<const Model> SceneDocument::modelIn(const ModelLibrary& models, const std::string& path) const
{
  const SceneDescription part = this->descriptionOf(path);
  return models.modelOf(part, part.objects.front());
}

SceneItem SceneDocument::addModel(const std::string& path)
{
  return this->paste("Import " + std::filesystem::path(path).filename().string(), this->descriptionOf(path)).front();
}

template <typename Description>
SceneItem SceneDocument::addTo(
  std::vector<Description> SceneDescription::*list, Description item, const char* usualName, const std::string& text)
{
  SceneDescription part;
  part.folder = this->Scene.folder;
  item.name = item.name.empty() ? usualName : item.name;
  (part.*list).push_back(std::move(item));
  return this->paste(text, part).front();
}

SceneItem SceneDocument::addLight(LightDescription light)
{
  return this->addTo(&SceneDescription::lights, std::move(light), "Light0", "Add light");
}

SceneItem SceneDocument::addCamera(CameraDescription camera)
{
  return this->addTo(&SceneDescription::cameras, std::move(camera), "Camera0", "Add camera");
}

SceneItems SceneDocument::paste(const std::string& text, const SceneDescription& from)
{
  SceneItems added;
  this->edit(text, [&](SceneDescription& scene) { added = appendItems(scene, from); });
  return added;
}

void SceneDocument::remove(const SceneItems& items)
{
  if (!items.empty())
  {
    this->edit("Delete", [&](SceneDescription& scene) { removeItems(scene, items); });
  }
}

} // namespace dgtk
