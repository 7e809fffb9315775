// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveLayers.h"

#include "dgtkError.h"
#include "dgtkLayerWriter.h"
#include "dgtkLayers.h"
#include "dgtkRayPictures.h"
#include "dgtkRaySource.h"
#include "dgtkSurfaceRows.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <utility>

namespace dgtk
{

const char* const draftLayer = "surface";

namespace
{
constexpr const char* liveSamples = "4"; ///< of a pixel, a side
constexpr int mostChannels = 4;          ///< of an image that can be shown
constexpr int stripPixels = 1 << 14;

LayerSpec draftSpec()
{
  return { draftLayer, PixelType::UInt8, 3, "sRGB", "image", "0", "the picture, one sample a pixel", Meaning::Picture };
}

const Layer* findLayer(const std::string& name)
{
  const auto found =
    std::find_if(layers().begin(), layers().end(), [&](const auto& layer) { return layer->info().layer == name; });
  return found == layers().end() ? nullptr : found->get();
}

/// An image that can be shown, and its layer.
struct LiveImage
{
  std::string layer;
  LayerSpec spec;
};

const std::vector<LiveImage>& liveImages()
{
  static const std::vector<LiveImage> all = []
  {
    std::vector<LiveImage> images;
    for (const LayerInfo& info : generatorLayers())
    {
      std::set<std::string> known; // each image once, whatever its formats
      for (const LayerRecord& record : info.records)
      {
        if (liveRefusal(info).empty() && known.insert(record.spec.name).second)
        {
          images.push_back({ info.layer, record.spec });
        }
      }
    }
    return images;
  }();
  return all;
}

const LiveImage& liveImage(const std::string& name)
{
  const std::vector<LiveImage>& all = liveImages();
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const LiveImage& image) { return image.spec.name == name; });
  if (found == all.end())
  {
    throw UsageError("there is no live layer " + quoted(name));
  }
  return *found;
}

/// The queries of a scene that is being edited, for the stage of an eye, which has a camera more.
class EyeQueries : public SceneQueries
{
public:
  EyeQueries(const LiveScene& scene, const Stage& stage)
    : Scene(scene)
    , Own(stage)
  {
  }
  Moment at(int frame) override { return this->Scene.at(frame); }
  const Stage& stage() const override { return this->Own; }
  std::unique_ptr<VisibilitySource> makeSource(ThreadPool& pool) const override { return makeRaySource(pool); }

private:
  const LiveScene& Scene;
  const Stage& Own;
};

/// Keeps the rows of the outputs that are wanted.
class LiveSink : public LayerSink
{
public:
  void want(std::size_t output, const std::string& name, const LayerSpec& spec, const PixelRect& rect)
  {
    LiveImageRows& image = this->Kept[output];
    image = { name, Rows(spec.type, spec.channels, rect.width, rect.y, rect.height) };
    std::fill_n(image.rows.data(), image.rows.bytes(), std::byte{ 0 });
  }
  void rows(std::size_t output, const Rows& rows) override
  {
    const auto wanted = this->Kept.find(output);
    if (wanted == this->Kept.end())
    {
      return;
    }
    Rows& kept = wanted->second.rows;
    if (rows.y() >= kept.y() && rows.y() + rows.height() <= kept.y() + kept.height() &&
        rows.rowBytes() == kept.rowBytes())
    {
      std::memcpy(kept.data() + kept.rowBytes() * std::size_t(rows.y() - kept.y()), rows.data(), rows.bytes());
    }
  }
  void surfaces(std::size_t, const LdiRows&) override {}
  void ranks(std::size_t, const std::vector<CoveredId>&, std::uint32_t) override {}
  void document(std::size_t, const std::string&) override {}
  void shared(const std::string&, const FileRecord&) override {}
  std::vector<LiveImageRows> take()
  {
    std::vector<LiveImageRows> all;
    for (auto& [output, image] : this->Kept)
    {
      all.push_back(std::move(image));
    }
    return all;
  }

private:
  std::map<std::size_t, LiveImageRows> Kept;
};

int stripRows(int width) { return std::max(8, stripPixels / width / 8 * 8); }

bool asked(const LiveEye::Stop& stop) { return stop && stop(); }
} // namespace

