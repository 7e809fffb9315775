// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetGenerator.h"

#include "dgtkBackgroundRun.h"
#include "dgtkExport.h"
#include "dgtkFolderWay.h"
#include "dgtkGenerator.h"
#include "dgtkRenderGLCalls.h"
#include "dgtkRunShards.h"
#include "dgtkScene.h"
#include "dgtkSceneFile.h"
#include "dgtkStage.h"
#include "dgtkWorkPlan.h"

#include "vtkObjectFactory.h"

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

vtkStandardNewMacro(dgtkDatasetGenerator);

namespace
{
/// What is set, of which a run has a copy.
struct Settings
{
  dgtk::GeneratorRequest request;
  std::string layers;
  std::string cameras;
  std::string formats; ///< of exports
  std::string classFile;
  std::shared_ptr<const dgtk::Stage> stage; ///< null: of a file
  std::string stageFile;                    ///< that the stage was loaded from

  dgtk::GeneratorRequest wholeRequest() const;
  void generate(const std::atomic<bool>& cancel, const std::function<void(dgtkBackgroundRun::Report)>& report) const;
};

/// The scene again, as its file is now.
void requireSame(const dgtk::SceneDescription& loaded, const std::string& file)
{
  const dgtk::SceneDescription now = dgtk::readScene(file);
  if (toJson(now, now.folder) != toJson(loaded, loaded.folder))
  {
    throw dgtk::InputError(file, "has changed since the scene was loaded");
  }
}

dgtk::GeneratorRequest Settings::wholeRequest() const
{
  if ((!this->stage && this->request.scene.empty()) || this->request.folder.empty())
  {
    throw dgtk::UsageError(this->request.folder.empty() ? "no folder is set" : "no scene is set");
  }
  dgtk::GeneratorRequest whole = this->request;
  whole.layers = dgtk::splitNames(this->layers, "layers");
  whole.cameras = dgtk::splitNames(this->cameras, "cameras");
  if (!this->formats.empty())
  {
    dgtk::addNeeds(dgtk::splitNames(this->formats, "formats"), whole.layers, whole.options);
  }
  if (!this->classFile.empty())
  {
    whole.classes = dgtk::readClassFile(this->classFile);
  }
  if (this->stage && !this->stageFile.empty())
  {
    requireSame(this->stage->description(), this->stageFile);
    whole.scene = this->stageFile;
  }
  else if (this->stage)
  {
    whole.description = this->stage->description();
  }
  return whole;
}

void Settings::generate(
  const std::atomic<bool>& cancel, const std::function<void(dgtkBackgroundRun::Report)>& report) const
{
  dgtkScene::UseModelCache();
  dgtk::GeneratorCallbacks callbacks;
  callbacks.cancel = &cancel;
  callbacks.progress = [&](const dgtk::GeneratorProgress& one) { report({ one.done, one.total }); };
  std::shared_ptr<dgtk::GLTurn> turn;
  if (dgtk::mayUseOpenGL(this->request)) // see GLTurn
  {
    turn = dgtk::renderGL().takeTurn();
  }
  dgtk::withWayOut(
    [&]
    {
      const dgtk::GeneratorRequest whole = this->wholeRequest();
      const bool many = dgtk::namesScenes(whole);
      if ((many ? dgtk::generateScenes(whole, callbacks) : dgtk::generate(whole, callbacks)).interrupted)
      {
        throw dgtk::MachineError(this->request.folder + ": interrupted; resume completes it");
      }
    });
}
} // namespace

struct dgtkDatasetGenerator::Internal : Settings
{
  dgtkBackgroundRun background;
};

dgtkDatasetGenerator::dgtkDatasetGenerator()
  : Self(new Internal)
{
}

dgtkDatasetGenerator::~dgtkDatasetGenerator() = default;

void dgtkDatasetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Folder: " << this->Self->request.folder << "\n";
  os << indent << "Layers: " << this->Self->layers << "\n";
  os << indent << "Done: " << this->GetDone() << " of " << this->GetTotal() << "\n";
}

void dgtkDatasetGenerator::SetSceneFile(const std::string& path)
{
  this->Self->stage = nullptr;
  this->Self->request.scene = path;
  this->Modified();
}

void dgtkDatasetGenerator::SetScene(dgtkScene* scene)
{
  this->Self->stage = scene ? scene->GetStage() : nullptr;
  this->Self->stageFile = scene ? scene->GetFile() : "";
  this->Modified();
}

void dgtkDatasetGenerator::SetFolder(const std::string& folder)
{
  this->Self->request.folder = folder;
  this->Modified();
}

void dgtkDatasetGenerator::SetLayers(const std::string& names)
{
  this->Self->layers = names;
  this->Modified();
}

void dgtkDatasetGenerator::SetCameras(const std::string& names)
{
  this->Self->cameras = names;
  this->Modified();
}

void dgtkDatasetGenerator::SetFormats(const std::string& names)
{
  this->Self->formats = names;
  this->Modified();
}

void dgtkDatasetGenerator::SetClassFile(const std::string& path)
{
  this->Self->classFile = path;
  this->Modified();
}

void dgtkDatasetGenerator::SetFrames(int first, int last, int step)
{
  this->Self->request.frames = dgtk::FrameRange{ first, last, step };
  this->Modified();
}

void dgtkDatasetGenerator::SetSize(int width, int height)
{
  this->Self->request.width = width;
  this->Self->request.height = height;
  this->Modified();
}

void dgtkDatasetGenerator::SetOption(const std::string& name, const std::string& value)
{
  this->Self->request.options[name] = value;
  this->Modified();
}

std::string dgtkDatasetGenerator::GetOptions()
{
  std::string lines;
  for (const dgtk::OptionRow* row : dgtk::allOptions())
  {
    lines += row->name + '\t' + row->value + '\t' + row->fallback + '\t' + row->help + '\n';
  }
  return lines;
}

void dgtkDatasetGenerator::SetResume(bool resume)
{
  this->Self->request.resume = resume;
  this->Modified();
}

void dgtkDatasetGenerator::SetReplace(bool replace)
{
  this->Self->request.replace = replace;
  this->Modified();
}

void dgtkDatasetGenerator::Start()
{
  this->Self->background.start(
    [settings = Settings(*this->Self)](const auto& cancel, const auto& report) { settings.generate(cancel, report); });
}

bool dgtkDatasetGenerator::IsRunning() const { return this->Self->background.isRunning(); }

bool dgtkDatasetGenerator::Wait(int milliseconds) { return this->Self->background.wait(milliseconds); }

int dgtkDatasetGenerator::GetDone() const { return static_cast<int>(this->Self->background.last().done); }

int dgtkDatasetGenerator::GetTotal() const { return static_cast<int>(this->Self->background.last().total); }

void dgtkDatasetGenerator::Cancel() { this->Self->background.cancel(); }

std::string dgtkDatasetGenerator::GetErrorMessage() const { return this->Self->background.failure().message; }

int dgtkDatasetGenerator::GetErrorCode() const { return this->Self->background.failure().code; }
