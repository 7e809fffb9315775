// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveLayers.h"

#include "dgtkAlbedo.h"
#include "dgtkError.h"
#include "dgtkPairValues.h"
#include "dgtkRaySource.h"
#include "dgtkRepresentation.h"
#include "dgtkSamples.h"
#include "dgtkSurfaceShading.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int alphaSide = 4; ///< samples a side of a pixel

/// A layer that relates a view with a neighbouring frame.
struct FlowLayer
{
  const char* name;
  const char* description;
  int step; ///< frames
  enum
  {
    Displacement,
    Class,
    Motion
  } value;
};
const FlowLayer flowLayers[] = {
  { "flow_forward", "motion in the image until the next frame, pixels", 1, FlowLayer::Displacement },
  { "flow_forward_class", "visibility in the next frame", 1, FlowLayer::Class },
  { "flow_backward", "motion in the image to the frame before, pixels", -1, FlowLayer::Displacement },
  { "flow_backward_class", "visibility in the frame before", -1, FlowLayer::Class },
  { "sceneflow", "motion in the world until the next frame, axes of the camera", 1, FlowLayer::Motion },
};

const FlowLayer* findFlow(const std::string& layer)
{
  const auto* const found = std::find_if(
    std::begin(flowLayers), std::end(flowLayers), [&](const FlowLayer& flow) { return layer == flow.name; });
  return found == std::end(flowLayers) ? nullptr : found;
}

LayerSpec specOf(const FlowLayer& flow)
{
  switch (flow.value)
  {
    case FlowLayer::Displacement:
      return { flow.name, PixelType::Float64, 2, "pixels", "image", "nan", flow.description, Meaning::Displacement };
    case FlowLayer::Class:
      return { flow.name, PixelType::UInt8, 1, "class", "image", "0", flow.description, Meaning::Visibility };
    default:
      return { flow.name, PixelType::Float64, 3, "scene units", "camera", "nan", flow.description,
        Meaning::Displacement };
  }
}

const LayerSpec alphaSpec{ "alpha", PixelType::UInt8, 4, "id", "image", "0", "nearest object and its coverage",
  Meaning::Id };
const LayerSpec surfaceSpec{ "color_surface", PixelType::UInt8, 3, "sRGB", "image", "0",
  "draft of the colours, without shadows and bumps", Meaning::Picture };

template <typename T>
void fill(Rows& rows, T value)
{
  T* const first = rows.row<T>(rows.y());
  std::fill(first, first + std::size_t(rows.width()) * rows.height() * rows.channels(), value);
}

bool isTranslucent(const SceneState& state, const Hit& hit)
{
  const Material* const material =
    hit.object == 0 ? nullptr : materialOf(state.instances[hit.object - 1], hit.triangle);
  return material != nullptr && material->opacity < 1;
}
} // namespace

const std::vector<LiveLayer>& liveLayers()
{
  static const std::vector<LiveLayer> layers = []
  {
    std::vector<LiveLayer> list{ { "surface", surfaceSpec.description } };
    for (const RepresentationInfo& info : representations())
    {
      list.push_back({ info.layer, info.description });
    }
    for (const FlowLayer& flow : flowLayers)
    {
      list.push_back({ flow.name, flow.description });
    }
    list.push_back({ alphaSpec.name, alphaSpec.description });
    return list;
  }();
  return layers;
}

struct LiveEye::Impl
{
  Impl(std::shared_ptr<const LiveScene> scene, int frame, LiveView view, ThreadPool& pool)
    : Scene(std::move(scene))
    , Views(std::move(view))
    , Pool(pool)
    , Now(this->Scene->at(frame))
    , Source(makeRaySource(pool))
  {
    this->Source->setScene(this->Now.state, this->Views.now);
  }

  Rows flow(const FlowLayer& flow, const SurfaceRows& in);
  Rows alpha(const VisibilityBuffer& hits);
  void shade(const SurfaceRows& in, Rows& out);
  Eigen::Vector3d through(int x, int y) const;
  const LiveScene::Moment& neighbour(int step);

  std::shared_ptr<const LiveScene> Scene;
  LiveView Views;
  ThreadPool& Pool;
  LiveScene::Moment Now;
  std::optional<LiveScene::Moment> Before;
  std::optional<LiveScene::Moment> After;
  std::unique_ptr<VisibilitySource> Source;
  std::unique_ptr<PixelSampler> Sampler;
  std::optional<SurfaceShading> Shading;
};

const LiveScene::Moment& LiveEye::Impl::neighbour(int step)
{
  std::optional<LiveScene::Moment>& kept = step > 0 ? this->After : this->Before;
  if (!kept)
  {
    kept = this->Scene->at(this->Now.frame + step);
  }
  return *kept;
}

