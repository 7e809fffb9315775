// SPDX-License-Identifier: BSD-3-Clause
// Projection and pose of the camera, as the thesis writes them.
#include "dgtkLayers.h"

namespace dgtk
{

namespace
{
class CalibrationPass : public LayerPass
{
public:
  explicit CalibrationPass(const View& view)
    : TheView(view)
  {
  }
  void finish(LayerSink& sink) override
  {
    const OpenGLMatrices matrices = openGLMatrices(this->TheView);
    const CameraModel& model = *this->TheView.model;
    sink.document(
      0, calibrationText(makeCalibration(matrices.projection, matrices.modelView, model.width(), model.height())));
  }

private:
  View TheView;
};

class CalibrationLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "calibration", { "txt" }, "projection and pose of the camera, as the thesis writes them", true };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofLinear(); }
  /// It has no image.
  std::vector<LayerRecord> records(const WorkPlan&, const std::string&) const override { return {}; }
  std::vector<LayerOutput> outputs(
    const WorkPlan&, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    LayerSpec spec;
    spec.name = this->info().layer;
    spec.meaning = Meaning::Record;
    return { documentOutput(stage, job, spec, planned.formats.front()) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<CalibrationPass>(context.view);
  }
};
} // namespace

LayerList calibrationLayers() { return { std::make_shared<CalibrationLayer>() }; }

} // namespace dgtk
