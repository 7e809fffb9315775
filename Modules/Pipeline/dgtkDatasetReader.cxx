// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetReader.h"

#include "dgtkDatasetView.h"
#include "dgtkError.h"
#include "dgtkFolderContents.h"
#include "dgtkInterpreterPause.h"
#include "dgtkReadLayers.h"
#include "dgtkSceneFolders.h"

#include "dgtkText.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(dgtkDatasetReader);

struct dgtkDatasetReader::Internal
{
  std::shared_ptr<const dgtk::DatasetView> dataset;

  const dgtk::DatasetShot* picture(int index) const
  {
    const bool there = this->dataset && index >= 0 && std::size_t(index) < this->dataset->shots().size();
    return there ? &this->dataset->shots()[std::size_t(index)] : nullptr;
  }
  const dgtk::DatasetShot& picture(const std::string& camera, int frame) const;
};

const dgtk::DatasetShot& dgtkDatasetReader::Internal::picture(const std::string& camera, int frame) const
{
  if (!this->dataset)
  {
    throw dgtk::UsageError("no dataset is open");
  }
  const dgtk::DatasetShot* const shot = this->dataset->shot(camera, frame);
  if (shot != nullptr)
  {
    return *shot;
  }
  const std::vector<std::string> cameras = this->dataset->cameras();
  if (this->dataset->shotsOf(camera).empty())
  {
    throw dgtk::UsageError(
      "the dataset has no camera " + dgtk::quoted(camera) + " (it has " + dgtk::joinedNames(cameras) + ')');
  }
  throw dgtk::UsageError(
    "the dataset has no picture of camera " + dgtk::quoted(camera) + " at frame " + std::to_string(frame));
}

dgtkDatasetReader::dgtkDatasetReader()
  : Self(new Internal)
{
}

dgtkDatasetReader::~dgtkDatasetReader() = default;

void dgtkDatasetReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Folder: " << (this->Self->dataset ? this->Self->dataset->folder() : "(none)") << "\n";
  os << indent << "Pictures: " << this->GetNumberOfPictures() << "\n";
}

bool dgtkDatasetReader::Open(const std::string& folder)
{
  this->Modified();
  this->Self->dataset.reset();
  try
  {
    {
      const dgtk::InterpreterPause pause;
      dgtk::requireDataset(folder);
      if (const std::vector<std::string> scenes = dgtk::sceneFoldersIn(folder); !scenes.empty())
      {
        throw dgtk::InputError(folder, "holds " + std::to_string(scenes.size()) + " datasets",
          "one of them, such as " + dgtk::quoted(scenes.front()));
      }
      this->Self->dataset = std::make_shared<dgtk::DatasetView>(folder);
    }
    this->SetOutputs({}, 0, 0);
    return true;
  }
  catch (...)
  {
    this->SetFailure();
    return false;
  }
}

void dgtkDatasetReader::ShallowCopy(dgtkDatasetReader* other)
{
  this->Self->dataset = other != nullptr ? other->Self->dataset : nullptr;
  this->SetOutputs({}, 0, 0);
  this->Modified();
}

int dgtkDatasetReader::GetNumberOfPictures() const
{
  return this->Self->dataset ? static_cast<int>(this->Self->dataset->shots().size()) : 0;
}

std::string dgtkDatasetReader::GetPictureCamera(int index) const
{
  const dgtk::DatasetShot* const shot = this->Self->picture(index);
  return shot != nullptr ? shot->name() : std::string();
}

int dgtkDatasetReader::GetPictureFrame(int index) const
{
  const dgtk::DatasetShot* const shot = this->Self->picture(index);
  return shot != nullptr ? shot->frame() : 0;
}

std::string dgtkDatasetReader::GetLayers() const
{
  std::string lines;
  if (this->Self->dataset)
  {
    for (const auto& [layer, outputs] : dgtk::layersOf(*this->Self->dataset))
    {
      lines += layer + '\t' + dgtk::joined(outputs, "\t") + '\n';
    }
  }
  return lines;
}

bool dgtkDatasetReader::Read(const std::string& camera, int frame, const std::string& layers)
{
  try
  {
    std::vector<dgtk::LayerArray> read;
    const dgtk::DatasetShot& shot = this->Self->picture(camera, frame);
    {
      const dgtk::InterpreterPause pause;
      read = dgtk::readLayers(*this->Self->dataset, shot, dgtk::splitNames(layers, "layers"));
    }
    this->SetOutputs(std::move(read), shot.camera.width, shot.camera.height);
    return true;
  }
  catch (...)
  {
    this->SetFailure();
    return false;
  }
}
