// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkObjectDocuments.h"
#include "dgtkPortableMath.h"
#include "dgtkSeenPoint.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Pixels, and parts of the distance of a place.
constexpr double placeTolerance = 1e-9;
/// Part of the diagonal of the object's box in front of a point in which nothing hides it, as the format has it.
constexpr double hiddenDepth = 0.01;
/// Part of the range of a point within which the limits of what is seen and hidden are a matter of rounding.
constexpr double limitSlack = 1e-6;
constexpr int mostKeypointSteps = 200;
constexpr double settledTime = 1e-14; ///< of a frame

enum Class
{
  Nothing,
  Visible,
  OtherObject,
  OwnObject,
  Outside,
  Behind
};

/// Where a keypoint is seen.
struct KeypointPlace
{
  bool known = true; ///< otherwise plain iteration of time and place does not settle
  bool projects = false;
  double time = 0;
  Eigen::Vector3d x{ 0, 0, 0 }; ///< camera frame
  Eigen::Vector2d pixel{ 0, 0 };
};

class KeypointCheck
{
public:
  KeypointCheck(Picture& picture, const std::string& file)
    : Owner(picture)
    , File(file)
  {
  }

  void object(const BoxRecord& record)
  {
    if (record.id == 0 || record.id > this->Owner.sight().state().instances.size())
    {
      return; // named by boxes
    }
    this->Record = &record;
    const std::vector<KeypointDescription>& expected = this->description().keypoints;
    std::string names;
    std::string wanted;
    for (const KeypointRecord& point : record.keypoints)
    {
      names += " '" + point.name + '\'';
    }
    for (const KeypointDescription& point : expected)
    {
      wanted += " '" + point.name + '\'';
    }
    if (names.empty() && wanted.empty())
    {
      return;
    }
    this->Places.equal(names == wanted, [&] { return this->offender("keypoints" + names, "keypoints" + wanted); });
    for (std::size_t i = 0; names == wanted && i < expected.size(); ++i)
    {
      this->point(record.keypoints[i], this->placeOf(expected[i]));
    }
  }

  void finish(Results& results) const
  {
    if (this->Places.Count > 0)
    {
      results.add({ "places", "pixel", { this->File } }, this->Places);
      results.add({ "visible", "", { this->File } }, this->Classes);
    }
  }

private:
  Offender offender(const std::string& found, const std::string& expected) const
  {
    return { this->File, -1, -1, "object " + std::to_string(this->Record->id) + ' ' + found, expected };
  }

  const ObjectDescription& description() const
  {
    const std::string& name = this->Owner.sight().instance(this->Record->id).name;
    const std::vector<ObjectDescription>& objects = this->Owner.dataset().stage().description().objects;
    return *std::find_if(
      objects.begin(), objects.end(), [&](const ObjectDescription& object) { return object.name == name; });
  }

  static Eigen::Vector3d inWorld(const KeypointDescription& point, const Instance& instance)
  {
    if (!point.vertex)
    {
      return instance.world_from_object * point.position;
    }
    return instance.world_from_object * instance.geometry->positions[*instance.model->splitVertexOf(*point.vertex)];
  }

  KeypointPlace placeOf(const KeypointDescription& point) const
  {
    const TimedSight& sight = this->Owner.time();
    KeypointPlace place;
    for (int step = 0; step < mostKeypointSteps; ++step)
    {
      const Eye eye = sight.eyeAt(place.time);
      place.x = eye.toCamera(inWorld(point, sight.instanceAt(place.time, this->Record->id)));
      place.projects = eye.project(place.x, place.pixel);
      const double next = place.projects ? sight.timeAt(place.pixel) : place.time;
      if (std::abs(next - place.time) <= settledTime)
      {
        place.known = place.projects || !sight.rolls();
        return place;
      }
      place.time = next;
    }
    place.known = false;
    return place;
  }

