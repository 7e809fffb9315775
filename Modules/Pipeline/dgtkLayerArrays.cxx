// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerArrays.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>

namespace dgtk
{

namespace
{
vtkSmartPointer<vtkDataArray> arrayFor(PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
      return vtkSmartPointer<vtkUnsignedCharArray>::New();
    case PixelType::UInt16:
      return vtkSmartPointer<vtkUnsignedShortArray>::New();
    case PixelType::UInt32:
      return vtkSmartPointer<vtkUnsignedIntArray>::New();
    case PixelType::Float32:
      return vtkSmartPointer<vtkFloatArray>::New();
    default:
      return vtkSmartPointer<vtkDoubleArray>::New();
  }
}
} // namespace

LayerArrays::LayerArrays(std::vector<LayerArray> arrays)
  : Own(std::move(arrays))
{
  for (LayerArray& own : this->Own)
  {
    const vtkSmartPointer<vtkDataArray> array = arrayFor(own.type);
    const std::size_t tuple = bytesOf(own.type) * std::size_t(own.channels);
    array->SetName(own.name.c_str());
    array->SetNumberOfComponents(own.channels);
    array->SetNumberOfTuples(static_cast<vtkIdType>(own.data.size() / tuple));
    std::copy_n(own.data.data(), own.data.size(), static_cast<std::byte*>(array->GetVoidPointer(0)));
    own.data = {};
    this->Arrays.push_back(array);
  }
}

vtkDataArray* LayerArrays::array(int index) const
{
  return index >= 0 && index < this->count() ? this->Arrays[std::size_t(index)].Get() : nullptr;
}

std::string LayerArrays::part(int index) const
{
  return this->array(index) != nullptr ? this->Own[std::size_t(index)].part : std::string();
}

std::string LayerArrays::format(int index) const
{
  return this->array(index) != nullptr ? this->Own[std::size_t(index)].format : std::string();
}

bool LayerArrays::isImage(int index) const
{
  return this->array(index) != nullptr && this->Own[std::size_t(index)].isImage;
}

} // namespace dgtk
