// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportSpace.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJson.h"
#include "dgtkPortableMath.h"
#include "dgtkUtf8.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::size_t mostScenes = 12;
constexpr std::size_t mostFrames = 48;
constexpr std::size_t mostObjects = 300;
constexpr std::size_t mostCameras = 100;
constexpr std::uint64_t largestScene = std::uint64_t(1) << 28;
constexpr const char* boxesLayer = "boxes";

/// Whether z is up, as scene.json says; y where it does not.
bool isUpZ(const DatasetView& view)
{
  try
  {
    const std::string path = Folder(view.folder()).fileAt("scene.json");
    const JsonDocument document = parseJson(path, readFile(path, largestScene));
    const JsonNode* const axis = document.root.find("upAxis");
    return axis != nullptr && axis->text == "z";
  }
  catch (const Error&)
  {
    return false;
  }
}

/// Right, down and up of a plan.
Eigen::Vector3d seenFromAbove(const Eigen::Vector3d& x, bool upZ)
{
  return upZ ? Eigen::Vector3d(x.x(), -x.y(), x.z()) : Eigen::Vector3d(x.x(), x.z(), x.y());
}

/// To five digits of the largest number that plans have: what is smaller is below a pixel.
double rounded(double value) { return std::isfinite(value) ? std::round(value * 1e5) / 1e5 : 0; }

ReportJson placeOf(int frame, const Eigen::Vector3d& x)
{
  return ReportJson::array({ frame, rounded(x.x()), rounded(x.y()), rounded(x.z()) });
}

/// Evenly, with the first and the last.
std::vector<int> someOf(const std::vector<int>& frames)
{
  if (frames.size() <= mostFrames)
  {
    return frames;
  }
  std::vector<int> some;
  for (std::size_t i = 0; i < mostFrames; ++i)
  {
    some.push_back(frames[i * (frames.size() - 1) / (mostFrames - 1)]);
  }
  return some;
}

/// Places: frame, centre, direction forward; of pinholes the directions to the picture's corners.
ReportJson camerasOf(const DatasetView& view, const std::vector<int>& frames, bool upZ)
{
  ReportJson cameras = ReportJson::array();
  for (const std::string& name : view.cameras())
  {
    if (cameras.size() == mostCameras)
    {
      break;
    }
    ReportJson camera{ { "name", utf8FromBytes(name) }, { "places", ReportJson::array() } };
    for (const int frame : frames)
    {
      const DatasetShot* const shot = view.shot(name, frame);
      if (shot == nullptr)
      {
        continue;
      }
      const CameraRecord& record = shot->camera;
      ReportJson place = placeOf(frame, seenFromAbove(-(record.R.transpose() * record.t), upZ));
      const Eigen::Vector3d forward = seenFromAbove(record.R.row(2).transpose(), upZ);
      place.push_back(rounded(forward.x()));
      place.push_back(rounded(forward.y()));
      for (int corner = 0; isPinhole(record) && corner < 4; ++corner)
      {
        const Eigen::Vector3d pixel(corner & 1 ? record.width : 0, corner & 2 ? record.height : 0, 1);
        const Eigen::Vector3d edge =
          seenFromAbove(record.R.transpose() * (record.K.inverse() * pixel).normalized(), upZ);
        place.push_back(rounded(edge.x()));
        place.push_back(rounded(edge.y()));
      }
      camera["places"].push_back(place);
      camera["model"] = utf8FromBytes(record.model);
    }
    cameras.push_back(camera);
  }
  return cameras;
}

/// Corners in the object's own frame, of the objects that some list of boxes has.
std::map<std::uint32_t, Eigen::Matrix<double, 8, 3>> cornersOf(const DatasetView& view, const std::vector<int>& frames)
{
  std::map<std::uint32_t, Eigen::Matrix<double, 8, 3>> corners;
  for (const int frame : frames)
  {
    for (const DatasetShot* shot : view.shotsAt(frame))
    {
      if (view.file(*shot, boxesLayer, { "json" }).empty())
      {
        continue;
      }
      for (const BoxRecord& box : view.boxes(*shot))
      {
        const Eigen::Matrix3d linear = box.matrix.leftCols<3>();
        if (std::abs(linear.determinant()) > 0 && corners.count(box.id) == 0)
        {
          corners[box.id] = (linear.inverse() * (box.corners.transpose().colwise() - box.matrix.col(3))).transpose();
        }
      }
      return corners; // one list has all objects
    }
  }
  return corners;
}

