// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjectTruth.h"

#include "dgtkPixelBlocks.h"
#include "dgtkSeenInTime.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Pixels around what is projected that count as its own.
constexpr double margin = 0.5;
/// Cosine between axes up to which they count as perpendicular.
constexpr double perpendicular = 1e-9;

/// Positions of toggles, in pixels column by column, between the runs of two successive rows.
void addToggles(std::vector<int>& ends, int y, int height, std::vector<std::uint64_t>& toggles)
{
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
  {
    for (int x = ends[i]; x < ends[i + 1]; ++x)
    {
      toggles.push_back(std::uint64_t(x) * height + y);
    }
  }
  ends.clear();
}
} // namespace

void ObjectPixels::append(const ObjectPixels& below)
{
  if (below.count == 0)
  {
    return;
  }
  if (this->count == 0)
  {
    *this = below;
    return;
  }
  this->count += below.count;
  this->x0 = std::min(this->x0, below.x0);
  this->x1 = std::max(this->x1, below.x1);
  this->y1 = below.y1;
  this->runs.insert(this->runs.end(), below.runs.begin(), below.runs.end());
}

void ObjectPixels::unite(const ObjectPixels& others)
{
  if (others.count == 0)
  {
    return;
  }
  const bool first = this->count == 0;
  this->count += others.count;
  this->x0 = first ? others.x0 : std::min(this->x0, others.x0);
  this->y0 = first ? others.y0 : std::min(this->y0, others.y0);
  this->x1 = first ? others.x1 : std::max(this->x1, others.x1);
  this->y1 = first ? others.y1 : std::max(this->y1, others.y1);
}

std::vector<std::uint64_t> columnRunLengths(const std::vector<PixelRun>& runs, int width, int height)
{
  // a column is left and entered where a row and the one above differ
  std::vector<std::uint64_t> toggles;
  std::vector<int> ends;
  std::size_t above = 0; // runs [above, i) are of row runs[above].y
  for (std::size_t i = 0; i < runs.size();)
  {
    const int y = runs[i].y;
    if (i > 0 && runs[above].y != y - 1)
    {
      for (std::size_t k = above; k < i; ++k)
      {
        ends.insert(ends.end(), { runs[k].x0, runs[k].x1 });
      }
      addToggles(ends, runs[above].y + 1, height, toggles);
      above = i;
    }
    for (; above < i; ++above)
    {
      ends.insert(ends.end(), { runs[above].x0, runs[above].x1 });
    }
    for (; i < runs.size() && runs[i].y == y; ++i)
    {
      ends.insert(ends.end(), { runs[i].x0, runs[i].x1 });
    }
    addToggles(ends, y, height, toggles);
  }
  for (; above < runs.size(); ++above)
  {
    ends.insert(ends.end(), { runs[above].x0, runs[above].x1 });
  }
  addToggles(ends, runs.empty() ? 0 : runs.back().y + 1, height, toggles);
  std::sort(toggles.begin(), toggles.end());
  std::vector<std::uint64_t> lengths;
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < toggles.size(); ++i)
  {
    if (i + 1 < toggles.size() && toggles[i] == toggles[i + 1])
    {
      ++i; // the foot of a column is the head of the next
      continue;
    }
    lengths.push_back(toggles[i] - last);
    last = toggles[i];
  }
  const std::uint64_t rest = std::uint64_t(width) * height - last;
  if (rest > 0 || lengths.empty())
  {
    lengths.push_back(rest);
  }
  return lengths;
}