  void point(const KeypointRecord& found, const KeypointPlace& expected)
  {
    if (!expected.known)
    {
      this->Places.skip();
      this->Classes.skip();
      return;
    }
    this->Places.add((found.x - expected.x).norm() / std::max(expected.x.norm(), 1e-300), [&]
      { return this->offender(found.name + ' ' + numbersText(found.x.data(), 3), numbersText(expected.x.data(), 3)); });
    if (!found.pixel || !expected.projects)
    {
      this->Places.equal(!found.pixel && !expected.projects,
        [&] { return this->offender(found.name, expected.projects ? "a place in the image" : "none in the image"); });
    }
    else
    {
      const double size = std::max(this->Owner.width(), this->Owner.height());
      const double far = expected.pixel.cwiseAbs().maxCoeff() / size;
      this->Places.add((*found.pixel - expected.pixel).norm() / std::max(1.0, far * far),
        [&]
        {
          return this->offender(
            found.name + ' ' + numbersText(found.pixel->data(), 2), numbersText(expected.pixel.data(), 2));
        });
    }
    this->visibility(found, expected);
  }

  void visibility(const KeypointRecord& found, const KeypointPlace& place)
  {
    const std::shared_ptr<const Sight> rolled =
      this->Owner.time().rolls() ? this->Owner.time().at(place.time) : nullptr;
    const Sight& sight = rolled ? *rolled : this->Owner.sight();
    const int expected = this->classOf(sight, place, place.pixel, 0);
    if (found.visibility != expected && this->isOpen(sight, place, found.visibility))
    {
      this->Classes.skip();
      return;
    }
    this->Classes.equal(found.visibility == expected,
      [&] {
        return this->offender(found.name + " visibility " + std::to_string(found.visibility), std::to_string(expected));
      });
  }

  /// By the ray through `pixel`, with what is nearer than the point by `slack`, parts of its range, more than the
  /// format allows.
  int classOf(const Sight& sight, const KeypointPlace& place, const Eigen::Vector2d& pixel, double slack) const
  {
    if (!sight.instance(this->Record->id).visible)
    {
      return Nothing;
    }
    if (!place.projects)
    {
      return Behind;
    }
    if (!sight.eye().sees(place.pixel, place.x))
    {
      return Outside;
    }
    const double depth = hiddenDepth * (this->Record->corners.row(7) - this->Record->corners.row(0)).norm();
    const Eigen::Vector3d direction = sight.eye().ray(place.pixel).direction.normalized();
    const double limit = sight.eye().range(place.pixel, place.x - depth * direction);
    std::vector<Hit> hits;
    std::vector<double> ranges;
    sight.surfaces(pixel, hits, ranges);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      if (ranges[i] < limit - slack * std::abs(limit))
      {
        return hits[i].object == this->Record->id ? OwnObject : OtherObject;
      }
    }
    return Visible;
  }

  /// Whether another class is as right: beside a silhouette, the border, or the limits of depth.
  bool isOpen(const Sight& sight, const KeypointPlace& place, int found) const
  {
    const Eye& eye = sight.eye();
    if (place.projects)
    {
      const double range = eye.range(place.pixel, place.x);
      const Eigen::Vector2d size(eye.width(), eye.height());
      if ((place.pixel.cwiseAbs().minCoeff() <= borderSlack) ||
          (place.pixel - size).cwiseAbs().minCoeff() <= borderSlack ||
          std::abs(range / eye.record().near - 1) <= limitSlack || std::abs(range / eye.record().far - 1) <= limitSlack)
      {
        return true;
      }
    }
    if (!place.projects || found == Nothing || found == Outside || found == Behind)
    {
      return false;
    }
    const Eigen::Vector2d reach = eye.reach(silhouetteReach, place.x);
    for (int i = 0; i < 48; ++i)
    {
      const Eigen::Vector2d direction(std::cos(i * pi / 8), std::sin(i * pi / 8));
      const Eigen::Vector2d pixel = place.pixel + (i < 16 ? 1.0 : 0.25) * reach.cwiseProduct(direction);
      if (this->classOf(sight, place, i < 32 ? pixel : place.pixel, i % 2 == 0 ? limitSlack : -limitSlack) == found)
      {
        return true;
      }
    }
    return false;
  }

  Picture& Owner;
  std::string File;
  const BoxRecord* Record = nullptr;
  Meter Places{ placeTolerance };
  Meter Classes{ 0 };
};
} // namespace

void checkKeypoints(Picture& picture, Results& results)
{
  const Dataset& dataset = picture.dataset();
  const std::string file = dataset.find(picture.camera(), "boxes", picture.frame(), { ".json" });
  if (file.empty())
  {
    return;
  }
  KeypointCheck check(picture, file);
  for (const BoxRecord& record : readBoxes(dataset.absolute(file)))
  {
    check.object(record);
  }
  check.finish(results);
}

} // namespace dgtk
