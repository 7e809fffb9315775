// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGroundTruthSource.h"

#include "dgtkViewOutputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

vtkStandardNewMacro(dgtkGroundTruthSource);

struct dgtkGroundTruthSource::Internal
{
  dgtk::ViewRequest request;
  dgtk::ViewOutputs found; // between the two passes of the pipeline; no arrays: none
};

namespace
{
/// The same rows from bottom to top.
vtkSmartPointer<vtkDataArray> upwards(vtkDataArray& from, int width, int height)
{
  vtkSmartPointer<vtkDataArray> to = vtkSmartPointer<vtkDataArray>::Take(from.NewInstance());
  to->SetName(from.GetName());
  to->SetNumberOfComponents(from.GetNumberOfComponents());
  to->SetNumberOfTuples(from.GetNumberOfTuples());
  for (int y = 0; y < height; ++y)
  {
    to->InsertTuples(vtkIdType(height - 1 - y) * width, width, vtkIdType(y) * width, &from);
  }
  return to;
}
} // namespace

dgtkGroundTruthSource::dgtkGroundTruthSource()
  : Self(new Internal)
{
  this->SetNumberOfInputPorts(0);
}

dgtkGroundTruthSource::~dgtkGroundTruthSource() = default;

void dgtkGroundTruthSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Layers: " << this->Self->request.layers << "\n";
}

void dgtkGroundTruthSource::SetRenderer(vtkRenderer* renderer)
{
  this->Self->request.renderer = renderer;
  this->Self->request.scene = nullptr;
  this->Modified();
}

void dgtkGroundTruthSource::SetScene(dgtkScene* scene)
{
  this->Self->request.scene = scene;
  this->Self->request.renderer = nullptr;
  this->Modified();
}

void dgtkGroundTruthSource::SetCamera(const std::string& name)
{
  this->Self->request.camera = name;
  this->Modified();
}

void dgtkGroundTruthSource::SetFrame(int frame)
{
  this->Self->request.frame = frame;
  this->Self->request.frameSet = true;
  this->Modified();
}

void dgtkGroundTruthSource::SetLayers(const std::string& layers)
{
  this->Self->request.layers = layers;
  this->Modified();
}

void dgtkGroundTruthSource::SetSize(int width, int height)
{
  this->Self->request.width = width;
  this->Self->request.height = height;
  this->Modified();
}

void dgtkGroundTruthSource::SetSkipUnsupported(bool skip)
{
  this->Self->request.skip = skip;
  this->Modified();
}

void dgtkGroundTruthSource::SetOption(const std::string& name, const std::string& value)
{
  this->Self->request.options[name] = value;
  this->Modified();
}

vtkMTimeType dgtkGroundTruthSource::GetMTime()
{
  vtkMTimeType latest = this->Superclass::GetMTime();
  if (this->Self->request.renderer)
  {
    latest = std::max(latest, dgtk::modifiedTime(*this->Self->request.renderer));
  }
  else if (this->Self->request.scene)
  {
    latest = std::max(latest, this->Self->request.scene->GetMTime());
  }
  return latest;
}

int dgtkGroundTruthSource::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  try
  {
    // The pipeline wants to know type and size before the data: they are what was drawn.
    this->Self->found = dgtk::outputsOf(this->Self->request);
    const dgtk::ViewOutputs& found = this->Self->found;
    vtkDataArray& first = *found.arrays.front();
    const int extent[6] = { 0, found.width - 1, 0, found.height - 1, 0, 0 };
    vtkInformation* const out = outputs->GetInformationObject(0);
    out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    out->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
    out->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
    vtkDataObject::SetPointDataActiveScalarInfo(out, first.GetDataType(), first.GetNumberOfComponents());
    return 1;
  }
  catch (const std::exception& error)
  {
    this->Self->found = {};
    if (vtkDataObject* const kept = outputs->GetInformationObject(0)->Get(vtkDataObject::DATA_OBJECT()))
    {
      kept->Initialize(); // what an earlier update gave is not the answer
    }
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

int dgtkGroundTruthSource::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkImageData* const image = vtkImageData::GetData(outputs, 0);
  try
  {
    dgtk::ViewOutputs found = std::move(this->Self->found);
    this->Self->found = {};
    found = found.arrays.empty() ? dgtk::outputsOf(this->Self->request) : found;
    image->SetExtent(0, found.width - 1, 0, found.height - 1, 0, 0);
    for (const vtkSmartPointer<vtkDataArray>& array : found.arrays)
    {
      const int at = image->GetPointData()->AddArray(upwards(*array, found.width, found.height));
      if (at == 0)
      {
        image->GetPointData()->SetActiveScalars(array->GetName());
      }
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    image->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}
