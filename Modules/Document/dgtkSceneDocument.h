// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneDocument_h
#define dgtkSceneDocument_h

#include "dgtkDocumentModule.h"

#include "dgtkHash.h"
#include "dgtkModelLibrary.h"
#include "dgtkSceneEdits.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dgtk
{

/// A scene with its models, read from a file.
struct LoadedScene
{
  SceneDescription scene;
  ModelLibrary models;
  std::string path;
  std::string hash{};                    ///< of the file
  std::map<std::string, FileAge> read{}; ///< the files of the models
};

/// A scene that is being edited: description, file, models, undo and redo. Knows nothing of windows. Every edit is
/// validated; one that is refused (InputError) leaves everything as it was.
class DGTKDOCUMENT_EXPORT SceneDocument
{
public:
  SceneDocument();
  SceneDocument(const SceneDocument&) = delete;
  SceneDocument& operator=(const SceneDocument&) = delete;

  const SceneDescription& scene() const { return this->Scene; }
  const ModelLibrary& models() const { return this->Models; }
  /// The objects that are boxes because their model's file is not there: indices.
  std::vector<std::size_t> absent() const { return this->Models.absent(this->Scene); }
  /// "" before the first save.
  const std::string& path() const { return this->Path; }
  bool modified() const { return this->Done.size() != this->Clean; }
  /// Whether the file at path() is no longer what was read or saved here: another program has written or removed it.
  bool isReplaced() const;
  /// Whether that file has comments, which saving removes.
  bool losesComments() const;
  /// Files of the scene's models that have changed since they were read, or since this was asked last.
  std::vector<std::string> takeReplacedModels();
  /// Scenes so far: another number, and other models, after clear(), install(), open() and recover().
  std::size_t opened() const { return this->Opened; }
  /// Called after every change of scene, path or modified().
  void onChange(std::function<void()> listener) { this->Listeners.push_back(std::move(listener)); }

  void clear();
  /// The part of open() that takes long; for any thread. None when `progress` stopped it. Throws InputError, also for
  /// models that cannot be read; those whose file is not there become boxes.
  static std::optional<LoadedScene> read(const std::string& path, const LoadProgress& progress = {});
  void install(LoadedScene loaded);
  /// Throws as read().
  void open(const std::string& path);
  /// A copy of unsaved work becomes the unsaved state of the scene file `origin`, or of a scene without a name.
  void recover(LoadedScene loaded, const std::string& origin = {});
  /// By extension, .json or .scene. Throws InputError for what the format cannot say, MachineError.
  void saveAs(const std::string& path);
  /// The scene as it is now, for a program beside: does not change path() and modified(). Throws as saveAs().
  void writeCopy(const std::string& path) const;
  /// As the file would be beside the scene's own folder.
  std::string json() const;

  bool canUndo() const { return !this->Done.empty(); }
  bool canRedo() const { return !this->Undone.empty(); }
  /// What undo() or redo() would take back or do again; "" when there is nothing.
  std::string undoText() const { return this->canUndo() ? this->Done.back().text : std::string(); }
  std::string redoText() const { return this->canRedo() ? this->Undone.back().text : std::string(); }
  void undo();
  void redo();

  /// An edit of anything. Steps that follow one another with the same `merge` other than "" are undone together, until
  /// finishMerging().
  void edit(
    const std::string& text, const std::function<void(SceneDescription&)>& change, const std::string& merge = {});
  /// An edit of nothing but one item (not its name): its undo step holds no more than the item.
  void editItem(const std::string& text, const SceneItem& item, const std::function<void(SceneDescription&)>& change,
    const std::string& merge = {});
  /// Steps that have changed nothing together are taken back as by abandon().
  void finishMerging();
  /// Takes back the merged steps that finishMerging() has not ended yet, as if they had not been: what could be redone
  /// before them can be redone again. Nothing without such steps.
  void abandon();

  /// What addModel() and adopt() need of the disk: a function for any thread, which returns none when it was stopped
  /// and throws InputError.
  std::function<std::optional<ModelLibrary>(const LoadProgress&)> modelReader(const std::string& path) const;
  /// The model of such a store that addModel() would add.
  std::shared_ptr<const Model> modelIn(const ModelLibrary& models, const std::string& path) const;
  void adopt(const ModelLibrary& models) { this->Models.adopt(models); }
  /// A model file becomes an object at the origin, with a unique name. Throws InputError when it cannot be read.
  SceneItem addModel(const std::string& path);
  SceneItem addLight(LightDescription light);
  SceneItem addCamera(CameraDescription camera);
  /// Copies of everything in `from`; returns the new items.
  SceneItems paste(const std::string& text, const SceneDescription& from);
  void remove(const SceneItems& items);

private:
  using ItemState = std::variant<ObjectDescription, LightDescription, CameraDescription>;
  struct Step
  {
    std::string text;
    std::string merge;
    bool whole = false;
    SceneDescription before; ///< whole
    SceneDescription after;
    SceneItem item; ///< otherwise
    ItemState itemBefore;
    ItemState itemAfter;
  };

  SceneDescription descriptionOf(const std::string& modelPath) const;
  template <typename Description>
  SceneItem addTo(
    std::vector<Description> SceneDescription::*list, Description item, const char* usualName, const std::string& text);
  static ItemState stateOf(const SceneDescription& scene, const SceneItem& item);
  static void putState(SceneDescription& scene, const SceneItem& item, const ItemState& state);
  void accept(Step step);
  void putBack(const Step& step);
  /// A scene of a step, which may be older than the file's name.
  void put(SceneDescription scene);
  bool lastChangesNothing() const;
  void forget();
  void loadModels(const SceneDescription& scene);
  void reset(SceneDescription scene, const std::string& path, std::size_t clean);
  void notify() const;

  SceneDescription Scene;
  std::string Path;
  std::string Hash; ///< of its file
  ModelLibrary Models;
  std::size_t Known = 0;               ///< of the models: how many there were when their files were looked at
  std::map<std::string, FileAge> Read; ///< the files
  std::size_t Opened = 0;
  std::vector<Step> Done;
  std::vector<Step> Undone;
  std::vector<Step> Before;    ///< steps undone when the merging began
  std::size_t CleanBefore = 0; ///< then
  std::size_t Clean = 0;       ///< number of done steps at which the scene is what the file holds
  std::vector<std::function<void()>> Listeners;
};

} // namespace dgtk

#endif
