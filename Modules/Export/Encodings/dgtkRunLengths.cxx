// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunLengths.h"

#include "dgtkDatasetView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dgtk
{

std::uint64_t RunLengths::area() const
{
  std::uint64_t sum = 0;
  for (std::size_t i = 1; i < this->counts.size(); i += 2)
  {
    sum += this->counts[i];
  }
  return sum;
}

Eigen::Vector4d RunLengths::box() const
{
  const auto rows = static_cast<std::uint64_t>(this->height);
  std::uint64_t x0 = static_cast<std::uint64_t>(this->width);
  std::uint64_t y0 = rows;
  std::uint64_t x1 = 0;
  std::uint64_t y1 = 0;
  std::uint64_t at = 0;
  for (std::size_t i = 0; i < this->counts.size(); at += this->counts[i++])
  {
    if (i % 2 == 0 || this->counts[i] == 0)
    {
      continue;
    }
    const std::uint64_t last = at + this->counts[i] - 1;
    const bool oneColumn = at / rows == last / rows;
    x0 = std::min(x0, at / rows);
    x1 = std::max(x1, last / rows + 1);
    y0 = std::min(y0, oneColumn ? at % rows : 0);
    y1 = std::max(y1, oneColumn ? last % rows + 1 : rows);
  }
  return x1 == 0 ? Eigen::Vector4d::Zero().eval()
                 : Eigen::Vector4d(double(x0), double(y0), double(x1 - x0), double(y1 - y0));
}

std::string RunLengths::compressed() const
{
  constexpr std::int64_t bits = 5;
  constexpr std::int64_t low = 31;
  constexpr std::int64_t sign = 16;
  constexpr std::int64_t more = 32;
  constexpr std::int64_t firstCharacter = 48;
  std::string text;
  for (std::size_t i = 0; i < this->counts.size(); ++i)
  {
    auto value = static_cast<std::int64_t>(this->counts[i]);
    value -= i > 2 ? static_cast<std::int64_t>(this->counts[i - 2]) : 0;
    for (bool goes = true; goes;)
    {
      std::int64_t code = value & low;
      value >>= bits;
      goes = (code & sign) != 0 ? value != -1 : value != 0;
      code |= goes ? more : 0;
      text += static_cast<char>(code + firstCharacter);
    }
  }
  return text;
}

namespace
{
/// Ids of all pixels, column by column.
std::vector<std::uint32_t> columnsOf(const Rows& objects)
{
  constexpr int together = 16; ///< rows: of a column they are what a processor writes at a time
  const auto width = std::size_t(objects.width());
  const auto height = std::size_t(objects.height());
  std::vector<std::uint32_t> columns(width * height);
  std::vector<std::vector<std::uint32_t>> rows(together, std::vector<std::uint32_t>(width));
  for (int y = 0; y < objects.height(); y += together)
  {
    const int count = std::min(together, objects.height() - y);
    for (int i = 0; i < count; ++i)
    {
      for (std::size_t x = 0; x < width; ++x)
      {
        rows[std::size_t(i)][x] = idAt(objects, int(x), y + i);
      }
    }
    for (std::size_t x = 0; x < width; ++x)
    {
      for (int i = 0; i < count; ++i)
      {
        columns[x * height + std::size_t(y + i)] = rows[std::size_t(i)][x];
      }
    }
  }
  return columns;
}
} // namespace

std::map<std::uint32_t, RunLengths> masksOf(const Rows& objects)
{
  const int width = objects.width();
  const int height = objects.height();
  std::map<std::uint32_t, RunLengths> masks;
  std::map<std::uint32_t, std::uint64_t> ends; // of the last run
  std::uint32_t current = 0;
  std::uint64_t begin = 0;
  const auto close = [&](std::uint64_t end)
  {
    if (current != 0 && end > begin)
    {
      RunLengths& mask = masks[current];
      mask.counts.push_back(begin - ends[current]);
      mask.counts.push_back(end - begin);
      ends[current] = end;
    }
    begin = end;
  };
  std::uint64_t at = 0;
  for (const std::uint32_t id : columnsOf(objects))
  {
    if (id != current)
    {
      close(at);
      current = id;
    }
    ++at;
  }
  close(at);
  for (auto& [id, mask] : masks)
  {
    mask.width = width;
    mask.height = height;
    if (ends[id] < at)
    {
      mask.counts.push_back(at - ends[id]);
    }
  }
  return masks;
}

namespace
{
/// Pixels of a mask, beyond which there is nothing.
class MaskPixels
{
public:
  explicit MaskPixels(const RunLengths& mask)
    : Width(mask.width)
    , Height(mask.height)
    , Inside(std::size_t(mask.width) * mask.height)
  {
    std::size_t at = 0;
    for (std::size_t i = 0; i < mask.counts.size(); at += mask.counts[i++])
    {
      std::fill_n(this->Inside.begin() + std::ptrdiff_t(at), mask.counts[i], char(i % 2));
    }
  }
  bool operator()(int x, int y) const
  {
    return x >= 0 && y >= 0 && x < this->Width && y < this->Height &&
           this->Inside[std::size_t(x) * this->Height + std::size_t(y)] != 0;
  }

private:
  int Width;
  int Height;
  std::vector<char> Inside; // column by column
};

// Steps along the borders with the mask on the right hand: right, down, left, up.
constexpr std::array<std::array<int, 2>, 4> steps{ { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } } };

/// Whether a step from a corner of pixels has the mask on its right and nothing on its left.
bool isBorder(const MaskPixels& mask, int x, int y, int direction)
{
  // pixels around the corner: the one on the right of a step to the right is (x, y), of one down (x - 1, y), ...
  static constexpr std::array<std::array<int, 2>, 4> right{ { { 0, 0 }, { -1, 0 }, { -1, -1 }, { 0, -1 } } };
  static constexpr std::array<std::array<int, 2>, 4> left{ { { 0, -1 }, { 0, 0 }, { -1, 0 }, { -1, -1 } } };
  const auto d = static_cast<std::size_t>(direction);
  return mask(x + right[d][0], y + right[d][1]) && !mask(x + left[d][0], y + left[d][1]);
}

double signedArea(const std::vector<double>& loop)
{
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); i += 2)
  {
    const std::size_t j = (i + 2) % loop.size();
    twice += loop[i] * loop[j + 1] - loop[j] * loop[i + 1];
  }
  return twice / 2;
}
} // namespace

