// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRowWindow_h
#define dgtkRowWindow_h

#include "dgtkThreadPool.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace dgtk::sensor
{

/// Rows of an image that arrive top to bottom, kept as long as a row within `halo` of them is to be computed.
template <typename T>
class RowWindow
{
public:
  RowWindow(int height, int halo)
    : Height(height)
    , Halo(halo)
  {
  }

  void push(std::vector<T> row) { this->Kept.push_back(std::move(row)); }
  /// Rows before this one have all their neighbours.
  int ready() const
  {
    const int received = this->First + static_cast<int>(this->Kept.size());
    return received >= this->Height ? this->Height : std::max(this->Done, received - this->Halo);
  }
  /// The first row that was not yet released.
  int done() const { return this->Done; }
  /// Image row y, which must be within the halo of one that is ready.
  const std::vector<T>& at(int y) const { return this->Kept[static_cast<std::size_t>(y - this->First)]; }
  const std::vector<T>& clamped(int y) const { return this->at(std::min(std::max(y, 0), this->Height - 1)); }
  /// Rows before y are computed.
  void release(int y)
  {
    this->Done = y;
    for (; this->First < y - this->Halo && !this->Kept.empty(); ++this->First)
    {
      this->Kept.pop_front();
    }
  }

private:
  int Height;
  int Halo;
  int First = 0;
  int Done = 0;
  std::deque<std::vector<T>> Kept;
};

/// work(0) ... work(count - 1), by the pool when there is one.
inline void forEach(ThreadPool* pool, int count, const std::function<void(int)>& work)
{
  if (pool && count > 1)
  {
    pool->parallelFor(count, work);
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    work(i);
  }
}

/// Computes the rows of a window that are ready, make(y) for each, and releases them.
template <typename T, typename Make>
auto computeReady(RowWindow<T>& window, ThreadPool* pool, const Make& make)
{
  const int first = window.done();
  std::vector<decltype(make(0))> rows(static_cast<std::size_t>(window.ready() - first));
  forEach(pool, static_cast<int>(rows.size()), [&](int i) { rows[static_cast<std::size_t>(i)] = make(first + i); });
  window.release(first + static_cast<int>(rows.size()));
  return rows;
}

} // namespace dgtk::sensor

#endif
