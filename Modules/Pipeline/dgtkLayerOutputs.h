// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkLayerOutputs
 * @brief What a renderer has drawn last, or a reader of datasets has read: arrays of a picture's layers.
 */
#ifndef dgtkLayerOutputs_h
#define dgtkLayerOutputs_h

#include "dgtkPipelineModule.h"
#include "vtkObject.h"

#include <memory> // private state
#include <string> // names
#include <vector> // private state

class vtkDataArray;
namespace dgtk
{
struct LayerArray;
}

class DGTKPIPELINE_EXPORT dgtkLayerOutputs : public vtkObject
{
public:
  vtkTypeMacro(dgtkLayerOutputs, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Arrays with the values of the layers' files, named by the output ("depth", "flow_forward_class"). An image has
   * GetWidth() x GetHeight() tuples, rows top to bottom. A document's bytes have a format ("json"). A layered depth
   * image is several arrays of one name, each a part: "count" (an image), "rgba", "depth" and "splat" of all its
   * surfaces. Arrays belong to the caller's reference.
   */
  int GetNumberOfOutputs() const;
  vtkDataArray* GetOutput(int index) const;
  std::string GetOutputPart(int index) const;
  std::string GetOutputFormat(int index) const;
  bool IsOutputImage(int index) const;
  ///@}

  ///@{
  /**
   * Size of the picture, pixels.
   */
  int GetWidth() const;
  int GetHeight() const;
  ///@}

  ///@{
  /**
   * What went wrong last, one line; empty after success. The code is the exit status that it means for a program: 2
   * for a wrong request, 3 for input that cannot be used, 4 for what the machine cannot do; 0 after success.
   */
  std::string GetErrorMessage() const;
  int GetErrorCode() const;
  ///@}

protected:
  dgtkLayerOutputs();
  ~dgtkLayerOutputs() override;

  /// After success. Takes the data of each array in turn, so that memory does not hold all of them twice.
  void SetOutputs(std::vector<dgtk::LayerArray> arrays, int width, int height);
  /// In a handler: what is handled went wrong, and there are no outputs.
  void SetFailure();

private:
  dgtkLayerOutputs(const dgtkLayerOutputs&) = delete;
  void operator=(const dgtkLayerOutputs&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Outputs;
};

#endif
