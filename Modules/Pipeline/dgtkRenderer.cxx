// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderer.h"

#include "dgtkArraySink.h"
#include "dgtkError.h"
#include "dgtkInterpreterPause.h"
#include "dgtkKeptSource.h"
#include "dgtkScene.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkPlan.h"

#include "dgtkText.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <optional>

#include <unistd.h>

vtkStandardNewMacro(dgtkRenderer);

namespace
{
/// Throws UsageError for layers that are not known or not given as arrays.
void requireArrays(const std::vector<std::string>& layers)
{
  std::map<std::string, std::string> filesOnly;
  std::vector<std::string> arrays;
  for (const dgtk::LayerInfo& info : dgtk::generatorLayers())
  {
    filesOnly[info.layer] = info.filesOnly;
    if (info.filesOnly.empty())
    {
      arrays.push_back(info.layer);
    }
  }
  for (const std::string& layer : layers)
  {
    const auto found = filesOnly.find(layer);
    if (found == filesOnly.end())
    {
      throw dgtk::UsageError(
        "unknown layer " + dgtk::quoted(layer) + " (expected one of " + dgtk::joined(arrays) + ')');
    }
    if (!found->second.empty())
    {
      throw dgtk::UsageError("the layer " + layer + " is not given as an array: " + found->second);
    }
  }
}
} // namespace

namespace
{
/// A picture that was asked for, beside which the renderer may be given another one.
struct Wanted
{
  std::shared_ptr<const dgtk::Stage> stage;
  dgtk::LayerRequest request;
  std::string camera;
  std::optional<int> frame;

  dgtk::WorkPlan plan();
};

/// The plan of all cameras, which layers may relate to one another; the first job is the picture.
dgtk::WorkPlan Wanted::plan()
{
  requireArrays(this->request.layers);
  if (!dgtk::drawsItself(this->request))
  {
    throw dgtk::UsageError("renderer: arrays are not drawn by POV-Ray");
  }
  const int at = this->frame.value_or(this->stage->description().firstFrame());
  this->request.frames = dgtk::FrameRange{ at, at, 1 };
  const std::vector<dgtk::CameraDescription>& cameras = this->stage->description().cameras;
  this->request.picture = this->camera.empty() && !cameras.empty() ? cameras.front().name : this->camera;
  dgtk::WorkPlan plan = dgtk::makeWorkPlan(this->request, *this->stage);
  const std::vector<std::string> names = this->stage->cameraNames();
  const auto own = std::find_if(plan.jobs.begin(), plan.jobs.end(),
    [&](const dgtk::Job& job) { return this->camera.empty() || names[job.camera] == this->camera; });
  if (own == plan.jobs.end())
  {
    dgtk::LayerRequest wrong = this->request;
    wrong.cameras = { this->camera };
    dgtk::makeWorkPlan(wrong, *this->stage); // says which there are
  }
  std::rotate(plan.jobs.begin(), own, own + 1);
  for (const dgtk::PlannedLayer& planned : plan.layers)
  {
    if (planned.formats.size() > 1)
    {
      throw dgtk::UsageError(dgtk::formatOption(planned.layer->info().layer) + ": an array has one format, found " +
                             dgtk::quoted(dgtk::joinedNames(planned.formats)));
    }
    if (dgtk::outputsOf(plan, *this->stage, plan.jobs.front(), planned).empty())
    {
      throw dgtk::UsageError("there is no layer " + planned.layer->info().layer + " of camera " +
                             dgtk::quoted(names[plan.jobs.front().camera]) + " at frame " + std::to_string(at) +
                             ": it needs " + dgtk::requirementOf(plan, plan.jobs.front(), planned));
    }
  }
  return plan;
}

std::vector<dgtk::LayerArray> drawWith(dgtk::FrameSource& frames, const dgtk::JobContext& context)
{
  using namespace dgtk;
  const Stage& stage = context.queries.stage();
  const Job& job = context.job;
  struct Lane
  {
    std::unique_ptr<LayerPass> pass;
    ArraySink sink;
  };
  std::vector<Lane> lanes;
  for (const PlannedPass& planned : passesOf(context.plan, stage, job))
  {
    lanes.push_back(
      { planned.layers.front().layer.makePass(context, planned.layers), ArraySink(context, planned.outputs()) });
  }
  frames.drop(); // of a picture that failed
  if (frames.drawsAnything())
  {
    frames.setScene(context.state, context.view);
    if (context.plan.drawsColor())
    {
      const LayerRequest& request = context.plan.request;
      frames.expose(stage.exposures(job.camera, job.frame, request.width, request.height),
        [&stage](double instant) { return stage.at(instant); });
    }
    for (int row = 0; row < frames.bands(); ++row)
    {
      frames.draw(row,
        [&lanes](const std::shared_ptr<DrawnBand>& band)
        {
          for (Lane& lane : lanes)
          {
            lane.pass->band(band->whole(), lane.sink);
          }
        });
    }
    frames.finish();
  }
  std::vector<LayerArray> all;
  for (Lane& lane : lanes)
  {
    lane.pass->finish(lane.sink);
    std::vector<LayerArray> own = lane.sink.finish();
    all.insert(all.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  }
  return all;
}
} // namespace

struct dgtkRenderer::Internal
{
  vtkSmartPointer<dgtkScene> scene;
  dgtk::LayerRequest request;
  std::string camera;
  std::optional<int> frame;
  dgtk::KeptSource source;
  std::atomic<pid_t> drawing{ 0 }; // the process in which one is under way; one that was forked may go on

