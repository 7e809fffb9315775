// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemMotion.h"

#include "dgtkPortableMath.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

namespace dgtk
{

namespace
{
constexpr double samePose = 1e-12; // of unit vectors
constexpr double sameShape = 1e-5; // of an object's matrix; scenes that people write have some six digits
constexpr int mostSteps = 60;      // of an iteration that converges in about ten

/// Newton's iteration for the orthogonal factor of the polar decomposition (Higham 1986).
Eigen::Matrix3d nearestOrthogonal(const Eigen::Matrix3d& matrix)
{
  Eigen::Matrix3d m = matrix / std::cbrt(std::abs(matrix.determinant()));
  for (int i = 0; i < mostSteps; ++i)
  {
    const Eigen::Matrix3d next = (m + m.inverse().transpose()) / 2;
    const bool done = (next - m).norm() < 1e-15;
    m = next;
    if (done)
    {
      break;
    }
  }
  return m;
}

bool isUnit(const Eigen::Matrix3d& m) { return m == Eigen::Matrix3d::Identity(); }

/// Without those whose parents, near or far, are among them.
SceneItems topmost(const SceneDescription& scene, const SceneItems& items)
{
  std::set<std::string> chosen;
  std::unordered_map<std::string, std::string> parents;
  for (const SceneItem& item : items)
  {
    if (item.kind == SceneItem::Kind::Object)
    {
      chosen.insert(scene.objects[item.index].name);
    }
  }
  for (const ObjectDescription& object : scene.objects)
  {
    parents[object.name] = object.parent;
  }
  SceneItems top;
  for (const SceneItem& item : items)
  {
    std::string parent = item.kind == SceneItem::Kind::Object ? scene.objects[item.index].parent : std::string();
    while (!parent.empty() && chosen.count(parent) == 0)
    {
      parent = parents[parent];
    }
    if (parent.empty())
    {
      top.push_back(item);
    }
  }
  return top;
}

/// Where a motion takes a point, as a step; exactly 0 for what it leaves.
Eigen::Vector3d stepOf(const Eigen::Vector3d& point, const WorldMotion& motion)
{
  const Eigen::Vector3d arm = point - motion.pivot;
  switch (motion.mode)
  {
    case HandleMode::Move:
      return motion.translation;
    case HandleMode::Rotate:
      return turn(motion.axis, motion.degrees).matrix() * arm - arm;
    case HandleMode::Scale:
      return motion.axes * (motion.factors.array() - 1).matrix().asDiagonal() * motion.axes.transpose() * arm;
    default:
      return { 0, 0, 0 };
  }
}

/// What a track has already needs no key.
template <typename T>
void put(Track<T>& track, int frame, const T& value)
{
  if (!(track.at(frame) == value))
  {
    setTrackAt(track, frame, value);
  }
}

void putMoved(Track<Eigen::Vector3d>& track, int frame, const Eigen::Vector3d& value, const Eigen::Vector3d& step)
{
  put<Eigen::Vector3d>(track, frame, step.isZero(0) ? value : Eigen::Vector3d(value + step));
}

/// A rotation by 0 leaves the quaternion as it was written.
void putTurned(Track<Quaternion>& track, int frame, const Quaternion& rotation, const Quaternion& start)
{
  const Quaternion turned = product(rotation, start);
  put(track, frame, rotation == Quaternion() ? start : turned.scaled(1 / turned.norm()));
}

/// What turns or grows about a point beside its origin steps aside as often as it turns or grows: at this frame alone
/// where `track` has keys, and at the others it stays; at all frames where it has none. `start`: before the motion.
template <typename T>
void stepAside(const Track<T>& track, int frame, const Track<Eigen::Vector3d>& start, const Eigen::Vector3d& step,
  Track<Eigen::Vector3d>& position)
{
  position = start; // also where the drag comes back to where it began
  if (step.isZero(0))
  {
    return;
  }
  if (track.animated())
  {
    for (std::size_t i = 0; i < track.keys.size() && !start.animated(); ++i)
    {
      position.keys.push_back({ track.keys[i].frame, start.value, std::nullopt });
    }
    putMoved(position, frame, start.at(frame), step);
    return;
  }
  position.value += step;
  for (Key<Eigen::Vector3d>& key : position.keys)
  {
    key.value += step;
  }
}

/// The up vector in the image.
Eigen::Vector3d imageUp(const Eigen::Vector3d& forward, const Eigen::Vector3d& up)
{
  return (up - up.dot(forward) * forward).normalized();
}
} // namespace

Quaternion product(const Quaternion& a, const Quaternion& b)
{
  return { a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w };
}

Quaternion turn(const Eigen::Vector3d& axis, double degrees)
{
  const double half = degrees * (pi / 360);
  const Eigen::Vector3d v = std::sin(half) * axis;
  return { std::cos(half), v.x() + 0.0, v.y() + 0.0, v.z() + 0.0 };
}

ItemMotion::ItemMotion(const SceneDescription& scene, const ScenePlaces& places, const SceneItems& items, int frame)
  : Items(topmost(scene, items))
  , Frame(frame)
{
  WorldBox box;
  for (const SceneItem& item : this->Items)
  {
    Start start;
    start.position = itemPosition(scene, item, frame);
    start.place = start.position;
    bool directed = item.kind == SceneItem::Kind::Camera;
    if (item.kind == SceneItem::Kind::Object)
    {
      const ObjectDescription& object = scene.objects[item.index];
      const ObjectPlace& place = places.objects[item.index];
      start.place = place.instance.world_from_object.translation;
      start.parent = place.world_from_parent.linear;
      start.parentRotation = isUnit(start.parent) ? start.parent : nearestOrthogonal(start.parent);
      start.path = object.position;
      start.orientation = object.orientation.at(frame);
      start.scale = object.scale.at(frame);
      directed = true;
      this->Center = place.center;
    }
    else if (item.kind == SceneItem::Kind::Light)
    {
      const LightDescription& light = scene.lights[item.index];
      start.target = light.target.at(frame);
      directed = traitsOf(light.kind).aimed;
    }
    else
    {
      const CameraDescription& camera = scene.cameras[item.index];
      start.target = camera.lookAt.at(frame);
      start.up = camera.up.at(frame);
      start.orientation = camera.orientation.at(frame);
    }
    if (item.kind != SceneItem::Kind::Object)
    {
      this->Center = start.place;
    }
    box.add(places.boxOf(item));
    this->Starts.push_back(start);
    this->Directed.push_back(directed);
  }
  if (this->Items.size() > 1)
  {
    this->Center = box.center();
  }
}

Eigen::Vector3d ItemMotion::pivot(HandlePivot wanted) const
{
  if (wanted == HandlePivot::Center)
  {
    return this->Center;
  }
  Eigen::Vector3d sum(0, 0, 0);
  for (const Start& start : this->Starts)
  {
    sum += start.place;
  }
  return this->Starts.size() < 2 ? sum : Eigen::Vector3d(sum / double(this->Starts.size()));
}

Eigen::Matrix3d ItemMotion::ownAxes(const Start& start) { return start.parentRotation * start.orientation.matrix(); }

Eigen::Matrix3d ItemMotion::axes(HandleMode mode) const
{
  const bool own =
    mode == HandleMode::Scale && this->Items.size() == 1 && this->Items.front().kind == SceneItem::Kind::Object;
  return own ? ownAxes(this->Starts.front()) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

bool ItemMotion::can(HandleMode mode) const
{
  if (this->Items.size() != 1)
  {
    return !this->Items.empty() && mode != HandleMode::None;
  }
  switch (mode)
  {
    case HandleMode::Move:
      return true;
    case HandleMode::Rotate:
      return this->Directed.front();
    case HandleMode::Scale:
      return this->Items.front().kind == SceneItem::Kind::Object;
    default:
      return false;
  }
}

Eigen::Vector3d ItemMotion::ownFactors(const Start& start, const WorldMotion& motion) const
{
  if (this->Items.size() == 1)
  {
    return motion.factors;
  }
  // How far the world's scaling stretches each of the object's axes.
  const Eigen::Matrix3d stretched =
    motion.axes * motion.factors.asDiagonal() * motion.axes.transpose() * ownAxes(start);
  return stretched.colwise().norm().transpose();
}

Quaternion ItemMotion::turnInParent(const Start& start, const WorldMotion& motion)
{
  // In the parent's frame the same rotation has another axis, and in a mirrored one the other sense.
  const Eigen::Vector3d axis = start.parentRotation.transpose() * motion.axis;
  return turn(axis, start.parentRotation.determinant() < 0 ? -motion.degrees : motion.degrees);
}

Eigen::Vector3d ItemMotion::stepInParent(const Start& start, const WorldMotion& motion)
{
  const Eigen::Vector3d arm = motion.mode == HandleMode::Move ? motion.translation : start.place - motion.pivot;
  Eigen::Vector3d inParent =
    isUnit(start.parent) || arm.isZero(0) ? arm : Eigen::Vector3d(start.parent.inverse() * arm);
  if (motion.mode == HandleMode::Rotate)
  {
    return turnInParent(start, motion).matrix() * inParent - inParent;
  }
  if (motion.mode == HandleMode::Scale)
  {
    const Eigen::Matrix3d own = start.orientation.matrix();
    return own * (motion.factors.array() - 1).matrix().asDiagonal() * own.transpose() * inParent;
  }
  return inParent;
}

bool ItemMotion::shears(const WorldMotion& motion) const
{
  const auto shearsOne = [&motion](const SceneItem& item, const Start& start)
  {
    if (item.kind != SceneItem::Kind::Object || isUnit(start.parent))
    {
      return false;
    }
    const Eigen::Matrix3d inParent = start.orientation.matrix() * start.scale.asDiagonal();
    const Eigen::Matrix3d wanted = turn(motion.axis, motion.degrees).matrix() * start.parent * inParent;
    const Eigen::Matrix3d got = start.parent * turnInParent(start, motion).matrix() * inParent;
    return (got - wanted).norm() > sameShape * wanted.norm();
  };
  bool any = false;
  for (std::size_t i = 0; i < this->Items.size() && motion.mode == HandleMode::Rotate; ++i)
  {
    any = any || shearsOne(this->Items[i], this->Starts[i]);
  }
  return any;
}

void ItemMotion::applyToObject(ObjectDescription& object, const Start& start, const WorldMotion& motion) const
{
  Eigen::Vector3d step;
  if (this->Items.size() == 1)
  {
    step = stepInParent(start, motion);
  }
  else
  {
    step = stepOf(start.place, motion);
    step = isUnit(start.parent) || step.isZero(0) ? step : Eigen::Vector3d(start.parent.inverse() * step);
  }
  if (motion.mode == HandleMode::Rotate)
  {
    stepAside(object.orientation, this->Frame, start.path, step, object.position);
    putTurned(object.orientation, this->Frame, turnInParent(start, motion), start.orientation);
  }
  else if (motion.mode == HandleMode::Scale)
  {
    stepAside(object.scale, this->Frame, start.path, step, object.position);
    put<Eigen::Vector3d>(object.scale, this->Frame, start.scale.cwiseProduct(this->ownFactors(start, motion)));
  }
  else
  {
    putMoved(object.position, this->Frame, start.position, step);
  }
}

void ItemMotion::applyToLight(LightDescription& light, const Start& start, const WorldMotion& motion) const
{
  putMoved(light.position, this->Frame, start.position, stepOf(start.position, motion));
  if (traitsOf(light.kind).aimed)
  {
    putMoved(light.target, this->Frame, start.target, stepOf(start.target, motion));
  }
}

void ItemMotion::applyToCamera(CameraDescription& camera, const Start& start, const WorldMotion& motion) const
{
  putMoved(camera.posed ? camera.position : camera.eye, this->Frame, start.position, stepOf(start.position, motion));
  const Quaternion rotation = turn(motion.axis, motion.mode == HandleMode::Rotate ? motion.degrees : 0);
  if (camera.posed)
  {
    putTurned(camera.orientation, this->Frame, rotation, start.orientation);
    return;
  }
  putMoved(camera.lookAt, this->Frame, start.target, stepOf(start.target, motion));
  const Eigen::Matrix3d R = rotation.matrix();
  const Eigen::Vector3d forward = (start.target - start.position).normalized();
  const Eigen::Vector3d wanted = R * imageUp(forward, start.up.normalized());
  const bool kept = (imageUp(R * forward, start.up.normalized()) - wanted).norm() < samePose;
  put<Eigen::Vector3d>(camera.up, this->Frame, kept ? start.up : Eigen::Vector3d(R * start.up));
}

void ItemMotion::apply(SceneDescription& scene, const WorldMotion& motion) const
{
  for (std::size_t i = 0; i < this->Items.size(); ++i)
  {
    const SceneItem& item = this->Items[i];
    switch (item.kind)
    {
      case SceneItem::Kind::Object:
        this->applyToObject(scene.objects[item.index], this->Starts[i], motion);
        break;
      case SceneItem::Kind::Light:
        this->applyToLight(scene.lights[item.index], this->Starts[i], motion);
        break;
      default:
        this->applyToCamera(scene.cameras[item.index], this->Starts[i], motion);
    }
  }
}

} // namespace dgtk
