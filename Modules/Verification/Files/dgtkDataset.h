// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDataset_h
#define dgtkDataset_h

#include "dgtkDatasetDocuments.h"
#include "dgtkLayerReader.h"
#include "dgtkSight.h"
#include "dgtkStage.h"
#include "dgtkThreadPool.h"
#include "dgtkVerification.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk
{

class TimedSight;

/// An image of the dataset, any type read as double.
class PictureFile
{
public:
  /// Throws InputError for a file that cannot be read or is not of this size.
  PictureFile(const std::string& folder, const std::string& file, int width, int height);

  const std::string& file() const { return this->File; } ///< relative to the dataset
  int width() const { return this->Data.info.width; }
  int height() const { return this->Data.info.height; }
  int channels() const { return this->Data.info.channels; }
  PixelType type() const { return this->Data.info.type; }
  const DepthMatrices& matrices() const { return this->Data.matrices; }
  double at(int x, int y, int channel = 0) const;
  Eigen::Vector2d at2(int x, int y) const { return { this->at(x, y, 0), this->at(x, y, 1) }; }
  Eigen::Vector3d at3(int x, int y) const { return { this->at(x, y, 0), this->at(x, y, 1), this->at(x, y, 2) }; }
  /// An id: 24 bits of R, G, B where there are three channels.
  std::uint32_t id(int x, int y) const;
  /// Half of the distance of neighbouring numbers of the file's type at a value; 0 for float64.
  double rounding(double value) const;
  bool isFloat() const { return this->type() == PixelType::Float32 || this->type() == PixelType::Float64; }
  Offender offender(int x, int y, const std::string& value, const std::string& expected) const
  {
    return { this->File, x, y, value, expected };
  }

private:
  std::string File;
  ImageData Data;
};
using PicturePointer = std::shared_ptr<const PictureFile>;

/// A dataset on disk and the scene that it shows.
class Dataset
{
public:
  /// Throws InputError unless there is a manifest. The other documents may be damaged, see problems().
  Dataset(const std::string& folder, int threads);

  struct Problem
  {
    std::string file;
    std::string what;
  };
  /// Documents that cannot be used; with any, only hashes can be checked.
  const std::vector<Problem>& problems() const { return this->Problems; }

  const std::string& folder() const { return this->Folder; }
  const Manifest& manifest() const { return this->TheManifest; }
  const std::vector<CameraRecord>& cameras() const { return this->Cameras; }
  const std::vector<ObjectRecord>& objects() const { return this->Objects; }
  bool hasStage() const { return this->TheStage != nullptr; }
  const Stage& stage() const { return *this->TheStage; }
  ThreadPool& pool() { return this->Pool; }
  std::string absolute(const std::string& file) const { return this->Folder + '/' + file; }
  /// Relative to the dataset, of a file of an error message.
  std::string relative(const std::string& file) const;

  /// Files of a camera: <camera>/<layer>/<frame><suffix>, as the manifest lists them. "" when there is none.
  std::string find(
    const std::string& camera, const std::string& layer, int frame, const std::vector<std::string>& suffixes) const;
  /// Layers (folders) of a camera and frame.
  std::vector<std::string> layers(const std::string& camera, int frame) const;
  /// Suffixes (".npy", "_2.png") of a layer's files.
  std::vector<std::string> suffixes(const std::string& camera, const std::string& layer, int frame) const;

  const CameraRecord* camera(const std::string& name, int frame) const;
  /// Index of a camera in the scene; -1 for none.
  int cameraIndex(const std::string& name) const;
  /// From cameras.json, or from the scene for what the dataset does not show: in the size that its other pictures have,
  /// or that of `like` where all pictures were asked for in one size. Nothing for an unknown camera.
  std::optional<Eye> eye(const std::string& name, int frame, const CameraRecord& like);
  /// The scene's own camera in the size of a record.
  View sceneView(const CameraRecord& record) const;
  std::shared_ptr<const SceneState> state(int frame);
  std::shared_ptr<const Sight> sight(const Eye& eye, int frame);
  /// The same with the times of its rolling shutter, as the scene's camera moves.
  std::shared_ptr<const TimedSight> timedSight(const Eye& eye, int frame);
  bool hasFrame(int frame) const; ///< of the scene

private:
  void index();
  void readDocuments();
  struct Moment
  {
    std::shared_ptr<const SceneState> state;
    std::shared_ptr<const OcclusionQuery> query;
  };
  Moment& moment(int frame);

  std::string Folder;
  Manifest TheManifest;
  std::vector<CameraRecord> Cameras;
  std::vector<ObjectRecord> Objects;
  std::shared_ptr<const Stage> TheStage;
  ThreadPool Pool;
  std::vector<Problem> Problems;
  using Key = std::tuple<std::string, int, std::string, std::string>; ///< camera, frame, layer, suffix
  std::map<Key, std::string> Files;
  std::map<int, Moment> Moments;
  int First = 0;
  int Last = 0;
};

} // namespace dgtk

#endif
