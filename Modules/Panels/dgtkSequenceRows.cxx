// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkSequenceBar.h"

namespace dgtk
{

void PropertiesPanel::buildSequence(std::size_t index)
{
  const ModelLibrary& models = this->State.document().models();
  const std::vector<std::string> names = sequencesOf(this->State.scene(), this->State.scene().objects[index], models);
  if (names.empty())
  {
    return;
  }
  QStringList words;
  for (const std::string& name : names)
  {
    words << toText(name);
  }
  // Of others that are selected only those of the same model have these sequences.
  const auto animation = [index, model = this->State.scene().objects[index].model](
                           SceneDescription& scene) -> AnimationDescription&
  {
    static AnimationDescription noOnes;
    ObjectDescription& object = scene.objects[index];
    return object.model == model ? object.animation : noOnes;
  };
  this->addChoice(
    tr("Sequence"), "sequence", words,
    [index, &models](const SceneDescription& scene) { return currentSequence(scene, scene.objects[index], models); },
    [animation, names](SceneDescription& scene, int choice)
    { animation(scene).sequence = names[std::size_t(choice)]; });
  this->addNumber(tr("Begins at frame"), "sequenceStart",
    [animation](SceneDescription& scene) -> double& { return animation(scene).start; });
  this->addNumber(
    tr("Speed"), "sequenceRate", [animation](SceneDescription& scene) -> double& { return animation(scene).rate; });
  this->addCheck(
    tr("Repeat"), "sequenceLoop", [animation](SceneDescription& scene) -> bool& { return animation(scene).loop; });
}

} // namespace dgtk