Rows LiveEye::Impl::flow(const FlowLayer& flow, const SurfaceRows& in)
{
  const LayerSpec spec = specOf(flow);
  Rows out(spec.type, spec.channels, in.rect.width, in.rect.y, in.rect.height);
  const LiveScene::Moment& moment = this->neighbour(flow.step);
  const OtherView other{ moment.state.get(), flow.step > 0 ? this->Views.after : this->Views.before,
    moment.occlusion.get() };
  std::vector<std::uint8_t> classes(in.t.size());
  if (flow.value != FlowLayer::Class)
  {
    const PairValue value = flow.value == FlowLayer::Motion ? PairValue::Motion : PairValue::Displacement;
    pairRows(in, other, value, out.row<double>(in.rect.y), classes.data());
    return out;
  }
  std::vector<double> pixels(2 * in.t.size());
  pairRows(in, other, PairValue::Position, pixels.data(), classes.data());
  std::copy(classes.begin(), classes.end(), out.row<std::uint8_t>(in.rect.y));
  return out;
}

Rows LiveEye::Impl::alpha(const VisibilityBuffer& hits)
{
  if (!this->Sampler)
  {
    this->Sampler = std::make_unique<PixelSampler>(
      this->Now.state, this->Views.now, alphaSide, makeRaySource(this->Pool), this->Pool);
  }
  SampledRows samples;
  this->Sampler->sample(hits.rect, hits.hits.data(), samples);
  return alphaRows(samples, this->Pool);
}

/// The colour of a pixel where the nearest surface is seen through.
Eigen::Vector3d LiveEye::Impl::through(int x, int y) const
{
  const SceneState& state = *this->Now.state;
  const View& view = this->Views.now;
  std::vector<Hit> hits;
  this->Now.occlusion->allHits(view, { x + 0.5, y + 0.5 }, hits);
  hits.push_back({}); // the background
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  double left = 1;
  for (auto hit = hits.begin(); hit != hits.end() && left > 0; ++hit)
  {
    SurfaceRows one;
    computeSurfaceRows(state, view, { x, y, 1, 1 }, &*hit, true, one);
    const double opacity =
      isTranslucent(state, *hit) ? materialOf(state.instances[hit->object - 1], hit->triangle)->opacity : 1.0;
    color += left * opacity * this->Shading->colors(one).front().cwiseMin(1.0);
    left *= 1 - opacity;
  }
  return color;
}

/// Points of the surface without rows of the full width: all that reads SurfaceRows takes any rectangle.
void LiveEye::Impl::shade(const SurfaceRows& in, Rows& out)
{
  if (!this->Shading)
  {
    this->Shading.emplace(*this->Now.state, this->Views.now, this->Scene->environmentLight());
  }
  const std::vector<Eigen::Vector3d> colors = this->Shading->colors(in);
  std::uint8_t* rgb = out.row<std::uint8_t>(in.rect.y);
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    const auto width = std::size_t(in.rect.width);
    const Eigen::Vector3d color = isTranslucent(*in.state, in.hits[i])
                                    ? this->through(in.rect.x + int(i % width), in.rect.y + int(i / width))
                                    : colors[i];
    for (int c = 0; c < 3; ++c)
    {
      *rgb++ = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[c], 0.0, 1.0)));
    }
  }
}

LiveEye::LiveEye(std::shared_ptr<const LiveScene> scene, int frame, LiveView view, ThreadPool& pool)
  : Self(std::make_unique<Impl>(std::move(scene), frame, std::move(view), pool))
{
}

LiveEye::~LiveEye() = default;

const View& LiveEye::view() const { return this->Self->Views.now; }

const LiveScene::Moment& LiveEye::moment() const { return this->Self->Now; }

void LiveEye::trace(const PixelRect& rect, VisibilityBuffer& hits) { this->Self->Source->render(rect, hits); }

LayerSpec LiveEye::spec(const std::string& layer) const
{
  if (const FlowLayer* const flow = findFlow(layer))
  {
    return specOf(*flow);
  }
  return layer == "alpha" ? alphaSpec : layer == "surface" ? surfaceSpec : makeRepresentation(layer)->spec();
}

bool LiveEye::isBeyond(const std::string& layer) const
{
  const FlowLayer* const flow = findFlow(layer);
  const int frame = this->Self->Now.frame + (flow != nullptr ? flow->step : 0);
  return flow != nullptr && (frame < this->Self->Scene->firstFrame() || frame > this->Self->Scene->lastFrame());
}

Rows LiveEye::values(const std::string& layer, const VisibilityBuffer& hits)
{
  if (layer == "alpha")
  {
    return this->Self->alpha(hits);
  }
  const LayerSpec spec = this->spec(layer);
  Rows out(spec.type, spec.channels, hits.rect.width, hits.rect.y, hits.rect.height);
  if (this->isBeyond(layer))
  {
    if (spec.type == PixelType::UInt8)
    {
      fill<std::uint8_t>(out, 0);
    }
    else
    {
      fill(out, std::numeric_limits<double>::quiet_NaN());
    }
    return out;
  }
  const FlowLayer* const flow = findFlow(layer);
  const std::unique_ptr<Representation> one =
    flow != nullptr || layer == "surface" ? nullptr : makeRepresentation(layer);
  SurfaceRows surface;
  computeSurfaceRows(*this->Self->Now.state, this->Self->Views.now, hits.rect, hits.hits.data(),
    one == nullptr || one->needsBarycentrics(), surface);
  if (flow != nullptr)
  {
    return this->Self->flow(*flow, surface);
  }
  if (one != nullptr)
  {
    one->compute(surface, out);
  }
  else
  {
    this->Self->shade(surface, out);
  }
  return out;
}

} // namespace dgtk