std::vector<std::vector<double>> bordersOf(const RunLengths& mask)
{
  const MaskPixels inside(mask);
  // tops of pixels that a loop has passed, from left to right
  std::vector<char> passed(std::size_t(mask.width) * (std::size_t(mask.height) + 1));
  const auto top = [&](int x, int y) { return std::size_t(y) * mask.width + std::size_t(x); };
  std::vector<std::vector<double>> loops;
  for (int y = 0; y < mask.height; ++y)
  {
    for (int x = 0; x < mask.width; ++x)
    {
      if (passed[top(x, y)] != 0 || !isBorder(inside, x, y, 0))
      {
        continue;
      }
      std::vector<double> loop{ double(x), double(y) };
      int px = x;
      int py = y;
      int direction = 0;
      do
      {
        if (direction == 0)
        {
          passed[top(px, py)] = 1;
        }
        px += steps[std::size_t(direction)][0];
        py += steps[std::size_t(direction)][1];
        // around its own pixel first, so that pixels that touch at a corner stay apart
        int turned = (direction + 1) % 4;
        while (!isBorder(inside, px, py, turned))
        {
          turned = (turned + 3) % 4;
        }
        if (turned != direction)
        {
          loop.push_back(px);
          loop.push_back(py);
        }
        direction = turned;
      } while (px != x || py != y || direction != 0);
      loop.resize(loop.size() - 2); // the first corner again
      loops.push_back(loop);
    }
  }
  return loops;
}

std::vector<std::vector<double>> polygonsOf(const RunLengths& mask)
{
  std::vector<std::vector<double>> loops = bordersOf(mask);
  const bool hole =
    std::any_of(loops.begin(), loops.end(), [](const std::vector<double>& loop) { return signedArea(loop) < 0; });
  return hole ? std::vector<std::vector<double>>() : loops;
}

std::vector<double> joinedBorder(const RunLengths& mask)
{
  std::vector<double> joined;
  for (const std::vector<double>& loop : bordersOf(mask))
  {
    std::size_t from = 0; // the nearest corners of what there is and of the loop
    std::size_t to = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < joined.size(); i += 2)
    {
      for (std::size_t k = 0; k < loop.size(); k += 2)
      {
        const double apart = std::hypot(joined[i] - loop[k], joined[i + 1] - loop[k + 1]);
        from = apart < nearest ? i : from;
        to = apart < nearest ? k : to;
        nearest = std::min(nearest, apart);
      }
    }
    std::vector<double> way(loop.begin() + std::ptrdiff_t(to), loop.end());
    way.insert(way.end(), loop.begin(), loop.begin() + std::ptrdiff_t(to));
    if (!joined.empty())
    {
      way.insert(way.end(), { loop[to], loop[to + 1], joined[from], joined[from + 1] });
      from += 2;
    }
    joined.insert(joined.begin() + std::ptrdiff_t(joined.empty() ? 0 : from), way.begin(), way.end());
  }
  return joined;
}

} // namespace dgtk
