// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineRows.h"

#include <algorithm>
#include <cmath>

namespace dgtk::timeline
{

namespace
{
Row rowOf(const SceneDescription& scene, const ModelLibrary& models, const SceneItem& item)
{
  Row row;
  row.item = item;
  row.name = QString::fromStdString(itemName(scene, item));
  row.keys = keyFramesOf(scene, item);
  for (const int key : row.keys)
  {
    row.kinds.push_back(keyInterpolationOf(scene, item, key)->kind);
  }
  if (item.kind == SceneItem::Kind::Object)
  {
    row.bar = sequenceBar(scene, scene.objects[item.index], models);
  }
  row.height = rowHeight + (row.bar ? barHeight : 0);
  return row;
}
} // namespace

void TimeLineRows::fill(const SceneDescription& scene, const ModelLibrary& models)
{
  this->rows.clear();
  int top = 0;
  for (const SceneItem& item : scene.items())
  {
    this->rows.push_back(rowOf(scene, models, item));
    this->rows.back().top = top;
    top += this->rows.back().height;
  }
  this->keys = scene.keyFrames();
}

int TimeLineRows::frames(int now) const
{
  int last = this->keys.empty() ? 0 : this->keys.back();
  for (const Row& row : this->rows)
  {
    const double end = row.bar ? row.bar->start + (std::isinf(row.bar->length) ? 0 : row.bar->length) : 0;
    last = std::max(last, int(std::clamp(end, 0.0, double(largestFrame))));
  }
  return std::min(largestFrame + 1, std::max({ fewestFrames, last + framesAfterLast, now + framesAfterLast }));
}

int TimeLineRows::leftOf(int frame) const { return namesWidth + frame * cellWidth - this->scrolled.x(); }

int TimeLineRows::middleOf(double frame) const
{
  // Bars may begin and end far outside of the window.
  const double middle = namesWidth + (frame + 0.5) * cellWidth - this->scrolled.x();
  return int(std::clamp(middle, -1e6, 1e6));
}

int TimeLineRows::frameAt(int x) const
{
  return std::clamp((x - namesWidth + this->scrolled.x()) / cellWidth, 0, largestFrame);
}

Hit TimeLineRows::hitAt(const QPoint& at) const
{
  Hit hit;
  hit.frame = this->frameAt(at.x());
  const bool names = at.x() < namesWidth;
  if (at.y() < headerHeight)
  {
    const bool marks = at.y() >= headerHeight - headerMarks;
    const bool key = marks && std::binary_search(this->keys.begin(), this->keys.end(), hit.frame);
    hit.target = names ? Target::Nothing : key ? Target::SceneKey : Target::Frames;
    return hit;
  }
  for (std::size_t i = 0; i < this->rows.size(); ++i)
  {
    const Row& row = this->rows[i];
    const int y = at.y() - this->topOf(row);
    if (y < 0 || y >= row.height)
    {
      continue;
    }
    hit.row = i;
    hit.target = names ? Target::Names : Target::Frames;
    if (!names && y < rowHeight && std::binary_search(row.keys.begin(), row.keys.end(), hit.frame))
    {
      hit.target = Target::Key;
    }
    if (!names && y >= rowHeight && row.bar)
    {
      const int left = this->middleOf(row.bar->start);
      const int right =
        std::isinf(row.bar->length) ? this->width + 2 * edgeWidth : this->middleOf(row.bar->start + row.bar->length);
      const bool end = std::abs(at.x() - right) <= edgeWidth;
      hit.target = end ? Target::BarEnd : at.x() >= left && at.x() < right ? Target::Bar : Target::Frames;
    }
    break;
  }
  return hit;
}

SequenceBar TimeLineRows::draggedBar(std::size_t index, const std::optional<Drag>& drag) const
{
  SequenceBar bar = *this->rows[index].bar;
  if (drag && drag->from.row == index)
  {
    const int by = drag->to - drag->from.frame;
    if (drag->from.target == Target::Bar)
    {
      bar.start = std::round(bar.start) + by;
    }
    else if (drag->from.target == Target::BarEnd && by != 0)
    {
      bar.length = std::max(1.0, std::round(bar.start + bar.length) + by - bar.start);
    }
  }
  return bar;
}

} // namespace dgtk::timeline
