// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetGenerator.h"

#include "dgtkFailure.h"
#include "dgtkGLContext.h"
#include "dgtkGenerator.h"
#include "dgtkInterpreterPause.h"
#include "dgtkScene.h"
#include "dgtkStage.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <unistd.h>

vtkStandardNewMacro(dgtkDatasetGenerator);

namespace
{
constexpr std::chrono::milliseconds patience(20);

/// The scene again, as its file is now.
void requireSame(const dgtk::SceneDescription& loaded, const std::string& file)
{
  const dgtk::SceneDescription now = dgtk::readScene(file);
  if (toJson(now, now.folder) != toJson(loaded, loaded.folder))
  {
    throw dgtk::InputError(file, 0, "has changed since the scene was loaded");
  }
}

/// Whether it starts OpenGL, see GLTurn.
bool usesGL(const dgtk::LayerRequest& request)
{
  return dgtk::option::renderer().of(request.options) == "vtk" ||
         dgtk::option::visibility().of(request.options) == "raster";
}

/// What may be done about a folder that is refused.
std::string wayOut(dgtk::FolderContents contents)
{
  switch (contents)
  {
    case dgtk::FolderContents::Unfinished:
      return "; resume completes it, replace starts over";
    case dgtk::FolderContents::FinishedOther:
    case dgtk::FolderContents::UnfinishedOther:
      return "; replace removes it";
    default:
      return "";
  }
}
} // namespace

struct dgtkDatasetGenerator::Internal
{
  dgtk::GeneratorRequest request;
  std::string layers;
  std::string cameras;
  std::shared_ptr<const dgtk::Stage> stage; ///< null: of a file
  std::string stageFile;                    ///< that the stage was loaded from

  std::thread thread;
  pid_t process = 0; ///< that has the thread
  std::atomic<bool> cancel{ false };
  dgtk::GeneratorProgress last;

  mutable std::mutex mutex; ///< of the following
  std::condition_variable change;
  std::deque<dgtk::GeneratorProgress> reports;
  bool over = true;
  dgtk::Failure failure;

  dgtk::GeneratorRequest wholeRequest() const;
  void start();
  void run();
  void generate();
  void report(const dgtk::GeneratorProgress& one);
  void end();
};

dgtk::GeneratorRequest dgtkDatasetGenerator::Internal::wholeRequest() const
{
  if ((!this->stage && this->request.scene.empty()) || this->request.folder.empty())
  {
    throw dgtk::UsageError(this->request.folder.empty() ? "no folder is set" : "no scene is set");
  }
  dgtk::GeneratorRequest whole = this->request;
  whole.layers = dgtk::splitNames(this->layers, "layers");
  whole.cameras = dgtk::splitNames(this->cameras, "cameras");
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

void dgtkDatasetGenerator::Internal::start()
{
  this->end();
  this->cancel = false;
  this->over = false;
  this->last = {};
  this->reports.clear();
  this->failure.clear();
  this->process = ::getpid();
  try
  {
    this->thread = std::thread([this] { this->run(); });
  }
  catch (...) // too many threads
  {
    this->failure.take();
    this->over = true;
  }
}

void dgtkDatasetGenerator::Internal::run()
{
  dgtk::Failure how;
  try
  {
    this->generate();
  }
  catch (...)
  {
    how.take();
  }
  const std::lock_guard<std::mutex> lock(this->mutex);
  this->failure = how;
  this->over = true;
  this->change.notify_all();
}

void dgtkDatasetGenerator::Internal::generate()
{
  dgtkScene::UseModelCache();
  dgtk::GeneratorCallbacks callbacks;
  callbacks.cancel = &this->cancel;
  callbacks.progress = [this](const dgtk::GeneratorProgress& one) { this->report(one); };
  std::optional<dgtk::GLTurn> turn;
  if (usesGL(this->request))
  {
    turn.emplace();
  }
  try
  {
    if (dgtk::generate(this->wholeRequest(), callbacks).interrupted)
    {
      throw dgtk::MachineError(this->request.folder + ": interrupted; resume completes it");
    }
  }
  catch (const dgtk::FolderError& error)
  {
    throw dgtk::UsageError(error.what() + wayOut(error.contents()));
  }
}

/// Whoever waits for it may cancel the run before the next picture.
void dgtkDatasetGenerator::Internal::report(const dgtk::GeneratorProgress& one)
{
  std::unique_lock<std::mutex> lock(this->mutex);
  this->reports.push_back(one);
  this->change.notify_all();
  this->change.wait_for(lock, patience, [this] { return this->cancel || this->reports.empty(); });
}

/// Of a run that is over, or soon.
void dgtkDatasetGenerator::Internal::end()
{
  this->cancel = true;
  if (this->thread.joinable())
  {
    const dgtk::InterpreterPause pause;
    this->thread.join();
  }
}

dgtkDatasetGenerator::dgtkDatasetGenerator()
  : Self(new Internal)
{
}

dgtkDatasetGenerator::~dgtkDatasetGenerator()
{
  if (this->Self->process != ::getpid() && this->Self->thread.joinable())
  {
    static_cast<void>(this->Self.release()); // in a process that was forked while it ran: the thread is not there
    return;
  }
  this->Self->end();
}

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
  if (!this->IsRunning())
  {
    this->Self->start();
  }
}

bool dgtkDatasetGenerator::IsRunning() const
{
  const std::lock_guard<std::mutex> lock(this->Self->mutex);
  return !this->Self->over || !this->Self->reports.empty();
}

bool dgtkDatasetGenerator::Wait(int milliseconds)
{
  const dgtk::InterpreterPause pause;
  Internal& self = *this->Self;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.change.wait_for(lock, std::chrono::milliseconds(std::clamp(milliseconds, 0, 1000000)),
    [&self] { return self.over || !self.reports.empty(); });
  if (self.reports.empty())
  {
    return false;
  }
  self.last = self.reports.front();
  self.reports.pop_front();
  self.change.notify_all();
  return true;
}

int dgtkDatasetGenerator::GetDone() const { return static_cast<int>(this->Self->last.done); }

int dgtkDatasetGenerator::GetTotal() const { return static_cast<int>(this->Self->last.total); }

void dgtkDatasetGenerator::Cancel() { this->Self->cancel = true; }

std::string dgtkDatasetGenerator::GetErrorMessage() const
{
  const std::lock_guard<std::mutex> lock(this->Self->mutex);
  return this->Self->failure.message;
}

int dgtkDatasetGenerator::GetErrorCode() const
{
  const std::lock_guard<std::mutex> lock(this->Self->mutex);
  return this->Self->failure.code;
}
