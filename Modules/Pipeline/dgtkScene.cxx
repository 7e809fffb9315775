// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkScene.h"

#include "dgtkFailure.h"
#include "dgtkInterpreterPause.h"
#include "dgtkLikeScene.h"
#include "dgtkModelCache.h"
#include "dgtkSceneFromText.h"
#include "dgtkUtf8.h"

#include "vtkObjectFactory.h"

#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

vtkStandardNewMacro(dgtkScene);

namespace
{
std::string absolutePath(const std::string& path)
{
  std::error_code error; // where there is no current folder any more
  const std::filesystem::path whole = std::filesystem::absolute(path.empty() ? "." : path, error);
  return error ? path : whole.lexically_normal().string();
}
} // namespace

struct dgtkScene::Internal
{
  std::shared_ptr<const dgtk::Stage> stage;
  std::shared_ptr<const dgtk::ReadFiles> files;
  std::vector<std::string> objects; ///< names by id - 1
  std::string folder;
  std::string file;
  std::string warnings; ///< a line each
  dgtk::Failure failure;

  void hold(dgtk::StageWithFiles loaded);
  void load(const std::function<dgtk::SceneDescription()>& read, const dgtk::ReadFiles* known);
};

void dgtkScene::Internal::hold(dgtk::StageWithFiles loaded)
{
  this->stage = std::move(loaded.stage);
  this->files = std::move(loaded.files);
  this->warnings.clear();
  this->objects = this->stage ? this->stage->objectNames() : std::vector<std::string>();
  this->folder = this->stage ? absolutePath(this->stage->description().folder) : "";
  const bool ofFile = this->stage && !this->stage->description().file.empty();
  this->file = ofFile ? absolutePath(this->stage->description().file) : "";
}

void dgtkScene::Internal::load(const std::function<dgtk::SceneDescription()>& read, const dgtk::ReadFiles* known)
{
  this->hold({});
  this->failure.clear();
  try
  {
    dgtk::StageWithFiles loaded;
    std::string said;
    {
      const dgtk::InterpreterPause pause;
      UseModelCache();
      loaded =
        dgtk::loadLike(read(), known, [&said](const std::string& line) { said += dgtk::printable(line) + '\n'; });
    }
    this->hold(std::move(loaded));
    this->warnings = std::move(said);
  }
  catch (...)
  {
    this->failure.take();
  }
}

dgtkScene::dgtkScene()
  : Self(new Internal)
{
}

dgtkScene::~dgtkScene() = default;

void dgtkScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Cameras: " << this->GetNumberOfCameras() << "\n";
  os << indent << "Objects: " << this->GetNumberOfObjects() << "\n";
  os << indent << "Frames: " << this->GetFirstFrame() << " to " << this->GetLastFrame() << "\n";
}

void dgtkScene::UseModelCache()
{
  if (!dgtk::ModelCache::inUse())
  {
    dgtk::ModelCache::use(dgtk::ModelCache::ofUser());
  }
}

bool dgtkScene::Load(const std::string& path)
{
  this->Self->load([&path] { return dgtk::readScene(path); }, nullptr);
  this->Modified();
  return this->Self->stage != nullptr;
}

bool dgtkScene::LoadText(const std::string& json, const std::string& folder)
{
  return this->LoadTextLike(json, folder, nullptr);
}

bool dgtkScene::LoadTextLike(const std::string& json, const std::string& folder, dgtkScene* like)
{
  const std::shared_ptr<const dgtk::ReadFiles> known = like ? like->Self->files : nullptr;
  this->Self->load([&] { return dgtk::readSceneText(json, folder); }, known.get());
  this->Modified();
  return this->Self->stage != nullptr;
}

void dgtkScene::SetStage(std::shared_ptr<const dgtk::Stage> stage)
{
  this->Self->failure.clear();
  this->Self->hold({ std::move(stage), nullptr });
  this->Modified();
}

bool dgtkScene::Attempt(const std::function<void()>& work)
{
  this->Self->failure.clear();
  try
  {
    work();
    return true;
  }
  catch (...)
  {
    this->Self->failure.take();
    return false;
  }
}

std::shared_ptr<const dgtk::Stage> dgtkScene::GetStage() const { return this->Self->stage; }

std::string dgtkScene::GetDescription() const
{
  try
  {
    return this->Self->stage ? toJson(this->Self->stage->description(), this->Self->stage->description().folder) : "";
  }
  catch (...) // a stage that comes from elsewhere
  {
    this->Self->failure.take();
    return "";
  }
}

std::string dgtkScene::GetFolder() const { return this->Self->folder; }

std::string dgtkScene::GetFile() const { return this->Self->file; }

std::string dgtkScene::GetErrorMessage() const { return this->Self->failure.message; }

int dgtkScene::GetErrorCode() const { return this->Self->failure.code; }

std::string dgtkScene::GetWarnings() const { return this->Self->warnings; }

int dgtkScene::GetNumberOfCameras() const
{
  return this->Self->stage ? static_cast<int>(this->Self->stage->description().cameras.size()) : 0;
}

std::string dgtkScene::GetCameraName(int index) const
{
  return index >= 0 && index < this->GetNumberOfCameras() ? this->Self->stage->description().cameras[index].name : "";
}

int dgtkScene::GetNumberOfObjects() const { return static_cast<int>(this->Self->objects.size()); }

std::string dgtkScene::GetObjectName(int index) const
{
  return index >= 0 && index < this->GetNumberOfObjects() ? this->Self->objects[index] : "";
}

int dgtkScene::GetFirstFrame() const { return this->Self->stage ? this->Self->stage->description().firstFrame() : 0; }

int dgtkScene::GetLastFrame() const { return this->Self->stage ? this->Self->stage->description().lastFrame() : 0; }
