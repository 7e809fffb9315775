// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkLayerFile.h"
#include "dgtkPickleFile.h"
#include "dgtkText.h"
#include "dgtkZipFile.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr const char* format = "tapvid";
constexpr int visible = 1;

/// Tracks of one video: arrays with the points of a track one after another.
struct Tracks
{
  std::size_t frames = 0;
  std::vector<std::int64_t> numbers;  ///< of the points in tracks/points.json, from 0
  std::vector<std::int64_t> objects;  ///< their objects' ids
  std::vector<float> places;          ///< x, y as shares of the image
  std::vector<std::uint8_t> occluded; ///< 0 or 1
  std::vector<float> queries;         ///< frame, y, x of where each is seen first; pixels
};

/// All points that the camera sees at some frame. Places that there are not are 0, 0.
Tracks tracksOf(const DatasetView& dataset, const std::string& camera)
{
  const std::vector<TrackPoint> points = dataset.trackPoints();
  const std::vector<const DatasetShot*> shots = dataset.shotsOf(camera);
  std::vector<std::vector<TrackPlace>> places;
  std::vector<int> first(points.size(), -1);
  for (const DatasetShot* shot : shots)
  {
    places.push_back(readTrackPlaces(dataset.pathOf(dataset.file(*shot, "tracks", { "npy" })), points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      first[i] = first[i] < 0 && places.back()[i].visibility == visible ? int(places.size()) - 1 : first[i];
    }
  }
  Tracks tracks;
  tracks.frames = shots.size();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (first[i] < 0)
    {
      continue;
    }
    tracks.numbers.push_back(std::int64_t(i));
    tracks.objects.push_back(points[i].object);
    for (std::size_t t = 0; t < shots.size(); ++t)
    {
      const TrackPlace& place = places[t][i];
      const bool there = std::isfinite(place.u) && std::isfinite(place.v);
      tracks.places.push_back(there ? float(place.u / shots[t]->camera.width) : 0.0F);
      tracks.places.push_back(there ? float(place.v / shots[t]->camera.height) : 0.0F);
      tracks.occluded.push_back(place.visibility == visible ? 0 : 1);
    }
    const TrackPlace& query = places[std::size_t(first[i])][i];
    tracks.queries.insert(tracks.queries.end(), { float(first[i]), float(query.v), float(query.u) });
  }
  return tracks;
}

/// The bytes of a .npy; `type` as NumPy writes it.
template <typename T>
std::string npyOf(const std::string& type, const std::string& shape, const std::vector<T>& values)
{
  constexpr std::size_t block = 64;
  constexpr std::size_t before = 10;
  std::string head = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  head.resize((before + head.size() + 1 + block - 1) / block * block - before - 1, ' ');
  head += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  putLittle(bytes, std::uint16_t(head.size()));
  bytes += head;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return bytes;
}

/// Whether the videos are also in one file as the benchmark hands them out.
const ChoiceOption& pickle()
{
  static const ChoiceOption row(
    "pickle", { "on", "off" }, "tapvid.pkl as TAP-Vid's loaders read it, with all pictures uncompressed");
  return row;
}

class TapvidExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &pickle() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "tracks" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, format);
    std::map<std::string, const DatasetShot*> firsts;
    for (const DatasetShot& shot : dataset.shots())
    {
      const CameraRecord& first = firsts.emplace(shot.name(), &shot).first->second->camera;
      if (shot.camera.width != first.width || shot.camera.height != first.height)
      {
        throw UsageError(std::string(format) + ": camera " + quoted(shot.name()) + " has pictures of several sizes");
      }
    }
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    requireEverywhere(dataset, "tracks", format, { "npy" });
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "points", "x, y as shares of width and height from the image's corner; 0, 0 for no place" },
      { "query_points", "frame, y, x in pixels from the image's corner: where a point is seen first" },
      { "tracks", "points that the camera sees at some frame" } };
    const std::shared_ptr<const SafeNames> names = safeNamesOf(dataset);
    for (const std::string& camera : dataset.cameras())
    {
      const std::string folder = names->known(camera) + '/';
      int number = 0;
      for (const DatasetShot* shot : dataset.shotsOf(camera))
      {
        const std::string name = folder + "frames/" + padded(number++, 6) + '.' + pictureExtension(options);
        plan.items.push_back({ { name }, [&dataset, shot, name, options](ExportSink& sink)
          { writePicture(sink, dataset, *shot, exported::color().of(options), name, options); } });
        plan.names.push_back({ camera, shot->frame(), name });
      }
      const std::string archive = folder + "tracks.npz";
      plan.items.push_back({ { archive },
        [&dataset, camera, archive](ExportSink& sink) { writeTracks(sink, archive, tracksOf(dataset, camera)); } });
    }
    if (pickle().of(options) == "on")
    {
      plan.items.push_back({ { pickleName }, [&dataset, names, options](ExportSink& sink)
        {
          PickleFile file(sink, pickleName);
          for (const std::string& camera : dataset.cameras())
          {
            file.beginDictionary(names->known(camera));
            addVideo(file, dataset, camera, exported::color().of(options));
            file.endDictionary();
          }
          file.finish();
        } });
    }
    return plan;
  }

private:
  static constexpr const char* pickleName = "tapvid.pkl";

  /// "video" (T, H, W, 3), "points" (N, T, 2), "occluded" (N, T).
  static void addVideo(
    PickleFile& file, const DatasetView& dataset, const std::string& camera, const std::string& layer)
  {
    const std::vector<const DatasetShot*> shots = dataset.shotsOf(camera);
    const CameraRecord& first = shots.front()->camera;
    file.beginArray("video", "u1", { shots.size(), std::uint64_t(first.height), std::uint64_t(first.width), 3 });
    std::vector<std::uint8_t> row(3 * std::size_t(first.width));
    for (const DatasetShot* shot : shots)
    {
      const std::unique_ptr<RowReader> reader = dataset.open(*shot, layer, { "png" });
      const bool wide = reader->info().type == PixelType::UInt16;
      for (int y = 0; y < first.height; ++y)
      {
        const Rows rows = reader->read(1);
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          const double value = valueAt(rows, int(i / 3), y, int(i % 3));
          row[i] = static_cast<std::uint8_t>(wide ? value / 257 + 0.5 : value);
        }
        file.add(row.data(), row.size());
      }
    }
    file.endArray();
    const Tracks tracks = tracksOf(dataset, camera);
    const std::uint64_t points = tracks.numbers.size();
    file.beginArray("points", "f4", { points, tracks.frames, 2 });
    file.add(tracks.places.data(), tracks.places.size() * sizeof(float));
    file.endArray();
    file.beginArray("occluded", "b1", { points, tracks.frames });
    file.add(tracks.occluded.data(), tracks.occluded.size());
    file.endArray();
  }

  static void writeTracks(ExportSink& sink, const std::string& name, const Tracks& tracks)
  {
    const std::string points = std::to_string(tracks.numbers.size());
    const std::string places = points + ", " + std::to_string(tracks.frames);
    ZipFile file(sink, name);
    file.add("points.npy", npyOf("<f4", places + ", 2", tracks.places));
    file.add("occluded.npy", npyOf("|b1", places, tracks.occluded));
    file.add("query_points.npy", npyOf("<f4", points + ", 3", tracks.queries));
    file.add("track.npy", npyOf("<i8", points + ",", tracks.numbers));
    file.add("object.npy", npyOf("<i8", points + ",", tracks.objects));
    file.finish();
  }
};
} // namespace

std::unique_ptr<Exporter> makeTapvidExporter() { return std::make_unique<TapvidExporter>(); }

} // namespace dgtk
