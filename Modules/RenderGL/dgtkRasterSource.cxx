// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterSource.h"

#include "dgtkError.h"
#include "dgtkFragmentList.h"
#include "dgtkGLWindow.h"
#include "dgtkPixelFilter.h"
#include "dgtkRasterScene.h"
#include "dgtkRasterTarget.h"
#include "dgtkSurfaceRows.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

constexpr int maxSamples = 64;
constexpr int maxPiece = 2048;  // side of what is drawn at once with several samples a pixel
constexpr int maxLayers = 4096; // of translucent surfaces; a safeguard

float clamped(float value) { return value > 0 ? (value < 1 ? value : 1.0f) : 0.0f; }

/// Row `y` from the top of a picture that OpenGL gives from the bottom.
const float* rowFromTop(const std::vector<float>& values, const PixelRect& rect, int y, int channels)
{
  return values.data() + std::size_t(rect.height - 1 - y) * rect.width * channels;
}

/// Ids of `rect` as they were drawn, bottom to top.
void takeHits(
  const std::vector<Hit>& firstHits, const std::vector<float>& ids, const PixelRect& rect, std::vector<Hit>& hits)
{
  for (int y = 0; y < rect.height; ++y)
  {
    const float* source = rowFromTop(ids, rect, y, 2);
    Hit* target = hits.data() + std::size_t(y) * rect.width;
    for (int x = 0; x < rect.width; ++x, source += 2)
    {
      target[x] = firstHits[std::size_t(source[0])];
      target[x].triangle += std::uint32_t(source[1]);
    }
  }
}

/// The colours of pixels without averaging: `pixels` is RGBA, bottom to top.
void take(const std::vector<float>& pixels, const PixelRect& rect, ColorBuffer& colors)
{
  for (int y = 0; y < rect.height; ++y)
  {
    const float* source = rowFromTop(pixels, rect, y, 4);
    float* target = colors.rgb.data() + std::size_t(y) * rect.width * 3;
    for (int x = 0; x < rect.width; ++x, source += 4, target += 3)
    {
      target[0] = clamped(source[0]);
      target[1] = clamped(source[1]);
      target[2] = clamped(source[2]);
    }
  }
}

class VtkRasterSource : public RasterSource
{
public:
  explicit VtkRasterSource(GLBackend backend)
    : Window(currentGLWindow(backend, this->Choice))
    , Scene(this->Window)
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
  void setHits(bool wanted) override { this->Scene.setNumbered(wanted); }
  void setFilter(PixelFilter filter) override { this->Filter = filter; }
  void setScene(std::shared_ptr<const SceneState> state, const View& view) override;
  void render(const PixelRect& rect, VisibilityBuffer& hits) override;
  std::function<void()> drawColor(
    const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits) override;
  UnreadColor startColor(const PixelRect& rect, int samples, ColorBuffer& colors) override;
  std::function<void()> peel(const PixelRect& rect, SurfaceLists& lists) override;

private:
  /// What is read of a target.
  struct Drawn
  {
    std::vector<float> pixels;
    std::vector<float> ids;
  };
  void aim(RasterTarget& target, const PixelRect& rect, int samples, bool color);
  void drawSamples(const PixelRect& rect, int samples, bool hits);
  void blendTranslucent();
  bool drawLayer(int rank, Surfaces surfaces, const RasterTarget* base);
  bool firstHitsTranslucent() const;
  void collect(int first, int last, std::vector<Fragment>& fragments);
  std::vector<Fragment> peelOneByOne(const PixelRect& rect);
  std::function<void()> restOf(
    std::shared_ptr<const Drawn> drawn, const PixelRect& rect, ColorBuffer& colors, VisibilityBuffer* hits) const;
  static void check();