std::string liveRefusal(const LayerInfo& info)
{
  static const std::shared_ptr<const Stage> nothing = Stage::load({});
  const Layer* const layer = findLayer(info.layer);
  if (layer == nullptr)
  {
    return "there is no such layer";
  }
  const LayerNeeds needs = layer->needs({}, *nothing);
  const std::vector<WriterInfo>& writers = layerWriters();
  const bool image = std::any_of(
    writers.begin(), writers.end(), [&](const WriterInfo& writer) { return writer.format == info.formats.front(); });
  if (info.records.empty() || !image)
  {
    return "it has no image of its own";
  }
  if (!info.filesOnly.empty())
  {
    return info.filesOnly;
  }
  if (!needs.hits || needs.color || needs.sharp || needs.peeled)
  {
    return "it needs the renderer's pictures";
  }
  return info.records.front().spec.channels > mostChannels ? "it has more numbers a pixel than a picture shows" : "";
}

const std::vector<LiveLayer>& liveLayers()
{
  static const std::vector<LiveLayer> all = []
  {
    std::vector<LiveLayer> list{ { draftLayer, draftSpec().description } };
    for (const LiveImage& image : liveImages())
    {
      list.push_back({ image.spec.name, image.spec.description });
    }
    return list;
  }();
  return all;
}

View viewOf(const LiveQuestion& question)
{
  return cameraView(
    question.camera, question.frame, question.width, question.height, question.scene->description().folder);
}

struct LiveEye::Impl
{
  Impl(const LiveQuestion& question, int step, ThreadPool& pool);

  /// The plan of one layer at the question's frame, with all cameras; this one's job is the first.
  WorkPlan planOf(const std::string& layer) const;
  void draft(const Band& band, LayerSink& sink);

  LiveQuestion Question;
  ThreadPool& Pool;
  std::size_t Camera = 0;           ///< of the stage
  std::shared_ptr<const Stage> Own; ///< of the scene, with the eye's camera
  EyeQueries Queries;
  View Eye;
  LiveScene::Moment Now;
  std::unique_ptr<VisibilitySource> Source;
  std::shared_ptr<const HitShader> Shader; ///< made when colours are asked for
};

LiveEye::Impl::Impl(const LiveQuestion& question, int step, ThreadPool& pool)
  : Question(question)
  , Pool(pool)
  , Own(question.scene->stageWith(question.camera, this->Camera))
  , Queries(*question.scene, *this->Own)
  , Now(question.scene->at(question.frame))
  , Source(makeRaySource(pool))
{
  const View whole = viewOf(question);
  this->Question.width = (whole.model->width() + step - 1) / step;
  this->Question.height = (whole.model->height() + step - 1) / step;
  this->Eye = this->Own->view(this->Camera, question.frame, this->Question.width, this->Question.height);
  this->Source->setScene(this->Now.state, this->Eye);
}

WorkPlan LiveEye::Impl::planOf(const std::string& layer) const
{
  const SceneDescription& scene = this->Own->description();
  const int known = std::clamp(this->Question.frame, scene.firstFrame(), scene.lastFrame());
  LayerRequest request;
  request.layers = { layer };
  request.frames = FrameRange{ known, known, 1 };
  request.width = this->Question.width;
  request.height = this->Question.height;
  request.options["samples"] = liveSamples;
  request.picture = scene.cameras[this->Camera].name;
  WorkPlan plan = makeWorkPlan(request, *this->Own);
  for (Job& job : plan.jobs)
  {
    job.frame = this->Question.frame;
  }
  std::rotate(plan.jobs.begin(), plan.jobs.begin() + std::ptrdiff_t(this->Camera), plan.jobs.end());
  return plan;
}

void LiveEye::Impl::draft(const Band& band, LayerSink& sink)
{
  if (!this->Shader)
  {
    this->Shader = makeHitShader(this->Now.state, this->Eye);
    this->Question.scene->keep(this->Shader);
  }
  std::vector<float> rgb(band.hits.size() * 3);
  this->Shader->shade({ band.rect, band.hits }, this->Pool, rgb.data());
  const LayerSpec spec = draftSpec();
  Rows out(spec.type, spec.channels, band.rect.width, band.rect.y, band.rect.height);
  std::transform(rgb.begin(), rgb.end(), out.row<std::uint8_t>(band.rect.y),
    [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0F, 1.0F) * 255 + 0.5F); });
  sink.rows(0, out);
}

