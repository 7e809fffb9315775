// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameLayers.h"
#include "dgtkOutputLanes.h"



namespace dgtk
{

namespace
{
constexpr const char* layerName = "color_sharp";

LayerSpec sharpSpec(const WorkPlan& plan, const std::string& format)
{
  LayerSpec spec = plan.colorSpec(format);
  spec.name = layerName;
  spec.description = "The picture at the frame's own instant and through the centre of the lens; red, green, blue.";
  return spec;
}

class SharpColorLayer : public FrameLayer
{
public:
  LayerInfo info() const override
  {
    return { layerName, { "png", "exr" },
      "the picture without motion blur and depth of field, of cameras that have them" };
  }
  std::string needs() const override { return "a camera with a shutter or a lens, drawn by the built-in renderer"; }
  std::vector<LayerRecord> specs(const std::string&) const override { return {}; }
  std::vector<LayerRecord> records(const WorkPlan& plan, const std::string& format) const override
  {
    return { { sharpSpec(plan, format), format } };
  }
  bool needsColor() const override { return true; }
  bool needsSharpColor() const override { return true; }
  std::vector<std::string> files(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    const CameraDescription& camera = stage.description().cameras[job.camera];
    std::vector<std::string> names;
    if (plan.request.renderer != "vtk" || !(camera.shutter.blurs() || camera.lens.blurs()))
    {
      return names;
    }
    for (const std::string& format : plan.formatsOf(layerName))
    {
      names.push_back(WorkPlan::fileName(camera.name, layerName, job.frame, formatExtension(format)));
    }
    return names;
  }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override;
};

/// One lane a format.
class SharpColorLane : public OutputLane
{
public:
  explicit SharpColorLane(const JobContext& context)
  {
    for (const std::string& format : context.plan.formatsOf(layerName))
    {
      this->Lanes.push_back(makePictureLane(context.plan, sharpSpec(context.plan, format),
        WorkPlan::fileName(context.camera, layerName, context.job.frame, formatExtension(format)), context.view, format,
        &Band::sharp));
    }
  }
  void write(const Band& band) override
  {
    for (const std::unique_ptr<OutputLane>& lane : this->Lanes)
    {
      lane->write(band);
    }
  }
  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    for (const std::unique_ptr<OutputLane>& lane : this->Lanes)
    {
      const std::vector<FinishedFile> own = lane->finish();
      files.insert(files.end(), own.begin(), own.end());
    }
    return files;
  }

private:
  std::vector<std::unique_ptr<OutputLane>> Lanes;
};

std::unique_ptr<OutputLane> SharpColorLayer::makeLane(const JobContext& context) const
{
  return std::make_unique<SharpColorLane>(context);
}
} // namespace

std::shared_ptr<const FrameLayer> makeSharpColorLayer() { return std::make_shared<SharpColorLayer>(); }

} // namespace dgtk
