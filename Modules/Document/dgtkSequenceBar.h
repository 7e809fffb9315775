// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSequenceBar_h
#define dgtkSequenceBar_h

#include "dgtkDocumentModule.h"

#include "dgtkModelLibrary.h"

#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// When an object shows the sequence of its model, in frames of the scene.
struct SequenceBar
{
  std::string name;
  double start = 0;  ///< first frame of the sequence
  double length = 0; ///< until it is done or begins again; infinite when it stands still
  bool loop = false;
};

/// None for an object whose model does not move, or was not loaded.
DGTKDOCUMENT_EXPORT std::optional<SequenceBar> sequenceBar(
  const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models);

/// Sets the rate with which a sequence takes `length` > 0 frames of the scene. No change where there is no sequence, or
/// one of a single pose.
DGTKDOCUMENT_EXPORT void setSequenceLength(
  const SceneDescription& scene, ObjectDescription& object, const ModelLibrary& models, double length);

/// Names of the sequences that the object's model has.
DGTKDOCUMENT_EXPORT std::vector<std::string> sequencesOf(
  const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models);

/// Index of the one that is shown, -1 without any.
DGTKDOCUMENT_EXPORT int currentSequence(
  const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models);

} // namespace dgtk

#endif