PlacedAxes placedAxes(const Eigen::Matrix3d& linear)
{
  PlacedAxes axes;
  axes.scale = linear.colwise().norm().transpose();
  axes.rotation = linear * axes.scale.cwiseInverse().asDiagonal();
  if (!(axes.scale.minCoeff() > 0))
  {
    return axes;
  }
  const Eigen::Matrix3d& r = axes.rotation;
  const double cosine =
    std::max({ std::abs(r.col(0).dot(r.col(1))), std::abs(r.col(1).dot(r.col(2))), std::abs(r.col(2).dot(r.col(0))) });
  if (!(cosine <= perpendicular))
  {
    return axes;
  }
  const Eigen::Vector3d a = r.col(0);
  const Eigen::Vector3d b = r.col(1);
  const Eigen::Vector3d third(
    a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
  if (third.dot(r.col(2)) < 0)
  {
    axes.rotation.col(0) *= -1;
    axes.scale.x() *= -1;
  }
  axes.rigid = true;
  return axes;
}

namespace
{
struct CopyOrder
{
  bool operator()(const Instance& copy, std::uint32_t id) const { return copy.copyOf < id; }
  bool operator()(std::uint32_t id, const Instance& copy) const { return id < copy.copyOf; }
};

bool seesInTime(const View& view, const Hit& hit, const Eigen::Vector2d& weights, Eigen::Vector2d& pixel)
{
  const SeenInTime seen = seenInTime(view, hit, weights);
  pixel = seen.pixel;
  return seen.seen;
}

/// A box of an object's vertices in its own frame, and of their projections.
class VertexBox
{
public:
  explicit VertexBox(const View& view)
    : TheView(view)
  {
  }

  /// Those of the triangles of an instance, whose hits have the number.
  void add(const Instance& instance, std::uint32_t number)
  {
    const bool isCopy = instance.copyOf != 0;
    const Affine3 camera_from_model = this->TheView.camera_from_world * instance.world_from_object;
    const std::vector<Eigen::Vector3d>& positions = instance.geometry->positions;
    std::vector<char> used(positions.size(), 0);
    for (std::size_t t = 0; t < instance.model->triangles.size(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::uint32_t corner = instance.model->triangles[t][std::size_t(k)];
        if (std::exchange(used[corner], 1) != 0)
        {
          continue;
        }
        const Eigen::Vector3d& x = positions[corner];
        const Eigen::Vector3d own = isCopy ? instance.object_from_model * x : x;
        this->Least = this->Least.cwiseMin(own);
        this->Most = this->Most.cwiseMax(own);
        Eigen::Vector2d pixel;
        const Eigen::Vector2d weights(k == 1 ? 1 : 0, k == 2 ? 1 : 0);
        if (this->TheView.instants ? seesInTime(this->TheView, { number, std::uint32_t(t) }, weights, pixel)
                                   : this->TheView.model->project(camera_from_model * x, pixel))
        {
          this->Projected.head<2>() = this->Projected.head<2>().cwiseMin(pixel);
          this->Projected.tail<2>() = this->Projected.tail<2>().cwiseMax(pixel);
        }
      }
    }
  }

  void store(const Affine3& camera_from_object, ObjectPose& pose) const
  {
    if (this->Projected[0] <= this->Projected[2])
    {
      pose.projected = this->Projected;
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      const Eigen::Vector3d x((corner & 1 ? this->Most : this->Least).x(), (corner & 2 ? this->Most : this->Least).y(),
        (corner & 4 ? this->Most : this->Least).z());
      pose.corners.row(corner) = (camera_from_object * x).transpose();
    }
  }

private:
  const View& TheView;
  Eigen::Vector3d Least = Eigen::Vector3d::Constant(infinite);
  Eigen::Vector3d Most = Eigen::Vector3d::Constant(-infinite);
  Eigen::Vector4d Projected{ infinite, infinite, -infinite, -infinite };
};
} // namespace

ObjectPose objectPose(const SceneState& state, std::uint32_t id, const View& view)
{
  ObjectPose pose;
  const Affine3 camera_from_object = view.camera_from_world * state.instances[id - 1].world_from_object;
  pose.matrix << camera_from_object.linear, camera_from_object.translation;
  pose.translation = camera_from_object.translation;
  const PlacedAxes axes = placedAxes(camera_from_object.linear);
  pose.rigid = axes.rigid;
  pose.rotation = axes.rotation;
  pose.scale = axes.scale;
  VertexBox box(view);
  const auto copies =
    std::equal_range(state.instances.begin() + std::ptrdiff_t(state.objects()), state.instances.end(), id, CopyOrder());
  if (copies.first == copies.second)
  {
    box.add(state.instances[id - 1], id);
  }
  for (auto copy = copies.first; copy != copies.second; ++copy)
  {
    box.add(*copy, std::uint32_t(copy - state.instances.begin()) + 1);
  }
  box.store(camera_from_object, pose);
  return pose;
}

BlockObjects::BlockObjects(const SceneState& state, const View& view)
  : Columns((view.model->width() >> shift) + 1)
  , RowCount((view.model->height() >> shift) + 1)
  , Blocks(std::size_t(this->Columns) * this->RowCount, 0)
{
  for (std::size_t i = 0; i < state.instances.size(); ++i)
  {
    if (state.instances[i].visible || view.instants)
    {
      this->markObject(state.objectOf(static_cast<std::uint32_t>(i + 1)), state.instances[i], view);
    }
  }
}

void BlockObjects::mark(std::uint32_t object, double x0, double y0, double x1, double y1)
{
  const auto block = [](double at, int count)
  { return static_cast<int>(std::clamp(std::floor(at / (1 << shift)), -1.0, double(count))); };
  const int left = std::max(0, block(x0, this->Columns));
  const int right = std::min(this->Columns - 1, block(x1, this->Columns));
  const int bottom = std::min(this->RowCount - 1, block(y1, this->RowCount));
  for (int y = std::max(0, block(y0, this->RowCount)); y <= bottom; ++y)
  {
    std::uint32_t* row = this->Blocks.data() + std::size_t(y) * this->Columns;
    for (int x = left; x <= right; ++x)
    {
      row[x] = row[x] == 0 || row[x] == object ? object : several;
    }
  }
}

PixelRect BlockObjects::occupied(const PixelRect& rect) const
{
  const int left = rect.x >> shift;
  const int right = (rect.x + rect.width - 1) >> shift;
  int x0 = right + 1;
  int x1 = left - 1;
  int y0 = 0;
  int y1 = -1;
  for (int y = rect.y >> shift; y <= (rect.y + rect.height - 1) >> shift; ++y)
  {
    const std::uint32_t* row = this->Blocks.data() + std::size_t(y) * this->Columns;
    for (int x = left; x <= right; ++x)
    {
      if (row[x] != 0)
      {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = y1 < 0 ? y : y0;
        y1 = y;
      }
    }
  }
  PixelRect found{ rect.x, rect.y, 0, 0 };
  if (x0 <= x1)
  {
    found.x = std::max(rect.x, x0 << shift);
    found.y = std::max(rect.y, y0 << shift);
    found.width = std::min(rect.x + rect.width, (x1 + 1) << shift) - found.x;
    found.height = std::min(rect.y + rect.height, (y1 + 1) << shift) - found.y;
  }
  return found;
}

/// The part of a triangle beyond near, by its corners in the camera frame: a triangle that reaches behind the camera.
void BlockObjects::markCut(std::uint32_t object, const Eigen::Vector3d corners[3], const View& view)
{
  Eigen::Array2d least = Eigen::Array2d::Constant(infinite);
  Eigen::Array2d most = -least;
  const auto add = [&](const Eigen::Vector3d& x)
  {
    Eigen::Vector2d pixel;
    if (view.model->project(x, pixel))
    {
      least = least.min(pixel.array());
      most = most.max(pixel.array());
    }
  };
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % 3];
    if (a.z() >= view.near)
    {
      add(a);
    }
    if ((a.z() >= view.near) != (b.z() >= view.near))
    {
      Eigen::Vector3d cut = a + (view.near - a.z()) / (b.z() - a.z()) * (b - a);
      cut.z() = view.near;
      add(cut);
    }
  }
  if (least.x() <= most.x())
  {
    this->mark(object, least.x() - margin, least.y() - margin, most.x() + margin, most.y() + margin);
  }
}

