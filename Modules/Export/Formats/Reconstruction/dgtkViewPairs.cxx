// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewPairs.h"

#include "dgtkMovingObjects.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::size_t mostCandidates = 64; ///< whose scores are found over all points
constexpr std::size_t wordBits = 64;

/// Of how many points candidates are chosen: as many as candidates, fewer of very many views.
std::size_t samplesFor(std::size_t views)
{
  constexpr std::size_t least = 8;
  constexpr std::size_t looks = std::size_t(1) << 17; ///< at a point from a view, for all candidates of one
  return std::min(mostCandidates, std::max(least, looks / views));
}
} // namespace

void ViewPairs::read() const
{
  const std::vector<TrackPoint> all = trackPointsBut(this->Dataset, movingObjects(this->Dataset));
  for (const TrackPoint& point : all)
  {
    this->Points.push_back(point.x);
  }
  this->Words = (all.size() + wordBits - 1) / wordBits;
  this->Seen.assign(this->Dataset.shots().size() * this->Words, 0);
  for (const DatasetShot& shot : this->Dataset.shots())
  {
    this->Centres.push_back(cameraFromWorld(shot.camera).inverse().translation);
    const std::vector<TrackPlace> places =
      readTrackPlaces(this->Dataset.pathOf(this->Dataset.file(shot, "tracks", { "npy" })), all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const bool seen = all[i].isStatic && places[i].visibility == 1;
      this->Seen[shot.index * this->Words + i / wordBits] |= std::uint64_t(seen) << i % wordBits;
    }
  }
}

bool ViewPairs::sees(std::size_t view, std::uint32_t point) const
{
  return (this->Seen[view * this->Words + point / wordBits] >> point % wordBits & 1) != 0;
}

std::vector<std::uint32_t> ViewPairs::seenBy(std::size_t view) const
{
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    if (this->sees(view, std::uint32_t(i)))
    {
      seen.push_back(std::uint32_t(i));
    }
  }
  return seen;
}

double ViewPairs::weight(std::size_t a, std::size_t b, std::uint32_t point) const
{
  constexpr double best = 5;
  const Eigen::Vector3d one = this->Centres[a] - this->Points[point];
  const Eigen::Vector3d two = this->Centres[b] - this->Points[point];
  const double angle = portable::atan2(one.cross(two).norm(), one.dot(two)) * 180 / pi;
  const double width = angle <= best ? 1 : 10;
  return portable::exp(-(angle - best) * (angle - best) / (2 * width * width));
}

double ViewPairs::score(std::size_t a, std::size_t b, const std::vector<std::uint32_t>& seenByFirst) const
{
  double score = 0;
  for (const std::uint32_t point : seenByFirst)
  {
    score += this->sees(b, point) ? this->weight(a, b, point) : 0;
  }
  return score;
}

std::vector<std::size_t> ViewPairs::candidates(std::size_t view, const std::vector<std::uint32_t>& seen) const
{
  const std::size_t views = this->Centres.size();
  std::vector<std::uint32_t> some;
  const std::size_t samples = views > mostCandidates + 1 ? std::min(samplesFor(views), seen.size()) : 0;
  for (std::size_t i = 0; i < samples; ++i)
  {
    some.push_back(seen[(2 * i + 1) * seen.size() / (2 * samples)]);
  }
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t other = 0; other < views; ++other)
  {
    if (other != view)
    {
      others.emplace_back(-this->score(view, other, some), other);
    }
  }
  const std::size_t count = std::min(others.size(), mostCandidates);
  std::partial_sort(others.begin(), others.begin() + std::ptrdiff_t(count), others.end());
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers.push_back(others[i].second);
  }
  return numbers;
}

std::vector<std::pair<double, std::size_t>> ViewPairs::bestOf(std::size_t view, std::size_t most) const
{
  std::call_once(this->Once, [this] { this->read(); });
  const std::vector<std::uint32_t> seen = this->seenBy(view);
  std::vector<std::pair<double, std::size_t>> best;
  for (const std::size_t other : this->candidates(view, seen))
  {
    const double score = this->score(view, other, seen);
    if (score > 0)
    {
      best.emplace_back(score, other);
    }
  }
  std::sort(best.begin(), best.end(), // of equal ones the first
    [](const auto& a, const auto& b) { return a.first > b.first || (a.first == b.first && a.second < b.second); });
  best.resize(std::min(best.size(), most));
  return best;
}

} // namespace dgtk
