// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySettle.h"

#include "dgtkThreadPool.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int ChunkRows = 16;

struct Change
{
  std::size_t index;
  Hit hit;
};

class Settler
{
public:
  Settler(const RayScene& scene, const dgtk::View& view, const RayMarks& marks, const VisibilityBuffer& buffer)
    : Scene(scene)
    , TheView(view)
    , Marks(marks)
    , Buffer(buffer)
  {
  }

  void row(int y, std::vector<Change>& changes)
  {
    const int width = this->Buffer.rect.width;
    const std::size_t start = std::size_t(y) * width;
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = start + x;
      const bool wrong = (this->Marks.doubtful[i] && !this->isMet(this->Buffer.hits[i], i)) ||
                         (x > 0 && this->isCovered(i, i - 1, x > 1 ? i - 2 : i - 1)) ||
                         (x + 1 < width && this->isCovered(i, i + 1, x + 2 < width ? i + 2 : i + 1)) ||
                         (y > 0 && this->isCovered(i, i - width, y > 1 ? i - 2 * width : i - width)) ||
                         (y + 1 < this->Buffer.rect.height &&
                           this->isCovered(i, i + width, y + 2 < this->Buffer.rect.height ? i + 2 * width : i + width));
      if (wrong)
      {
        this->decide(i, changes);
      }
    }
  }

private:
  ExactRay rayAt(std::size_t i) const
  {
    const PixelRect& rect = this->Buffer.rect;
    return rayOf(
      this->TheView, Eigen::Vector2d(rect.x + int(i % rect.width) + 0.5, rect.y + int(i / rect.width) + 0.5));
  }

  bool isMet(const Hit& hit, std::size_t i) const { return this->Scene.intersect(this->rayAt(i), hit).inside; }

  /// Whether a nearer surface of the neighbour contains the pixel's centre although something else is recorded there.
  /// `beyond` is the neighbour's neighbour on the same line.
  bool isCovered(std::size_t i, std::size_t neighbour, std::size_t beyond) const
  {
    const Hit& other = this->Buffer.hits[neighbour];
    if (other == this->Buffer.hits[i] || other.object == 0)
    {
      return false;
    }
    const float own = this->Marks.nearness[i];
    const float next = this->Marks.nearness[neighbour];
    if (next < own)
    {
      return false;
    }
    // The surface that goes on evenly has no silhouette here.
    const bool even = next - own <= JumpFactor * std::abs(this->Marks.nearness[beyond] - next);
    return !(even && other.object == this->Buffer.hits[i].object) && this->isMet(other, i);
  }

  void decide(std::size_t i, std::vector<Change>& changes)
  {
    collectHits(this->Scene, this->rayAt(i), true, this->Found);
    const Hit hit = this->Found.empty() ? Hit{} : this->Found.front().hit;
    if (hit != this->Buffer.hits[i])
    {
      changes.push_back({ i, hit });
    }
  }

  static constexpr float JumpFactor = 2;

  const RayScene& Scene;
  const dgtk::View& TheView;
  const RayMarks& Marks;
  const VisibilityBuffer& Buffer;
  std::vector<RayHit> Found;
};

} // namespace

std::size_t settleMarked(
  const RayScene& scene, const View& view, const RayMarks& marks, VisibilityBuffer& buffer, ThreadPool& pool)
{
  const int height = buffer.rect.height;
  std::vector<std::vector<Change>> changes(std::size_t((height + ChunkRows - 1) / ChunkRows));
  pool.parallelFor(int(changes.size()),
    [&](int chunk)
    {
      Settler settler(scene, view, marks, buffer);
      for (int y = chunk * ChunkRows; y < std::min(height, (chunk + 1) * ChunkRows); ++y)
      {
        settler.row(y, changes[chunk]);
      }
    });
  std::size_t changed = 0;
  for (const std::vector<Change>& part : changes)
  {
    for (const Change& change : part)
    {
      buffer.hits[change.index] = change.hit;
    }
    changed += part.size();
  }
  return changed;
}

} // namespace dgtk