void BlockObjects::markObject(std::uint32_t object, const Instance& instance, const View& view)
{
  if (!view.model->linear() || view.instants) // lines are curved
  {
    this->mark(object, 0, 0, view.model->width(), view.model->height());
    return;
  }
  struct Projected
  {
    Eigen::Vector2d pixel;
    bool seen;
  };
  const Affine3 camera_from_object = view.camera_from_world * instance.world_from_object;
  const std::vector<Eigen::Vector3d>& positions = instance.geometry->positions;
  std::vector<Projected> vertices(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const Eigen::Vector3d x = camera_from_object * positions[i];
    vertices[i].seen = x.z() >= view.near && view.model->project(x, vertices[i].pixel);
  }
  for (const auto& corners : instance.model->triangles)
  {
    const Projected* v[3] = { &vertices[corners[0]], &vertices[corners[1]], &vertices[corners[2]] };
    if (v[0]->seen && v[1]->seen && v[2]->seen)
    {
      this->mark(object, std::min({ v[0]->pixel.x(), v[1]->pixel.x(), v[2]->pixel.x() }) - margin,
        std::min({ v[0]->pixel.y(), v[1]->pixel.y(), v[2]->pixel.y() }) - margin,
        std::max({ v[0]->pixel.x(), v[1]->pixel.x(), v[2]->pixel.x() }) + margin,
        std::max({ v[0]->pixel.y(), v[1]->pixel.y(), v[2]->pixel.y() }) + margin);
    }
    else if (v[0]->seen || v[1]->seen || v[2]->seen)
    {
      const Eigen::Vector3d cut[3] = { camera_from_object * positions[corners[0]],
        camera_from_object * positions[corners[1]], camera_from_object * positions[corners[2]] };
      this->markCut(object, cut, view);
    }
  }
}

