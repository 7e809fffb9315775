// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSequenceBar.h"

#include "dgtkModelClock.h"

#include <limits>

namespace dgtk
{

namespace
{
/// Frames of the scene at rate 1; below or equal to 0 for a sequence of a single pose.
double lengthAtRateOne(const SceneDescription& scene, const ObjectDescription& object, const Model& model, int sequence)
{
  const AnimationDescription& animation = object.animation;
  const double poses = sequenceSpan(model, sequence, animation.loop) - animation.offset;
  return poses * scene.fps / model.animations[std::size_t(sequence)].fps;
}
} // namespace

int currentSequence(const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models)
{
  const std::shared_ptr<const Model> model = models.modelOf(scene, object);
  return model && model->deformation ? findAnimation(scene, object, *model) : -1;
}

std::vector<std::string> sequencesOf(
  const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models)
{
  std::vector<std::string> names;
  const std::shared_ptr<const Model> model = models.modelOf(scene, object);
  if (model && model->deformation)
  {
    for (const Animation& animation : model->animations)
    {
      names.push_back(animation.name);
    }
  }
  return names;
}

std::optional<SequenceBar> sequenceBar(
  const SceneDescription& scene, const ObjectDescription& object, const ModelLibrary& models)
{
  const int sequence = currentSequence(scene, object, models);
  if (sequence < 0)
  {
    return std::nullopt;
  }
  const std::shared_ptr<const Model> model = models.modelOf(scene, object);
  SequenceBar bar;
  bar.name = model->animations[std::size_t(sequence)].name;
  bar.start = object.animation.start;
  bar.loop = object.animation.loop;
  const double natural = lengthAtRateOne(scene, object, *model, sequence);
  bar.length = object.animation.rate > 0 && natural > 0 ? natural / object.animation.rate
                                                        : std::numeric_limits<double>::infinity();
  return bar;
}

void setSequenceLength(
  const SceneDescription& scene, ObjectDescription& object, const ModelLibrary& models, double length)
{
  const int sequence = currentSequence(scene, object, models);
  if (sequence >= 0)
  {
    const double natural = lengthAtRateOne(scene, object, *models.modelOf(scene, object), sequence);
    object.animation.rate = natural > 0 ? natural / length : object.animation.rate;
  }
}

} // namespace dgtk