LiveEye::LiveEye(const LiveQuestion& question, int step, ThreadPool& pool)
  : Self(std::make_unique<Impl>(question, step, pool))
{
}

LiveEye::~LiveEye() = default;

const View& LiveEye::view() const { return this->Self->Eye; }

const LiveScene::Moment& LiveEye::moment() const { return this->Self->Now; }

bool LiveEye::trace(int y, int height, VisibilityBuffer& hits, const Stop& stop)
{
  const int width = this->view().model->width();
  const int strip = stripRows(width);
  VisibilityBuffer part;
  hits.resize({ 0, y, width, height });
  for (int done = 0; done < height; done += strip)
  {
    if (asked(stop))
    {
      return false;
    }
    this->Self->Source->render({ 0, y + done, width, std::min(strip, height - done) }, part);
    std::copy(part.hits.begin(), part.hits.end(), hits.hits.begin() + std::ptrdiff_t(done) * width);
  }
  return true;
}

LayerSpec LiveEye::spec(const std::string& layer) const
{
  return layer == draftLayer ? draftSpec() : liveImage(layer).spec;
}

std::string LiveEye::missing(const std::string& layer) const
{
  if (layer == draftLayer)
  {
    return {};
  }
  const LiveImage& image = liveImage(layer);
  try
  {
    const WorkPlan plan = this->Self->planOf(image.layer);
    const PlannedLayer& planned = plan.layers.front();
    return outputsOf(plan, *this->Self->Own, plan.jobs.front(), planned).empty()
             ? requirementOf(plan, plan.jobs.front(), planned)
             : std::string();
  }
  catch (const UsageError&)
  {
    return findLayer(image.layer)->requirement();
  }
}

namespace
{
/// The bands of these hits, strip by strip. False when it was stopped.
bool giveBands(const VisibilityBuffer& hits, const std::function<void(const Band&)>& give, const LiveEye::Stop& stop)
{
  const int strip = stripRows(hits.rect.width);
  for (int done = 0; done < hits.rect.height; done += strip)
  {
    if (asked(stop))
    {
      return false;
    }
    Band band;
    band.rect = { 0, hits.rect.y + done, hits.rect.width, std::min(strip, hits.rect.height - done) };
    const auto first = hits.hits.begin() + std::ptrdiff_t(done) * hits.rect.width;
    band.hits.assign(first, first + std::ptrdiff_t(band.rect.height) * hits.rect.width);
    give(band);
  }
  return true;
}
} // namespace

Rows LiveEye::values(const std::string& layer, const VisibilityBuffer& hits, const Stop& stop)
{
  std::vector<LiveImageRows> all = this->allValues(layer, hits, stop);
  return all.empty() ? Rows() : std::move(all.front().rows);
}

std::vector<LiveImageRows> LiveEye::allValues(const std::string& layer, const VisibilityBuffer& hits, const Stop& stop)
{
  LiveSink sink;
  if (layer == draftLayer)
  {
    sink.want(0, layer, draftSpec(), hits.rect);
    const bool done = giveBands(
      hits, [&](const Band& band) { this->Self->draft(band, sink); }, stop);
    return done ? sink.take() : std::vector<LiveImageRows>();
  }
  if (!this->missing(layer).empty())
  {
    return {};
  }
  const WorkPlan plan = this->Self->planOf(liveImage(layer).layer);
  if (plan.needs.whole && hits.rect.height < this->view().model->height())
  {
    return {};
  }
  const Job job = plan.jobs.front();
  const JobContext context{ plan, job, this->Self->Own->cameraNames()[job.camera], this->Self->Now.state, this->view(),
    this->Self->Queries, this->Self->Pool };
  const PlannedPass planned = passesOf(plan, *this->Self->Own, job).front();
  const std::vector<LayerOutput> outputs = planned.outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    if (outputs[i].spec.name == layer)
    {
      sink.want(i, outputs[i].name, outputs[i].spec, hits.rect);
    }
  }
  const std::unique_ptr<LayerPass> pass = planned.layers.front().layer.makePass(context, planned.layers);
  if (!giveBands(
        hits, [&](const Band& band) { pass->band(band, sink); }, stop))
  {
    return {};
  }
  pass->finish(sink);
  return sink.take();
}

} // namespace dgtk
