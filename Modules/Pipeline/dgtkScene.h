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

#include <memory> // private state
#include <string> // names

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
  /**
   * What went wrong last, one line; empty after success.
   */
  std::string GetErrorMessage() const;

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
  std::shared_ptr<const dgtk::Stage> GetStage() const { return this->Stage; }
#endif

protected:
  dgtkScene();
  ~dgtkScene() override;

#ifndef __VTK_WRAP__
  /**
   * For scenes that come from elsewhere than a file; null empties the scene.
   */
  void SetStage(std::shared_ptr<const dgtk::Stage> stage);
#endif

private:
  dgtkScene(const dgtkScene&) = delete;
  void operator=(const dgtkScene&) = delete;

  std::shared_ptr<const dgtk::Stage> Stage;
  std::string ErrorMessage;
};

#endif