  GLChoice Choice;
  vtkOpenGLRenderWindow* Window;
  RasterScene Scene;
  RasterTarget Main{ false };
  std::vector<std::shared_ptr<RasterTarget>> Spare; // of startColor()
  RasterTarget Layers[2]{ RasterTarget{ true }, RasterTarget{ true } };
  std::shared_ptr<const SceneState> State;
  View TheView;
  bool ClipControl;
  PixelFilter Filter = PixelFilter::Box;
  std::vector<float> Pixels; // RGBA, bottom to top
  std::vector<float> Ids;
  std::vector<float> LayerPixels;
  std::vector<float> LayerIds;
  FragmentList Fragments;
};

void VtkRasterSource::setScene(std::shared_ptr<const SceneState> state, const View& view)
{
  const WorkTime build(WorkStage::Build);
  this->Window->MakeCurrent();
  this->TheView = view;
  this->State = state;
  this->Scene.setState(std::move(state), view);
}

void VtkRasterSource::aim(RasterTarget& target, const PixelRect& rect, int samples, bool color)
{
  if (!this->State)
  {
    throw UsageError("no scene was set");
  }
  this->Window->MakeCurrent();
  if (color)
  {
    this->Scene.prepareLight(this->ClipControl);
  }
  target.resize(rect.width, rect.height);
  // Off for clear() and copyDepthFrom(): VTK's state begins with a scissor of the window's size.
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglViewport(0, 0, rect.width, rect.height);
  this->Scene.aim(rasterCamera(this->TheView, rect, samples, this->ClipControl), rect.width, rect.height);
  this->Scene.peelBehind(0);
}

void VtkRasterSource::render(const PixelRect& rect, VisibilityBuffer& hits)
{
  const WorkTime draw(WorkStage::Draw);
  this->aim(this->Main, rect, 1, false);
  this->Main.bind(false, true);
  this->Main.clear({});
  this->Scene.drawIds();
  this->Main.readIds(this->Ids);
  hits.resize(rect);
  takeHits(*this->Scene.firstHits(), this->Ids, rect, hits.hits);
  check();
  const WorkTime settle(WorkStage::Settle);
  settleEdges(*this->State, this->TheView, hits);
}

std::function<void()> VtkRasterSource::drawColor(
  const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits)
{
  if (samples < 1 || samples > maxSamples)
  {
    throw UsageError(
      "samples must be between 1 and " + std::to_string(maxSamples) + " (found " + std::to_string(samples) + ")");
  }
  const WorkTime draw(WorkStage::Draw);
  colors.resize(rect);
  if (samples == 1)
  {
    this->drawSamples(rect, 1, hits != nullptr);
    check();
    auto drawn = std::make_shared<Drawn>();
    drawn->pixels = std::move(this->Pixels);
    drawn->ids = std::move(this->Ids);
    return this->restOf(drawn, rect, colors, hits);
  }
  const SampleFilter filter(this->Filter, samples);
  const int side = std::max(1, maxPiece / samples - 2 * filter.margin());
  for (int y = 0; y < rect.height; y += side)
  {
    for (int x = 0; x < rect.width; x += side)
    {
      const PixelRect piece{ rect.x + x, rect.y + y, std::min(side, rect.width - x), std::min(side, rect.height - y) };
      this->drawSamples(filter.drawn(piece), samples, false);
      filter.apply(SampleImage::upwards(this->Pixels, filter.drawn(piece).width * samples), piece, colors);
    }
  }
  check();
  if (hits)
  {
    this->render(rect, *hits);
  }
  return [] {};
}

std::function<void()> VtkRasterSource::restOf(
  std::shared_ptr<const Drawn> drawn, const PixelRect& rect, ColorBuffer& colors, VisibilityBuffer* hits) const
{
  return [first = this->Scene.firstHits(), drawn = std::move(drawn), rect, &colors, hits]
  {
    const WorkTime draw(WorkStage::Draw);
    take(drawn->pixels, rect, colors);
    if (hits)
    {
      hits->resize(rect);
      takeHits(*first, drawn->ids, rect, hits->hits);
    }
  };
}

