// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLikeScene_h
#define dgtkLikeScene_h

#include "dgtkStageModule.h"

#include "dgtkStage.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace dgtk
{

struct ReadFiles;

/// A loaded scene, and what was read for it.
struct StageWithFiles
{
  std::shared_ptr<const Stage> stage; ///< its inputFiles() are those that the scene names, read now or before
  std::shared_ptr<const ReadFiles> files;
};

/// Stage::load(); but models and the picture of the environment that are among the files of another scene are not read
/// again, whatever became of them. Models with the same textures are the same ones, so that what was made of their
/// geometry is used again. `known` may be null.
DGTKSTAGE_EXPORT StageWithFiles loadLike(
  SceneDescription scene, const ReadFiles* known, const Stage::WarningSink& warning = {});

/// Loads one scene after another, as Stage::load() does: but models, the pictures that scenes give to their materials
/// and those of environments are read once, and models with the same pictures are the same ones, while all that is kept
/// takes no more than some memory; what was not used for longest goes then. One thread at a time.
class DGTKSTAGE_EXPORT SceneSeries
{
public:
  explicit SceneSeries(std::uint64_t bytes);
  ~SceneSeries();
  SceneSeries(const SceneSeries&) = delete;
  SceneSeries& operator=(const SceneSeries&) = delete;

  std::shared_ptr<const Stage> load(SceneDescription scene, const Stage::WarningSink& warning = {});

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
