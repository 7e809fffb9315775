// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStage_h
#define dgtkStage_h

#include "dgtkStageModule.h"

#include "dgtkSceneDescription.h"
#include "dgtkSceneState.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

class ModelSource;

/// One of the pictures whose mean, in linear light, is the colour of a frame: an instant, and a pinhole at a point of
/// the lens.
struct Exposure
{
  double frame = 0;
  View view;
};

/// A camera of any scene at a frame. 0, 0: its own size, or 640 x 480. K of another size is scaled per axis. Its files
/// are below `folder`. Throws what makeCamera() throws, and UsageError for a pose that is undefined (eye = look-at).
DGTKSTAGE_EXPORT View cameraView(
  const CameraDescription& camera, double frame, int width = 0, int height = 0, const std::string& folder = {});

/// A scene with everything that it names loaded. Immutable; all members are thread-safe.
class DGTKSTAGE_EXPORT Stage : public std::enable_shared_from_this<Stage>
{
public:
  /// Called with one line for each warning.
  using WarningSink = std::function<void(const std::string&)>;

  /// Validates the scene and reads each model file once, however its path is spelled, and each replacing texture.
  /// Throws InputError, with the scene's file and line, for models that are missing (all of them in one line) or one
  /// that cannot be used, an unknown sequence or skin, and cameras or objects that are invalid at a key frame. Missing
  /// textures are warnings.
  static std::shared_ptr<const Stage> load(SceneDescription scene, const WarningSink& warning = {});

  /// A stage over models that are there already: cheap, so that a description that changes gets a new one. Objects
  /// without a look, or with one without triangles, are not there and have no id. Throws what load() throws of
  /// descriptions, sequences and looks.
  static std::shared_ptr<const Stage> make(SceneDescription scene, const ModelSource& models);

  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const SceneDescription& description() const;

  /// The scene at a frame; fractions lie between frames. Rigid instances share their model's rest geometry, deforming
  /// ones that show the same model frame share one Geometry, also between states while it is in use.
  std::shared_ptr<const SceneState> at(double frame) const;

  /// A camera at a frame, with `instants` where it has a rolling shutter; they keep the stage. 0, 0: the camera's own
  /// size, or 640 x 480. K of another size is scaled per axis. Throws UsageError for an index or a size out of range,
  /// InputError where the pose is undefined (eye = look-at).
  View view(std::size_t camera, double frame, int width = 0, int height = 0) const;

  /// The exposures of a frame, none for a camera without shutter and lens, whose colour is that of view(). Exposure i
  /// of N, which is 1 where all would be the same, is at the frame plus open + (i + 1/2) / N (close - open). Points of
  /// the lens follow Vogel's spiral (1979), in bit-reversed order, so that time and lens are independent; the plane in
  /// focus stays where it is in the image.
  std::vector<Exposure> exposures(std::size_t camera, int frame, int width = 0, int height = 0) const;

  std::vector<std::string> cameraNames() const;
  /// Names of the objects with an id, in the order of the ids: objectNames()[id - 1].
  std::vector<std::string> objectNames() const;
  /// Of the objects with an id, in the order of the ids: whether it or what it hangs on has key frames of its place, or
  /// its model plays an animation. Others are the same at all frames but for their looks and whether they are visible.
  std::vector<bool> movingObjects() const;

  /// Models in the order of their first use, each once.
  std::vector<std::shared_ptr<const Model>> models() const;
  /// Every file that load() has read, without repetition: scene, classes, models with what they include, textures.
  std::vector<std::string> inputFiles() const;

private:
  struct Impl;
  class Instants;
  explicit Stage(std::unique_ptr<Impl> impl);
  static void check(SceneDescription& scene);
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
