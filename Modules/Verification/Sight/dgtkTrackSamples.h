// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTrackSamples_h
#define dgtkTrackSamples_h

#include "dgtkDataset.h"
#include "dgtkMeter.h"
#include "dgtkTimedSight.h"
#include "dgtkTrackDocuments.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A view of a run with the places that it claims for the points of its tracks.
struct TrackView
{
  int index = 0;        ///< among the views of the run
  bool sampled = false; ///< it may have points of its own
  std::string file;
  std::shared_ptr<const TimedSight> sight;
  std::vector<TrackPlace> places;
};

/// A point as the check needs it.
struct TrackOrigin
{
  Hit hit;
  int view = -1; ///< index of the view that it was sampled in; -1: none
};

constexpr int trackVisible = 1;
/// Of a rolling shutter one of so many points and pixels is looked at: a scene of its own for each takes its time.
constexpr int trackInstantStep = 8;

/// Whether the points of a view are those that its grid gives: one at each of its pixels with a surface unless an
/// earlier point is visible within half a step, from left to right in rows from top to bottom.
Meter meterTrackSamples(Dataset& dataset, const TrackView& view, const std::vector<TrackOrigin>& points, int step);

} // namespace dgtk

#endif
