// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkLayerFile.h"
#include "dgtkPickleFile.h"
#include "dgtkZipFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace dgtk
{

namespace
{
constexpr const char* tapvidName = "tapvid";
constexpr int visible = 1;

/// A place of a track in a picture.
struct Sight
{
  float x = 0; ///< shares of the image; 0, 0 where there is no place
  float y = 0;
  std::uint8_t occluded = 1;
};

/// The tracks of one video, those of all points that the camera sees at some frame. What it keeps does not grow with
/// the frames: the places are read when they are asked for.
class VideoTracks
{
public:
  VideoTracks(const DatasetView& dataset, const std::string& camera)
    : Dataset(dataset)
    , Shots(dataset.shotsOf(camera))
  {
    const std::vector<TrackPoint> points = dataset.trackPoints();
    this->Points = points.size();
    std::vector<std::array<float, 3>> first(points.size(), { -1, 0, 0 });
    for (std::size_t t = 0; t < this->Shots.size(); ++t)
    {
      const std::vector<TrackPlace> places = this->placesAt(t);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        if (first[i][0] < 0 && places[i].visibility == visible)
        {
          first[i] = { float(t), float(places[i].v), float(places[i].u) };
        }
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (first[i][0] >= 0)
      {
        this->Numbers.push_back(std::int64_t(i));
        this->Objects.push_back(points[i].object);
        this->Queries.push_back(first[i]);
      }
    }
  }

  std::size_t frames() const { return this->Shots.size(); }
  std::size_t count() const { return this->Numbers.size(); }
  /// Of the points in tracks/points.json, from 0.
  const std::vector<std::int64_t>& numbers() const { return this->Numbers; }
  /// Their objects' ids.
  const std::vector<std::int64_t>& objects() const { return this->Objects; }
  /// Frame, y, x of where each is seen first; pixels.
  const std::vector<std::array<float, 3>>& queries() const { return this->Queries; }

  /// Calls visit() with the places of each track, one a frame. Pictures lie frame by frame on the disk, and tracks are
  /// told one by one: as many as fit are turned at a time.
  void each(const std::function<void(const std::vector<Sight>&)>& visit) const
  {
    constexpr std::size_t most = (std::size_t(16) << 20) / sizeof(Sight);
    const std::size_t block = std::max<std::size_t>(1, most / std::max<std::size_t>(1, this->frames()));
    for (std::size_t begin = 0; begin < this->count(); begin += block)
    {
      std::vector<std::vector<Sight>> tracks(std::min(block, this->count() - begin));
      for (std::size_t t = 0; t < this->frames(); ++t)
      {
        const std::vector<TrackPlace> places = this->placesAt(t);
        for (std::size_t i = 0; i < tracks.size(); ++i)
        {
          tracks[i].resize(this->frames());
          tracks[i][t] = sightOf(places[std::size_t(this->Numbers[begin + i])], this->Shots[t]->camera);
        }
      }
      for (const std::vector<Sight>& track : tracks)
      {
        visit(track);
      }
    }
  }

private:
  std::vector<TrackPlace> placesAt(std::size_t t) const
  {
    const DatasetShot& shot = *this->Shots[t];
    return readTrackPlaces(this->Dataset.pathOf(this->Dataset.file(shot, "tracks", { "npy" })), this->Points);
  }

  static Sight sightOf(const TrackPlace& place, const CameraRecord& camera)
  {
    const bool there = std::isfinite(place.u) && std::isfinite(place.v);
    return { there ? float(place.u / camera.width) : 0.0F, there ? float(place.v / camera.height) : 0.0F,
      std::uint8_t(place.visibility == visible ? 0 : 1) };
  }

  const DatasetView& Dataset;
  std::vector<const DatasetShot*> Shots;
  std::size_t Points = 0;
  std::vector<std::int64_t> Numbers;
  std::vector<std::int64_t> Objects;
  std::vector<std::array<float, 3>> Queries;
};

using Put = std::function<void(const void*, std::size_t)>;

/// float32 (N, T, 2).
void putPlaces(const VideoTracks& tracks, const Put& put)
{
  std::vector<float> values;
  tracks.each(
    [&](const std::vector<Sight>& track)
    {
      values.clear();
      for (const Sight& sight : track)
      {
        values.insert(values.end(), { sight.x, sight.y });
      }
      put(values.data(), values.size() * sizeof(float));
    });
}

/// Truth values of a byte (N, T).
void putOccluded(const VideoTracks& tracks, const Put& put)
{
  std::vector<std::uint8_t> values;
  tracks.each(
    [&](const std::vector<Sight>& track)
    {
      values.clear();
      for (const Sight& sight : track)
      {
        values.push_back(sight.occluded);
      }
      put(values.data(), values.size());
    });
}

/// What stands before the values of a .npy; `type` as NumPy writes it.
std::string npyHead(const std::string& type, const std::string& shape)
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
  return bytes + head;
}

/// An archive's member of `bytes` behind its head.
void addArray(ZipFile& file, const std::string& name, const std::string& head, std::uint64_t bytes,
  const std::function<void(const Put&)>& fill)
{
  file.begin(name, head.size() + bytes);
  file.put(head.data(), head.size());
  fill([&](const void* data, std::size_t size) { file.put(data, size); });
  file.end();
}

template <typename T>
void addArray(ZipFile& file, const std::string& name, const std::string& head, const std::vector<T>& values)
{
  const std::size_t bytes = values.size() * sizeof(T);
  addArray(file, name, head, bytes, [&](const Put& put) { put(values.data(), bytes); });
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
    requireWhole(options, tapvidName);
    std::map<std::string, const DatasetShot*> firsts;
    for (const DatasetShot& shot : dataset.shots())
    {
      const CameraRecord& first = firsts.emplace(shot.name(), &shot).first->second->camera;
      if (shot.camera.width != first.width || shot.camera.height != first.height)
      {
        throw UsageError(
          std::string(tapvidName) + ": camera " + quoted(shot.name()) + " has pictures of several sizes");
      }
    }
    requireEverywhere(dataset, exported::color().of(options), tapvidName, { "png" });
    requireEverywhere(dataset, "tracks", tapvidName, { "npy" });
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
      const auto picture = [&dataset, folder, options](const DatasetShot& shot, std::size_t i)
      {
        const std::string name = folder + "frames/" + padded(static_cast<int>(i), 6) + '.' + pictureExtension(options);
        return named(shot, { { name }, [&dataset, &shot, name, options](ExportSink& sink)
                             { writePicture(sink, dataset, shot, exported::color().of(options), name, options); } });
      };
      plan.series.push_back(seriesOf(dataset, camera, picture));
      const std::string archive = folder + "tracks.npz";
      plan.series.push_back(seriesOf({ { archive },
        [&dataset, camera, archive](ExportSink& sink) { writeTracks(sink, archive, VideoTracks(dataset, camera)); } }));
    }
    if (pickle().of(options) == "on")
    {
      plan.series.push_back(seriesOf({ { pickleName }, [&dataset, names, options](ExportSink& sink)
        {
          PickleFile file(sink, pickleName);
          for (const std::string& camera : dataset.cameras())
          {
            file.beginDictionary(names->known(camera));
            addVideo(file, dataset, camera, exported::color().of(options));
            file.endDictionary();
          }
          file.finish();
        } }));
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
    const VideoTracks tracks(dataset, camera);
    const Put put = [&](const void* data, std::size_t bytes) { file.add(data, bytes); };
    file.beginArray("points", "f4", { tracks.count(), tracks.frames(), 2 });
    putPlaces(tracks, put);
    file.endArray();
    file.beginArray("occluded", "b1", { tracks.count(), tracks.frames() });
    putOccluded(tracks, put);
    file.endArray();
  }

  static void writeTracks(ExportSink& sink, const std::string& name, const VideoTracks& tracks)
  {
    const std::string points = std::to_string(tracks.count());
    const std::string places = points + ", " + std::to_string(tracks.frames());
    const std::uint64_t sights = std::uint64_t(tracks.count()) * tracks.frames();
    ZipFile file(sink, name);
    addArray(file, "points.npy", npyHead("<f4", places + ", 2"), sights * 2 * sizeof(float),
      [&](const Put& put) { putPlaces(tracks, put); });
    addArray(file, "occluded.npy", npyHead("|b1", places), sights, [&](const Put& put) { putOccluded(tracks, put); });
    addArray(file, "query_points.npy", npyHead("<f4", points + ", 3"), tracks.queries());
    addArray(file, "track.npy", npyHead("<i8", points + ","), tracks.numbers());
    addArray(file, "object.npy", npyHead("<i8", points + ","), tracks.objects());
    file.finish();
  }
};
} // namespace

std::unique_ptr<Exporter> makeTapvidExporter() { return std::make_unique<TapvidExporter>(); }

} // namespace dgtk
