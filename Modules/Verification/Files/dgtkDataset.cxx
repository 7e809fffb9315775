// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDataset.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkPixelValues.h"
#include "dgtkRaySource.h"
#include "dgtkTimedSight.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
/// Instants whose scenes are kept.
constexpr std::size_t mostMoments = 4;
} // namespace

PictureFile::PictureFile(const std::string& folder, const std::string& file, int width, int height)
  : File(file)
  , Data(readLayerFile(folder + '/' + file))
{
  if (this->width() != width || this->height() != height)
  {
    throw InputError(folder + '/' + file, "size differs from the camera's",
      std::to_string(width) + " x " + std::to_string(height),
      std::to_string(this->width()) + " x " + std::to_string(this->height()));
  }
}

double PictureFile::at(int x, int y, int channel) const { return valueAt(this->Data.pixels, x, y, channel); }

std::uint32_t PictureFile::id(int x, int y) const { return idAt(this->Data.pixels, x, y); }

double PictureFile::rounding(double value) const
{
  if (this->type() != PixelType::Float32 || !std::isfinite(value))
  {
    return 0;
  }
  const float narrow = static_cast<float>(std::abs(value));
  return 0.5 * double(std::nextafter(narrow, std::numeric_limits<float>::infinity()) - narrow);
}

Dataset::Dataset(const std::string& folder, int threads)
  : Folder(folder)
  , TheManifest(readManifestIn(folder))
  , Pool(threads)
{
  this->index();
  this->readDocuments();
}

void Dataset::index()
{
  for (const DatasetFile& file : this->TheManifest.files)
  {
    const fs::path path(file.path);
    const std::string name = path.filename().string();
    const std::size_t end = std::min(name.find_first_of("._", 1), name.size());
    int frame = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + end, frame);
    if (error != std::errc() || stop != name.data() + end || !path.has_parent_path())
    {
      continue;
    }
    const fs::path layer = path.parent_path();
    this->Files[{ layer.parent_path().generic_string(), frame, layer.filename().string(), name.substr(end) }] =
      file.path;
  }
}

void Dataset::readDocuments()
{
  const auto attempt = [&](const char* file, const auto& read)
  {
    try
    {
      read(dgtk::Folder(this->Folder).fileAt(file));
    }
    catch (const MachineError&)
    {
      throw;
    }
    catch (const Error& error)
    {
      this->Problems.push_back({ file, error.what() });
    }
  };
  attempt("cameras.json", [&](const std::string& path) { this->Cameras = readCameras(path); });
  attempt("objects.json", [&](const std::string& path) { this->Objects = readObjects(path); });
  attempt("scene.json",
    [&](const std::string& path)
    {
      this->TheStage = Stage::load(readScene(path));
      this->First = this->TheStage->description().firstFrame();
      this->Last = this->TheStage->description().lastFrame();
    });
}

std::string Dataset::relative(const std::string& file) const
{
  const std::string prefix = this->Folder + '/';
  return file.compare(0, prefix.size(), prefix) == 0 ? file.substr(prefix.size()) : file;
}

std::string Dataset::find(
  const std::string& camera, const std::string& layer, int frame, const std::vector<std::string>& suffixes) const
{
  for (const std::string& suffix : suffixes)
  {
    const auto found = this->Files.find({ camera, frame, layer, suffix });
    if (found != this->Files.end())
    {
      return found->second;
    }
  }
  return {};
}

std::vector<std::string> Dataset::layers(const std::string& camera, int frame) const
{
  std::vector<std::string> names;
  for (auto at = this->Files.lower_bound({ camera, frame, {}, {} });
       at != this->Files.end() && std::get<0>(at->first) == camera && std::get<1>(at->first) == frame; ++at)
  {
    if (names.empty() || names.back() != std::get<2>(at->first))
    {
      names.push_back(std::get<2>(at->first));
    }
  }
  return names;
}

std::vector<std::string> Dataset::suffixes(const std::string& camera, const std::string& layer, int frame) const
{
  std::vector<std::string> found;
  for (auto at = this->Files.lower_bound({ camera, frame, layer, {} });
       at != this->Files.end() && std::get<0>(at->first) == camera && std::get<1>(at->first) == frame &&
       std::get<2>(at->first) == layer;
       ++at)
  {
    found.push_back(std::get<3>(at->first));
  }
  return found;
}

