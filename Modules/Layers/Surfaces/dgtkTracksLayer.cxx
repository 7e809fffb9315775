// SPDX-License-Identifier: BSD-3-Clause
// The layer of all views of a run: surface points followed through all of them.
#include "dgtkTrackSeeds.h"

namespace dgtk
{

namespace
{
LayerSpec tracksSpec()
{
  return { "tracks", PixelType::Float64, 3, "pixels, class", "image", "u, v nan",
    "for each point of tracks/points.json where it is in the view, u and v, and its visibility class: 0 its object is "
    "not there, 1 visible, 2 occluded by another object, 3 occluded by its own object, 4 outside the image, 5 behind "
    "the camera",
    Meaning::Record };
}

TrackPlace placeOf(const Correspondence& found)
{
  const bool nowhere = found.visibility == VisibilityClass::NoSurface || found.visibility == VisibilityClass::Behind;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return { nowhere ? none : found.pixel.x(), nowhere ? none : found.pixel.y(), double(found.visibility) };
}

/// Needs no pixels.
class TracksPass : public LayerPass
{
public:
  TracksPass(const JobContext& context, std::shared_ptr<TrackRun> run)
    : Context(context)
    , Run(std::move(run))
    , Seeds(Run->seeds(context))
  {
  }

  void finish(LayerSink& sink) override
  {
    const SceneQueries::Moment moment = this->Context.queries.at(this->Context.job.frame);
    std::vector<Correspondence> found;
    followPoints({ moment.state.get(), this->Context.view, moment.occlusion.get() }, this->Seeds.points,
      this->Context.pool, found);
    std::vector<TrackPlace> places;
    places.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const TrackSeeds::Origin& origin = this->Seeds.origins[i];
      const Job& own = this->Context.job;
      const bool isOrigin = origin.view.camera == own.camera && origin.view.frame == own.frame;
      places.push_back(placeOf(isOrigin ? Correspondence{ origin.pixel, VisibilityClass::Visible } : found[i]));
    }
    sink.shared("tracks", this->Run->file());
    sink.document(0, trackPlacesNpy(places));
  }

private:
  JobContext Context;
  std::shared_ptr<TrackRun> Run;
  const TrackSeeds& Seeds;
};

class TracksLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "tracks", { "npy" }, "surface points followed through all views of the run, and their visibility", false,
      "its points are those of a run of views" };
  }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return {}; }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { tracksSpec(), format } };
  }
  std::vector<const OptionRow*> options() const override { return { &tracksStep(), &tracksEvery() }; }
  std::vector<LayerOutput> outputs(
    const WorkPlan&, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { documentOutput(stage, job, tracksSpec(), planned.formats.front()) };
  }
  std::shared_ptr<void> makeShared(const SharedPlace& place) const override
  {
    return std::make_shared<TrackRun>(place);
  }
  std::vector<std::string> sharedFiles(const std::string&) const override { return { trackPointsFile }; }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    return std::make_unique<TracksPass>(context, std::static_pointer_cast<TrackRun>(layers.front().planned.shared));
  }
};
} // namespace

LayerList tracksLayers() { return { std::make_shared<TracksLayer>() }; }

} // namespace dgtk
