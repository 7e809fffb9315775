// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkError.h"
#include "dgtkSeenPoint.h"
#include "dgtkSurfaceColor.h"
#include "dgtkTrackSamples.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace dgtk
{

namespace
{
/// Pixels; a ground plane of 1e5 needs 1e-9.
constexpr double seenTolerance = 1e-8;
/// Part of a point's distance from the world's origin, and of 1 of its weights.
constexpr double pointTolerance = 1e-9;

/// A number of the request; `fallback` where it does not say.
int numberOf(const Manifest& manifest, const std::string& name, int fallback)
{
  for (const auto& [key, text] : manifest.request)
  {
    int value = 0;
    if (key == name && std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc() && value > 0)
    {
      return value;
    }
  }
  return fallback;
}

/// The views of a run, in its order.
std::vector<CameraRecord> viewsOf(const Dataset& dataset)
{
  std::vector<CameraRecord> records = dataset.cameras();
  std::stable_sort(records.begin(), records.end(),
    [&](const CameraRecord& a, const CameraRecord& b)
    { return std::pair(a.frame, dataset.cameraIndex(a.name)) < std::pair(b.frame, dataset.cameraIndex(b.name)); });
  return records;
}

/// Whether something in the scene's description may move or deform an object.
bool mayMove(const SceneDescription& scene, const Instance& instance)
{
  std::string name = instance.name;
  bool moves = instance.model->deformation && !instance.model->animations.empty();
  for (std::size_t depth = 0; !name.empty() && depth <= scene.objects.size(); ++depth)
  {
    const auto object = std::find_if(
      scene.objects.begin(), scene.objects.end(), [&](const ObjectDescription& one) { return one.name == name; });
    if (object == scene.objects.end())
    {
      break;
    }
    moves = moves || object->position.animated() || object->orientation.animated() || object->scale.animated();
    name = object->parent;
  }
  return moves;
}

class TracksCheck
{
public:
  TracksCheck(Dataset& dataset, std::string file)
    : Owner(dataset)
    , File(std::move(file))
    , Points(readTrackPoints(dataset.absolute(this->File)))
    , Views(viewsOf(dataset))
    , First(Views.empty() ? nullptr : dataset.state(Views.front().frame))
  {
    std::map<std::pair<std::string, int>, int> index;
    for (const CameraRecord& record : this->Views)
    {
      index.emplace(std::pair(record.name, record.frame), static_cast<int>(index.size()));
    }
    for (const TrackPoint& point : this->Points)
    {
      const auto view = index.find({ point.camera, point.frame });
      this->Origins.push_back({ { point.object, point.triangle }, view == index.end() ? -1 : view->second });
    }
  }

  const std::vector<CameraRecord>& views() const { return this->Views; }
  int count() const { return static_cast<int>(this->Points.size()); }
  const std::vector<TrackOrigin>& origins() const { return this->Origins; }

  bool isSound(std::size_t i) const
  {
    const Hit& hit = this->Origins[i].hit;
    return this->Origins[i].view >= 0 && this->First && hit.object > 0 && hit.object <= this->First->instances.size() &&
           hit.triangle < this->First->instances[hit.object - 1].model->triangles.size();
  }

  /// The weights are those of a point of the triangle, which is at x at the first frame.
  void point(std::size_t i, Meter& meter) const
  {
    const TrackPoint& point = this->Points[i];
    if (!this->isSound(i))
    {
      meter.equal(
        false, [&] { return this->offender(i, "an unknown object, triangle, camera or frame", "known ones"); });
      return;
    }
    const Eigen::Vector3d& weights = point.barycentric;
    meter.add(std::max(std::abs(weights.sum() - 1), -weights.minCoeff()),
      [&] { return this->offender(i, "barycentric " + numbersText(weights.data(), 3), "weights of sum 1"); });
    const Eigen::Vector3d expected = pointOf(this->First->instances[point.object - 1], this->Origins[i].hit, weights);
    meter.add((point.x - expected).norm() / std::max(expected.norm(), std::numeric_limits<double>::min()),
      [&] { return this->offender(i, numbersText(point.x.data(), 3), numbersText(expected.data(), 3)); });
  }

  /// What is said to be static is where it was, and nothing else may move.
  void statics(const SceneState& state, Meter& meter) const
  {
    std::map<std::uint32_t, bool> moving;
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      if (!this->isSound(i))
      {
        continue;
      }
      const std::uint32_t object = this->Points[i].object;
      const auto known = moving.find(object);
      const bool moves =
        known != moving.end() ? known->second : moving.emplace(object, this->moves(state, object)).first->second;
      meter.equal(this->Points[i].isStatic == !moves,
        [&]
        {
          return this->offender(i, this->Points[i].isStatic ? "static" : "not static",
            moves ? "an object that moves or deforms" : "an object that does neither");
        });
    }
  }

  void view(const TrackView& view, Results& results) const
  {
    const auto measure = [&](double tolerance, void (TracksCheck::*body)(const TrackView&, std::size_t, Meter&) const)
    {
      return meterRows(this->Owner.pool(), this->count(), tolerance,
        [&](int i, Meter& meter) { (this->*body)(view, static_cast<std::size_t>(i), meter); });
    };
    results.add({ "places", "pixel", { view.file } }, measure(seenTolerance, &TracksCheck::place));
    results.add({ "classes", "", { view.file } }, measure(0, &TracksCheck::visibility));
    results.add({ "colors", "1/255", { this->File } }, measure(colorTolerance, &TracksCheck::color));
  }

private:
  bool moves(const SceneState& state, std::uint32_t object) const
  {
    const Instance& before = this->First->instances[object - 1];
    const Instance& now = state.instances[object - 1];
    const bool moved = before.world_from_object.linear != now.world_from_object.linear ||
                       before.world_from_object.translation != now.world_from_object.translation ||
                       before.geometry->positions != now.geometry->positions;
    return moved || mayMove(this->Owner.stage().description(), now);
  }

  /// A point as a view sees it, at the time at which it does.
  struct Look
  {
    SeenPoint point;
    double time = 0;
    bool settled = true; ///< that time is known
  };

  Look lookOf(const TrackView& view, std::size_t i) const
  {
    const TimedSight& timed = *view.sight;
    const TrackPlace& place = view.places[i];
    const bool claims = std::isfinite(place.u) && std::isfinite(place.v);
    Look look;
    look.point.hit = this->Origins[i].hit;
    look.time = claims ? timed.timeAt({ place.u, place.v }) : 0;
    look.settled = timed.findTime(look.point.hit, this->Points[i].barycentric, look.time);
    const Eye eye = timed.eyeAt(look.time);
    look.point.x_in_camera = eye.toCamera(timed.pointAt(look.time, look.point.hit, this->Points[i].barycentric));
    look.point.projects = (look.settled || claims) && eye.project(look.point.x_in_camera, look.point.pixel);
    // What a rolling shutter sees at no time has no time at which it might be visible.
    const bool never = !look.point.projects && timed.rolls();
    look.point.gone = !never && !this->isThere(timed, look.time, look.point.hit.object);
    return look;
  }

  static bool isThere(const TimedSight& timed, double time, std::uint32_t object)
  {
    return timed.rolls() ? timed.instanceAt(time, object).visible : timed.middle()->instance(object).visible;
  }

  void place(const TrackView& view, std::size_t i, Meter& meter) const
  {
    if (!this->isSound(i))
    {
      return;
    }
    const TrackPlace& place = view.places[i];
    const Look look = this->lookOf(view, i);
    const Eye& eye = view.sight->middle()->eye();
    const bool none = look.point.gone || !look.point.projects;
    const auto where = [&]
    {
      const double found[2] = { place.u, place.v };
      const std::string expected = none ? "nan" : numbersText(look.point.pixel.data(), 2);
      return this->offender(view, i, numbersText(found, 2), expected);
    };
    if (none)
    {
      const bool open = !look.settled || isAtPlane(look.point);
      const bool right = std::isnan(place.u) && std::isnan(place.v);
      right || !open ? meter.equal(right, where) : meter.skip();
      return;
    }
    Eigen::Vector2d difference = (Eigen::Vector2d(place.u, place.v) - look.point.pixel).cwiseAbs();
    const double seam = eye.lens() != nullptr ? eye.lens()->seam(look.point.pixel) : 0;
    difference.x() = std::min(difference.x(), std::abs(difference.x() - seam));
    const double beside = look.point.pixel.cwiseAbs().maxCoeff() / std::max(eye.width(), eye.height());
    const double error = std::isnan(difference.sum()) ? infinite : difference.norm();
    if (error == infinite && isAtPlane(look.point))
    {
      meter.skip();
      return;
    }
    meter.add(error / std::max(1.0, beside * beside) / eye.farness(look.point.x_in_camera), where);
  }

  /// As near to the camera's plane, whether a point projects is a matter of rounding.
  static bool isAtPlane(const SeenPoint& point)
  {
    return std::abs(point.x_in_camera.z()) <= seenSlack * point.x_in_camera.norm();
  }

  void visibility(const TrackView& view, std::size_t i, Meter& meter) const
  {
    const bool timed = view.sight->rolls();
    if (!this->isSound(i) || (timed && (i + std::size_t(view.index)) % trackInstantStep != 0))
    {
      return;
    }
    const double found = view.places[i].visibility;
    const Look look = this->lookOf(view, i);
    const std::shared_ptr<const Sight> sight = timed ? view.sight->at(look.time) : view.sight->middle();
    const int expected = classOf(*sight, look.point);
    const bool whole = found == std::floor(found) && found >= 0 && found <= BehindSeen;
    if (found != expected && whole && meter.Bad < usualPatience &&
        (!look.settled || isAtPlane(look.point) || isOpenClass(*sight, look.point, int(found))))
    {
      meter.skip();
      return;
    }
    meter.equal(found == expected,
      [&] { return this->offender(view, i, "class " + numberText(found), std::to_string(expected)); });
  }

  /// Of the view's own points.
  void color(const TrackView& view, std::size_t i, Meter& meter) const
  {
    if (!this->isSound(i) || this->Origins[i].view != view.index)
    {
      return;
    }
    const TrackPlace& place = view.places[i];
    const double time = std::isfinite(place.u) ? view.sight->timeAt({ place.u, place.v }) : 0;
    const auto where = [&](const std::string& found, const std::string& expected)
    { return this->offender(i, "colour " + found, expected); };
    meterColor(view.sight->instanceAt(time, this->Points[i].object), this->Origins[i].hit, this->Points[i].barycentric,
      this->Points[i].color, where, meter);
  }

  Offender offender(std::size_t i, const std::string& found, const std::string& expected) const
  {
    return { this->File, -1, -1, "point " + std::to_string(i) + ' ' + found, expected };
  }
  static Offender offender(const TrackView& view, std::size_t i, const std::string& found, const std::string& expected)
  {
    return { view.file, -1, -1, "point " + std::to_string(i) + ' ' + found, expected };
  }

  Dataset& Owner;
  std::string File;
  std::vector<TrackPoint> Points;
  std::vector<CameraRecord> Views;
  std::shared_ptr<const SceneState> First; ///< at the first frame of the run
  std::vector<TrackOrigin> Origins;
};

/// One view after the other: their places are as many as the points.
void checkViews(Dataset& dataset, const TracksCheck& check, const std::string& file, Results& results)
{
  const int step = numberOf(dataset.manifest(), "tracks_step", 16);
  const int every = numberOf(dataset.manifest(), "tracks_every", 10);
  int frames = -1;
  int last = 0;
  TrackView view;
  for (const CameraRecord& record : check.views())
  {
    if (frames < 0 || record.frame != last)
    {
      ++frames;
      last = record.frame;
      Meter statics(0);
      check.statics(*dataset.state(record.frame), statics);
      results.add({ "static", "", { file } }, statics);
    }
    view.file = dataset.find(record.name, "tracks", record.frame, { ".npy" });
    if (view.file.empty())
    {
      throw InputError(dataset.absolute(file), "has no places",
        "those of camera " + quoted(record.name) + " at frame " + std::to_string(record.frame));
    }
    view.sampled = frames % every == 0;
    view.sight = dataset.timedSight(Eye(record, dataset.sceneView(record).model), record.frame);
    view.places = readTrackPlaces(dataset.absolute(view.file), std::size_t(check.count()));
    check.view(view, results);
    results.add({ "samples", "", { view.file, file } }, meterTrackSamples(dataset, view, check.origins(), step));
    ++view.index;
  }
}
} // namespace

void checkTracks(Dataset& dataset, Results& results)
{
  const std::vector<DatasetFile>& files = dataset.manifest().files;
  const std::string file = trackPointsFile;
  if (std::none_of(files.begin(), files.end(), [&](const DatasetFile& one) { return one.path == file; }))
  {
    return;
  }
  const TracksCheck check(dataset, file);
  results.add({ "points", "relative", { file } },
    meterRows(dataset.pool(), check.count(), pointTolerance,
      [&](int i, Meter& meter) { check.point(static_cast<std::size_t>(i), meter); }));
  checkViews(dataset, check, file, results);
}

} // namespace dgtk
