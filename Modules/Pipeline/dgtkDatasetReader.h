// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkDatasetReader
 * @brief Reads layers of a picture of a dataset into arrays.
 *
 * The arrays are those that dgtkRenderer gives for the same request, with the values of the dataset's files, whatever
 * their formats are. Threads may read at the same time, each with a reader of its own (ShallowCopy()); Python's lock is
 * free meanwhile.
 */
#ifndef dgtkDatasetReader_h
#define dgtkDatasetReader_h

#include "dgtkLayerOutputs.h"
#include "dgtkPipelineModule.h"

#include <memory> // private state
#include <string> // names

class DGTKPIPELINE_EXPORT dgtkDatasetReader : public dgtkLayerOutputs
{
public:
  static dgtkDatasetReader* New();
  vtkTypeMacro(dgtkDatasetReader, dgtkLayerOutputs);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Opens the dataset of a folder. False for what is none, or is not finished; see GetErrorMessage().
   */
  bool Open(const std::string& folder);
  /**
   * The dataset that another reader has opened.
   */
  void ShallowCopy(dgtkDatasetReader* other);

  ///@{
  /**
   * The pictures, sorted by camera, then frame.
   */
  int GetNumberOfPictures() const;
  std::string GetPictureCamera(int index) const;
  int GetPictureFrame(int index) const;
  ///@}

  /**
   * The layers of which some picture has a file, in the order of `dgtk list`; each with its outputs ("flow_forward",
   * "flow_forward_class") after tabulators, one layer a line.
   */
  std::string GetLayers() const;

  /**
   * Reads layers of a picture, their names separated by commas; a layer's output may be named alone. False on failure,
   * see GetErrorMessage(), which also names the layers that the picture has.
   */
  bool Read(const std::string& camera, int frame, const std::string& layers);

protected:
  dgtkDatasetReader();
  ~dgtkDatasetReader() override;

private:
  dgtkDatasetReader(const dgtkDatasetReader&) = delete;
  void operator=(const dgtkDatasetReader&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
