// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderer.h"

#include "dgtkError.h"
#include "dgtkFrameSource.h"
#include "dgtkGLContext.h"
#include "dgtkOutputLanes.h"
#include "dgtkScene.h"
#include "dgtkSurfaceRows.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkPlan.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>
#include <thread>
#include <unistd.h>

vtkStandardNewMacro(dgtkRenderer);

namespace
{
/// What draws, kept from picture to picture; for any thread, and for processes forked from the one that made it.
class KeptSource
{
public:
  ~KeptSource() { this->drop(); }
  void use(const dgtk::FrameSourceOptions& options, const std::function<void(dgtk::FrameSource&)>& draw);

private:
  void drop();
  void leaveInherited();

  pid_t Process = 0; // that of the members below
  std::unique_ptr<dgtk::ThreadPool> Pool;
  dgtk::FrameSourceOptions Options; // of Source
  std::unique_ptr<dgtk::FrameSource> Source;
};

bool usesGL(const dgtk::FrameSourceOptions& options) { return options.color || options.raster; }

bool same(const dgtk::FrameSourceOptions& a, const dgtk::FrameSourceOptions& b)
{
  return a.hits == b.hits && a.color == b.color && a.raster == b.raster && a.samples == b.samples && a.gl == b.gl;
}

void KeptSource::use(const dgtk::FrameSourceOptions& options, const std::function<void(dgtk::FrameSource&)>& draw)
{
  this->leaveInherited();
  if (!same(options, this->Options))
  {
    this->drop();
  }
  std::optional<dgtk::GLTurn> turn;
  if (usesGL(options))
  {
    turn.emplace();
  }
  if (!this->Source)
  {
    this->Options = options;
    this->Source = std::make_unique<dgtk::FrameSource>(options, *this->Pool);
  }
  draw(*this->Source);
}

void KeptSource::drop()
{
  this->leaveInherited();
  std::optional<dgtk::GLTurn> turn;
  if (this->Source && usesGL(this->Options))
  {
    turn.emplace();
  }
  this->Source.reset();
}

/// The threads of what a process finds when it was forked are not there: its end would wait for them.
void KeptSource::leaveInherited()
{
  if (this->Process != ::getpid())
  {
    static_cast<void>(this->Source.release());
    static_cast<void>(this->Pool.release());
    this->Process = ::getpid();
    this->Pool = std::make_unique<dgtk::ThreadPool>(std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
  }
}

dgtk::FrameSourceOptions sourceOptions(const dgtk::WorkPlan& plan)
{
  dgtk::FrameSourceOptions options;
  options.hits = !plan.representations.empty();
  options.color = plan.drawsColor();
  options.raster = plan.raster;
  options.samples = plan.request.samples;
  options.gl = plan.request.gl;
  return options;
}

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

/// Throws UsageError for every name but those of the layers that say that they are arrays.
void requireArray(const std::string& layer)
{
  bool known = false;
  std::string arrays;
  for (const dgtk::LayerInfo& info : dgtk::generatorLayers())
  {
    if (info.layer == layer && info.array)
    {
      return;
    }
    known = known || info.layer == layer;
    if (info.array)
    {
      arrays += (arrays.empty() ? "" : ", ") + info.layer;
    }
  }
  throw dgtk::UsageError(
    (known ? "the layer " + layer + " is not given as an array yet" : "unknown layer " + dgtk::quoted(layer)) +
    " (expected one of " + arrays + ')');
}
} // namespace

struct dgtkRenderer::Internal
{
  vtkSmartPointer<dgtkScene> scene;
  dgtk::GeneratorRequest request;
  std::string camera;
  int frame = 0;
  bool frameSet = false;
  std::string errorMessage;
  int width = 0;
  int height = 0;
  KeptSource source;
  vtkSmartPointer<vtkDataArray> result;

