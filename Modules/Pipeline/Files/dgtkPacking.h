// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPacking_h
#define dgtkPacking_h

// Private to Pipeline.

#include "dgtkDatasetRecords.h"
#include "dgtkStage.h"

#include <map>
#include <string>
#include <vector>

namespace dgtk
{

class RunSession;

/// Copies of all that a scene was loaded from, below `inputs` in a dataset, so placed that each model finds what it
/// names where it found it: the files of a model keep their places relative to each other.
struct Packing
{
  std::map<std::string, std::string> copies; ///< of Stage::inputFiles(): path -> path relative to the dataset
  SceneDescription scene;                    ///< names the copies; its folder is the dataset's
};

/// Throws UsageError for a scene that was loaded from the copies in `folder`, which goes before it is rendered into.
void refuseOwnInputs(const Stage& stage, const std::string& folder);

/// Depends on the scene and on what its models name, not on where they are.
Packing planPacking(const Stage& stage, const std::string& folder);

/// What a scene was loaded from, as the dataset in `folder` records it: the copies, each once, if there is a packing.
std::vector<InputRecord> recordedInputs(
  const Stage& stage, const std::string& folder, const Packing* packing, RunSession& session);

/// Loads the packed scene, whose copies are in place. Throws InputError unless it reads the copies and nothing else.
void checkPacking(const Packing& packing, const Stage& stage);

} // namespace dgtk

#endif
