// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInstantSource.h"

namespace dgtk
{

namespace
{
std::vector<double> timesOf(const CameraModel& model, const PixelRect& rect, int y)
{
  std::vector<double> times(static_cast<std::size_t>(rect.width));
  for (int x = 0; x < rect.width; ++x)
  {
    times[std::size_t(x)] = model.timeAt({ rect.x + x + 0.5, y + 0.5 });
  }
  return times;
}

/// Neighbours of one time in one part.
void addRuns(const std::vector<double>& times, PixelRect rect, std::vector<TimedRect>& parts)
{
  const int left = rect.x;
  for (std::size_t first = 0; first < times.size();)
  {
    std::size_t end = first + 1;
    while (end < times.size() && times[end] == times[first])
    {
      ++end;
    }
    rect.x = left + int(first);
    rect.width = int(end - first);
    parts.push_back({ rect, times[first] });
    first = end;
  }
}
} // namespace

std::vector<TimedRect> timedRects(const CameraModel& model, const PixelRect& rect)
{
  const std::vector<double> first = timesOf(model, rect, rect.y);
  for (int y = rect.y + 1; y < rect.y + rect.height; ++y)
  {
    if (timesOf(model, rect, y) != first)
    {
      return timedRuns(model, rect);
    }
  }
  std::vector<TimedRect> parts;
  addRuns(first, rect, parts);
  return parts;
}

std::vector<TimedRect> timedRuns(const CameraModel& model, const PixelRect& rect)
{
  std::vector<TimedRect> parts;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
  {
    addRuns(timesOf(model, rect, y), { rect.x, y, rect.width, 1 }, parts);
  }
  return parts;
}

} // namespace dgtk
