// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterSource.h"

#include "dgtkError.h"
#include "dgtkGLWindow.h"
#include "dgtkRasterScene.h"
#include "dgtkRasterTarget.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

float clamped(float value) { return value > 0 ? (value < 1 ? value : 1.0f) : 0.0f; }

class VtkRasterSource : public RasterSource
{
public:
  explicit VtkRasterSource(GLBackend backend)
    : Window(currentGLWindow(backend, this->Choice))
    , Scene(std::make_unique<RasterScene>(this->Window))
    , ClipControl(GLEW_ARB_clip_control)
  {
    if (this->ClipControl)
    {
      glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }
  }
  ~VtkRasterSource() override { this->Window->MakeCurrent(); }

  std::string name() const override { return "raster"; }
  GLChoice choice() const override { return this->Choice; }

  void setScene(std::shared_ptr<const SceneState> state, const View& view) override
  {
    this->Window->MakeCurrent();
    this->View_ = view;
    this->Scene->setState(std::move(state));
  }

  void render(const PixelRect& rect, VisibilityBuffer& hits) override
  {
    this->begin(this->Main, rect, 1);
    this->Main.bind(false, true);
    this->Main.clear({});
    this->Scene->drawIds();
    this->takeHits(rect, hits);
    this->check();
  }

  void renderColor(const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits) override
  {
    if (samples < 1 || samples > 64)
    {
      throw UsageError("samples must be between 1 and 64 (found " + std::to_string(samples) + ")");
    }
    this->begin(this->Main, rect, 1);
    this->Main.bind(true, true);
    const Eigen::Vector3f background = this->Scene->state().background.cast<float>();
    this->Main.clear({ background.x(), background.y(), background.z(), 1 });
    this->Scene->drawColor(Surfaces::All);
    this->Main.readColor(this->Pixels);
    colors.resize(rect);
    for (int y = 0; y < rect.height; ++y)
    {
      const float* source = this->Pixels.data() + std::size_t(rect.height - 1 - y) * rect.width * 4;
      float* target = colors.rgb.data() + std::size_t(y) * rect.width * 3;
      for (int x = 0; x < rect.width; ++x, source += 4, target += 3)
      {
        target[0] = clamped(source[0]);
        target[1] = clamped(source[1]);
        target[2] = clamped(source[2]);
      }
    }
    if (hits)
    {
      this->takeHits(rect, *hits);
    }
    this->check();
  }

  void peel(const PixelRect&, const std::function<bool(const SurfaceLayer&)>&) override {}

private:
  void begin(RasterTarget& target, const PixelRect& rect, int samples)
  {
    if (!this->Scene)
    {
      throw UsageError("no scene was set");
    }
    this->Window->MakeCurrent();
    target.resize(rect.width, rect.height);
    this->Window->GetState()->vtkglViewport(0, 0, rect.width, rect.height);
    this->Scene->aim(rasterCamera(this->View_, rect, samples, this->ClipControl));
  }

  void takeHits(const PixelRect& rect, VisibilityBuffer& hits)
  {
    this->Main.readIds(this->Ids);
    hits.resize(rect);
    for (int y = 0; y < rect.height; ++y)
    {
      const float* source = this->Ids.data() + std::size_t(rect.height - 1 - y) * rect.width * 2;
      Hit* target = hits.hits.data() + std::size_t(y) * rect.width;
      for (int x = 0; x < rect.width; ++x, source += 2)
      {
        target[x] = this->Scene->hit(source[0], source[1]);
      }
    }
  }

  void check()
  {
    const std::string said = takeVTKErrors();
    if (!said.empty())
    {
      throw MachineError("VTK: " + said);
    }
  }

  GLChoice Choice;
  vtkOpenGLRenderWindow* Window;
  std::unique_ptr<RasterScene> Scene;
  RasterTarget Main{ false };
  View View_;
  bool ClipControl;
  std::vector<float> Pixels;
  std::vector<float> Ids;
};

} // namespace

std::unique_ptr<RasterSource> makeRasterSource(GLBackend backend) { return std::make_unique<VtkRasterSource>(backend); }

} // namespace dgtk