UnreadColor VtkRasterSource::startColor(const PixelRect& rect, int samples, ColorBuffer& colors)
{
  if (samples != 1 || this->Scene.hasTranslucent())
  {
    return { nullptr, this->drawColor(rect, samples, colors, nullptr) };
  }
  const WorkTime draw(WorkStage::Draw);
  colors.resize(rect);
  if (this->Spare.empty())
  {
    this->Spare.push_back(std::make_shared<RasterTarget>(false));
  }
  const std::shared_ptr<RasterTarget> target = std::move(this->Spare.back());
  this->Spare.pop_back();
  this->aim(*target, rect, 1, true);
  const Eigen::Vector3f background = this->State->background.cast<float>();
  target->bind(true, false);
  target->clear({ background.x(), background.y(), background.z(), 1 });
  this->Scene.drawColor(Surfaces::All);
  glFlush();
  const auto drawn = std::make_shared<Drawn>();
  const auto read = [this, target, drawn]
  {
    const WorkTime reading(WorkStage::Draw);
    this->Window->MakeCurrent();
    target->readColor(drawn->pixels);
    check();
    this->Spare.push_back(target);
  };
  return { read, this->restOf(drawn, rect, colors, nullptr) };
}

/// Leaves the samples of a piece of the image in Pixels.
void VtkRasterSource::drawSamples(const PixelRect& piece, int samples, bool hits)
{
  const PixelRect rect{ piece.x * samples, piece.y * samples, piece.width * samples, piece.height * samples };
  this->aim(this->Main, rect, samples, true);
  const Eigen::Vector3f background = this->State->background.cast<float>();
  const std::array<float, 4> clear{ background.x(), background.y(), background.z(), 1 };
  const bool ids = hits || this->Scene.hasTranslucent();
  this->Main.bind(true, ids);
  this->Main.clear(clear);
  this->Scene.drawColor(Surfaces::All);
  if (ids)
  {
    this->Main.readIds(this->Ids);
  }
  if (this->Scene.hasTranslucent() && this->firstHitsTranslucent())
  {
    this->Main.bind(true, false);
    this->Main.clear(clear);
    this->Scene.drawColor(Surfaces::Opaque);
    this->Main.readColor(this->Pixels);
    this->blendTranslucent();
  }
  else
  {
    this->Main.readColor(this->Pixels);
  }
}

bool VtkRasterSource::firstHitsTranslucent() const
{
  for (std::size_t i = 0; i < this->Ids.size(); i += 2)
  {
    if (this->Scene.translucent(this->Ids[i]))
    {
      return true;
    }
  }
  return false;
}

/// Draws the surfaces of a rank to Layers[rank % 2] and reads them; false when there are none.
bool VtkRasterSource::drawLayer(int rank, Surfaces surfaces, const RasterTarget* base)
{
  RasterTarget& target = this->Layers[rank % 2];
  RasterTarget& before = this->Layers[(rank + 1) % 2];
  if (rank == 0)
  {
    before.resize(this->Main.width(), this->Main.height());
    before.bind(true, true);
    before.clear({}, 2); // nearer than everything
  }
  target.resize(this->Main.width(), this->Main.height());
  target.bind(true, true);
  target.clear({}, 0);
  if (base)
  {
    target.copyDepthFrom(*base);
  }
  this->Scene.peelBehind(before.idTexture());
  this->Scene.drawColor(surfaces);
  this->Scene.peelBehind(0);
  target.readColor(this->LayerPixels);
  target.readIds(this->LayerIds);
  for (std::size_t i = 0; i < this->LayerIds.size(); i += 2)
  {
    if (this->LayerIds[i] != 0)
    {
      return true;
    }
  }
  return false;
}

/// Puts the translucent surfaces in front of the opaque ones in Main over Pixels, nearest first.
void VtkRasterSource::blendTranslucent()
{
  const std::size_t count = this->Pixels.size() / 4;
  std::vector<float> over(count * 3, 0.0f);
  std::vector<float> through(count, 1.0f);
  for (int rank = 0; rank < maxLayers && this->drawLayer(rank, Surfaces::Translucent, &this->Main); ++rank)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->LayerIds[i * 2] != 0)
      {
        const float* layer = this->LayerPixels.data() + i * 4;
        const float opacity = clamped(layer[3]);
        for (std::size_t c = 0; c < 3; ++c)
        {
          over[i * 3 + c] += through[i] * opacity * clamped(layer[c]);
        }
        through[i] *= 1 - opacity;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      float& value = this->Pixels[i * 4 + c];
      value = over[i * 3 + c] + through[i] * clamped(value);
    }
  }
}

