// SPDX-License-Identifier: BSD-3-Clause
// The layers of whole objects: boxes and amodal. One pass casts the rays for both.
#include "dgtkKeypointTruth.h"
#include "dgtkLayers.h"
#include "dgtkObjectDocuments.h"
#include "dgtkObjectTruth.h"
#include "dgtkPixelBlocks.h"
#include "dgtkWholeObjects.h"

#include <algorithm>
#include <optional>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool.
constexpr int objectStrip = 1 << 12;

LayerSpec boxesSpec()
{
  return { "boxes", PixelType::Float64, 1, "pixels", "image", "null",
    "2D boxes of the visible and the amodal pixels of each object, in the image and around it, its 3D box and pose in "
    "the camera frame",
    Meaning::Record };
}

LayerSpec amodalSpec()
{
  return { "amodal", PixelType::UInt8, 1, "mask", "image", "0",
    "for each object the pixels whose ray meets it, hidden or not; COCO's uncompressed run lengths", Meaning::Mask };
}

class ObjectsLayer : public Layer
{
public:
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { this->spec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan&, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { documentOutput(stage, job, this->spec(), planned.formats.front()) };
  }
  std::string passKey() const override { return "objects"; }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override;

  virtual LayerSpec spec() const = 0;
  /// Whether it reads the runs of ObjectRows::amodal.
  virtual bool needsRuns() const { return false; }
  /// `occlusion`: of the picture's scene.
  virtual std::string text(
    const JobContext& context, const OcclusionQuery& occlusion, const ObjectRows& objects) const = 0;
};

class ObjectsPass : public LayerPass
{
public:
  ObjectsPass(const JobContext& context, const std::vector<PassLayer>& layers)
    : Context(context)
    , Moment(context.queries.at(context.job.frame))
  {
    for (const PassLayer& layer : layers)
    {
      this->Layers.push_back(static_cast<const ObjectsLayer*>(&layer.layer));
      this->Runs = this->Runs || this->Layers.back()->needsRuns();
    }
    this->All.visible.resize(context.state->objects());
    this->All.amodal.resize(context.state->objects());
  }

  void band(const Band& band, LayerSink&) override
  {
    if (!this->Blocks)
    {
      this->Blocks.emplace(*this->Context.state, this->Context.view);
    }
    const int stripRows = std::max(pixelBlock, objectStrip / band.rect.width / pixelBlock * pixelBlock);
    std::vector<ObjectRows> strips((band.rect.height + stripRows - 1) / stripRows);
    this->Context.pool.parallelFor(static_cast<int>(strips.size()),
      [&](int i)
      {
        PixelRect rect = band.rect;
        rect.y += i * stripRows;
        rect.height = std::min(stripRows, band.rect.height - i * stripRows);
        collectObjects(*this->Context.state, this->Context.view, *this->Moment.occlusion, *this->Blocks, rect,
          band.hits.data() + std::size_t(i) * stripRows * rect.width, this->Runs, strips[i]);
      });
    for (const ObjectRows& strip : strips)
    {
      for (std::size_t i = 0; i < strip.visible.size(); ++i)
      {
        this->All.visible[i].append(strip.visible[i]);
        this->All.amodal[i].append(strip.amodal[i]);
      }
    }
  }

  void finish(LayerSink& sink) override
  {
    for (std::size_t i = 0; i < this->Layers.size(); ++i)
    {
      sink.document(i, this->Layers[i]->text(this->Context, *this->Moment.occlusion, this->All));
    }
  }

private:
  JobContext Context;
  SceneQueries::Moment Moment;
  std::vector<const ObjectsLayer*> Layers; // one an output
  bool Runs = false;
  std::optional<BlockObjects> Blocks;
  ObjectRows All;
};

std::unique_ptr<LayerPass> ObjectsLayer::makePass(const JobContext& context, const std::vector<PassLayer>& layers) const
{
  return std::make_unique<ObjectsPass>(context, layers);
}

