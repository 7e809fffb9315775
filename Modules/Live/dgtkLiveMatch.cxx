// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveMatch.h"

#include "dgtkEpipolarLine.h"
#include "dgtkError.h"
#include "dgtkSeenInTime.h"
#include "dgtkSurfaceRows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
void describe(LiveMatch& match, const LiveScene::Moment& now, const LiveScene::Moment& then, const MatchView& from,
  const MatchView& to)
{
  const Instance& instance = now.state->instances[match.hit.object - 1];
  match.object = instance.name;
  match.part = instance.model->partOf(match.hit.triangle);
  match.triangle = match.hit.triangle - instance.model->parts[match.part].firstTriangle;
  const SurfacePoint point = surfacePointAt(*now.state, from.view, match.from, match.hit);
  const Eigen::Vector2d& weights = point.barycentrics;
  match.worldFrom = from.view.instants ? carriedPoint(*instantOf(from.view, from.view.model->timeAt(match.from)).state,
                                           match.hit, weights)
                                       : carriedPoint(*now.state, match.hit, weights);
  const SeenInTime seen = to.view.instants ? seenInTime(to.view, match.hit, weights) : SeenInTime{};
  match.worldTo = to.view.instants ? seen.x_in_world : carriedPoint(*then.state, match.hit, weights);
  match.depthFrom = point.t;
  match.depthTo = to.view.instants ? seen.x_in_camera.z() : (to.view.camera_from_world * match.worldTo).z();
  if (match.to.visibility == VisibilityClass::OccludedByOther || match.to.visibility == VisibilityClass::OccludedByOwn)
  {
    Hit before;
    if (to.view.instants)
    {
      then.occlusion->occludersAt(to.view, &seen.frame, &match.worldTo, &match.hit, 1, &before);
    }
    else
    {
      before = then.occlusion->occluder(to.view, match.worldTo, match.hit);
    }
    match.occluder = before.object != 0 ? then.state->instances[before.object - 1].name : std::string();
  }
}
} // namespace

namespace
{
/// A rolling shutter's view with what it sees at which time.
MatchView inTime(const LiveScene& scene, const MatchView& place)
{
  if (place.view.instants || !place.view.model->rolls())
  {
    return place;
  }
  const std::vector<std::string> names = scene.stage()->cameraNames();
  const auto camera = static_cast<std::size_t>(std::find(names.begin(), names.end(), place.view.name) - names.begin());
  const CameraModel& model = *place.view.model;
  return { scene.stage()->view(camera, place.frame, model.width(), model.height()), place.frame };
}
} // namespace

LiveMatch liveMatch(
  const LiveScene& scene, const MatchView& fromPlace, const Eigen::Vector2d& pixel, const MatchView& toPlace)
{
  const MatchView from = inTime(scene, fromPlace);
  const MatchView to = inTime(scene, toPlace);
  const CameraModel& model = *from.view.model;
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= model.width() && pixel.y() <= model.height()))
  {
    throw UsageError("the point is outside the image");
  }
  const LiveScene::Moment now = scene.at(from.frame);
  const LiveScene::Moment then = scene.at(to.frame);
  LiveMatch match;
  match.from = pixel;
  match.to = correspondPixel(
    *now.state, from.view, *now.occlusion, pixel, { then.state.get(), to.view, then.occlusion.get() }, &match.hit);
  match.line = epipolarLine(from.view, pixel, to.view);
  match.lineDistance = match.line && match.to.pixel.allFinite()
                         ? std::abs(match.line->head<2>().dot(match.to.pixel) + match.line->z())
                         : std::numeric_limits<double>::quiet_NaN();
  if (match.hit.object != 0)
  {
    describe(match, now, then, from, to);
  }
  return match;
}

} // namespace dgtk
