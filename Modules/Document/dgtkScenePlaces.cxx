// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkScenePlaces.h"

#include "dgtkError.h"
#include "dgtkObjectPoses.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace dgtk
{

namespace
{
constexpr double atEye = 1e-6;      // world units; nearer cameras and lights are at the eye itself
constexpr double sameCenter = 1e-6; // of a box's diagonal: what single-precision files leave of a centred model
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Boxes of geometries in their own axes, each computed once.
class Boxes
{
public:
  const WorldBox& of(const Geometry& geometry)
  {
    const auto [at, isNew] = this->Known.try_emplace(&geometry);
    if (isNew)
    {
      for (const Eigen::Vector3d& position : geometry.positions)
      {
        at->second.add(position);
      }
    }
    return at->second;
  }

private:
  std::unordered_map<const Geometry*, WorldBox> Known;
};

WorldBox transformed(const WorldBox& box, const Affine3& world_from_object)
{
  WorldBox result;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
  {
    result.add(world_from_object * Eigen::Vector3d((corner & 1 ? box.max : box.min).x(),
                                     (corner & 2 ? box.max : box.min).y(), (corner & 4 ? box.max : box.min).z()));
  }
  return result;
}

CameraPlace placeCamera(const CameraDescription& camera, double frame, const std::string& folder)
{
  CameraPlace place;
  place.center = camera.posed ? camera.position.at(frame) : camera.eye.at(frame);
  try
  {
    place.view = cameraView(camera, frame, 0, 0, folder);
    place.valid = true;
  }
  catch (const Error&)
  {
    place.valid = false;
  }
  return place;
}

bool meetsBox(const WorldBox& box, const WorldRay& ray, double most)
{
  double from = ray.least;
  double to = most;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double inverse = 1 / ray.direction[axis];
    double a = (box.min[axis] - ray.origin[axis]) * inverse;
    double b = (box.max[axis] - ray.origin[axis]) * inverse;
    if (a > b)
    {
      std::swap(a, b);
    }
    from = a > from ? a : from; // NaN: within the slab
    to = b < to ? b : to;
  }
  return from <= to;
}

/// Möller and Trumbore 1997; infinity for a miss.
double meetTriangle(const WorldRay& ray, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0)
  {
    return infinity;
  }
  const Eigen::Vector3d s = ray.origin - a;
  const double u = s.dot(p) / determinant;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  const double t = ac.dot(q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t > ray.least ? t : infinity;
}

double meetObject(const ObjectPlace& place, const WorldRay& ray, double most)
{
  if (!place.visible || place.instance.model == nullptr || !meetsBox(place.box, ray, most))
  {
    return infinity;
  }
  // Parameters of a ray are the same in the object's own axes.
  const Eigen::Matrix3d object_from_world = place.instance.world_from_object.linear.inverse();
  const WorldRay own{ object_from_world * (ray.origin - place.instance.world_from_object.translation),
    object_from_world * ray.direction, ray.least };
  const std::vector<Eigen::Vector3d>& positions = place.instance.geometry->positions;
  double first = infinity;
  for (const std::array<std::uint32_t, 3>& t : place.instance.model->triangles)
  {
    first = std::min(first, meetTriangle(own, positions[t[0]], positions[t[1]], positions[t[2]]));
  }
  return first;
}

double meetPoint(const Eigen::Vector3d& point, const WorldRay& ray, const PickReach& reach)
{
  const double t = (point - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
  const double distance = (ray.origin + t * ray.direction - point).norm();
  return t > ray.least && (point - ray.origin).norm() > atEye && distance <= reach.constant + reach.slope * t
           ? t
           : infinity;
}
} // namespace

void WorldBox::add(const Eigen::Vector3d& point)
{
  const bool first = this->empty();
  this->min = first ? point : Eigen::Vector3d(this->min.cwiseMin(point));
  this->max = first ? point : Eigen::Vector3d(this->max.cwiseMax(point));
}

void WorldBox::add(const WorldBox& box)
{
  if (!box.empty())
  {
    this->add(box.min);
    this->add(box.max);
  }
}

WorldBox ScenePlaces::boxOf(const SceneItem& item) const
{
  WorldBox found;
  if (item.kind == SceneItem::Kind::Object && item.index < this->objects.size())
  {
    found = this->objects[item.index].box;
    if (found.empty())
    {
      found.add(this->objects[item.index].instance.world_from_object.translation);
    }
  }
  else if (item.kind == SceneItem::Kind::Light && item.index < this->lights.size())
  {
    found.add(this->lights[item.index]);
  }
  else if (item.kind == SceneItem::Kind::Camera && item.index < this->cameras.size())
  {
    found.add(this->cameras[item.index].center);
  }
  return found;
}

std::optional<double> fieldOfViewOf(const CameraDescription& camera)
{
  CameraParameters of = cameraParameters(camera, 0, camera.width, camera.height);
  of.rollingShutter = RollingShutter();
  const auto distortion = of.numbers.find("distortion");
  if (distortion != of.numbers.end())
  {
    std::fill(distortion->second.begin(), distortion->second.end(), 0);
  }
  const Eigen::Matrix3d& K = *camera.K;
  const double y = -camera.height / 2.0 / K(1, 1); // on the plane of K
  const CameraRay up = makeCamera(camera.model, of)->rayThrough({ K(0, 2) + K(0, 1) * y, K(1, 2) + K(1, 1) * y });
  return up.direction.isZero() ? std::nullopt
                               : std::make_optional(std::atan2(-up.direction.y(), up.direction.z()) * 360 / pi);
}

namespace
{
/// Without objects and cameras Stage reads nothing.
std::shared_ptr<const SceneState> surroundingsOf(
  const SceneDescription& scene, const ModelLibrary& models, double frame)
{
  SceneDescription alone;
  alone.file = scene.file;
  alone.background = scene.background;
  alone.fog = scene.fog;
  alone.lights = scene.lights;
  auto state = std::make_shared<SceneState>(*Stage::load(std::move(alone))->at(frame));
  state->environment = models.environment(scene);
  return state;
}
} // namespace

ScenePlaces placeScene(const SceneDescription& scene, const ModelLibrary& models, double frame)
{
  ScenePlaces places;
  places.frame = frame;
  places.surroundings = surroundingsOf(scene, models, frame);
  const ObjectPoses poses(scene);
  const std::vector<Affine3> world = poses.at(frame);
  Boxes boxes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    ObjectPlace place;
    place.instance = models.at(scene, scene.objects[i], frame);
    place.instance.name = scene.objects[i].name;
    place.instance.world_from_object = world[i];
    const std::size_t parent = poses.parentOf(i);
    place.world_from_parent = parent == ObjectPoses::noParent ? Affine3{} : world[parent];
    place.visible = scene.objects[i].visible.at(frame);
    place.center = place.instance.world_from_object.translation;
    if (place.instance.geometry != nullptr)
    {
      const WorldBox& own = boxes.of(*place.instance.geometry);
      place.box = transformed(own, place.instance.world_from_object);
      if (!own.empty() && own.center().norm() > sameCenter * own.diagonal())
      {
        place.center = place.instance.world_from_object * own.center();
      }
    }
    if (place.visible)
    {
      places.box.add(place.box);
    }
    places.objects.push_back(std::move(place));
  }
  for (const LightDescription& light : scene.lights)
  {
    places.lights.push_back(light.position.at(frame));
    if (traitsOf(light.kind).placed && traitsOf(light.kind).near)
    {
      places.box.add(places.lights.back());
    }
  }
  for (const CameraDescription& camera : scene.cameras)
  {
    places.cameras.push_back(placeCamera(camera, frame, scene.folder));
    places.box.add(places.cameras.back().center);
  }
  return places;
}

std::optional<SceneItem> pickItem(const ScenePlaces& places, const WorldRay& ray, const PickReach& reach)
{
  std::optional<SceneItem> best;
  double nearest = ray.most;
  const auto offer = [&](double t, SceneItem::Kind kind, std::size_t index)
  {
    if (t < nearest)
    {
      nearest = t;
      best = SceneItem{ kind, index };
    }
  };
  for (std::size_t i = 0; i < places.objects.size(); ++i)
  {
    offer(meetObject(places.objects[i], ray, nearest), SceneItem::Kind::Object, i);
  }
  for (std::size_t i = 0; i < places.lights.size(); ++i)
  {
    offer(meetPoint(places.lights[i], ray, reach), SceneItem::Kind::Light, i);
  }
  for (std::size_t i = 0; i < places.cameras.size(); ++i)
  {
    offer(meetPoint(places.cameras[i].center, ray, reach), SceneItem::Kind::Camera, i);
  }
  return best;
}

} // namespace dgtk
