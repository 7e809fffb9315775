// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkDatasetExporter
 * @brief Writes a dataset in the format of other people's tools, as `dgtk export` does.
 *
 * The run has a thread of its own; who started it waits for its reports, and may cancel it. An export has the same
 * bytes however it was made.
 */
#ifndef dgtkDatasetExporter_h
#define dgtkDatasetExporter_h

#include "dgtkPipelineModule.h"
#include "vtkObject.h"

#include <memory> // private state
#include <string> // names

class DGTKPIPELINE_EXPORT dgtkDatasetExporter : public vtkObject
{
public:
  static dgtkDatasetExporter* New();
  vtkTypeMacro(dgtkDatasetExporter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The dataset's folder, the one of the export, and the name of the format, see GetFormats().
   */
  void SetDataset(const std::string& folder);
  void SetFolder(const std::string& folder);
  void SetFormat(const std::string& name);
  ///@}
  /**
   * Frames first, first + step, ... up to last, included. Default: all.
   */
  void SetFrames(int first, int last, int step);
  /**
   * Any of the options of GetOptions(), as on the command line.
   */
  void SetOption(const std::string& name, const std::string& value);
  /**
   * All options of all formats, one a line, see dgtkRenderer::GetOptions().
   */
  static std::string GetOptions();
  /**
   * All formats: name, layers that a dataset must have, separated by commas, and description, separated by tabs, one a
   * line.
   */
  static std::string GetFormats();

  ///@{
  /**
   * Continue an interrupted export of the same request; remove another one, or an interrupted one, that the folder
   * holds.
   */
  void SetResume(bool resume);
  void SetReplace(bool replace);
  ///@}

  ///@{
  /**
   * As those of dgtkDatasetGenerator.
   */
  void Start();
  bool IsRunning() const;
  bool Wait(int milliseconds);
  int GetDone() const;
  int GetTotal() const;
  void Cancel();
  std::string GetErrorMessage() const;
  int GetErrorCode() const;
  ///@}

protected:
  dgtkDatasetExporter();
  ~dgtkDatasetExporter() override;

private:
  dgtkDatasetExporter(const dgtkDatasetExporter&) = delete;
  void operator=(const dgtkDatasetExporter&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
