// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveMatch.h"

#include "dgtkEpipolarLine.h"
#include "dgtkError.h"
#include "dgtkSurfaceRows.h"

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
  match.worldFrom = carriedPoint(*now.state, match.hit, point.barycentrics);
  match.worldTo = carriedPoint(*then.state, match.hit, point.barycentrics);
  match.depthFrom = point.t;
  match.depthTo = (to.view.camera_from_world * match.worldTo).z();
  if (match.to.visibility == VisibilityClass::OccludedByOther || match.to.visibility == VisibilityClass::OccludedByOwn)
  {
    const Hit before = then.occlusion->occluder(to.view, match.worldTo, match.hit);
    match.occluder = before.object != 0 ? then.state->instances[before.object - 1].name : std::string();
  }
}
} // namespace

LiveMatch liveMatch(const LiveScene& scene, const MatchView& from, const Eigen::Vector2d& pixel, const MatchView& to)
{
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
