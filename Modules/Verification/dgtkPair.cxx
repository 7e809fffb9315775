// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPair.h"

#include "dgtkError.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace dgtk
{

namespace
{
/// Part by which K, rotation and displacement of a rectified pair may differ.
constexpr double rectifiedTolerance = 1e-9;

double roundingBetween(const Eye& a, const Eye& b)
{
  return 4 * std::numeric_limits<double>::epsilon() * (a.record().t.norm() + b.record().t.norm());
}

/// Displacement of camera b along the x axis of camera a; 0 unless they differ in nothing else but cx.
double rectifiedBaseline(const Eye& a, const Eye& b)
{
  if (!a.pinhole() || !b.pinhole() || a.width() != b.width() || a.height() != b.height())
  {
    return 0;
  }
  Eigen::Matrix3d K = a.record().K - b.record().K;
  K(0, 2) = 0;
  const Eigen::Vector3d centre = a.toCamera(b.toWorld(Eigen::Vector3d::Zero()));
  const double rounding = roundingBetween(a, b);
  const bool same = K.cwiseAbs().maxCoeff() <= rectifiedTolerance * a.record().K(0, 0) &&
                    (a.record().R - b.record().R).cwiseAbs().maxCoeff() <= rectifiedTolerance &&
                    std::abs(centre.x()) > rounding &&
                    centre.tail<2>().cwiseAbs().maxCoeff() <= rectifiedTolerance * std::abs(centre.x()) + rounding;
  return same ? centre.x() : 0;
}

/// The nearest of some cameras that is a rectified pair with the picture's, the first of several.
std::optional<Pair> nearestPair(Picture& picture, const std::vector<std::string>& cameras)
{
  Dataset& dataset = picture.dataset();
  std::optional<Pair> best;
  double nearest = 0;
  for (const std::string& name : cameras)
  {
    const std::optional<Eye> eye =
      name == picture.camera() ? std::nullopt : dataset.eye(name, picture.frame(), picture.eye().record());
    const double baseline = eye ? rectifiedBaseline(picture.eye(), *eye) : 0;
    if (baseline != 0 &&
        (!best || std::abs(baseline) < nearest * (1 - rectifiedTolerance) - 2 * roundingBetween(picture.eye(), *eye)))
    {
      nearest = std::abs(baseline);
      best = Pair{ "disparity", baseline > 0 ? PairKind::FromLeft : PairKind::FromRight, name, picture.frame(), nullptr,
        true };
    }
  }
  return best;
}

/// One that the dataset shows, where there is one.
std::optional<Pair> disparityPair(Picture& picture)
{
  std::vector<std::string> all = picture.dataset().stage().cameraNames();
  std::sort(all.begin(), all.end());
  std::vector<std::string> shown;
  std::copy_if(all.begin(), all.end(), std::back_inserter(shown),
    [&](const std::string& name) { return picture.dataset().camera(name, picture.frame()) != nullptr; });
  const std::optional<Pair> best = nearestPair(picture, shown);
  return best ? best : nearestPair(picture, all);
}

int stepOf(const std::string& layer) { return layer.find("_forward") != std::string::npos ? 1 : -1; }

/// The pair of `disparity`, where it still is one at the neighbouring frame.
std::optional<Pair> movedDisparityPair(Picture& picture, const std::string& layer)
{
  Dataset& dataset = picture.dataset();
  std::optional<Pair> pair = disparityPair(picture);
  const int frame = picture.frame() + stepOf(layer);
  if (!pair || !dataset.hasFrame(frame))
  {
    return std::nullopt;
  }
  const std::optional<Eye> own = dataset.eye(picture.camera(), frame, picture.eye().record());
  const std::optional<Eye> other = dataset.eye(pair->camera, frame, picture.eye().record());
  const double baseline = own && other ? rectifiedBaseline(*own, *other) : 0;
  if (baseline == 0 || (baseline > 0) != (pair->kind == PairKind::FromLeft))
  {
    return std::nullopt;
  }
  pair->layer = layer;
  pair->frame = frame;
  pair->sameFrame = false;
  pair->ownThen = dataset.timedSight(*own, frame)->middle();
  return pair;
}

/// correspondence_<camera>, or with +N or -N frames where no camera has the whole name.
std::optional<Pair> correspondencePair(Picture& picture, const std::string& layer)
{
  const std::vector<std::string>& names = picture.dataset().stage().cameraNames();
  const auto isCamera = [&](const std::string& name)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  const std::string rest = layer.substr(std::string("correspondence_").size());
  if (isCamera(rest))
  {
    return Pair{ layer, PairKind::Place, rest, picture.frame(), nullptr, true };
  }
  const std::size_t sign = rest.find_last_of("+-");
  if (sign == std::string::npos || !isCamera(rest.substr(0, sign)))
  {
    return std::nullopt;
  }
  int offset = 0;
  const char* const end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data() + sign + (rest[sign] == '+' ? 1 : 0), end, offset);
  if (error != std::errc() || stop != end)
  {
    return std::nullopt;
  }
  return Pair{ layer, PairKind::Place, rest.substr(0, sign), picture.frame() + offset, nullptr, offset == 0 };
}

std::optional<Pair> pairOf(Picture& picture, const std::string& layer)
{
  if (layer == "flow_forward" || layer == "flow_backward")
  {
    return Pair{ layer, PairKind::Displacement, picture.camera(), picture.frame() + stepOf(layer), nullptr, false };
  }
  if (layer == "sceneflow")
  {
    return Pair{ layer, PairKind::Motion, picture.camera(), picture.frame() + 1, nullptr, false };
  }
  if (layer == "disparity")
  {
    return disparityPair(picture);
  }
  if (layer == "disparity_forward" || layer == "disparity_backward")
  {
    return movedDisparityPair(picture, layer);
  }
  if (layer.compare(0, 15, "correspondence_") == 0)
  {
    return correspondencePair(picture, layer);
  }
  return std::nullopt;
}

bool isPairLayer(const std::string& layer)
{
  return layer == "flow_forward" || layer == "flow_backward" || layer == "sceneflow" || layer == "disparity" ||
         layer == "disparity_forward" || layer == "disparity_backward" || layer.compare(0, 15, "correspondence_") == 0;
}
} // namespace

