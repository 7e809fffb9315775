// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTrackSeeds.h"

#include "dgtkAlbedo.h"
#include "dgtkFolder.h"
#include "dgtkPixelGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int mostPixels = 1 << 20;
constexpr int mostFrames = 1 << 30;
constexpr int blockPoints = 512; ///< that one thread follows at once

const IntegerOption seedStep("tracks_step", 16, 1, mostPixels, "pixels between the samples of the tracks layer");
const IntegerOption everyOption(
  "tracks_every", 10, 1, mostFrames, "the tracks layer samples new points in the first of so many frames of the run");

/// Samples the views of a run in the order of its jobs.
class Sampler
{
public:
  Sampler(const JobContext& context, TrackSeeds& seeds, std::vector<TrackPoint>& described)
    : Context(context)
    , Seeds(seeds)
    , Described(described)
    , Step(seedStep.of(context.plan.request.options))
    , First(context.queries.stage().at(context.plan.jobs.front().frame))
    , Moving(context.queries.stage().movingObjects())
  {
  }

  void sample(const Job& job)
  {
    const LayerRequest& request = this->Context.plan.request;
    const SceneQueries::Moment moment = this->Context.queries.at(job.frame);
    const View view = this->Context.queries.stage().view(job.camera, job.frame, request.width, request.height);
    const PixelGrid grid(*view.model, this->Step);
    const std::vector<char> taken = this->takenOf(grid, { moment.state.get(), view, moment.occlusion.get() });
    std::vector<Found> rows(std::size_t(grid.rows()));
    grid.forSurfaces(moment.state, view, this->Context.queries, this->Context.pool,
      [&](int row, const SurfaceRows& surface)
      {
        for (int i = 0; i < surface.rect.width; ++i)
        {
          const int column = surface.rect.x + i;
          if (std::isfinite(surface.t[i]) && !taken[std::size_t(row) * grid.columns() + column])
          {
            const FixedPoint point{ surface.hits[i],
              { surface.barycentrics[2 * std::size_t(i)], surface.barycentrics[2 * std::size_t(i) + 1] } };
            rows[std::size_t(row)].add(
              point, { job, grid.centre(column, row) }, this->describe(*surface.state, view.name, job.frame, point));
          }
        }
      });
    for (Found& row : rows)
    {
      this->append(std::move(row));
    }
  }

private:
  struct Found
  {
    TrackSeeds seeds;
    std::vector<TrackPoint> described;
    void add(const FixedPoint& point, const TrackSeeds::Origin& origin, TrackPoint description)
    {
      this->seeds.points.push_back(point);
      this->seeds.origins.push_back(origin);
      this->described.push_back(std::move(description));
    }
  };

  /// Pixels of the grid, row by row, that have a point within half a step already.
  std::vector<char> takenOf(const PixelGrid& grid, const OtherView& view) const
  {
    std::vector<char> taken(std::size_t(grid.columns()) * std::size_t(grid.rows()), 0);
    std::vector<Correspondence> places;
    followPoints(view, this->Seeds.points, this->Context.pool, places);
    for (const Correspondence& place : places)
    {
      if (place.visibility != VisibilityClass::Visible)
      {
        continue;
      }
      grid.forNear(place.pixel,
        [&](int column, int row) { taken[std::size_t(row) * std::size_t(grid.columns()) + std::size_t(column)] = 1; });
    }
    return taken;
  }

  /// `state`: of the time at which the point is seen.
  TrackPoint describe(const SceneState& state, const std::string& camera, int frame, const FixedPoint& point) const
  {
    TrackPoint track;
    track.object = state.objectOf(point.hit.object);
    track.triangle = state.instances[point.hit.object - 1].firstTriangle + point.hit.triangle;
    track.barycentric = { 1 - point.barycentrics.sum(), point.barycentrics.x(), point.barycentrics.y() };
    track.x = carriedPoint(*this->First, point.hit, point.barycentrics);
    const std::array<std::uint8_t, 3> color =
      albedoAt(state.instances[point.hit.object - 1], point.hit.triangle, point.barycentrics);
    std::copy(color.begin(), color.end(), track.color);
    track.isStatic = !this->Moving[track.object - 1];
    track.camera = camera;
    track.frame = frame;
    return track;
  }

  void append(Found row)
  {
    const auto move = [](auto& from, auto& to)
    { to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end())); };
    move(row.seeds.points, this->Seeds.points);
    move(row.seeds.origins, this->Seeds.origins);
    move(row.described, this->Described);
  }

  const JobContext& Context;
  TrackSeeds& Seeds;
  std::vector<TrackPoint>& Described;
  int Step;
  std::shared_ptr<const SceneState> First; ///< at the first frame of the run
  std::vector<bool> Moving;
};

/// The views of a run that are sampled: those of its first and every k-th frame.
std::vector<Job> sampledJobs(const WorkPlan& plan)
{
  const int every = everyOption.of(plan.request.options);
  std::vector<Job> jobs;
  int frames = 0;
  for (std::size_t i = 0; i < plan.jobs.size(); ++i)
  {
    frames += i > 0 && plan.jobs[i].frame != plan.jobs[i - 1].frame ? 1 : 0;
    if (frames % every == 0)
    {
      jobs.push_back(plan.jobs[i]);
    }
  }
  return jobs;
}
} // namespace

const IntegerOption& tracksStep() { return seedStep; }

const IntegerOption& tracksEvery() { return everyOption; }

void followPoints(
  const OtherView& view, const std::vector<FixedPoint>& points, ThreadPool& pool, std::vector<Correspondence>& places)
{
  places.resize(points.size());
  pool.parallelFor(static_cast<int>((points.size() + blockPoints - 1) / blockPoints),
    [&](int block)
    {
      const std::size_t first = std::size_t(block) * blockPoints;
      const std::size_t count = std::min<std::size_t>(blockPoints, points.size() - first);
      correspondPoints(view, points.data() + first, count, places.data() + first);
    });
}

const TrackSeeds& TrackRun::seeds(const JobContext& context)
{
  std::call_once(this->Once,
    [&]
    {
      TrackSeeds seeds;
      std::vector<TrackPoint> described;
      Sampler sampler(context, seeds, described);
      for (const Job& job : sampledJobs(context.plan))
      {
        sampler.sample(job);
      }
      const std::string folder = this->Place.folder();
      Folder(folder).makeParents(trackPointsFile);
      this->Place.announce(trackPointsFile);
      const DatasetFile file = writeDocument(folder, trackPointsFile, tracksText(described));
      this->File = { file.path, file.bytes, file.sha256 };
      this->Seeds = std::move(seeds);
    });
  return this->Seeds;
}

} // namespace dgtk