  dgtk::Rows draw(const std::string& layer);
  dgtk::WorkPlan planOf(const std::string& layer, const dgtk::Stage& stage);
  dgtk::Rows drawWith(dgtk::FrameSource& frames, const dgtk::WorkPlan& plan, const dgtk::Stage& stage);
};

dgtk::Rows dgtkRenderer::Internal::draw(const std::string& layer)
{
  if (!this->scene || !this->scene->GetStage())
  {
    throw dgtk::UsageError("no scene is set");
  }
  const dgtk::Stage& stage = *this->scene->GetStage();
  const dgtk::WorkPlan plan = this->planOf(layer, stage);
  dgtk::Rows image;
  this->source.use(
    sourceOptions(plan), [&](dgtk::FrameSource& frames) { image = this->drawWith(frames, plan, stage); });
  return image;
}

dgtk::WorkPlan dgtkRenderer::Internal::planOf(const std::string& layer, const dgtk::Stage& stage)
{
  requireArray(layer);
  this->request.layers = { layer };
  this->request.cameras.clear();
  if (!this->camera.empty())
  {
    this->request.cameras = { this->camera };
  }
  const int at = this->frameSet ? this->frame : stage.description().firstFrame();
  this->request.frames = dgtk::FrameRange{ at, at, 1 };
  return dgtk::makeWorkPlan(this->request, stage);
}

dgtk::Rows dgtkRenderer::Internal::drawWith(
  dgtk::FrameSource& frames, const dgtk::WorkPlan& plan, const dgtk::Stage& stage)
{
  using namespace dgtk;
  const Job& job = plan.jobs.front();
  const View view = stage.view(job.camera, job.frame, this->request.width, this->request.height);
  const std::shared_ptr<const SceneState> state = stage.at(job.frame);
  frames.setScene(state, view);
  this->width = view.model->width();
  this->height = view.model->height();

  const bool color = plan.representations.empty();
  if (color)
  {
    frames.expose(stage.exposures(job.camera, job.frame, this->request.width, this->request.height),
      [&stage](double instant) { return stage.at(instant); });
  }
  const LayerSpec spec = color ? plan.colorSpec("png") : plan.representations.front().spec;
  Rows image(spec.type, spec.channels, this->width, 0, this->height);
  for (int row = 0; row < frames.bands(); ++row)
  {
    DrawnBand drawn;
    frames.draw(row, drawn);
    frames.finish();
    const Band& band = drawn.whole();
    Rows part;
    if (color)
    {
      part = quantise(band, spec, band.rect.y, band.rect.height);
    }
    else
    {
      const Representation& representation = *plan.representations.front().representation;
      SurfaceRows surface;
      computeSurfaceRows(*state, view, band.rect, band.hits.data(), representation.needsBarycentrics(), surface);
      part = Rows(spec.type, spec.channels, this->width, band.rect.y, band.rect.height);
      representation.compute(surface, part);
    }
    std::copy_n(part.data(), part.bytes(), image.data() + band.rect.y * image.rowBytes());
  }
  return image;
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
  os << indent << "Frame: " << this->Self->frame << "\n";
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
  this->Self->frameSet = true;
  this->Modified();
}

void dgtkRenderer::SetSize(int width, int height)
{
  this->Self->request.width = width;
  this->Self->request.height = height;
  this->Modified();
}

void dgtkRenderer::SetSamples(int samples)
{
  this->Self->request.samples = samples;
  this->Modified();
}

void dgtkRenderer::SetVisibility(const std::string& engine)
{
  this->Self->request.visibility = engine;
  this->Modified();
}

void dgtkRenderer::SetGL(const std::string& backend)
{
  this->Self->request.gl = backend;
  this->Modified();
}

vtkDataArray* dgtkRenderer::Render(const std::string& layer)
{
  this->Self->errorMessage.clear();
  this->Self->result = nullptr;
  try
  {
    const dgtk::Rows image = this->Self->draw(layer);
    const vtkSmartPointer<vtkDataArray> array = arrayFor(image.type());
    array->SetName(layer.c_str());
    array->SetNumberOfComponents(image.channels());
    array->SetNumberOfTuples(static_cast<vtkIdType>(image.width()) * image.height());
    std::memcpy(array->GetVoidPointer(0), image.data(), image.bytes());
    this->Self->result = array;
  }
  catch (const std::exception& error)
  {
    this->Self->errorMessage = error.what();
  }
  return this->Self->result;
}

int dgtkRenderer::GetWidth() const { return this->Self->width; }

int dgtkRenderer::GetHeight() const { return this->Self->height; }

std::string dgtkRenderer::GetErrorMessage() const { return this->Self->errorMessage; }
