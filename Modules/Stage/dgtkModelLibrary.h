// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelLibrary_h
#define dgtkModelLibrary_h

#include "dgtkStageModule.h"

#include "dgtkModelSource.h"
#include "dgtkStage.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

class MaterialNumbers;

/// Called between files with how many are read, of how many; false stops.
using LoadProgress = std::function<bool(std::size_t done, std::size_t total)>;

/// What becomes of a model whose file is not there.
enum class AbsentModel
{
  Refused,
  Box ///< of 1 x 1 x 1, grey, about the origin
};

/// A library of models that grows: those of a scene that changes, as Stage::load() prepares them (materials replaced),
/// and their motion. Objects that differ in nothing but their place and time share everything; what was loaded once
/// stays for undo.
class DGTKSTAGE_EXPORT ModelLibrary : public ModelSource
{
public:
  ModelLibrary();

  /// Loads what the scene needs beyond what is there. Throws what Stage::load throws, but for an environment that
  /// cannot be read: that is a warning. The store is then as before; also when the result is false, because `progress`
  /// stopped it.
  /// A file that was absent once is a box while it is, without being asked for.
  bool load(
    const SceneDescription& scene, const LoadProgress& progress = {}, AbsentModel absent = AbsentModel::Refused);
  /// The objects that are boxes because their model's file is not there: indices.
  std::vector<std::size_t> absent(const SceneDescription& scene) const;
  /// What is wrong with what was loaded, one line each, in the order in which it was found. Lines are only added.
  const std::vector<std::string>& warnings() const { return this->Warnings; }
  /// Takes over what another store has loaded.
  void adopt(const ModelLibrary& other);

  /// The object's geometry and materials at a frame; world_from_object is without meaning. `model` is null for a model
  /// without triangles, and for one that was not loaded.
  Instance at(const SceneDescription& scene, const ObjectDescription& object, double frame) const;
  /// The object's model, also one without triangles; null for one that was not loaded.
  std::shared_ptr<const Model> modelOf(const SceneDescription& scene, const ObjectDescription& object) const;

  ObjectLook lookOf(const SceneDescription& scene, const ObjectDescription& object) const override;
  /// Null also for one that was not loaded.
  std::shared_ptr<const EnvironmentState> environment(const SceneDescription& scene) const override;
  std::shared_ptr<GeometryCache> geometries() const override { return this->Moving; }

  /// Number of different models with their materials.
  std::size_t size() const { return this->Entries.size(); }

private:
  struct Entry
  {
    std::shared_ptr<const Stage> stage; ///< of one object for each look of a file; null for a box
    std::shared_ptr<const Model> model;
    std::size_t instance = 0;
    bool empty = false;
  };
  using EntryMap = std::map<std::string, Entry>;

  static std::string keyOf(const SceneDescription& scene, const ObjectDescription& object);
  static void loadFile(
    SceneDescription wanted, const std::vector<std::string>& keys, EntryMap& into, const Stage::WarningSink& warning);
  static std::string environmentKey(const SceneDescription& scene);
  static std::shared_ptr<const EnvironmentState> readEnvironment(
    const SceneDescription& scene, const Stage::WarningSink& warning);
  void addWarnings(const std::vector<std::string>& lines);
  void take(const EntryMap& entries);
  static const Entry* find(const EntryMap& entries, const std::string& key);

  EntryMap Entries;
  std::map<std::string, std::shared_ptr<const EnvironmentState>> Environments;
  std::set<std::string> Absent; ///< files
  std::vector<std::string> Warnings;
  std::shared_ptr<GeometryCache> Moving;
  std::shared_ptr<MaterialNumbers> Materials;
};

} // namespace dgtk

#endif
