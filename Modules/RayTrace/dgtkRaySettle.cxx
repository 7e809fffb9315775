// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySettle.h"

#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int chunkRows = 16;

struct Change
{
  std::size_t index;
  Hit hit;
};

/// Pixels: below this error of single precision, few rays pass an edge so closely, and one that is missed for want of a
/// jump in depth is rarer still.
constexpr double smallError = 1.0 / 128;

class Settler
{
public:
  Settler(const RayScene& scene, const dgtk::View& view, const RayMarks& marks, const VisibilityBuffer& buffer)
    : Scene(scene)
    , TheView(view)
    , Marks(marks)
    , Buffer(buffer)
    , EveryEdge(!(scene.errorInPixels(view) < smallError))
  {
  }

  void row(int y, std::vector<Change>& changes)
  {
    const int width = this->Buffer.rect.width;
    const std::size_t start = std::size_t(y) * width;
    this->findSuspects(y);
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = start + x;
      const bool doubtful = this->Marks.doubtful[i] != 0;
      if ((doubtful && !this->isMet(this->Buffer.hits[i], i)) ||
          (this->Suspects[x] != 0 && this->isCovered(this->Suspects[x], i)))
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

  /// Whether a neighbour's surface is met before the recorded one.
  bool comesFirst(std::size_t neighbour, std::size_t i) const
  {
    const Hit& own = this->Buffer.hits[i];
    const Hit& other = this->Buffer.hits[neighbour];
    if (other.object == 0 || other == own)
    {
      return false;
    }
    const ExactRay ray = this->rayAt(i);
    const ExactHit first = this->Scene.intersect(ray, other);
    return first.inside &&
           (own.object == 0 || comesBefore(first.t, other, this->Scene.intersectTriangle(ray, own).t, own));
  }

  /// A row of the buffer with its first and last pixel doubled.
  struct Row
  {
    std::vector<float> nearness;
    std::vector<std::uint32_t> objects;
  };
  static constexpr int pad = 2;

  void load(int y, Row& row) const
  {
    const int width = this->Buffer.rect.width;
    const int clamped = std::clamp(y, 0, this->Buffer.rect.height - 1);
    const std::size_t start = std::size_t(clamped) * width;
    row.nearness.resize(std::size_t(width) + 2 * pad);
    row.objects.resize(std::size_t(width) + 2 * pad);
    std::copy_n(this->Marks.nearness.begin() + start, width, row.nearness.begin() + pad);
    const Hit* hits = this->Buffer.hits.data() + start;
    std::uint32_t* objects = row.objects.data() + pad;
    for (int x = 0; x < width; ++x)
    {
      objects[x] = hits[x].object;
    }
    for (int i = 0; i < pad; ++i)
    {
      row.nearness[i] = row.nearness[pad];
      row.objects[i] = row.objects[pad];
      row.nearness[std::size_t(width) + pad + i] = row.nearness[std::size_t(width) + pad - 1];
      row.objects[std::size_t(width) + pad + i] = row.objects[std::size_t(width) + pad - 1];
    }
  }

  Row& ringRow(int y) { return this->Rows[(y + 10) % 5]; }

  /// Marks the pixels, and on which side, beside a nearer surface that may have an edge there: of another object, or
  /// one whose 1 / t changes by much more than it does beyond. (On a plane 1 / t changes evenly.)
  void findSuspects(int y)
  {
    const int width = this->Buffer.rect.width;
    if (this->EveryEdge)
    {
      this->Suspects.assign(width, (y > 0 ? Above : 0) | (y + 1 < this->Buffer.rect.height ? Below : 0) | Left | Right);
      this->Suspects.front() &= ~Left;
      this->Suspects.back() &= ~Right;
      return;
    }
    // Rows go round: of the next one only the last is new.
    for (int i = y == this->Loaded ? 2 : -2; i <= 2; ++i)
    {
      this->load(y + i, this->ringRow(y + i));
    }
    this->Loaded = y + 1;
    this->Suspects.assign(width, 0);
    const Row& row = this->ringRow(y);
    this->compare(row, row, 1, row, 2, Right);
    this->compare(row, row, -1, row, -2, Left);
    this->compare(row, this->ringRow(y - 1), 0, this->ringRow(y - 2), 0, Above);
    this->compare(row, this->ringRow(y + 1), 0, this->ringRow(y + 2), 0, Below);
  }

  void compare(const Row& own, const Row& next, int nextShift, const Row& beyond, int beyondShift, int side)
  {
    const int width = this->Buffer.rect.width;
    const float* a = own.nearness.data() + pad;
    const float* b = next.nearness.data() + pad + nextShift;
    const float* c = beyond.nearness.data() + pad + beyondShift;
    const std::uint32_t* p = own.objects.data() + pad;
    const std::uint32_t* q = next.objects.data() + pad + nextShift;
    int* out = this->Suspects.data();
    for (int x = 0; x < width; ++x)
    {
      const float jump = b[x] - a[x];
      const int steep = jump > jumpFactor * std::abs(c[x] - b[x]);
      const int other = (p[x] != q[x]) & (jump >= 0);
      out[x] |= -(steep | other) & side;
    }
  }

  /// Whether the surface of a neighbour on one of the sides is met before what is recorded.
  bool isCovered(int sides, std::size_t i) const
  {
    const std::size_t width = std::size_t(this->Buffer.rect.width);
    return ((sides & Right) != 0 && this->comesFirst(i + 1, i)) ||
           ((sides & Left) != 0 && this->comesFirst(i - 1, i)) ||
           ((sides & Above) != 0 && this->comesFirst(i - width, i)) ||
           ((sides & Below) != 0 && this->comesFirst(i + width, i));
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

  static constexpr float jumpFactor = 2;
  enum Side
  {
    Right = 1,
    Left = 2,
    Above = 4,
    Below = 8
  };

  const RayScene& Scene;
  const dgtk::View& TheView;
  const RayMarks& Marks;
  const VisibilityBuffer& Buffer;
  bool EveryEdge; ///< of every triangle is looked at, not only where the depth jumps
  std::vector<RayHit> Found;
  Row Rows[5];
  int Loaded = -1; ///< the row around which all but the last of Rows are loaded
  std::vector<int> Suspects;
};

} // namespace

void settleMarked(
  const RayScene& scene, const View& view, const RayMarks& marks, VisibilityBuffer& buffer, ThreadPool& pool)
{
  const int height = buffer.rect.height;
  const int chunks = (height + chunkRows - 1) / chunkRows;
  std::vector<std::vector<Change>> changes(static_cast<std::size_t>(chunks));
  pool.parallelFor(chunks,
    [&](int chunk)
    {
      const WorkTime time(WorkStage::Settle);
      Settler settler(scene, view, marks, buffer);
      const int first = chunk * chunkRows;
      for (int y = first; y < std::min(height, first + chunkRows); ++y)
      {
        settler.row(y, changes[chunk]);
      }
    });
  for (const std::vector<Change>& part : changes)
  {
    for (const Change& change : part)
    {
      buffer.hits[change.index] = change.hit;
    }
  }
}

} // namespace dgtk
