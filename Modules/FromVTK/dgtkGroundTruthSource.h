// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkGroundTruthSource
 * @brief Ground truth of a VTK renderer, or of a scene, as the start of a VTK pipeline.
 *
 * The output is a vtkImageData of the picture's size with an array of points for each output of the layers ("depth",
 * "flow_forward_class"), the first one being its scalars. Rows are VTK's, from bottom to top; values and types are
 * those of the layers' files. "cells", of a renderer, are the cells of the mappers' inputs
 * (dgtkSnapshot::TraceCells()).
 *
 * It executes again when the renderer, its camera, lights or props, or what these show, were modified.
 */
#ifndef dgtkGroundTruthSource_h
#define dgtkGroundTruthSource_h

#include "dgtkFromVTKModule.h"
#include "vtkImageAlgorithm.h"

#include <memory> // private state
#include <string> // names

class dgtkScene;
class vtkRenderer;

class DGTKFROMVTK_EXPORT dgtkGroundTruthSource : public vtkImageAlgorithm
{
public:
  static dgtkGroundTruthSource* New();
  vtkTypeMacro(dgtkGroundTruthSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whose picture it is: a renderer, or a scene with a camera by name (default: its first) at a frame (default: its
   * first). The last one that is set counts.
   */
  void SetRenderer(vtkRenderer* renderer);
  void SetScene(dgtkScene* scene);
  void SetCamera(const std::string& name);
  void SetFrame(int frame);
  ///@}

  /**
   * Layers, their names separated by commas; default: "depth".
   */
  void SetLayers(const std::string& layers);
  /**
   * Size in pixels; 0, 0 (default): the renderer's, or the camera's own.
   */
  void SetSize(int width, int height);
  /**
   * What a renderer shows that is no surface is left out, instead of being an error.
   */
  void SetSkipUnsupported(bool skip);
  /**
   * An option of dgtkRenderer: SetOption("samples", "4").
   */
  void SetOption(const std::string& name, const std::string& value);

  vtkMTimeType GetMTime() override;

protected:
  dgtkGroundTruthSource();
  ~dgtkGroundTruthSource() override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  dgtkGroundTruthSource(const dgtkGroundTruthSource&) = delete;
  void operator=(const dgtkGroundTruthSource&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
