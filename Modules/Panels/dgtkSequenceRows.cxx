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
  const auto animation = [index](SceneDescription& scene) -> AnimationDescription&
  { return scene.objects[index].animation; };
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
