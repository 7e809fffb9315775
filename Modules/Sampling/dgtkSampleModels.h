// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleModels_h
#define dgtkSampleModels_h

#include "dgtkSamplingModule.h"

#include "dgtkModel.h"
#include "dgtkSceneDescription.h"
#include "dgtkStage.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace dgtk
{

/// What is read or made of models, once for all samples: of files it grows with the number of different ones only, of
/// their looks (materials, textures) the last mostLooks or so are kept. Thread-safe.
class DGTKSAMPLING_EXPORT SampleModels
{
public:
  static constexpr std::size_t mostLooks = 1000;

  SampleModels();
  ~SampleModels();
  SampleModels(const SampleModels&) = delete;
  SampleModels& operator=(const SampleModels&) = delete;

  /// The model of a file, its textures not decoded; `path` as SceneDescription::resolve() gives it. The same pointer at
  /// every call. Throws what readModel() throws.
  std::shared_ptr<const Model> model(const std::string& path);

  /// The scene's geometry, with the textures that cut holes into it: without lights, environment and materials'
  /// colours. Objects without triangles are not there. Throws what Stage::load() throws.
  std::shared_ptr<const Stage> stage(const SceneDescription& scene);

  /// Models with their looks that are kept for further samples: at most mostLooks and those of one scene.
  std::size_t looks() const;

  /// What `make` gives for a key ("hulls\n" + path), made once; of one type a key. Others wait while it is made.
  template <typename T>
  std::shared_ptr<const T> kept(const std::string& key, const std::function<std::shared_ptr<const T>()>& make)
  {
    return std::static_pointer_cast<const T>(
      this->keptAny(key, [&make]() -> std::shared_ptr<const void> { return make(); }));
  }

private:
  std::shared_ptr<const void> keptAny(const std::string& key, const std::function<std::shared_ptr<const void>()>& make);
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
