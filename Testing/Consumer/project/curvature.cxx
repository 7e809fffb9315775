// SPDX-License-Identifier: BSD-3-Clause
// A layer of a program of its own: how much the surface's normal turns from a pixel to those beside and below it.
#include <dgtkEdges.h>
#include <dgtkLayers.h>
#include <dgtkSurfaceRows.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using namespace dgtk;

const IntegerOption reach("curvature_reach", 1, 1, 64, "pixels to the right between normals that are compared");

LayerSpec spec()
{
  return { "curvature", PixelType::Float64, 1, "1 / scene units", "", "nan",
    "angle between the pixel's normal and the next ones on the same object, by their distance; the largest" };
}

double turn(const PixelPlane& a, const PixelPlane& b)
{
  const double distance = (a.point - b.point).norm();
  const double angle = std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
  return a.object == b.object && a.object != 0 && distance > 0 ? angle / distance : 0;
}

class CurvaturePass : public LayerPass
{
public:
  explicit CurvaturePass(const JobContext& context)
    : State(context.state)
    , TheView(context.view)
    , Reach(std::size_t(reach.of(context.plan.request.options)))
  {
  }

  void band(const Band& band, LayerSink& sink) override
  {
    const int width = band.rect.width;
    for (int y = band.rect.y; y < band.rect.y + band.rect.height; ++y)
    {
      SurfaceRows surface;
      computeSurfaceRows(*this->State, this->TheView, { 0, y, width, 1 },
        band.hits.data() + std::size_t(y - band.rect.y) * std::size_t(width), false, surface);
      std::vector<PixelPlane> row = pixelPlanes(surface);
      this->give(row, sink);
      this->Above = std::move(row);
      this->Row = y;
    }
  }
  void finish(LayerSink& sink) override { this->give({}, sink); }

private:
  /// The row above another one; nothing is below the last.
  void give(const std::vector<PixelPlane>& below, LayerSink& sink) const
  {
    if (this->Above.empty())
    {
      return;
    }
    Rows rows(PixelType::Float64, 1, static_cast<int>(this->Above.size()), this->Row, 1);
    double* value = rows.row<double>(this->Row);
    for (std::size_t x = 0; x < this->Above.size(); ++x, ++value)
    {
      const PixelPlane& own = this->Above[x];
      *value = own.object == 0 ? std::numeric_limits<double>::quiet_NaN() : 0;
      *value =
        x + this->Reach < this->Above.size() ? std::max(*value, turn(own, this->Above[x + this->Reach])) : *value;
      *value = x < below.size() ? std::max(*value, turn(own, below[x])) : *value;
    }
    sink.rows(0, rows);
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  std::size_t Reach;
  std::vector<PixelPlane> Above;
  int Row = 0;
};

class Curvature final : public Layer
{
public:
  LayerInfo info() const override { return { "curvature", { "npy", "text" }, "how much the surface bends" }; }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  std::vector<const OptionRow*> options() const override { return { &reach }; }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { spec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, spec(), planned.formats) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<CurvaturePass>(context);
  }
};

const bool added = addLayers({ std::make_shared<Curvature>() }); // the row
} // namespace
