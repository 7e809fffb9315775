// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelSource_h
#define dgtkModelSource_h

#include "dgtkModelClock.h"
#include "dgtkSceneState.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A model at a place of an object that is made of many.
struct ModelCopy
{
  std::shared_ptr<const Model> model;
  std::shared_ptr<const std::vector<Material>> materials;
  Affine3 object_from_model;
  std::uint32_t firstPart = 0; ///< as Instance has them
  std::uint32_t firstTriangle = 0;
  std::uint32_t firstInPart = 0;
};

/// What an object looks like: its model with the materials that the scene gives it. Null: nothing is known.
struct ObjectLook
{
  std::shared_ptr<const Model> model;
  std::shared_ptr<const std::vector<Material>> materials;
  bool standsIn = false; ///< for a model that is not there: without its animations
  /// Instead of `model`, which is that of one of them; null: the object is its model. They have no animations.
  std::shared_ptr<const std::vector<ModelCopy>> copies = nullptr;
};

/// Where a stage has its models from: files, a library that grows, memory.
class ModelSource
{
public:
  virtual ~ModelSource() = default;
  /// Objects that look the same share it. Throws InputError for an object that cannot look so.
  virtual ObjectLook lookOf(const SceneDescription& scene, const ObjectDescription& object) const = 0;
  /// Null for none.
  virtual std::shared_ptr<const EnvironmentState> environment(const SceneDescription& scene) const = 0;
  /// Whether light above white is cut before it is blended, as OpenGL does.
  virtual bool cutsAtWhite() const { return false; }
  /// Every file that was read for the scene, without repetition; none where that is not known.
  virtual std::vector<std::string> files() const { return {}; }
  /// Of the models, which live as long as it does. Not null.
  virtual std::shared_ptr<GeometryCache> geometries() const = 0;
};

} // namespace dgtk

#endif
