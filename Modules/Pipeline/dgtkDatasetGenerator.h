// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkDatasetGenerator
 * @brief Writes a dataset, as `dgtk render` does.
 *
 * The run has a thread of its own; who started it waits for its reports, and may cancel it. A dataset has the same
 * bytes however it was made.
 */
#ifndef dgtkDatasetGenerator_h
#define dgtkDatasetGenerator_h

#include "dgtkPipelineModule.h"
#include "vtkObject.h"

#include <memory> // private state
#include <string> // names

class dgtkScene;

class DGTKPIPELINE_EXPORT dgtkDatasetGenerator : public vtkObject
{
public:
  static dgtkDatasetGenerator* New();
  vtkTypeMacro(dgtkDatasetGenerator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What is rendered: a .scene or .json file, a folder of them, or a loaded scene. One that was loaded from a file is
   * read again, with its models as they are now; the file must not have changed. Of a folder, each scene becomes a
   * dataset in a folder of its name.
   */
  void SetSceneFile(const std::string& path);
  void SetScene(dgtkScene* scene);
  ///@}
  /**
   * Where the dataset goes.
   */
  void SetFolder(const std::string& folder);

  ///@{
  /**
   * Names separated by commas; nothing (the default): the usual layers, all cameras.
   */
  void SetLayers(const std::string& names);
  void SetCameras(const std::string& names);
  ///@}
  /**
   * Formats of exports, separated by commas: the layers and options that they need are added; without SetLayers() they
   * are all there are.
   */
  void SetFormats(const std::string& names);
  /**
   * A file of the numbers of the classes, for scenes that fix none.
   */
  void SetClassFile(const std::string& path);
  /**
   * Frames first, first + step, ... up to last, included. Default: all.
   */
  void SetFrames(int first, int last, int step);
  /**
   * Size of the images in pixels; 0, 0 (the default) is each camera's own, or 640 x 480.
   */
  void SetSize(int width, int height);
  /**
   * Any of the options of GetOptions(), as on the command line, see dgtkRenderer::SetOption().
   */
  void SetOption(const std::string& name, const std::string& value);
  /**
   * All options, one a line, see dgtkRenderer::GetOptions().
   */
  static std::string GetOptions();

  ///@{
  /**
   * Continue an interrupted run of the same request; remove the dataset of another request, or an interrupted run,
   * that the folder holds.
   */
  void SetResume(bool resume);
  void SetReplace(bool replace);
  ///@}

  /**
   * Starts the run. It is over when IsRunning() is false; GetErrorMessage() then says how it went. Nothing happens
   * while another one is running. What is set meanwhile counts for the next one.
   */
  void Start();
  /**
   * Whether the run goes on, or has reports that nobody has waited for.
   */
  bool IsRunning() const;
  /**
   * Waits for the next report, at most so many milliseconds: true when there was one.
   */
  bool Wait(int milliseconds);
  ///@{
  /**
   * Of the last report: pictures (one camera at one frame), or scenes of a folder, that are done, of how many.
   */
  int GetDone() const;
  int GetTotal() const;
  ///@}
  /**
   * Ends the run soon. What is finished stays, and a run that resumes it makes the rest.
   */
  void Cancel();

  ///@{
  /**
   * What went wrong, one line; empty after success. The code is the exit status that it means for a program, see
   * dgtkRenderer::GetErrorCode().
   */
  std::string GetErrorMessage() const;
  int GetErrorCode() const;
  ///@}

protected:
  dgtkDatasetGenerator();
  ~dgtkDatasetGenerator() override;

private:
  dgtkDatasetGenerator(const dgtkDatasetGenerator&) = delete;
  void operator=(const dgtkDatasetGenerator&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
