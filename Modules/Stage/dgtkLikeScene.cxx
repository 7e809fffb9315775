// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLikeScene.h"

#include "dgtkStageModels.h"

#include <utility>

namespace dgtk
{

StageWithFiles loadLike(SceneDescription scene, const ReadFiles* known, const Stage::WarningSink& warning)
{
  nameAll(scene);
  validate(scene);
  const StageModels read(scene, warning, known ? *known : ReadFiles());
  std::shared_ptr<const Stage> stage = Stage::make(std::move(scene), read);
  return { stage, std::make_shared<ReadFiles>(read.read()) };
}

} // namespace dgtk