/// All fragments of rows [first, last), from the bottom; strips that are too much for the list are halved.
void VtkRasterSource::collect(int first, int last, std::vector<Fragment>& fragments)
{
  this->Main.bind(false, false);
  this->Fragments.begin(this->Main.width());
  this->Scene.drawFragments(this->Main.width(), first, last);
  std::vector<Fragment> found;
  const std::size_t count = this->Fragments.end(found);
  if (count > FragmentList::capacity && last - first > 1)
  {
    const int middle = (first + last) / 2;
    this->collect(first, middle, fragments);
    this->collect(middle, last, fragments);
    return;
  }
  if (count > FragmentList::capacity)
  {
    throw MachineError("a row of the image has more than " + std::to_string(FragmentList::capacity) + " surfaces");
  }
  fragments.insert(fragments.end(), found.begin(), found.end());
}

std::function<void()> VtkRasterSource::peel(const PixelRect& rect, SurfaceLists& lists)
{
  this->aim(this->Main, rect, 1, true);
  std::vector<Fragment> fragments;
  if (FragmentList::supported())
  {
    this->collect(0, rect.height, fragments);
  }
  else
  {
    fragments = this->peelOneByOne(rect);
  }
  check();
  sortFragments(fragments, std::size_t(rect.width) * rect.height);
  const std::vector<Hit>& firstHits = *this->Scene.firstHits();
  lists.rect = rect;
  lists.first.assign(1, 0);
  std::vector<std::size_t> begins(std::size_t(rect.width) * rect.height + 1, 0); // of pixels from the bottom
  for (const Fragment& f : fragments)
  {
    ++begins[std::size_t(f.pixel) + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  lists.hits.reserve(fragments.size());
  lists.rgba.reserve(4 * fragments.size());
  for (std::size_t i = 0; i < begins.size() - 1; ++i)
  {
    const std::size_t pixel = (std::size_t(rect.height) - 1 - i / rect.width) * rect.width + i % rect.width;
    for (std::size_t at = begins[pixel]; at < begins[pixel + 1]; ++at)
    {
      const Fragment& f = fragments[at];
      lists.hits.push_back(firstHits[std::size_t(f.number)]);
      lists.hits.back().triangle += std::uint32_t(f.triangle);
      std::transform(f.rgba.begin(), f.rgba.end(), std::back_inserter(lists.rgba), clamped);
    }
    lists.first.push_back(std::uint32_t(lists.hits.size()));
  }
  return [] {};
}

/// For OpenGL without storage buffers: as many passes as there are surfaces behind one another.
std::vector<Fragment> VtkRasterSource::peelOneByOne(const PixelRect& rect)
{
  std::vector<Fragment> fragments;
  for (int rank = 0; rank < maxLayers && this->drawLayer(rank, Surfaces::All, nullptr); ++rank)
  {
    for (std::size_t i = 0; i < std::size_t(rect.width) * rect.height; ++i)
    {
      if (this->LayerIds[2 * i] != 0)
      {
        Fragment f;
        f.pixel = float(i);
        f.depth = float(maxLayers - rank); // larger is nearer
        f.number = this->LayerIds[2 * i];
        f.triangle = this->LayerIds[2 * i + 1];
        std::copy_n(&this->LayerPixels[4 * i], 4, f.rgba.begin());
        fragments.push_back(f);
      }
    }
  }
  return fragments;
}

void VtkRasterSource::check()
{
  const std::string said = takeVTKErrors();
  if (!said.empty())
  {
    throw MachineError("VTK: " + said);
  }
}

} // namespace

std::unique_ptr<RasterSource> makeRasterSource(GLBackend backend) { return std::make_unique<VtkRasterSource>(backend); }

} // namespace dgtk
