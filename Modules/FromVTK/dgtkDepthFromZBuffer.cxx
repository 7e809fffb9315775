// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDepthFromZBuffer.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(dgtkDepthFromZBuffer);

namespace
{
constexpr double singlePrecision = 1.0 / (1 << 24);

/// Depth by the value of the buffer: the third and fourth row of the camera's projection.
class DepthCurve
{
public:
  explicit DepthCurve(vtkCamera& camera)
  {
    const vtkMatrix4x4& p = *camera.GetProjectionTransformMatrix(1.0, -1, 1);
    this->A = p.GetElement(2, 2);
    this->B = p.GetElement(2, 3);
    this->C = p.GetElement(3, 2);
    this->D = p.GetElement(3, 3);
    this->Straight =
      p.GetElement(2, 0) == 0 && p.GetElement(2, 1) == 0 && p.GetElement(3, 0) == 0 && p.GetElement(3, 1) == 0;
  }
  bool isStraight() const { return this->Straight; }
  double at(double z) const
  {
    const double clip = 2 * z - 1;
    return -(this->D * clip - this->B) / (this->A - this->C * clip);
  }
  /// Change of depth with the buffer's value.
  double slope(double z) const
  {
    const double below = this->A - this->C * (2 * z - 1);
    return std::abs(2 * (this->A * this->D - this->B * this->C) / (below * below));
  }

private:
  double A, B, C, D;
  bool Straight;
};

/// The change of depth to the nearer one of two neighbours; 0 without.
double leastStep(double depth, double before, double after)
{
  const double first = std::abs(depth - before);
  const double second = std::abs(depth - after);
  const double least = std::fmin(std::isfinite(first) ? first : second, std::isfinite(second) ? second : first);
  return std::isfinite(least) ? least : 0.0;
}
} // namespace

dgtkDepthFromZBuffer::dgtkDepthFromZBuffer() = default;
dgtkDepthFromZBuffer::~dgtkDepthFromZBuffer() = default;

void dgtkDepthFromZBuffer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DepthBits: " << this->DepthBits << "\n";
  os << indent << "SubpixelBits: " << this->SubpixelBits << "\n";
  os << indent << "RoundingSteps: " << this->RoundingSteps << "\n";
}

void dgtkDepthFromZBuffer::SetCamera(vtkCamera* camera)
{
  this->Camera = camera;
  this->Modified();
}

vtkMTimeType dgtkDepthFromZBuffer::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Camera ? std::max(own, this->Camera->GetMTime()) : own;
}

int dgtkDepthFromZBuffer::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputs->GetInformationObject(0), VTK_DOUBLE, 1);
  return 1;
}

int dgtkDepthFromZBuffer::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* const input = vtkImageData::GetData(inputs[0], 0);
  vtkImageData* const output = vtkImageData::GetData(outputs, 0);
  vtkDataArray* const buffer = input != nullptr ? input->GetPointData()->GetScalars() : nullptr;
  if (!this->Camera || buffer == nullptr || buffer->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro(<< (this->Camera ? "the input is no z-buffer (expected one component)" : "there is no camera"));
    return 0;
  }
  const DepthCurve curve(*this->Camera);
  if (!curve.isStraight())
  {
    vtkErrorMacro(<< "the camera's near plane leans: a z-buffer's value is no depth then");
    return 0;
  }
  output->SetExtent(input->GetExtent());
  const int* const size = input->GetDimensions();
  const vtkIdType width = size[0];
  const vtkIdType count = width * size[1];
  vtkNew<vtkDoubleArray> depth;
  depth->SetName("depth");
  depth->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double z = buffer->GetComponent(i, 0);
    depth->SetValue(i, z < 1 ? curve.at(z) : std::numeric_limits<double>::infinity());
  }
  const double step = 0.5 * std::ldexp(1, -this->DepthBits) + this->RoundingSteps * singlePrecision;
  const double beside = 0.5 * std::ldexp(1, -this->SubpixelBits);
  const auto at = [&](vtkIdType x, vtkIdType y)
  {
    const bool inside = x >= 0 && x < width && y >= 0 && y < size[1];
    return inside ? depth->GetValue(y * width + x) : std::numeric_limits<double>::infinity();
  };
  vtkNew<vtkDoubleArray> halfWidth;
  halfWidth->SetName("half_width");
  halfWidth->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType x = i % width;
    const vtkIdType y = i / width;
    const double d = depth->GetValue(i);
    const double across = leastStep(d, at(x - 1, y), at(x + 1, y)) + leastStep(d, at(x, y - 1), at(x, y + 1));
    halfWidth->SetValue(i, std::isfinite(d) ? step * curve.slope(buffer->GetComponent(i, 0)) + beside * across : d);
  }
  output->GetPointData()->SetScalars(depth);
  output->GetPointData()->AddArray(halfWidth);
  return 1;
}
