// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColmap.h"
#include "dgtkColmapRigs.h"

#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkLayerFile.h"
#include "dgtkMovingObjects.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace dgtk::colmap
{

namespace
{
constexpr std::size_t mostPlaces = std::size_t(1) << 19; ///< of tracks in memory at a time

/// Where a point of the dataset's list stands in a model; none of points that the model does not hold.
using Positions = std::vector<std::optional<Eigen::Vector3d>>;

/// World matrices of the objects that are rigid or at least affine, from those at the first frame of the run.
std::map<std::uint32_t, Eigen::Matrix4d> motionsOf(const DatasetView& dataset, int frame)
{
  const auto whole = [](const PoseRecord& pose)
  {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topRows<3>() = pose.matrix;
    return matrix;
  };
  std::map<std::uint32_t, Eigen::Matrix4d> first;
  for (const PoseRecord& pose : dataset.poses(dataset.firstFrame()))
  {
    first[pose.id] = whole(pose);
  }
  std::map<std::uint32_t, Eigen::Matrix4d> motions;
  for (const PoseRecord& pose : dataset.poses(frame))
  {
    const ObjectRecord* object = dataset.object(pose.id);
    const auto from = first.find(pose.id);
    if (object && !object->deforming && from != first.end() && std::abs(from->second.determinant()) > 0)
    {
      motions[pose.id] = whole(pose) * from->second.inverse();
    }
  }
  return motions;
}

Positions positionsOf(const DatasetView& dataset, const Views& views, const std::vector<TrackPoint>& points)
{
  const std::optional<int> frame = frameOf(views);
  const std::map<std::uint32_t, Eigen::Matrix4d> motions =
    frame ? motionsOf(dataset, *frame) : std::map<std::uint32_t, Eigen::Matrix4d>();
  Positions positions(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto motion = motions.find(points[i].object);
    if (points[i].isStatic)
    {
      positions[i] = points[i].x;
    }
    else if (motion != motions.end())
    {
      positions[i] = (motion->second * points[i].x.homogeneous()).head<3>();
    }
  }
  return positions;
}

/// Writes a model, as text or as binary numbers.
class Writer
{
public:
  Writer(const DatasetView& dataset, const Views& views, bool binary, const OptionValues& options, ExportSink& sink)
    : Dataset(dataset)
    , Shown(views)
    , Binary(binary)
    , Points(trackPointsBut(dataset, leftOut(dataset, views)))
    , PointsInWorld(positionsOf(dataset, views, this->Points))
    , Seen(this->Points.size(), 0)
  {
    for (std::size_t i = 0; i < this->Shown.shots.size(); ++i)
    {
      const CodeCounter counter = this->countPlaces(i);
      counter.report(sink, *this->Shown.shots[i], options);
    }
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      if (this->Seen[i] < 2)
      {
        this->PointsInWorld[i].reset();
      }
    }
  }

  void cameras(ExportFile& file)
  {
    std::string text = this->Binary ? "" : "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
    std::map<std::pair<std::string, std::vector<double>>, std::uint32_t> known;
    std::string rows;
    for (const DatasetShot* shot : this->Shown.shots)
    {
      const CameraModel model = modelOf(shot->camera, this->Shown.centre, "colmap");
      std::vector<double> key = model.numbers;
      key.insert(key.end(), { double(model.id), double(shot->camera.width), double(shot->camera.height) });
      const auto [found, fresh] = known.emplace(std::make_pair(shot->name(), key), std::uint32_t(known.size() + 1));
      this->CameraIds.push_back(found->second);
      if (fresh)
      {
        rows += this->cameraRow(found->second, model, shot->camera);
      }
    }
    if (this->Binary)
    {
      putLittle(text, std::uint64_t(known.size()));
    }
    file.write(text + rows);
  }

  void images(ExportFile& file)
  {
    std::string head = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
    if (this->Binary)
    {
      head.clear();
      putLittle(head, std::uint64_t(this->Shown.shots.size()));
    }
    file.write(head);
    for (std::size_t i = 0; i < this->Shown.shots.size(); ++i)
    {
      file.write(this->imageRow(i));
    }
  }

  void points(ExportFile& file)
  {
    const auto held = [](const std::optional<Eigen::Vector3d>& x) { return x.has_value(); };
    std::string head = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
    if (this->Binary)
    {
      head.clear();
      putLittle(head, std::uint64_t(std::count_if(this->PointsInWorld.begin(), this->PointsInWorld.end(), held)));
    }
    file.write(head);
    for (std::size_t begin = 0; begin < this->Points.size();)
    {
      std::size_t end = begin;
      for (std::size_t places = 0; end < this->Points.size() && (end == begin || places < mostPlaces); ++end)
      {
        places += this->PointsInWorld[end] ? this->Seen[end] : 0;
      }
      this->pointRows(file, begin, end);
      begin = end;
    }
  }

  /// COLMAP's number of the camera of each picture; once cameras() are written.
  const std::vector<std::uint32_t>& cameraIds() const { return this->CameraIds; }

private:
  /// Whether COLMAP's models, which all divide by z, can say where a picture has a point of the world.
  bool projects(std::size_t picture, std::size_t point) const
  {
    const Rigid3 view = cameraFromWorld(this->Shown.shots[picture]->camera);
    return (view.rotation * *this->PointsInWorld[point] + view.translation).z() > 0;
  }

  std::vector<TrackPlace> placesOf(std::size_t picture) const
  {
    const std::string file = this->Dataset.file(*this->Shown.shots[picture], "tracks", { "npy" });
    return readTrackPlaces(this->Dataset.pathOf(file), this->Points.size());
  }

  /// Adds the places of a picture to what is known of points.
  CodeCounter countPlaces(std::size_t picture)
  {
    LinearCode exact;
    exact.scale = 0;
    exact.unit = "px";
    CodeCounter counter(exact, "tracks");
    const std::vector<TrackPlace> places = this->placesOf(picture);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (this->PointsInWorld[i] && places[i].visibility == 1)
      {
        const bool sayable = this->projects(picture, i);
        counter.count(sayable);
        this->Seen[i] += sayable ? 1 : 0;
      }
    }
    return counter;
  }

  /// visit(point, number among the places of the picture, place) for the places that the model holds.
  template <typename Visit>
  void forPlaces(std::size_t picture, const Visit& visit) const
  {
    const std::vector<TrackPlace> places = this->placesOf(picture);
    std::size_t number = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (this->PointsInWorld[i] && places[i].visibility == 1 && this->projects(picture, i))
      {
        visit(i, number++, places[i]);
      }
    }
  }

  std::string cameraRow(std::uint32_t id, const CameraModel& model, const CameraRecord& camera) const
  {
    if (!this->Binary)
    {
      return std::to_string(id) + ' ' + model.name + ' ' + std::to_string(camera.width) + ' ' +
             std::to_string(camera.height) + ' ' + numbersLine(model.numbers) + '\n';
    }
    std::string bytes;
    putLittle(bytes, id);
    putLittle(bytes, std::int32_t(model.id));
    putLittle(bytes, std::uint64_t(camera.width));
    putLittle(bytes, std::uint64_t(camera.height));
    putAll(bytes, model.numbers);
    return bytes;
  }

  std::string imageRow(std::size_t picture) const
  {
    const Rigid3 pose = cameraFromWorld(this->Shown.shots[picture]->camera);
    const Eigen::Vector4d q = quaternionOf(pose.rotation);
    const Eigen::Vector3d& t = pose.translation;
    const std::vector<double> numbers{ q[0], q[1], q[2], q[3], t[0], t[1], t[2] };
    const auto id = std::uint32_t(picture + 1);
    std::string row;
    std::string places;
    std::uint64_t count = 0;
    const double shift = this->Shown.centre == PixelCentre::Integer ? -0.5 : 0;
    this->forPlaces(picture,
      [&](std::size_t point, std::size_t, const TrackPlace& place)
      {
        const double u = place.u + shift;
        const double v = place.v + shift;
        ++count;
        if (this->Binary)
        {
          putAll(places, { u, v });
          putLittle(places, std::uint64_t(point + 1));
          return;
        }
        places += (places.empty() ? "" : " ") + numbersLine({ u, v }) + ' ' + std::to_string(point + 1);
      });
    if (!this->Binary)
    {
      return std::to_string(id) + ' ' + numbersLine(numbers) + ' ' + std::to_string(this->CameraIds[picture]) + ' ' +
             this->Shown.name(*this->Shown.shots[picture]) + '\n' + places + '\n';
    }
    putLittle(row, id);
    putAll(row, numbers);
    putLittle(row, this->CameraIds[picture]);
    row += this->Shown.name(*this->Shown.shots[picture]) + '\0';
    putLittle(row, count);
    return row + places;
  }

  void pointRows(ExportFile& file, std::size_t begin, std::size_t end) const
  {
    using Track = std::vector<std::pair<std::uint32_t, std::uint32_t>>; ///< picture, number in it
    std::vector<Track> tracks(end - begin);
    for (std::size_t picture = 0; picture < this->Shown.shots.size(); ++picture)
    {
      this->forPlaces(picture,
        [&](std::size_t point, std::size_t number, const TrackPlace&)
        {
          if (point >= begin && point < end)
          {
            tracks[point - begin].emplace_back(picture + 1, number);
          }
        });
    }
    for (std::size_t i = begin; i < end; ++i)
    {
      if (this->PointsInWorld[i])
      {
        file.write(this->pointRow(i, tracks[i - begin]));
      }
    }
  }

  template <typename Track>
  std::string pointRow(std::size_t point, const Track& track) const
  {
    const Eigen::Vector3d& x = *this->PointsInWorld[point];
    const std::uint8_t* color = this->Points[point].color;
    std::string row;
    if (!this->Binary)
    {
      row = std::to_string(point + 1) + ' ' + numbersLine({ x[0], x[1], x[2] });
      row += ' ' + numbersLine({ double(color[0]), double(color[1]), double(color[2]) }) + " 0";
      for (const auto& [picture, number] : track)
      {
        row += ' ' + std::to_string(picture) + ' ' + std::to_string(number);
      }
      return row + '\n';
    }
    putLittle(row, std::uint64_t(point + 1));
    putAll(row, { x[0], x[1], x[2] });
    row.append(color, color + 3);
    putLittle(row, 0.0); // the error of an exact point
    putLittle(row, std::uint64_t(track.size()));
    for (const auto& [picture, number] : track)
    {
      putLittle(row, picture);
      putLittle(row, number);
    }
    return row;
  }

  static void putAll(std::string& to, const std::vector<double>& numbers)
  {
    for (const double number : numbers)
    {
      putLittle(to, number);
    }
  }

  const DatasetView& Dataset;
  const Views& Shown;
  bool Binary;
  std::vector<TrackPoint> Points;
  Positions PointsInWorld;
  std::vector<std::uint32_t> Seen; ///< pictures that see a point
  std::vector<std::uint32_t> CameraIds;
};
} // namespace

ExportItem modelItem(const DatasetView& dataset, const std::shared_ptr<const Views>& views, const std::string& folder,
  const OptionValues& options)
{
  const std::string extension = '.' + modelFormat().of(options);
  const std::string cameras = folder + "cameras" + extension;
  const std::string images = folder + "images" + extension;
  const std::string points = folder + "points3D" + extension;
  const std::vector<std::string> more = rigFiles(folder, options);
  ExportItem item{ { cameras, images, points },
    [&dataset, views, cameras, images, points, extension, more, options](ExportSink& sink)
    {
      Writer writer(dataset, *views, extension == ".bin", options, sink);
      const auto write = [&](const std::string& name, void (Writer::*part)(ExportFile&))
      {
        const std::unique_ptr<ExportFile> file = sink.open(name);
        (writer.*part)(*file);
        file->finish();
      };
      write(cameras, &Writer::cameras);
      write(images, &Writer::images);
      write(points, &Writer::points);
      writeRigs(sink, dataset, *views, writer.cameraIds(), more);
    } };
  item.files.insert(item.files.end(), more.begin(), more.end());
  return item;
}

} // namespace dgtk::colmap
