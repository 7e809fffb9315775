// SPDX-License-Identifier: BSD-3-Clause
// The layer of all cameras of a frame: a fused point cloud with tracks.
#include "dgtkAlbedo.h"
#include "dgtkCorrespondence.h"
#include "dgtkLayers.h"
#include "dgtkObjectDocuments.h"
#include "dgtkPixelGrid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk
{

namespace
{
constexpr int largestStep = 1 << 20;
const IntegerOption stepOption("points_step", 4, 1, largestStep, "pixels between the samples of the points layer");

LayerSpec pointsSpec()
{
  return { "points", PixelType::Float64, 3, "scene units", "world", "none",
    "surface points seen by the cameras, each once, with normal, albedo, object and triangle; .json: the pixels that "
    "see each",
    Meaning::Record };
}

/// The cameras of the plan, in the order of the scene.
std::set<std::size_t> camerasOf(const WorkPlan& plan)
{
  std::set<std::size_t> cameras;
  for (const Job& job : plan.jobs)
  {
    cameras.insert(job.camera);
  }
  return cameras;
}

class PointsPass : public LayerPass
{
public:
  explicit PointsPass(const JobContext& context)
    : Context(context)
    , Step(stepOption.of(context.plan.request.options))
  {
    const SceneQueries::Moment moment = context.queries.at(context.job.frame);
    this->Occlusion = moment.occlusion;
    for (const std::size_t camera : camerasOf(context.plan))
    {
      const LayerRequest& request = context.plan.request;
      this->Views.push_back(
        { context.state.get(), context.queries.stage().view(camera, context.job.frame, request.width, request.height),
          this->Occlusion.get() });
    }
  }

  void finish(LayerSink& sink) override
  {
    std::vector<PointRecord> points;
    for (std::size_t camera = 0; camera < this->Views.size(); ++camera)
    {
      std::vector<PointRecord> own = this->pointsOf(camera);
      points.insert(points.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
    }
    std::vector<std::string> names;
    for (const OtherView& view : this->Views)
    {
      names.push_back(view.view.name);
    }
    sink.document(0, pointsPly(points));
    sink.document(1, pointsText(this->Context.job.frame, names, points));
  }

private:
  /// Points of a camera's grid that no earlier camera sees.
  std::vector<PointRecord> pointsOf(std::size_t camera) const
  {
    const View& view = this->Views[camera].view;
    const PixelGrid grid(*view.model, this->Step);
    std::vector<std::vector<PointRecord>> rows(std::size_t(grid.rows()));
    grid.forSurfaces(this->Context.state, view, this->Context.queries, this->Context.pool,
      [&](int y, const SurfaceRows& surface)
      {
        for (int i = 0; i < surface.rect.width; ++i)
        {
          PointRecord point;
          const Eigen::Vector2d barycentrics(surface.barycentrics[2 * i], surface.barycentrics[2 * i + 1]);
          const Eigen::Vector2d pixel = grid.centre(surface.rect.x + i, y);
          if (std::isfinite(surface.t[i]) && this->track(camera, pixel, surface.hits[i], barycentrics, point))
          {
            describe(surface, view, surface.hits[i], barycentrics, point);
            rows[y].push_back(std::move(point));
          }
        }
      });
    std::vector<PointRecord> points;
    for (std::vector<PointRecord>& row : rows)
    {
      points.insert(points.end(), std::make_move_iterator(row.begin()), std::make_move_iterator(row.end()));
    }
    return points;
  }

  /// False when an earlier camera sees the point.
  bool track(std::size_t own, const Eigen::Vector2d& pixel, const Hit& hit, const Eigen::Vector2d& barycentrics,
    PointRecord& point) const
  {
    for (std::size_t camera = 0; camera < this->Views.size(); ++camera)
    {
      const auto index = static_cast<std::uint32_t>(camera);
      if (camera == own)
      {
        point.track.push_back({ index, pixel.x(), pixel.y() });
        continue;
      }
      const Correspondence seen = correspond(this->Views[camera], hit, barycentrics);
      if (seen.visibility == VisibilityClass::Visible)
      {
        if (camera < own)
        {
          return false;
        }
        point.track.push_back({ index, seen.pixel.x(), seen.pixel.y() });
      }
    }
    return true;
  }

  /// `in`: rows with the point, of the view's scene and pose at the time at which it is seen.
  static void describe(
    const SurfaceRows& in, const View& view, const Hit& hit, const Eigen::Vector2d& barycentrics, PointRecord& point)
  {
    const SceneState& state = *in.state;
    const Rigid3& camera_from_world = in.view->camera_from_world;
    point.x = carriedPoint(state, hit, barycentrics);
    point.object = state.objectOf(hit.object);
    point.triangle = state.instances[hit.object - 1].firstTriangle + hit.triangle;
    const std::array<std::uint8_t, 3> color = albedoAt(state.instances[hit.object - 1], hit.triangle, barycentrics);
    std::copy(color.begin(), color.end(), point.color);
    Eigen::Vector3d corners[3];
    triangleInWorld(state, hit, corners);
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    const Eigen::Vector3d x_in_camera = camera_from_world * point.x;
    Eigen::Vector2d pixel;
    view.model->project(x_in_camera, pixel);
    const Eigen::Vector3d direction = camera_from_world.rotation.transpose() * view.model->rayThrough(pixel).direction;
    point.normal = (normal.dot(direction) > 0 ? Eigen::Vector3d(-normal) : normal).cast<float>();
  }

  JobContext Context;
  int Step;
  std::shared_ptr<const OcclusionQuery> Occlusion;
  std::vector<OtherView> Views; ///< in the order of the cameras of the file
};

class PointsLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "points", { "ply" }, "point cloud fused over the cameras, and the pixels that see each point" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return {}; }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { pointsSpec(), format } };
  }
  std::vector<const OptionRow*> options() const override { return { &stepOption }; }
  /// The files of a frame belong to its first camera's job.
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    if (job.camera != plan.jobs.front().camera)
    {
      return {};
    }
    LayerOutput points = documentOutput(stage, job, pointsSpec(), planned.formats.front());
    points.path = WorkPlan::stem({}, points.layer, job.frame).substr(1); // of no camera
    LayerOutput tracks = points;
    tracks.formats = { "json" };
    return { points, tracks };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<PointsPass>(context);
  }
};
} // namespace

LayerList pointsLayers() { return { std::make_shared<PointsLayer>() }; }

} // namespace dgtk
