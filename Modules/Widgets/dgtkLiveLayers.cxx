// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveLayers.h"

#include "dgtkAlbedo.h"
#include "dgtkCorrespondence.h"
#include "dgtkError.h"
#include "dgtkRaySource.h"
#include "dgtkRepresentation.h"
#include "dgtkSamples.h"

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
constexpr double ambient = 0.25;

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
      return { flow.name, PixelType::Float64, 2, "pixels", "image", "nan", flow.description };
    case FlowLayer::Class:
      return { flow.name, PixelType::UInt8, 1, "class", "image", "0", flow.description };
    default:
      return { flow.name, PixelType::Float64, 3, "scene units", "camera", "nan", flow.description };
  }
}

const LayerSpec alphaSpec{ "alpha", PixelType::UInt8, 4, "id", "image", "0", "nearest object and its coverage" };
const LayerSpec surfaceSpec{ "color_surface", PixelType::UInt8, 3, "sRGB", "image", "0",
  "diffuse colour in a light at the camera" };

template <typename T>
void fill(Rows& rows, T value)
{
  T* const first = rows.row<T>(rows.y());
  std::fill(first, first + std::size_t(rows.width()) * rows.height() * rows.channels(), value);
}

/// Points of the surface without rows of the full width: all that reads SurfaceRows takes any rectangle.
void shade(const SurfaceRows& in, Rows& out)
{
  const std::unique_ptr<Representation> normals = makeRepresentation("shadingnormal");
  Rows normal(PixelType::Float64, 3, in.rect.width, in.rect.y, in.rect.height);
  normals->compute(in, normal);
  const double* n = normal.row<double>(in.rect.y);
  std::uint8_t* rgb = out.row<std::uint8_t>(in.rect.y);
  std::size_t i = 0;
  for (int y = in.rect.y; y < in.rect.y + in.rect.height; ++y)
  {
    for (int x = in.rect.x; x < in.rect.x + in.rect.width; ++x, ++i, n += 3, rgb += 3)
    {
      if (!std::isfinite(in.t[i]))
      {
        rgb[0] = rgb[1] = rgb[2] = 70;
        continue;
      }
      const auto albedo = albedoAt(in.state->instances[in.hits[i].object - 1], in.hits[i].triangle,
        { in.barycentrics[2 * i], in.barycentrics[2 * i + 1] });
      const Eigen::Vector3d ray = in.view->model->rayThrough({ x + 0.5, y + 0.5 }).direction.normalized();
      const double cosine = std::abs(ray.dot(Eigen::Vector3d(n[0], n[1], n[2])));
      const double light = ambient + (1 - ambient) * (std::isfinite(cosine) ? cosine : 1.0);
      for (std::size_t c = 0; c < 3; ++c)
      {
        rgb[c] = static_cast<std::uint8_t>(std::lround(albedo[c] * std::min(light, 1.0)));
      }
    }
  }
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
  const LiveScene::Moment& neighbour(int step);

  std::shared_ptr<const LiveScene> Scene;
  LiveView Views;
  ThreadPool& Pool;
  LiveScene::Moment Now;
  std::optional<LiveScene::Moment> Before;
  std::optional<LiveScene::Moment> After;
  std::unique_ptr<VisibilitySource> Source;
  std::unique_ptr<PixelSampler> Sampler;
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
  if (flow.value == FlowLayer::Motion)
  {
    sceneFlowRows(in, *moment.state, out.row<double>(in.rect.y));
    return out;
  }
  const OtherView other{ moment.state.get(), flow.step > 0 ? this->Views.after : this->Views.before,
    moment.occlusion.get() };
  std::vector<double> pixels(2 * in.t.size());
  std::vector<std::uint8_t> classes(in.t.size());
  correspondRows(in, other, pixels.data(), classes.data());
  if (flow.value == FlowLayer::Class)
  {
    std::copy(classes.begin(), classes.end(), out.row<std::uint8_t>(in.rect.y));
    return out;
  }
  double* value = out.row<double>(in.rect.y);
  std::size_t i = 0;
  for (int y = in.rect.y; y < in.rect.y + in.rect.height; ++y)
  {
    for (int x = in.rect.x; x < in.rect.x + in.rect.width; ++x, i += 2)
    {
      value[i] = pixels[i] - (x + 0.5);
      value[i + 1] = pixels[i + 1] - (y + 0.5);
    }
  }
  return out;
}

Rows LiveEye::Impl::alpha(const VisibilityBuffer& hits)
{
  if (!this->Sampler)
  {
    this->Sampler = std::make_unique<PixelSampler>(this->Now.state, this->Views.now, alphaSide, this->Pool);
  }
  SampledRows samples;
  this->Sampler->sample(hits.rect, hits.hits.data(), samples);
  return alphaRows(samples, this->Pool);
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
    shade(surface, out);
  }
  return out;
}

} // namespace dgtk
