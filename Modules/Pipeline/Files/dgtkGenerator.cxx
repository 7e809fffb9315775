// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGenerator.h"

#include "dgtkDatasetRecords.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFrameOutput.h"
#include "dgtkFrameSource.h"
#include "dgtkLayers.h"
#include "dgtkRunDocuments.h"
#include "dgtkRunFiles.h"
#include "dgtkRunNotes.h"
#include "dgtkRunSession.h"
#include "dgtkSceneFile.h"
#include "dgtkSpaceNeeded.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkTracedQueries.h"
#include "dgtkWorkPlan.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace dgtk
{

namespace
{
// Bands that wait for their encoders, before drawing pauses.
constexpr std::size_t mostPendingBytes = std::size_t(384) << 20;

int threadsOf(const GeneratorRequest& request)
{
  const int threads = option::threads().of(request.options);
  return threads > 0 ? threads : machineThreads();
}

/// The scene of a request, and the numbers of classes that the request gives it: as classesText(), or nothing.
struct NumberedScene
{
  explicit NumberedScene(const GeneratorRequest& request)
    : scene(request.description ? *request.description : readScene(request.scene))
  {
    if (scene.classes.empty() && !request.classes.empty())
    {
      scene.classes = request.classes;
      numbers = classesText(request.classes);
      validate(scene);
    }
  }
  SceneDescription scene;
  std::string numbers;
};

JournalStart startOf(const GeneratorRequest& request)
{
  if (request.resume && request.replace)
  {
    throw UsageError("a run is either resumed or replaced");
  }
  return request.resume ? JournalStart::Resume : request.replace ? JournalStart::Replace : JournalStart::Fresh;
}

class Run
{
public:
  Run(const GeneratorRequest& request, const GeneratorCallbacks& callbacks, NumberedScene scene);
  GeneratorResult execute();

private:
  // A job whose last band is drawn and whose files are being completed.
  struct Open
  {
    Job job;
    std::unique_ptr<FrameOutput> output;
  };

  std::shared_ptr<const SceneState> stateAt(int frame);
  void renderAll();
  void render(const Job& job);
  std::shared_ptr<DrawnBand> counted(std::shared_ptr<DrawnBand> band);
  void completeOldest();
  bool keep(const Job& job);
  std::vector<Job> jobs() const;
  bool cancelled() const { return this->Callbacks.cancel && *this->Callbacks.cancel; }
  void say(const std::string& line) const
  {
    if (this->Callbacks.message)
    {
      this->Callbacks.message(line);
    }
  }
  void warn(const std::string& line)
  {
    this->Result.warnings.push_back(line);
    this->say("warning: " + line);
  }
  void sayNotes();
  const std::string& cameraName(const Job& job) const { return this->Scene->description().cameras[job.camera].name; }
  View viewOf(const Job& job) const
  {
    return this->Scene->view(job.camera, job.frame, this->Plan.request.width, this->Plan.request.height);
  }

  GeneratorCallbacks Callbacks;
  GeneratorResult Result;
  std::shared_ptr<RunSession> Session;
  std::shared_ptr<const Stage> Scene;
  std::string ClassNumbers; ///< that the request gives
  GeneratorRequest Request;
  std::string Root; ///< where files are written
  WorkPlan Plan;
  int Threads;
  std::unique_ptr<RunDocuments> Documents;
  std::unique_ptr<RunFiles> Files;
  ThreadPool* Pool = nullptr; ///< the session's
  std::unique_ptr<FrameSource> Source;
  TracedQueries Queries;
  std::atomic<std::size_t> PendingBytes{ 0 };
  std::deque<Open> Opened;
  std::shared_ptr<const SceneState> State;
  std::size_t Done = 0;
};

Run::Run(const GeneratorRequest& request, const GeneratorCallbacks& callbacks, NumberedScene scene)
  : Callbacks(callbacks)
  , Session(request.session ? request.session : makeRunSession())
  , Scene(this->Session->load(std::move(scene.scene), [this](const std::string& line) { this->warn(line); }))
  , ClassNumbers(std::move(scene.numbers))
  , Request(request)
  , Root(request.block ? request.block->folder : request.folder)
  , Plan(makeWorkPlan(request, *this->Scene))
  , Threads(threadsOf(request))
  , Queries(this->Scene)
{
}

GeneratorResult Run::execute()
{
  const GeneratorRequest& request = this->Request;
  if (!request.block)
  {
    requireOutsideDatasets(request.folder);
  }
  FrameSourceOptions options = sourceOptions(this->Plan);
  if (!drawsItself(request))
  {
    options.pov =
      PovColorSettings{ request.options, this->Root, option::samples().of(request.options), this->Callbacks.cancel };
  }
  this->Pool = &this->Session->pool(this->Threads);
  this->Source = std::make_unique<FrameSource>(options, *this->Pool);
  this->Result.glDescription = this->Source->glDescription();
  this->Result.visibility = this->Plan.raster ? "raster" : "ray";
  this->Documents = std::make_unique<RunDocuments>(
    *this->Scene, this->Plan, request.folder, this->Root, *this->Session, this->ClassNumbers);
  const SpaceNeeded needed = spaceOf(this->Plan, *this->Scene);
  const std::string tight = checkSpace(request.folder, needed, spaceIn(request.folder, needed.likely));
  if (!tight.empty())
  {
    this->say("warning: " + tight); // not in the manifest, which is the same on every disk
  }
  this->Files = std::make_unique<RunFiles>(this->Root, this->Documents->requestHash(), startOf(request),
    this->Documents->allNames(), request.resume ? this->Documents->judge() : JudgeOfFiles());
  for (PlannedLayer& planned : this->Plan.layers)
  {
    planned.shared = planned.layer->makeShared(
      { [this] { return this->Root; }, [this](const std::string& name) { this->Files->planLate(name); } });
  }

  if (!this->Result.glDescription.empty())
  {
    this->say(this->Result.glDescription);
  }

  this->Documents->pack(*this->Files);
  this->Documents->writeModels(*this->Files);
  this->sayNotes();
  try
  {
    this->renderAll();
  }
  catch (const Error&)
  {
    if (!this->cancelled())
    {
      throw;
    }
    this->Result.interrupted = true; // while POV-Ray was drawing
    this->Source->drop();
    this->Opened.clear();
  }
  this->Source.reset();
  this->Result.pictures = this->Done;
  if (!this->Result.interrupted)
  {
    this->Result.files = this->Documents->write(*this->Files, this->Result.warnings);
    if (this->Callbacks.progress)
    {
      this->Callbacks.progress({ this->Done, this->jobs().size(), this->Result.kept });
    }
  }
  this->Result.files += this->Files->files().size();
  return this->Result;
}

/// Those of the run, or of its part.
std::vector<Job> Run::jobs() const
{
  const std::vector<Job>& all = this->Plan.jobs;
  if (!this->Request.block)
  {
    return all;
  }
  const std::size_t first = std::min(this->Request.block->first, all.size());
  const std::size_t last = std::min(first + this->Request.block->count, all.size());
  return { all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(last) };
}

/// What deserves a word before the first picture.
void Run::sayNotes()
{
  const std::string empty = emptyLine(this->Plan.empty);
  if (!empty.empty())
  {
    this->say(empty);
  }
  for (const std::string& line : pictureNotes(this->Plan, *this->Scene))
  {
    this->warn(line);
  }
}

void Run::renderAll()
{
  if (this->Callbacks.progress)
  {
    this->Callbacks.progress({ this->Done, this->jobs().size(), this->Result.kept });
  }
  for (const Job& job : this->jobs())
  {
    if (this->cancelled())
    {
      this->Result.interrupted = true;
      break;
    }
    if (this->keep(job))
    {
      ++this->Result.kept;
      ++this->Done;
      continue;
    }
    this->render(job);
    if (this->Result.interrupted)
    {
      break;
    }
    if (this->Callbacks.progress)
    {
      this->Callbacks.progress({ this->Done, this->jobs().size(), this->Result.kept });
    }
  }
  this->Source->finish();
  while (!this->Opened.empty())
  {
    this->completeOldest();
  }
}

std::shared_ptr<const SceneState> Run::stateAt(int frame)
{
  if (!this->State || this->State->frame != frame)
  {
    this->State = this->Scene->at(frame);
  }
  return this->State;
}

void Run::render(const Job& job)
{
  const GeneratorRequest& request = this->Request;
  const View view = this->viewOf(job);
  const std::shared_ptr<const SceneState> state = this->stateAt(job.frame);
  const std::vector<std::string> names = filesOf(this->Plan, *this->Scene, job);
  this->Files->plan(names);
  for (const std::string& name : names)
  {
    Folder(this->Root).makeParents(name);
  }
  int bands = 0;
  if (this->Source->drawsAnything())
  {
    this->Source->setScene(state, view);
    bands = this->Source->bands();
  }
  auto output = std::make_unique<FrameOutput>(
    this->Root, JobContext{ this->Plan, job, this->cameraName(job), state, view, this->Queries, *this->Pool }, bands);
  if (bands > 0)
  {
    if (this->Plan.drawsColor() && drawsItself(request))
    {
      this->Source->expose(this->Scene->exposures(job.camera, job.frame, request.width, request.height),
        [this](double frame) { return this->Scene->at(frame); });
    }
    for (int row = 0; row < bands; ++row)
    {
      if (this->cancelled())
      {
        this->Source->finish(); // of this picture, which goes, or of the one before
        this->Result.interrupted = true;
        return;
      }
      if (this->PendingBytes > mostPendingBytes)
      {
        this->Source->finish();
        output->wait();
      }
      this->Source->draw(row,
        [this, out = output.get()](std::shared_ptr<DrawnBand> band) { out->submit(this->counted(std::move(band))); });
    }
  }
  this->Opened.push_back({ job, std::move(output) });
  // Others than this thread derive and write, as long as they keep up: it draws.
  while (!this->Opened.empty() &&
         (this->Opened.front().output->isDone() || this->Opened.size() > 1 + static_cast<std::size_t>(this->Threads)))
  {
    this->completeOldest();
  }
}

/// The band, whose bytes are pending until it is gone.
std::shared_ptr<DrawnBand> Run::counted(std::shared_ptr<DrawnBand> band)
{
  std::size_t bytes = std::size_t(band->band.rect.width) * band->band.rect.height * 2 *
                      (sizeof(Hit) + 3 * sizeof(float)); // as drawn, and whole
  for (const SurfaceLists& lists : band->band.peeled)
  {
    bytes += lists.rgba.size() * sizeof(float) + lists.hits.size() * sizeof(Hit);
  }
  this->PendingBytes += bytes;
  DrawnBand* const drawn = band.get();
  return { drawn, [this, bytes, band = std::move(band)](DrawnBand*) mutable
    {
      band.reset();
      this->PendingBytes -= bytes;
    } };
}

void Run::completeOldest()
{
  Open open = std::move(this->Opened.front());
  this->Opened.pop_front();
  const std::vector<FinishedFile> files = open.output->finish();
  this->Files->add(files, this->cameraName(open.job), open.job.frame);
  ++this->Done;
}

// A picture is kept when every file that it consists of is in the journal; files of the tiles layer follow from the
// sizes.
bool Run::keep(const Job& job)
{
  const std::vector<std::string> own = filesOf(this->Plan, *this->Scene, job);
  if (!this->Files->has(own))
  {
    return false;
  }
  std::vector<std::string> shared;
  for (const PlannedLayer& planned : this->Plan.layers)
  {
    for (const LayerOutput& output : outputsOf(this->Plan, *this->Scene, job, planned))
    {
      for (const std::string& name : output.files())
      {
        const std::vector<std::string> needed = planned.layer->sharedFiles(this->Root + '/' + name);
        shared.insert(shared.end(), needed.begin(), needed.end());
      }
    }
  }
  return this->Files->keep(own, shared);
}

} // namespace

std::shared_ptr<RunSession> makeRunSession() { return std::make_shared<RunSession>(); }

std::string requestHash(const GeneratorRequest& request)
{
  const NumberedScene numbered(request);
  const std::shared_ptr<RunSession> session = request.session ? request.session : makeRunSession();
  const std::shared_ptr<const Stage> scene = session->load(numbered.scene, [](const std::string&) {});
  const WorkPlan plan = makeWorkPlan(request, *scene);
  std::optional<Packing> packing;
  if (option::pack().of(plan.request.options))
  {
    packing = planPacking(*scene, request.folder);
  }
  return identityOf(
    plan, *scene, numbered.numbers, recordedInputs(*scene, request.folder, packing ? &*packing : nullptr, *session));
}

GeneratorResult generate(const GeneratorRequest& request, const GeneratorCallbacks& callbacks)
{
  return Run(request, callbacks, NumberedScene(request)).execute();
}

} // namespace dgtk
