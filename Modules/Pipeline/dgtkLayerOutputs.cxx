// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerOutputs.h"

#include "dgtkArraySink.h"
#include "dgtkFailure.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>

struct dgtkLayerOutputs::Internal
{
  std::vector<dgtk::LayerArray> own; // without their data
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  int width = 0;
  int height = 0;
  dgtk::Failure failure;
};

namespace
{
vtkSmartPointer<vtkDataArray> arrayFor(dgtk::PixelType type)
{
  switch (type)
  {
    case dgtk::PixelType::UInt8:
      return vtkSmartPointer<vtkUnsignedCharArray>::New();
    case dgtk::PixelType::UInt16:
      return vtkSmartPointer<vtkUnsignedShortArray>::New();
    case dgtk::PixelType::UInt32:
      return vtkSmartPointer<vtkUnsignedIntArray>::New();
    case dgtk::PixelType::Float32:
      return vtkSmartPointer<vtkFloatArray>::New();
    default:
      return vtkSmartPointer<vtkDoubleArray>::New();
  }
}
} // namespace

dgtkLayerOutputs::dgtkLayerOutputs()
  : Outputs(new Internal)
{
}

dgtkLayerOutputs::~dgtkLayerOutputs() = default;

void dgtkLayerOutputs::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Outputs: " << this->GetNumberOfOutputs() << "\n";
}

void dgtkLayerOutputs::SetOutputs(std::vector<dgtk::LayerArray> arrays, int width, int height)
{
  Internal made;
  made.width = width;
  made.height = height;
  made.own = std::move(arrays);
  for (dgtk::LayerArray& own : made.own)
  {
    const vtkSmartPointer<vtkDataArray> array = arrayFor(own.type);
    const std::size_t tuple = dgtk::bytesOf(own.type) * std::size_t(own.channels);
    array->SetName(own.name.c_str());
    array->SetNumberOfComponents(own.channels);
    array->SetNumberOfTuples(static_cast<vtkIdType>(own.data.size() / tuple));
    std::copy_n(own.data.data(), own.data.size(), static_cast<std::byte*>(array->GetVoidPointer(0)));
    own.data = {};
    made.arrays.push_back(array);
  }
  *this->Outputs = std::move(made);
}

void dgtkLayerOutputs::SetFailure()
{
  *this->Outputs = {};
  this->Outputs->failure.take();
}

int dgtkLayerOutputs::GetNumberOfOutputs() const { return static_cast<int>(this->Outputs->arrays.size()); }

vtkDataArray* dgtkLayerOutputs::GetOutput(int index) const
{
  return index >= 0 && index < this->GetNumberOfOutputs() ? this->Outputs->arrays[std::size_t(index)].Get() : nullptr;
}

std::string dgtkLayerOutputs::GetOutputPart(int index) const
{
  return this->GetOutput(index) != nullptr ? this->Outputs->own[std::size_t(index)].part : std::string();
}

std::string dgtkLayerOutputs::GetOutputFormat(int index) const
{
  return this->GetOutput(index) != nullptr ? this->Outputs->own[std::size_t(index)].format : std::string();
}

bool dgtkLayerOutputs::IsOutputImage(int index) const
{
  return this->GetOutput(index) != nullptr && this->Outputs->own[std::size_t(index)].isImage;
}

int dgtkLayerOutputs::GetWidth() const { return this->Outputs->width; }

int dgtkLayerOutputs::GetHeight() const { return this->Outputs->height; }

std::string dgtkLayerOutputs::GetErrorMessage() const { return this->Outputs->failure.message; }

int dgtkLayerOutputs::GetErrorCode() const { return this->Outputs->failure.code; }
