// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkScene
 * @brief A loaded scene: its cameras, objects and frames.
 *
 * Methods that can fail return false and leave a line in GetErrorMessage().
 */
#ifndef dgtkScene_h
#define dgtkScene_h

#include "dgtkPipelineModule.h"
#include "vtkObject.h"

#include <functional> // work that may fail
#include <memory>     // private state
#include <string>     // names

namespace dgtk
{
class Stage;
}

class DGTKPIPELINE_EXPORT dgtkScene : public vtkObject
{
public:
  static dgtkScene* New();
  vtkTypeMacro(dgtkScene, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Reads a .scene or .json file and the models that it names. On failure the scene is empty.
   */
  bool Load(const std::string& path);
  ///@{
  /**
   * The same of a scene's .json text; its relative paths start in `folder`. Models that `like` has loaded are not read
   * again, whatever became of their files; `like` stays as it is.
   */
  bool LoadText(const std::string& json, const std::string& folder);
  bool LoadTextLike(const std::string& json, const std::string& folder, dgtkScene* like);
  ///@}

  ///@{
  /**
   * The scene's canonical .json text, empty without a scene, and where its relative paths start: an absolute path.
   */
  std::string GetDescription() const;
  std::string GetFolder() const;
  ///@}
  /**
   * The absolute path that the scene was loaded from; empty for one of a text.
   */
  std::string GetFile() const;

  ///@{
  /**
   * What went wrong last, one line; empty after success. The code is the exit status that it means for a program: 3
   * for input that cannot be used, 4 for what the machine cannot do; 0 after success.
   */
  std::string GetErrorMessage() const;
  int GetErrorCode() const;
  ///@}

  /**
   * What deserves a word of a scene that was loaded, as textures that are missing: a line each.
   */
  std::string GetWarnings() const;

  ///@{
  /**
   * Cameras, in the scene's order.
   */
  int GetNumberOfCameras() const;
  std::string GetCameraName(int index) const;
  ///@}

  ///@{
  /**
   * Objects with geometry; the object at `index` has id index + 1 in the `objects` layer.
   */
  int GetNumberOfObjects() const;
  std::string GetObjectName(int index) const;
  ///@}

  ///@{
  /**
   * First and last frame, both included.
   */
  int GetFirstFrame() const;
  int GetLastFrame() const;
  ///@}

#ifndef __VTK_WRAP__
  std::shared_ptr<const dgtk::Stage> GetStage() const;
  /**
   * Models are kept in the user's folder of models that were read, unless the program has said otherwise.
   */
  static void UseModelCache();
#endif

protected:
  dgtkScene();
  ~dgtkScene() override;

#ifndef __VTK_WRAP__
  /**
   * For scenes that come from elsewhere than a file; null empties the scene.
   */
  void SetStage(std::shared_ptr<const dgtk::Stage> stage);
  /**
   * Does what may throw: false then, and GetErrorMessage() says why.
   */
  bool Attempt(const std::function<void()>& work);
#endif

private:
  dgtkScene(const dgtkScene&) = delete;
  void operator=(const dgtkScene&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