std::vector<Pair> pairsOf(Picture& picture)
{
  Dataset& dataset = picture.dataset();
  std::vector<Pair> pairs;
  for (const std::string& layer : dataset.layers(picture.camera(), picture.frame()))
  {
    if (!isPairLayer(layer))
    {
      continue;
    }
    std::optional<Pair> pair = pairOf(picture, layer);
    const std::optional<Eye> eye = pair && dataset.hasFrame(pair->frame)
                                     ? dataset.eye(pair->camera, pair->frame, picture.eye().record())
                                     : std::nullopt;
    if (!eye)
    {
      const std::vector<std::string> suffixes = dataset.suffixes(picture.camera(), layer, picture.frame());
      throw InputError(dataset.absolute(dataset.find(picture.camera(), layer, picture.frame(), suffixes)),
        "there is no other view for layer " + quoted(layer) + " in the scene");
    }
    pair->timed = dataset.timedSight(*eye, pair->frame);
    pair->other = pair->timed->middle();
    pairs.push_back(*pair);
  }
  return pairs;
}

PicturePointer pairValues(Picture& picture, const Pair& pair)
{
  return picture.image(pair.layer, { ".npy", ".flo", ".pfm", ".exr" });
}

PicturePointer pairClasses(Picture& picture, const Pair& pair) { return picture.image(pair.layer, { ".png" }); }

PairTargets::PairTargets(Picture& picture, const Pair& pair)
  : Owner(picture)
  , Seen(picture.surfaces())
  , ThePair(pair)
  , Values(pair.timed->rolls() && pair.kind != PairKind::Motion
             ? picture.quietly([&] { return pairValues(picture, pair); })
             : nullptr)
{
  picture.preparePoints();
}

/// When a rolling shutter sees the point: near the time of the place that the file claims, else of the picture's own.
/// Where that does not settle, the place must at least be its own answer. False where it is seen at no time.
bool PairTargets::findTime(int x, int y, const Hit& hit, Target& target) const
{
  const TimedSight& other = *this->ThePair.timed;
  const Eigen::Vector2d value = this->Values ? this->Values->at2(x, y) : Eigen::Vector2d(std::nan(""), 0);
  const Eigen::Vector2d place = this->ThePair.kind == PairKind::Place ? value : centreOf(x, y) + value;
  target.time = place.allFinite() ? other.timeAt(place) : 0;
  const auto weights = this->Owner.sight(x, y).weights(hit, target.here);
  target.timed = other.findTime(hit, weights, target.time);
  if (!target.timed && place.allFinite())
  {
    const Eigen::Vector2d rounding(this->Values->rounding(value.x()), this->Values->rounding(value.y()));
    const double claimed = std::abs(other.timeAt(place + rounding) - other.timeAt(place - rounding));
    target.slack = other.timeSlack(hit, weights, target.time, claimed);
  }
  return target.timed || place.allFinite();
}

Target PairTargets::at(int x, int y, const Hit& hit) const
{
  Target target;
  target.surface = hit.object != 0;
  if (!target.surface)
  {
    return target;
  }
  target.here = this->Owner.point(x, y);
  const TimedSight& other = *this->ThePair.timed;
  const bool seen = !other.rolls() || this->findTime(x, y, hit, target);
  const Carried there =
    other.rolls() ? carried(this->Owner.sight(x, y), other.instanceAt(target.time, hit.object), hit, target.here)
                  : carried(this->Owner.sight(x, y), other.middle()->instance(hit.object), hit, target.here);
  target.ok = there.ok;
  target.world = there.x_in_world;
  const auto project = [&](const Eye& eye)
  {
    target.there = eye.toCamera(there.x_in_world);
    target.projects = seen && eye.project(target.there, target.pixel);
  };
  project(other.rolls() ? other.eyeAt(target.time) : other.middle()->eye());
  return target;
}

double PairTargets::moves(int x, int y, const Hit& hit, const Target& target) const
{
  const TimedSight& other = *this->ThePair.timed;
  if (!other.rolls() || !target.timed)
  {
    return 0;
  }
  const auto weights = this->Owner.sight(x, y).weights(hit, target.here);
  return this->ThePair.kind == PairKind::Motion ? other.pointSlack(hit, weights, target.time)
                                                : other.timeSlack(hit, weights, target.time, 0);
}

} // namespace dgtk
