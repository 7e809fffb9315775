// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMattingSource.h"

#include "dgtkInstantSource.h"
#include "dgtkSamples.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int mostSide = 2048; // of a picture of samples

/// The scene with an object out of sight; ids and what the engine has loaded stay as they are.
std::shared_ptr<const SceneState> without(const SceneState& all, std::uint32_t object)
{
  auto state = std::make_shared<SceneState>(all);
  for (std::size_t i = 0; i < all.instances.size(); ++i)
  {
    if (all.objectOf(std::uint32_t(i + 1)) == object)
    {
      state->instances[i].visible = false;
    }
  }
  return state;
}

/// Instants at which an object cannot be hit.
class InstantsWithout final : public InstantSource
{
public:
  InstantsWithout(std::shared_ptr<const InstantSource> all, std::uint32_t object)
    : All(std::move(all))
    , Object(object)
  {
  }
  double frame() const override { return this->All->frame(); }
  Instant at(double frame) const override
  {
    const Instant now = this->All->at(frame);
    return { without(*now.state, this->Object), now.camera_from_world };
  }
  Instance instanceAt(double frame, std::uint32_t object) const override
  {
    return this->All->instanceAt(frame, object);
  }
  const std::vector<Motion>& motions() const override { return this->All->motions(); }
  Rigid3 poseAt(double frame) const override { return this->All->poseAt(frame); }
  Affine3 placeAt(double frame, std::uint32_t object) const override { return this->All->placeAt(frame, object); }
  bool isVisibleAt(double frame, std::uint32_t object) const override { return this->All->isVisibleAt(frame, object); }
  Point pointAt(
    double frame, std::uint32_t object, std::uint32_t triangle, const Eigen::Vector2d& barycentrics) const override
  {
    return this->All->pointAt(frame, object, triangle, barycentrics);
  }

private:
  std::shared_ptr<const InstantSource> All;
  std::uint32_t Object;
};
} // namespace

MattingSource::MattingSource(PictureSource& pictures, std::vector<std::uint32_t> objects, int samples)
  : Pictures(pictures)
  , Objects(std::move(objects))
  , Samples(samples)
{
}

void MattingSource::setScene(const std::shared_ptr<const SceneState>& state, const View& view)
{
  this->State = state;
  this->TheView = view;
}

std::vector<MattePixels> MattingSource::draw(const PixelRect& rect)
{
  const std::size_t pixels = std::size_t(rect.width) * rect.height;
  std::vector<MattePixels> mattes(this->Objects.size());
  for (MattePixels& matte : mattes)
  {
    matte.count.assign(pixels, 0);
    matte.foreground.assign(pixels * 3, 0.0f);
  }
  this->drawForegrounds(rect, mattes);
  for (std::size_t i = 0; i < mattes.size(); ++i)
  {
    ColorBuffer colors;
    View view = this->TheView;
    if (view.instants)
    {
      view.instants = std::make_shared<InstantsWithout>(view.instants, this->Objects[i]);
    }
    this->Pictures.setScene(without(*this->State, this->Objects[i]), view);
    this->Pictures.renderColor(rect, this->Samples, colors, nullptr);
    mattes[i].background = std::move(colors.rgb);
  }
  this->Pictures.setScene(this->State, this->TheView);
  return mattes;
}

/// Draws the samples as pixels of a picture `Samples` times as large, in the pieces in which the engine draws them for
/// their mean, so that both see the same textures.
void MattingSource::drawForegrounds(const PixelRect& rect, std::vector<MattePixels>& mattes)
{
  View large = this->TheView;
  const CameraModel& model = *this->TheView.model;
  large.model = resampledCamera(
    this->TheView.model, model.width() * this->Samples, model.height() * this->Samples, 1.0 / this->Samples, { 0, 0 });
  this->Pictures.setScene(this->State, large);
  const int side = std::max(1, mostSide / this->Samples);
  for (int y = 0; y < rect.height; y += side)
  {
    for (int x = 0; x < rect.width; x += side)
    {
      this->drawPiece({ x, y, std::min(side, rect.width - x), std::min(side, rect.height - y) }, rect, mattes);
    }
  }
}

/// `piece` relative to `rect`.
void MattingSource::drawPiece(const PixelRect& piece, const PixelRect& rect, std::vector<MattePixels>& mattes)
{
  ColorBuffer colors;
  VisibilityBuffer hits;
  const int n = this->Samples;
  const PixelRect large{ (rect.x + piece.x) * n, (rect.y + piece.y) * n, piece.width * n, piece.height * n };
  this->Pictures.renderWanted(large, colors, hits,
    [this](const Hit& hit)
    {
      const std::uint32_t object = this->State->objectOf(hit.object);
      return std::find(this->Objects.begin(), this->Objects.end(), object) != this->Objects.end();
    });
  for (std::size_t m = 0; m < mattes.size(); ++m)
  {
    for (int y = 0; y < piece.height; ++y)
    {
      for (int x = 0; x < piece.width; ++x)
      {
        double sum[3] = {};
        std::uint16_t count = 0;
        for (int k = 0; k < n * n; ++k)
        {
          const std::size_t sample = (std::size_t(y) * n + k / n) * large.width + std::size_t(x) * n + k % n;
          if (this->State->objectOf(hits.hits[sample].object) == this->Objects[m])
          {
            ++count;
            for (int c = 0; c < 3; ++c)
            {
              sum[c] += colors.rgb[3 * sample + c];
            }
          }
        }
        const std::size_t pixel = std::size_t(piece.y + y) * rect.width + piece.x + x;
        mattes[m].count[pixel] = count;
        for (int c = 0; c < 3; ++c)
        {
          mattes[m].foreground[3 * pixel + c] = count > 0 ? static_cast<float>(sum[c] / count) : 0.0f;
        }
      }
    }
  }
}

} // namespace dgtk
