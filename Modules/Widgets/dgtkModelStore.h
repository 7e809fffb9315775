// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelStore_h
#define dgtkModelStore_h

#include "dgtkWidgetsModule.h"

#include "dgtkStage.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace dgtk
{

/// The models of a scene that changes, as Stage prepares them (materials replaced, motion applied). Objects that differ
/// in nothing but their place share everything; what was loaded once stays for undo.
class DGTKWIDGETS_EXPORT ModelStore
{
public:
  /// Loads what the scene needs beyond what is there. Throws what Stage::load throws; the store is then as before.
  void load(const SceneDescription& scene);

  /// The object's geometry and materials at a frame; world_from_object is without meaning. `model` is null for a model
  /// without triangles, and for one that was not loaded.
  Instance at(const SceneDescription& scene, const ObjectDescription& object, double frame) const;

  /// Number of different models with their materials.
  std::size_t size() const { return this->Entries.size(); }

private:
  struct Entry
  {
    std::shared_ptr<const Stage> stage; ///< of one object for each entry loaded together
    std::size_t instance = 0;
    bool empty = false;
  };
  static std::string keyOf(const SceneDescription& scene, const ObjectDescription& object);
  std::map<std::string, Entry> Entries;
};

} // namespace dgtk

#endif
