// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTrackSeeds_h
#define dgtkTrackSeeds_h

// Private to Layers.

#include "dgtkCorrespondence.h"
#include "dgtkLayers.h"
#include "dgtkTrackDocuments.h"

#include <mutex>
#include <vector>

namespace dgtk
{

/// The points that the tracks of a run follow, in their order.
struct TrackSeeds
{
  /// Where a point was sampled.
  struct Origin
  {
    Job view;
    Eigen::Vector2d pixel{ 0, 0 }; ///< a pixel's centre
  };
  std::vector<FixedPoint> points;
  std::vector<Origin> origins; ///< one a point
};

/// Where points are in a view, by several threads; `places` as many.
void followPoints(
  const OtherView& view, const std::vector<FixedPoint>& points, ThreadPool& pool, std::vector<Correspondence>& places);

/// What the pictures of a run share: its points and the file that lists them, both made when the first picture asks.
class TrackRun
{
public:
  explicit TrackRun(SharedPlace place)
    : Place(std::move(place))
  {
  }
  /// Of the whole run that `context` is a picture of.
  const TrackSeeds& seeds(const JobContext& context);
  /// To be called after seeds().
  const FileRecord& file() const { return this->File; }

private:
  SharedPlace Place;
  std::once_flag Once;
  TrackSeeds Seeds;
  FileRecord File;
};

/// Pixels between samples, and frames of the run between those that are sampled.
const IntegerOption& tracksStep();
const IntegerOption& tracksEvery();

} // namespace dgtk

#endif