const CameraRecord* Dataset::camera(const std::string& name, int frame) const
{
  const auto found = std::find_if(this->Cameras.begin(), this->Cameras.end(),
    [&](const CameraRecord& camera) { return camera.name == name && camera.frame == frame; });
  return found == this->Cameras.end() ? nullptr : &*found;
}

int Dataset::cameraIndex(const std::string& name) const
{
  const std::vector<std::string> names = this->TheStage->cameraNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

View Dataset::sceneView(const CameraRecord& record) const
{
  const int index = this->cameraIndex(record.name);
  if (index < 0)
  {
    throw InputError(this->absolute("cameras.json"), "camera " + quoted(record.name) + " is not in the scene");
  }
  return this->TheStage->view(static_cast<std::size_t>(index), record.frame, record.width, record.height);
}

std::optional<Eye> Dataset::eye(const std::string& name, int frame, const CameraRecord& like)
{
  if (const CameraRecord* record = this->camera(name, frame))
  {
    return Eye(*record, this->sceneView(*record).model);
  }
  const int index = this->cameraIndex(name);
  if (index < 0)
  {
    return std::nullopt;
  }
  const auto& request = this->TheManifest.request;
  const bool sized = std::any_of(request.begin(), request.end(),
    [](const auto& option) { return option.first == "size" && option.second.find('x') != std::string::npos; });
  int width = sized ? like.width : 0;
  int height = sized ? like.height : 0;
  for (const CameraRecord& record : this->Cameras)
  {
    if (record.name == name)
    {
      width = record.width;
      height = record.height;
    }
  }
  const View view = this->TheStage->view(static_cast<std::size_t>(index), frame, width, height);
  CameraRecord record;
  record.name = name;
  record.frame = frame;
  record.width = view.model->width();
  record.height = view.model->height();
  const CameraParameters& parameters = view.model->parameters();
  record.hasK = view.model->linear() || parameters.K;
  record.K = view.model->linear() ? view.model->linear()->K : parameters.K.value_or(record.K);
  record.numbers = parameters.numbers;
  record.rollingShutter = parameters.rollingShutter;
  record.R = view.camera_from_world.rotation;
  record.t = view.camera_from_world.translation;
  record.model = view.model->name();
  record.near = view.near;
  record.far = view.far;
  return Eye(record, view.model);
}

Dataset::Moment& Dataset::moment(int frame)
{
  const auto found = this->Moments.find(frame);
  if (found != this->Moments.end())
  {
    return found->second;
  }
  if (this->Moments.size() == mostMoments)
  {
    // Frames are visited in order, so the one farthest away is not needed for the longest time.
    const bool first =
      std::abs(this->Moments.begin()->first - frame) >= std::abs(this->Moments.rbegin()->first - frame);
    this->Moments.erase(first ? this->Moments.begin() : std::prev(this->Moments.end()));
  }
  Moment& moment = this->Moments[frame];
  moment.state = this->TheStage->at(frame);
  std::unique_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(moment.state);
  moment.query = std::move(query);
  return moment;
}

std::shared_ptr<const SceneState> Dataset::state(int frame) { return this->moment(frame).state; }

std::shared_ptr<const Sight> Dataset::sight(const Eye& eye, int frame)
{
  const Moment& moment = this->moment(frame);
  return std::make_shared<Sight>(eye, moment.state, moment.query);
}

std::shared_ptr<const TimedSight> Dataset::timedSight(const Eye& eye, int frame)
{
  const int index = this->cameraIndex(eye.record().name);
  const View view =
    index < 0 ? View() : this->TheStage->view(static_cast<std::size_t>(index), frame, eye.width(), eye.height());
  const bool table = view.model && !view.model->parameters().files.empty();
  return std::make_shared<TimedSight>(this->sight(eye, frame), view.instants, table ? view.model : nullptr);
}

bool Dataset::hasFrame(int frame) const { return frame >= this->First && frame <= this->Last; }

} // namespace dgtk
