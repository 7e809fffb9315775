// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLikeScene_h
#define dgtkLikeScene_h

#include "dgtkStageModule.h"

#include "dgtkStage.h"

#include <memory>

namespace dgtk
{

struct ReadFiles;

/// A loaded scene, and what was read for it.
struct StageWithFiles
{
  std::shared_ptr<const Stage> stage; ///< its inputFiles() are not known
  std::shared_ptr<const ReadFiles> files;
};

/// Stage::load(); but models and the picture of the environment that are among the files of another scene are not read
/// again, whatever became of them. Models with the same textures are the same ones, so that what was made of their
/// geometry is used again. `known` may be null.
DGTKSTAGE_EXPORT StageWithFiles loadLike(
  SceneDescription scene, const ReadFiles* known, const Stage::WarningSink& warning = {});

} // namespace dgtk

#endif