void collectObjects(const SceneState& state, const View& view, const OcclusionQuery& occlusion,
  const BlockObjects& blocks, const PixelRect& rect, const Hit* hits, bool amodalRuns, ObjectRows& rows)
{
  const std::size_t objects = state.objects();
  rows.visible.assign(objects, {});
  rows.amodal.assign(objects, {});
  std::vector<Eigen::Vector2d> asked;
  std::vector<std::vector<Hit>> all;
  std::vector<std::size_t> answers;          // of pixels: 1 + the place in `all`, 0: not asked
  std::vector<std::size_t> seen(objects, 0); // 1 + the pixel at which an object was met last
  const auto width = static_cast<std::size_t>(rect.width);
  const auto indexOf = [&](int x, int y)
  { return static_cast<std::size_t>(y - rect.y) * width + static_cast<std::size_t>(x - rect.x); };
  for (int top = 0; top < rect.height; top += rowsOfBlocks(rect.y + top, rect.height - top))
  {
    const PixelRect part{ rect.x, rect.y + top, rect.width, rowsOfBlocks(rect.y + top, rect.height - top) };
    const std::size_t start = indexOf(part.x, part.y);
    asked.clear();
    answers.assign(width * static_cast<std::size_t>(part.height), 0);
    forPixelBlocks(part,
      [&](int x, int y)
      {
        const std::uint32_t object = state.objectOf(hits[indexOf(x, y)].object);
        if (object != 0 && blocks.mayHideOthers(x, y, object))
        {
          asked.emplace_back(x + 0.5, y + 0.5);
          answers[indexOf(x, y) - start] = asked.size();
        }
      });
    all.resize(std::max(all.size(), asked.size()));
    occlusion.allHits(view, asked.data(), asked.size(), all.data());
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      const std::uint32_t first = state.objectOf(hits[start + i].object);
      if (first == 0)
      {
        continue; // the ray meets nothing
      }
      const int x = rect.x + static_cast<int>(i % width);
      const int y = part.y + static_cast<int>(i / width);
      rows.visible[first - 1].add(x, y, false);
      rows.amodal[first - 1].add(x, y, amodalRuns);
      if (answers[i] == 0)
      {
        continue;
      }
      seen[first - 1] = start + i + 1;
      for (const Hit& hit : all[answers[i] - 1])
      {
        const std::size_t object = state.objectOf(hit.object) - 1;
        if (std::exchange(seen[object], start + i + 1) != start + i + 1)
        {
          rows.amodal[object].add(x, y, amodalRuns);
        }
      }
    }
  }
}

} // namespace dgtk
