// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelClock.h"

#include "dgtkError.h"
#include "dgtkStageModels.h"
#include "dgtkVertexDeformation.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double singlePrecision = 1e-7; // of the lengths that files have
constexpr double mostRounding = 1e-3;    // of a round, however many came before

std::shared_ptr<const Geometry> blended(const Geometry& a, const Geometry& b, double u)
{
  auto geometry = std::make_shared<Geometry>();
  geometry->positions.reserve(a.positions.size());
  geometry->normals.reserve(a.normals.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i)
  {
    geometry->positions.push_back(a.positions[i] + (b.positions[i] - a.positions[i]) * u);
  }
  for (std::size_t i = 0; i < a.normals.size(); ++i)
  {
    const Eigen::Vector3f normal = a.normals[i] + (b.normals[i] - a.normals[i]) * float(u);
    const float length = normal.norm();
    geometry->normals.push_back(length > 1e-6f ? Eigen::Vector3f(normal / length) : a.normals[i]);
  }
  return geometry;
}

std::shared_ptr<const Geometry> compute(const Model& model, const ModelMoment& moment)
{
  std::shared_ptr<const Geometry> here = geometryAt(model, moment.animation, moment.frame);
  if (moment.wrap == 0)
  {
    return here;
  }
  const double first = model.animations[std::size_t(moment.animation)].first;
  return blended(*here, *geometryAt(model, moment.animation, first), moment.wrap);
}
} // namespace

int findAnimation(const SceneDescription& scene, const ObjectDescription& object, const Model& model)
{
  const std::string& wanted = object.animation.sequence;
  const int count = static_cast<int>(model.animations.size());
  if (wanted.empty())
  {
    return count == 0 ? -1 : 0;
  }
  std::string names;
  for (int i = 0; i < count; ++i)
  {
    const std::string& name = model.animations[std::size_t(i)].name;
    if (name == wanted)
    {
      return i;
    }
    names += i >= 40 ? "" : (i == 0 ? "" : ", ") + name;
  }
  if (wanted.size() <= 6 && wanted.find_first_not_of("0123456789") == std::string::npos && std::stoi(wanted) < count)
  {
    return std::stoi(wanted);
  }
  failObject(scene, object, "animation.sequence is no sequence of " + object.model,
    count == 0 ? "none" : "one of " + names, quoted(wanted));
}

double sequenceSpan(const Model& model, int animation, bool loop)
{
  const double span = model.animations[std::size_t(animation)].span();
  return loop && span > 0 && model.format == "md2" ? span + 1 : span;
}

ModelMoment momentAt(
  const AnimationDescription& description, const Model& model, int animation, double frame, double sceneFps)
{
  const Animation& sequence = model.animations[std::size_t(animation)];
  const double span = sequence.span();
  const double seconds = std::max(0.0, frame - description.start) / sceneFps;
  double position = description.offset + seconds * sequence.fps * description.rate;
  ModelMoment moment;
  moment.animation = animation;
  if (description.loop && span > 0)
  {
    const double whole = sequenceSpan(model, animation, true);
    const double rounding =
      sequence.length > 0 ? std::min(singlePrecision * std::max(1.0, position), whole * mostRounding) : 0;
    const double rest = std::fmod(position, whole);
    position = whole - rest < rounding ? 0 : rest;
    moment.wrap = std::max(0.0, position - span);
  }
  moment.frame = sequence.first + std::min(position, span);
  return moment;
}

std::shared_ptr<const Geometry> GeometryCache::get(const Model& model, const ModelMoment& moment)
{
  const Key key{ &model, moment.animation, moment.frame, moment.wrap };
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Entries.find(key);
    std::shared_ptr<const Geometry> known = found == this->Entries.end() ? nullptr : found->second.lock();
    if (known)
    {
      return known;
    }
  }
  std::shared_ptr<const Geometry> made = compute(model, moment);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
  {
    entry = entry->second.expired() ? this->Entries.erase(entry) : std::next(entry);
  }
  std::weak_ptr<const Geometry>& entry = this->Entries[key];
  std::shared_ptr<const Geometry> other = entry.lock(); // another thread was faster
  if (other)
  {
    return other;
  }
  entry = made;
  return made;
}

std::shared_ptr<const Geometry> geometryAt(const SceneDescription& scene, const ObjectDescription& object,
  const Model& model, double frame, GeometryCache& cache)
{
  const int animation = model.deformation ? findAnimation(scene, object, model) : -1;
  return animation < 0 ? model.rest : cache.get(model, momentAt(object.animation, model, animation, frame, scene.fps));
}

std::array<Eigen::Vector3d, 3> cornersAt(const SceneDescription& scene, const ObjectDescription& object,
  const Model& model, double frame, std::uint32_t triangle)
{
  const auto& vertices = model.triangles[triangle];
  const int animation = model.deformation ? findAnimation(scene, object, model) : -1;
  if (animation < 0)
  {
    const std::vector<Eigen::Vector3d>& p = model.rest->positions;
    return { p[vertices[0]], p[vertices[1]], p[vertices[2]] };
  }
  const ModelMoment moment = momentAt(object.animation, model, animation, frame, scene.fps);
  const auto sourceOf = [&](int i) { return model.sourceVertex[vertices[std::size_t(i)]]; };
  const auto* const single = dynamic_cast<const VertexDeformation*>(model.deformation.get());
  thread_local std::vector<Eigen::Vector3d> source;
  const auto cornersOf = [&](double at)
  {
    if (single != nullptr)
    {
      const auto corner = [&](int i) { return single->positionAt(animation, at, sourceOf(i)); };
      return std::array<Eigen::Vector3d, 3>{ corner(0), corner(1), corner(2) };
    }
    model.deformation->positionsAt(animation, at, source);
    const auto corner = [&](int i) { return source[sourceOf(i)]; };
    return std::array<Eigen::Vector3d, 3>{ corner(0), corner(1), corner(2) };
  };
  std::array<Eigen::Vector3d, 3> corners = cornersOf(moment.frame);
  if (moment.wrap != 0)
  {
    const std::array<Eigen::Vector3d, 3> first = cornersOf(model.animations[std::size_t(animation)].first);
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      corners[i] += (first[i] - corners[i]) * moment.wrap; // as blended()
    }
  }
  return corners;
}

} // namespace dgtk
