// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkScene.h"

#include "dgtkError.h"
#include "dgtkModelCache.h"
#include "dgtkStage.h"

#include "vtkObjectFactory.h"

#include <utility>

vtkStandardNewMacro(dgtkScene);

dgtkScene::dgtkScene() = default;
dgtkScene::~dgtkScene() = default;

void dgtkScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Cameras: " << this->GetNumberOfCameras() << "\n";
  os << indent << "Objects: " << this->GetNumberOfObjects() << "\n";
  os << indent << "Frames: " << this->GetFirstFrame() << " to " << this->GetLastFrame() << "\n";
}

bool dgtkScene::Load(const std::string& path)
{
  this->Stage.reset();
  this->ErrorMessage.clear();
  this->Modified();
  try
  {
    if (!dgtk::ModelCache::inUse())
    {
      dgtk::ModelCache::use(dgtk::ModelCache::ofUser());
    }
    this->Stage = dgtk::Stage::load(dgtk::readScene(path));
  }
  catch (const std::exception& error)
  {
    this->ErrorMessage = error.what();
  }
  return this->Stage != nullptr;
}

void dgtkScene::SetStage(std::shared_ptr<const dgtk::Stage> stage)
{
  this->Stage = std::move(stage);
  this->Modified();
}

std::string dgtkScene::GetErrorMessage() const { return this->ErrorMessage; }

int dgtkScene::GetNumberOfCameras() const
{
  return this->Stage ? static_cast<int>(this->Stage->description().cameras.size()) : 0;
}

std::string dgtkScene::GetCameraName(int index) const
{
  return index >= 0 && index < this->GetNumberOfCameras() ? this->Stage->description().cameras[index].name : "";
}

int dgtkScene::GetNumberOfObjects() const
{
  return this->Stage ? static_cast<int>(this->Stage->at(this->GetFirstFrame())->instances.size()) : 0;
}

std::string dgtkScene::GetObjectName(int index) const
{
  return index >= 0 && index < this->GetNumberOfObjects()
           ? this->Stage->at(this->GetFirstFrame())->instances[index].name
           : "";
}

int dgtkScene::GetFirstFrame() const { return this->Stage ? this->Stage->description().firstFrame() : 0; }

int dgtkScene::GetLastFrame() const { return this->Stage ? this->Stage->description().lastFrame() : 0; }
