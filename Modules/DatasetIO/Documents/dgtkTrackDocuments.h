// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTrackDocuments_h
#define dgtkTrackDocuments_h

#include "dgtkDatasetIOModule.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// The files of the layer `tracks`; see Documentation/Formats/tracks.md. Every `...Text` function is a pure function;
// every `read...` function throws an InputError that names the file and the place.

namespace dgtk
{

/// The file that all views of a run share, relative to the dataset.
inline constexpr const char* trackPointsFile = "tracks/points.json";

/// A surface point that is fixed on its triangle and followed through all views of a run.
struct TrackPoint
{
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;             ///< over the whole model of the object
  Eigen::Vector3d barycentric{ 1, 0, 0 }; ///< weights of the triangle's corners, sum 1
  Eigen::Vector3d x{ 0, 0, 0 };           ///< world, at the first frame of the run
  std::uint8_t color[3] = { 0, 0, 0 };    ///< albedo, sRGB
  bool isStatic = false;                  ///< `static` in the file: its object neither moves nor deforms
  std::string camera;                     ///< of the view that it was sampled in
  int frame = 0;                          ///< likewise
};
DGTKDATASETIO_EXPORT std::string tracksText(const std::vector<TrackPoint>& points);
DGTKDATASETIO_EXPORT std::vector<TrackPoint> readTrackPoints(const std::string& path);

/// Where a point is in a view: u, v in pixels, NaN for the classes 0 and 5, and its visibility class.
struct TrackPlace
{
  double u = 0;
  double v = 0;
  double visibility = 0;
};
/// The bytes of a `.npy` of shape (places, 3).
DGTKDATASETIO_EXPORT std::string trackPlacesNpy(const std::vector<TrackPlace>& places);
/// The places of a view; `points` as many as readTrackPoints() gives, which the file must have.
DGTKDATASETIO_EXPORT std::vector<TrackPlace> readTrackPlaces(const std::string& path, std::size_t points);

} // namespace dgtk

#endif