  bool render(dgtkRenderer& self, const std::function<std::vector<std::string>()>& layers);
  std::vector<dgtk::LayerArray> draw(Wanted wanted, int& columns, int& rows);
  std::vector<dgtk::LayerArray> drawPicture(Wanted& wanted, int& columns, int& rows);
};

bool dgtkRenderer::Internal::render(dgtkRenderer& self, const std::function<std::vector<std::string>()>& layers)
{
  try
  {
    Wanted wanted{ this->scene ? this->scene->GetStage() : nullptr, this->request, this->camera, this->frame };
    if (!wanted.stage)
    {
      throw dgtk::UsageError("no scene is set");
    }
    wanted.request.layers = layers();
    int columns = 0;
    int rows = 0;
    std::vector<dgtk::LayerArray> drawn = this->draw(std::move(wanted), columns, rows);
    self.SetOutputs(std::move(drawn), columns, rows);
    return true;
  }
  catch (...)
  {
    self.SetFailure();
    return false;
  }
}

std::vector<dgtk::LayerArray> dgtkRenderer::Internal::draw(Wanted wanted, int& columns, int& rows)
{
  const dgtk::InterpreterPause pause;
  pid_t before = this->drawing;
  if (before == ::getpid() || !this->drawing.compare_exchange_strong(before, ::getpid()))
  {
    throw dgtk::UsageError("the renderer draws for another thread; each has its own");
  }
  try
  {
    std::vector<dgtk::LayerArray> drawn = this->drawPicture(wanted, columns, rows);
    this->drawing = 0;
    return drawn;
  }
  catch (...)
  {
    this->drawing = 0;
    throw;
  }
}

std::vector<dgtk::LayerArray> dgtkRenderer::Internal::drawPicture(Wanted& wanted, int& columns, int& rows)
{
  const dgtk::Stage& stage = *wanted.stage;
  dgtk::ScratchFolder scratch;
  dgtk::WorkPlan plan = wanted.plan();
  requireMemory(plan, stage, plan.jobs.front());
  for (dgtk::PlannedLayer& planned : plan.layers)
  {
    planned.shared = planned.layer->makeShared({ [&scratch] { return scratch.path(); }, [](const std::string&) {} });
  }
  std::vector<dgtk::LayerArray> drawn;
  this->source.use(sourceOptions(plan), wanted.stage,
    [&](dgtk::FrameSource& frames, dgtk::SceneQueries& queries, dgtk::ThreadPool& pool)
    {
      const dgtk::Job job = plan.jobs.front();
      const dgtk::View view = stage.view(job.camera, job.frame, plan.request.width, plan.request.height);
      columns = view.model->width();
      rows = view.model->height();
      drawn =
        drawWith(frames, { plan, job, stage.cameraNames()[job.camera], stage.at(job.frame), view, queries, pool });
    });
  return drawn;
}

dgtkRenderer::dgtkRenderer()
  : Self(new Internal)
{
}

dgtkRenderer::~dgtkRenderer() = default;

void dgtkRenderer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Camera: " << this->Self->camera << "\n";
  os << indent << "Frame: " << this->Self->frame.value_or(0) << "\n";
  os << indent << "Size: " << this->Self->request.width << " x " << this->Self->request.height << "\n";
}

void dgtkRenderer::SetScene(dgtkScene* scene)
{
  this->Self->scene = scene;
  this->Modified();
}

void dgtkRenderer::SetCamera(const std::string& name)
{
  this->Self->camera = name;
  this->Modified();
}

void dgtkRenderer::SetFrame(int frame)
{
  this->Self->frame = frame;
  this->Modified();
}

void dgtkRenderer::SetSize(int width, int height)
{
  this->Self->request.width = width;
  this->Self->request.height = height;
  this->Modified();
}

void dgtkRenderer::SetSamples(int samples) { this->SetOption("samples", std::to_string(samples)); }

void dgtkRenderer::SetVisibility(const std::string& engine) { this->SetOption("visibility", engine); }

void dgtkRenderer::SetGL(const std::string& backend) { this->SetOption("gl", backend); }

void dgtkRenderer::SetOption(const std::string& name, const std::string& value)
{
  this->Self->request.options[name] = value;
  this->Modified();
}

void dgtkRenderer::ClearOptions()
{
  this->Self->request.options.clear();
  this->Modified();
}

std::string dgtkRenderer::GetOptions()
{
  std::string lines;
  for (const dgtk::OptionRow* row : dgtk::requestOptions())
  {
    lines += row->name + '\t' + row->value + '\t' + row->fallback + '\t' + row->help + '\n';
  }
  return lines;
}

vtkDataArray* dgtkRenderer::Render(const std::string& layer)
{
  return this->Self->render(*this, [&layer] { return std::vector<std::string>{ layer }; }) ? this->GetOutput(0)
                                                                                           : nullptr;
}

bool dgtkRenderer::RenderLayers(const std::string& layers)
{
  return this->Self->render(*this, [&layers] { return dgtk::splitNames(layers, "layers"); });
}