ReportJson objectsOf(const DatasetView& view, const std::vector<int>& frames, bool upZ)
{
  std::map<std::uint32_t, Eigen::Matrix<double, 8, 3>> corners;
  try
  {
    corners = cornersOf(view, frames);
  }
  catch (const Error&)
  {
    // the list is named where it is counted
  }
  std::map<std::uint32_t, ReportJson> places;
  std::map<std::uint32_t, std::vector<int>> hidden; // frames
  for (const int frame : frames)
  {
    for (const PoseRecord& pose : view.poses(frame))
    {
      const ObjectRecord* const object = view.object(pose.id);
      ReportJson& list = places[pose.id];
      if (!pose.visible)
      {
        hidden[pose.id].push_back(frame);
      }
      if (!pose.visible || (object != nullptr && object->isStatic && !list.empty()))
      {
        continue;
      }
      const Eigen::Vector3d centre = pose.matrix.col(3);
      const auto corner = corners.find(pose.id);
      ReportJson place = placeOf(frame, seenFromAbove(centre, upZ));
      for (int i = 0; corner != corners.end() && i < 8; ++i)
      {
        const Eigen::Vector3d x = seenFromAbove(pose.matrix * corner->second.row(i).transpose().homogeneous(), upZ);
        place.push_back(rounded(x.x()));
        place.push_back(rounded(x.y()));
      }
      list.push_back(place);
    }
  }
  ReportJson objects = ReportJson::array();
  for (const auto& [id, list] : places)
  {
    if (objects.size() < mostObjects && !list.empty())
    {
      const ObjectRecord* const object = view.object(id);
      objects.push_back({ { "id", id }, { "static", object != nullptr && object->isStatic }, { "places", list },
        { "hidden", hidden[id] } });
    }
  }
  return objects;
}
} // namespace

ReportJson plansOf(const ReportSource& source)
{
  std::vector<std::size_t> scenes; // of the pictures that are shown
  for (const std::size_t picture : source.shown)
  {
    if (scenes.empty() || scenes.back() != source.pictures[picture].scene)
    {
      scenes.push_back(source.pictures[picture].scene);
    }
  }
  scenes.resize(std::min(scenes.size(), mostScenes));
  ReportJson plans = ReportJson::array();
  for (const std::size_t scene : scenes)
  {
    const DatasetView& view = *source.scenes[scene].view;
    const std::vector<int> frames = someOf(view.frames());
    const bool upZ = isUpZ(view);
    plans.push_back({ { "scene", scene }, { "up", upZ ? "z" : "y" }, { "units", utf8FromBytes(view.manifest().units) },
      { "frames", frames }, { "allFrames", view.frames().size() }, { "allCameras", view.cameras().size() },
      { "allObjects", view.objects().size() }, { "cameras", camerasOf(view, frames, upZ) },
      { "objects", objectsOf(view, frames, upZ) } });
  }
  return plans;
}

ReportJson viewpointsOf(const ReportSource& source, const std::map<std::size_t, IdTally>& ids)
{
  constexpr int columns = 24; // of azimuth
  constexpr int rows = 12;    // of the sine of elevation: equal areas
  std::vector<std::uint64_t> bins(std::size_t(columns) * rows, 0);
  std::uint64_t views = 0;
  std::map<std::size_t, bool> upAxes;
  for (const std::size_t picture : source.read)
  {
    const ReportPicture& one = source.pictures[picture];
    const DatasetView& view = source.viewOf(one);
    const auto known = upAxes.find(one.scene);
    const bool upZ = known != upAxes.end() ? known->second : upAxes.emplace(one.scene, isUpZ(view)).first->second;
    const auto seen = ids.find(picture);
    const CameraRecord& camera = one.shot->camera;
    const Eigen::Vector3d eye = -(camera.R.transpose() * camera.t);
    for (const PoseRecord& pose : view.poses(camera.frame))
    {
      if (!pose.visible || !pose.rigid || (seen != ids.end() && seen->second.count(pose.id) == 0))
      {
        continue;
      }
      const Eigen::Vector3d towards = seenFromAbove(pose.R.transpose() * (eye - pose.t), upZ);
      const double distance = towards.norm();
      if (!(distance > 0))
      {
        continue;
      }
      const double azimuth = portable::atan2(-towards.y(), towards.x()) / (2 * pi) + 0.5;
      const double height = (towards.z() / distance + 1) / 2;
      const int column = std::min(columns - 1, std::max(0, static_cast<int>(azimuth * columns)));
      const int row = std::min(rows - 1, std::max(0, static_cast<int>(height * rows)));
      ++bins[std::size_t(row) * columns + std::size_t(column)];
      ++views;
    }
  }
  return { { "columns", columns }, { "rows", rows }, { "views", views }, { "bins", bins } };
}

} // namespace dgtk
