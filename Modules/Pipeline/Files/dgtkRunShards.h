// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunShards_h
#define dgtkRunShards_h

#include "dgtkPipelineModule.h"

#include "dgtkGenerator.h"
#include "dgtkRunParts.h"

#include <optional>
#include <string>

namespace dgtk
{

/// Makes a share of a run into its folder; any number of processes may do so at the same time, also the same share.
/// Blocks of pictures (of scenes, where `scene` is a folder of them) do not depend on the number of processes. What is
/// there of the same run is kept. mergeParts() ends the run, when all shares are there. Throws what generate() throws;
/// AgainError when another process is busy with a block of this share.
DGTKPIPELINE_EXPORT GeneratorResult generateShard(
  const GeneratorRequest& request, const RunShard& shard, const GeneratorCallbacks& callbacks = {});

/// Whether a request names a folder of scenes.
DGTKPIPELINE_EXPORT bool namesScenes(const GeneratorRequest& request);

/// Renders every scene of a folder, in the order of their names, as a dataset in a folder of the scene's name, and ends
/// with a manifest of all. Models are loaded once. A scene that cannot be rendered is named, the others go on, and an
/// InputError follows; the same run may then be resumed.
DGTKPIPELINE_EXPORT GeneratorResult generateScenes(
  const GeneratorRequest& request, const GeneratorCallbacks& callbacks = {});

} // namespace dgtk

#endif
