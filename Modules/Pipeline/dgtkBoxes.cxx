// SPDX-License-Identifier: BSD-3-Clause
// The layers of whole objects: boxes and amodal. One lane casts the rays for both.
#include "dgtkEmptyLane.h"
#include "dgtkFrameLayers.h"
#include "dgtkObjectDocuments.h"
#include "dgtkObjectTruth.h"

#include <algorithm>
#include <optional>

namespace dgtk
{

namespace
{
// Pixels that are one job of the pool.
constexpr int stripPixels = 1 << 12;

LayerSpec boxesSpec()
{
  return { "boxes", PixelType::Float64, 1, "pixels", "image", "null",
    "2D boxes of the visible and the amodal pixels of each object, its 3D box and pose in the camera frame" };
}

LayerSpec amodalSpec()
{
  return { "amodal", PixelType::UInt8, 1, "mask", "image", "0",
    "for each object the pixels whose ray meets it, hidden or not; COCO's uncompressed run lengths" };
}

class ObjectsLane : public OutputLane
{
public:
  explicit ObjectsLane(const JobContext& context)
    : Context(context)
    , Moment(context.queries.at(context.job.frame))
    , Boxes(context.plan.has("boxes"))
    , Amodal(context.plan.has("amodal"))
  {
    this->All.visible.resize(context.state->instances.size());
    this->All.amodal.resize(context.state->instances.size());
  }

  void write(const Band& band) override
  {
    if (!this->Blocks)
    {
      this->Blocks.emplace(*this->Context.state, this->Context.view);
    }
    const int stripRows = std::max(1, stripPixels / band.rect.width);
    std::vector<ObjectRows> strips((band.rect.height + stripRows - 1) / stripRows);
    this->Context.pool.parallelFor(static_cast<int>(strips.size()),
      [&](int i)
      {
        PixelRect rect = band.rect;
        rect.y += i * stripRows;
        rect.height = std::min(stripRows, band.rect.height - i * stripRows);
        collectObjects(*this->Context.state, this->Context.view, *this->Moment.occlusion, *this->Blocks, rect,
          band.hits.data() + std::size_t(i) * stripRows * rect.width, this->Amodal, strips[i]);
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

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    if (this->Boxes)
    {
      this->add(files, "boxes", this->boxes());
    }
    if (this->Amodal)
    {
      this->add(files, "amodal", this->masks());
    }
    return files;
  }

private:
  void add(std::vector<FinishedFile>& files, const std::string& layer, const std::string& text) const
  {
    const std::string name = WorkPlan::fileName(this->Context.camera, layer, this->Context.job.frame, "json");
    const DatasetFile file = writeDocument(this->Context.plan.request.folder, name, text);
    files.push_back({ { file.path, file.bytes, file.sha256 }, layer });
  }

  static std::optional<Eigen::Vector4d> boxOf(const ObjectPixels& pixels)
  {
    if (pixels.count == 0)
    {
      return std::nullopt;
    }
    return Eigen::Vector4d(pixels.x0, pixels.y0, pixels.x1, pixels.y1);
  }

  std::string boxes() const
  {
    const std::vector<Instance>& instances = this->Context.state->instances;
    std::vector<BoxRecord> records(instances.size());
    this->Context.pool.parallelFor(static_cast<int>(instances.size()),
      [&](int i)
      {
        const ObjectPose pose = objectPose(instances[i], this->Context.view);
        BoxRecord& record = records[i];
        record.id = static_cast<std::uint32_t>(i + 1);
        record.name = instances[i].name;
        record.objectClass = instances[i].className;
        record.pixelsVisible = this->All.visible[i].count;
        record.pixelsAmodal = this->All.amodal[i].count;
        record.visible = boxOf(this->All.visible[i]);
        record.amodal = boxOf(this->All.amodal[i]);
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
      });
    return boxesText(this->Context.camera, this->Context.job.frame, records);
  }

  std::string masks() const
  {
    const int width = this->Context.view.model->width();
    const int height = this->Context.view.model->height();
    std::vector<MaskRecord> masks;
    for (std::size_t i = 0; i < this->All.amodal.size(); ++i)
    {
      if (this->All.amodal[i].count > 0)
      {
        masks.push_back(
          { static_cast<std::uint32_t>(i + 1), columnRunLengths(this->All.amodal[i].runs, width, height) });
      }
    }
    return amodalText(width, height, masks);
  }

  JobContext Context;
  SceneQueries::Moment Moment;
  bool Boxes;
  bool Amodal;
  std::optional<BlockObjects> Blocks;
  ObjectRows All;
};

class ObjectsLayer : public FrameLayer
{
public:
  std::vector<std::string> files(const WorkPlan&, const Stage& stage, const Job& job) const override
  {
    return { WorkPlan::fileName(stage.cameraNames()[job.camera], this->info().layer, job.frame, "json") };
  }
};

class BoxesLayer final : public ObjectsLayer
{
public:
  LayerInfo info() const override
  {
    return { "boxes", { "json" }, "2D and 3D boxes, visible fraction and pose of every object" };
  }
  std::vector<LayerRecord> specs(const std::string& format) const override { return { { boxesSpec(), format } }; }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    return std::make_unique<ObjectsLane>(context);
  }
};

class AmodalLayer final : public ObjectsLayer
{
public:
  LayerInfo info() const override
  {
    return { "amodal", { "json" }, "mask of every object with its hidden pixels, as run lengths" };
  }
  std::vector<LayerRecord> specs(const std::string& format) const override { return { { amodalSpec(), format } }; }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    if (context.plan.has("boxes"))
    {
      return std::make_unique<EmptyLane>();
    }
    return std::make_unique<ObjectsLane>(context);
  }
};
} // namespace

std::shared_ptr<const FrameLayer> makeBoxesLayer();
std::shared_ptr<const FrameLayer> makeBoxesLayer() { return std::make_shared<BoxesLayer>(); }

std::shared_ptr<const FrameLayer> makeAmodalLayer();
std::shared_ptr<const FrameLayer> makeAmodalLayer() { return std::make_shared<AmodalLayer>(); }

} // namespace dgtk
