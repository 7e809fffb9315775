// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkObjectDocuments.h"
#include "dgtkSeenPoint.h"
#include "dgtkSurfaceColor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace dgtk
{

namespace
{
/// Pixels: places are taken from points in the world, whose rounding grows with the distance from its origin; a ground
/// plane of 1e5 needs 1e-9.
constexpr double trackTolerance = 1e-8;
/// Part of the depth.
constexpr double surfaceTolerance = 1e-9;
constexpr std::size_t plyVertexBytes = 47;
constexpr const char* plyProperties =
  "\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny\nproperty float nz"
  "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uint object\nproperty uint triangle";
/// One rounding of float32.
constexpr double normalTolerance = 1e-7;

struct SeenTrack
{
  std::size_t camera = 0;
  Eigen::Vector2d pixel{ 0, 0 };
};
struct CloudPoint
{
  Eigen::Vector3d x{ 0, 0, 0 };
  Hit hit;
  std::vector<SeenTrack> track;
};

std::vector<CloudPoint> cloudOf(const TrackedPoints& file)
{
  std::vector<CloudPoint> points;
  for (const PointRecord& record : file.points)
  {
    CloudPoint point;
    point.x = record.x;
    point.hit = { record.object, record.triangle };
    for (const PointRecord::Sight& sight : record.track)
    {
      point.track.push_back({ sight.camera, { sight.u, sight.v } });
    }
    points.push_back(point);
  }
  return points;
}

class CloudCheck
{
public:
  CloudCheck(Dataset& dataset, std::string file, int frame, const TrackedPoints& points)
    : File(std::move(file))
    , Points(cloudOf(points))
  {
    if (points.frame != frame ||
        std::set<std::string>(points.cameras.begin(), points.cameras.end()).size() != points.cameras.size())
    {
      throw InputError(dataset.absolute(this->File), "is of another frame, or names a camera twice");
    }
    for (const std::string& camera : points.cameras)
    {
      const CameraRecord* record = dataset.camera(camera, frame);
      if (!record)
      {
        throw InputError(dataset.absolute(this->File), "names a camera that cameras.json lacks", {}, quoted(camera));
      }
      this->Sights.push_back(dataset.timedSight(Eye(*record, dataset.sceneView(*record).model), frame));
      this->Rolls = this->Rolls || this->Sights.back()->rolls();
    }
  }
  const std::vector<CloudPoint>& points() const { return this->Points; }

  bool isSound(const CloudPoint& point) const
  {
    if (this->Sights.empty() || point.hit.object == 0 ||
        point.hit.object > this->Sights[0]->middle()->state().instances.size() ||
        point.hit.triangle >= this->Sights[0]->middle()->instance(point.hit.object).model->triangles.size() ||
        std::adjacent_find(point.track.begin(), point.track.end(),
          [](const SeenTrack& a, const SeenTrack& b) { return a.camera >= b.camera; }) != point.track.end() ||
        point.track.empty())
    {
      return false;
    }
    return std::all_of(
      point.track.begin(), point.track.end(), [&](const SeenTrack& t) { return t.camera < this->Sights.size(); });
  }

  /// The point projects where the track says; the first place is a pixel's centre on the point's triangle.
  void reproject(std::size_t index, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    if (!this->isSound(point))
    {
      meter.equal(false, [&] { return this->offender(index, "an unknown object, triangle or camera", "known ones"); });
      return;
    }
    for (const SeenTrack& track : point.track)
    {
      const Look look = this->lookOf(point, track);
      const Eye& eye = look.sight->eye();
      Eigen::Vector2d expected(std::nan(""), std::nan(""));
      eye.project(eye.toCamera(look.x_in_world), expected);
      meter.add((expected - track.pixel).norm() / eye.farness(eye.toCamera(look.x_in_world)),
        [&] { return this->offender(index, numbersText(track.pixel.data(), 2), numbersText(expected.data(), 2)); });
    }
    const Eigen::Vector2d centre = point.track[0].pixel.array().floor() + 0.5;
    meter.add((centre - point.track[0].pixel).norm(),
      [&]
      {
        return this->offender(
          index, "first seen at " + numbersText(point.track[0].pixel.data(), 2), "the centre of a pixel");
      });
  }

  void onSurface(std::size_t index, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    if (!this->isSound(point))
    {
      return;
    }
    const std::shared_ptr<const Sight> first = this->lookOf(point, point.track[0]).sight;
    const Sight& sight = *first;
    const double found = sight.eye().range(point.track[0].pixel, sight.eye().toCamera(point.x));
    const double expected = sight.rangeOf(point.hit, point.track[0].pixel);
    meter.add((found - expected) / expected / sight.eye().farness(expected),
      [&] { return this->offender(index, "depth " + numberText(found), numberText(expected)); });
  }

  void visible(std::size_t index, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    for (const SeenTrack& track : this->isSound(point) ? point.track : std::vector<SeenTrack>{})
    {
      const Look look = this->lookOf(point, track);
      const bool seen = isSeen(look, point.hit, track.pixel, surfaceTolerance);
      if (!seen && isOpen(look, point.hit, track.pixel))
      {
        meter.skip();
        continue;
      }
      meter.equal(seen,
        [&]
        {
          return this->offender(
            index, "seen by camera '" + look.sight->eye().record().name + "'", "hidden or outside there");
        });
    }
    if (this->isSound(point) && !this->Rolls)
    {
      this->unseen(index, meter);
    }
  }

  /// The vertices of the .ply are the points, with the normals and colours of their surfaces.
  void ply(const Dataset& dataset, const std::string& file, Meter& meter, Meter& normals, Meter& colors) const
  {
    const std::string bytes = readFile(dataset.absolute(file));
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                               std::to_string(this->Points.size()) + plyProperties + "\nend_header\n";
    const std::size_t expected = this->Points.size() * plyVertexBytes;
    const std::size_t start = bytes.compare(0, header.size(), header) == 0 ? header.size() : bytes.size();
    meter.equal(start == header.size(),
      [&] {
        return Offender{ file, -1, -1, "another header", "that of the points" };
      });
    meter.equal(bytes.size() - start == expected,
      [&]
      {
        return Offender{ file, -1, -1, std::to_string(bytes.size() - start) + " bytes of vertices",
          std::to_string(expected) };
      });
    for (std::size_t i = 0; bytes.size() - start == expected && i < this->Points.size(); ++i)
    {
      const char* vertex = bytes.data() + start + i * plyVertexBytes;
      Eigen::Vector3d x;
      Hit hit;
      std::memcpy(x.data(), vertex, 24);
      std::memcpy(&hit.object, vertex + 39, 4);
      std::memcpy(&hit.triangle, vertex + 43, 4);
      meter.equal(x == this->Points[i].x && hit == this->Points[i].hit,
        [&]
        {
          return Offender{ file, -1, -1, "vertex " + std::to_string(i) + ' ' + numbersText(x.data(), 3),
            numbersText(this->Points[i].x.data(), 3) };
        });
      if (this->isSound(this->Points[i]) && hit == this->Points[i].hit)
      {
        this->normal(file, i, vertex + 24, normals);
        this->color(file, i, vertex + 36, colors);
      }
    }
  }

private:
  /// Cameras that are not in a point's track do not see it.
  void unseen(std::size_t index, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    for (std::size_t camera = 0; camera < this->Sights.size(); ++camera)
    {
      const bool tracked = std::any_of(
        point.track.begin(), point.track.end(), [&](const SeenTrack& track) { return track.camera == camera; });
      const Look look{ this->Sights[camera]->middle(), point.x };
      Eigen::Vector2d pixel;
      if (tracked || !look.sight->eye().project(look.sight->eye().toCamera(point.x), pixel))
      {
        continue;
      }
      const bool seen = isSeen(look, point.hit, pixel, surfaceTolerance);
      if (seen && isOpen(look, point.hit, pixel, false))
      {
        meter.skip();
        continue;
      }
      meter.equal(!seen,
        [&] {
          return this->offender(index, "not seen by camera '" + look.sight->eye().record().name + "'", "seen there");
        });
    }
  }

  /// Unit, in the world, on the side of the camera that the point comes from.
  void normal(const std::string& file, std::size_t index, const char* bytes, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    const std::shared_ptr<const Sight> first = this->lookOf(point, point.track[0]).sight;
    const Sight& sight = *first;
    float narrow[3];
    std::memcpy(narrow, bytes, sizeof narrow);
    const Eigen::Vector3d found(narrow[0], narrow[1], narrow[2]);
    const Eigen::Vector3d unit = sight.normal(point.hit).stableNormalized();
    const double side = unit.dot(sight.eye().ray(point.track[0].pixel).direction) > 0 ? -1 : 1;
    const Eigen::Vector3d expected = side * (sight.eye().record().R.transpose() * unit);
    meter.add(apart(found, expected),
      [&]
      {
        return Offender{ file, -1, -1, "vertex " + std::to_string(index) + " normal " + numbersText(found.data(), 3),
          numbersText(expected.data(), 3) };
      });
  }

  void color(const std::string& file, std::size_t index, const char* bytes, Meter& meter) const
  {
    const CloudPoint& point = this->Points[index];
    const std::shared_ptr<const Sight> sight = this->lookOf(point, point.track[0]).sight;
    const Eigen::Vector3d weights = sight->weights(point.hit, sight->eye().toCamera(point.x));
    std::uint8_t color[3];
    std::memcpy(color, bytes, sizeof color);
    const auto where = [&](const std::string& found, const std::string& expected) {
      return Offender{ file, -1, -1, "vertex " + std::to_string(index) + " colour " + found, expected };
    };
    meterColor(sight->instance(point.hit.object), point.hit, weights, color, where, meter);
  }

  Offender offender(std::size_t index, const std::string& found, const std::string& expected) const
  {
    return { this->File, -1, -1, "point " + std::to_string(index) + ' ' + found, expected };
  }

  /// A camera at the time at which it sees a point, and where the point is then.
  struct Look
  {
    std::shared_ptr<const Sight> sight;
    Eigen::Vector3d x_in_world{ 0, 0, 0 };
  };

  Look lookOf(const CloudPoint& point, const SeenTrack& track) const
  {
    if (!this->Rolls)
    {
      return { this->Sights[track.camera]->middle(), point.x };
    }
    const auto sightOf = [this](const SeenTrack& of)
    {
      const TimedSight& timed = *this->Sights[of.camera];
      return timed.at(timed.timeAt(of.pixel));
    };
    const std::shared_ptr<const Sight> first = sightOf(point.track[0]);
    Look look{ sightOf(track), point.x };
    look.x_in_world =
      carried(*first, look.sight->instance(point.hit.object), point.hit, first->eye().toCamera(point.x)).x_in_world;
    return look;
  }

  static bool isSeen(const Look& look, const Hit& own, const Eigen::Vector2d& pixel, double slack)
  {
    const Eye& eye = look.sight->eye();
    const Eigen::Vector3d x = eye.toCamera(look.x_in_world);
    if (!eye.sees(pixel, x))
    {
      return false;
    }
    std::vector<Hit> hits;
    std::vector<double> ranges;
    look.sight->surfaces(pixel, hits, ranges);
    const double range = eye.range(pixel, x);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      if (hits[i] != own && ranges[i] / range < 1 - slack)
      {
        return false;
      }
    }
    return true;
  }

  /// Whether a point may be seen beside where it is, or hidden.
  static bool isOpen(const Look& look, const Hit& own, const Eigen::Vector2d& pixel, bool otherwise = true)
  {
    const Eigen::Vector2d reach = look.sight->eye().reach(silhouetteReach, look.sight->eye().toCamera(look.x_in_world));
    for (int i = 0; i <= 16; ++i)
    {
      constexpr double sixteenth = 0.39269908169872414;
      const Eigen::Vector2d direction(std::cos(i * sixteenth), std::sin(i * sixteenth));
      const Eigen::Vector2d beside = pixel + (i == 16 ? 0.0 : 1.0) * reach.cwiseProduct(direction);
      if (isSeen(look, own, beside, otherwise ? silhouetteReach : -silhouetteReach) == otherwise)
      {
        return true;
      }
    }
    return false;
  }

  std::string File;
  std::vector<CloudPoint> Points;
  std::vector<std::shared_ptr<const TimedSight>> Sights;
  bool Rolls = false; ///< any of them
};

void checkCloud(Dataset& dataset, const std::string& file, int frame, Results& results)
{
  const std::string path = dataset.absolute(file);
  const CloudCheck check(dataset, file, frame, readPoints(path));
  const int points = static_cast<int>(check.points().size());
  const auto measure = [&](double tolerance, void (CloudCheck::*body)(std::size_t, Meter&) const)
  {
    return meterRows(dataset.pool(), points, tolerance,
      [&](int i, Meter& meter) { (check.*body)(static_cast<std::size_t>(i), meter); });
  };
  results.add({ "tracks", "pixel", { file } }, measure(trackTolerance, &CloudCheck::reproject));
  results.add({ "surface", "relative", { file } }, measure(surfaceTolerance, &CloudCheck::onSurface));
  results.add({ "visible", "", { file } }, measure(0, &CloudCheck::visible));
  const std::string ply = dataset.find("", "points", frame, { ".ply" });
  if (!ply.empty())
  {
    Meter meter(0);
    Meter normals(normalTolerance);
    Meter colors(colorTolerance);
    check.ply(dataset, ply, meter, normals, colors);
    results.add({ "ply", "", { ply } }, meter);
    results.add({ "normals", "1", { ply } }, normals);
    results.add({ "colors", "1/255", { ply } }, colors);
  }
}
} // namespace

void checkPoints(Dataset& dataset, Results& results)
{
  std::set<int> frames;
  for (const CameraRecord& camera : dataset.cameras())
  {
    frames.insert(camera.frame);
  }
  for (const int frame : frames)
  {
    const std::string file = dataset.find("", "points", frame, { ".json" });
    if (!file.empty())
    {
      checkCloud(dataset, file, frame, results);
    }
  }
}

} // namespace dgtk
