// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerArrays_h
#define dgtkLayerArrays_h

// Private to Pipeline.

#include "dgtkArraySink.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace dgtk
{

/// The outputs of a picture as VTK has them. Functions with an index that there is not return nothing.
class LayerArrays
{
public:
  LayerArrays() = default;
  /// Takes the data of each in turn, so that memory does not hold all of them twice.
  explicit LayerArrays(std::vector<LayerArray> arrays);

  int count() const { return static_cast<int>(this->Arrays.size()); }
  vtkDataArray* array(int index) const;
  std::string part(int index) const;
  std::string format(int index) const;
  bool isImage(int index) const;

private:
  std::vector<LayerArray> Own; // without their data
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
};

} // namespace dgtk

#endif