std::optional<Eigen::Vector4d> boxOf(const ObjectPixels& pixels)
{
  if (pixels.count == 0)
  {
    return std::nullopt;
  }
  return Eigen::Vector4d(pixels.x0, pixels.y0, pixels.x1, pixels.y1);
}

std::vector<KeypointRecord> keypointsOf(
  const JobContext& context, const OcclusionQuery& occlusion, const BoxRecord& box)
{
  const double depth = keypointDepth * (box.corners.row(7) - box.corners.row(0)).norm();
  const std::vector<SeenKeypoint> seen = seeKeypoints(*context.state, box.id, context.view, occlusion, depth);
  std::vector<KeypointRecord> records;
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    records.push_back({ context.state->instances[box.id - 1].keypoints[i].name, seen[i].x_in_camera, seen[i].pixel,
      static_cast<int>(seen[i].visibility) });
  }
  return records;
}

std::string boxes(const JobContext& context, const OcclusionQuery& occlusion, const ObjectRows& objects)
{
  const std::unique_ptr<VisibilitySource> source = context.queries.makeSource(context.pool);
  std::vector<ObjectPixels> whole = objectsAround(context.state, context.view, occlusion, *source, context.pool);
  const std::vector<Instance>& instances = context.state->instances;
  std::vector<BoxRecord> records(context.state->objects());
  context.pool.parallelFor(static_cast<int>(records.size()),
    [&](int i)
    {
      const ObjectPose pose = objectPose(*context.state, static_cast<std::uint32_t>(i + 1), context.view);
      BoxRecord& record = records[i];
      record.id = static_cast<std::uint32_t>(i + 1);
      record.name = instances[i].name;
      record.objectClass = instances[i].className;
      record.pixelsVisible = objects.visible[i].count;
      record.pixelsAmodal = objects.amodal[i].count;
      whole[i].unite(objects.amodal[i]);
      record.pixelsWhole = whole[i].count;
      record.visible = boxOf(objects.visible[i]);
      record.amodal = boxOf(objects.amodal[i]);
      record.whole = boxOf(whole[i]);
      record.projected = pose.projected;
      record.rigid = pose.rigid;
      if (pose.rigid)
      {
        record.R = pose.rotation;
        record.t = pose.translation;
        record.scale = pose.scale;
      }
      record.matrix = pose.matrix;
      record.corners = pose.corners;
      record.keypoints = keypointsOf(context, occlusion, record);
    });
  return boxesText(context.camera, context.job.frame, records);
}

std::string masks(const JobContext& context, const ObjectRows& objects)
{
  const int width = context.view.model->width();
  const int height = context.view.model->height();
  std::vector<MaskRecord> masks;
  for (std::size_t i = 0; i < objects.amodal.size(); ++i)
  {
    if (objects.amodal[i].count > 0)
    {
      masks.push_back({ static_cast<std::uint32_t>(i + 1), columnRunLengths(objects.amodal[i].runs, width, height) });
    }
  }
  return amodalText(width, height, masks);
}

class BoxesLayer final : public ObjectsLayer
{
public:
  LayerInfo info() const override
  {
    return { "boxes", { "json" }, "2D and 3D boxes, visible fraction and pose of every object" };
  }
  LayerSpec spec() const override { return boxesSpec(); }
  std::string text(const JobContext& context, const OcclusionQuery& occlusion, const ObjectRows& objects) const override
  {
    return boxes(context, occlusion, objects);
  }
};

class AmodalLayer final : public ObjectsLayer
{
public:
  LayerInfo info() const override
  {
    return { "amodal", { "json" }, "mask of every object with its hidden pixels, as run lengths" };
  }
  LayerSpec spec() const override { return amodalSpec(); }
  bool needsRuns() const override { return true; }
  std::string text(const JobContext& context, const OcclusionQuery&, const ObjectRows& objects) const override
  {
    return masks(context, objects);
  }
};
} // namespace

LayerList objectLayers() { return { std::make_shared<BoxesLayer>(), std::make_shared<AmodalLayer>() }; }

} // namespace dgtk
