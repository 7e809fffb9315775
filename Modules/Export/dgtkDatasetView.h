// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetView_h
#define dgtkDatasetView_h

#include "dgtkExportModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkLayerReader.h"
#include "dgtkObjectDocuments.h"
#include "dgtkPixelValues.h"
#include "dgtkRigid3.h"
#include "dgtkTrackDocuments.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// Which pictures of a dataset are meant.
struct DatasetSelection
{
  std::vector<std::string> cameras; ///< none: all
  bool someFrames = false;
  int first = 0; ///< of some frames: first, first + step, ... up to last
  int last = 0;
  int step = 1;
  double metresPerUnit = 0;  ///< where the dataset does not say it; 0: not known
  bool pinholeTwins = false; ///< a camera with a lens or a shutter gives way to a plain pinhole with the same poses
};

/// A dataset as one scene of a folder of datasets, when all of them are looked at together.
struct SceneOfMany
{
  std::string name = {};           ///< its folder; cameras are then called NAME/CAMERA. "": there are no others
  int place = 0;                   ///< among the scenes, from 0
  int count = 1;                   ///< of the scenes
  std::size_t shotsBefore = 0;     ///< shots of the scenes before
  std::uint32_t largestObject = 0; ///< the largest object id of all scenes
};

/// A picture's place in a dataset: a camera at a frame.
struct DatasetShot
{
  std::size_t index = 0; ///< among the shots, from 0
  CameraRecord camera;
  std::size_t number = 0; ///< the same among those of all scenes
  int part = 0;           ///< what splits count: its frame, or, of many scenes, the scene's place
  const std::string& name() const { return this->camera.name; }
  int frame() const { return this->camera.frame; }
};

/// Two cameras with parallel image planes and rows in common, at every frame.
struct RectifiedPair
{
  std::string left;
  std::string right;
  double baseline = 0; ///< scene units, positive: the right camera's centre along the left one's x
};

/// Where a format puts the centre of the first pixel.
enum class PixelCentre
{
  Half,   ///< (0.5, 0.5): DGTk, COLMAP, instant-ngp, nerfstudio
  Integer ///< (0, 0): OpenCV, BOP, KITTI, TUM, Sintel: cx and cy are 0.5 less
};

/// A finished dataset on disk, as exporters see it. Immutable; every function may be called from any thread. Files that
/// cannot be read are InputErrors.
class DGTKEXPORT_EXPORT DatasetView
{
public:
  /// Throws UsageError for a camera that there is not, for a selection without a picture and for a camera that lacks
  /// the pinhole twin that is to take its place: it says which one is needed; and for a unit that contradicts the
  /// dataset's.
  explicit DatasetView(
    const std::string& folder, const DatasetSelection& selection = {}, const SceneOfMany& scene = {});
  ~DatasetView();
  DatasetView(const DatasetView&) = delete;
  DatasetView& operator=(const DatasetView&) = delete;

  const std::string& folder() const { return this->Folder; }
  /// Without its files, which are listed().
  const Manifest& manifest() const { return this->TheManifest; }
  const std::string& manifestHash() const { return this->ManifestHash; }

  /// Sorted by camera, then frame.
  const std::vector<DatasetShot>& shots() const { return this->Shots; }
  const DatasetShot* shot(const std::string& camera, int frame) const; ///< null for none
  std::vector<std::string> cameras() const;                            ///< of the shots, sorted
  std::vector<int> frames() const;                                     ///< of the shots, sorted
  std::vector<const DatasetShot*> shotsOf(const std::string& camera) const;
  std::vector<const DatasetShot*> shotsAt(int frame) const;

  const std::vector<ObjectRecord>& objects() const { return this->Objects; }
  const ObjectRecord* object(std::uint32_t id) const; ///< null for none
  /// Of all scenes.
  std::uint32_t largestObject() const;
  const SceneOfMany& scene() const { return this->Scene; }
  const std::vector<ClassRecord>& classes() const { return this->Classes; }

  /// Whether some shot has a file of the layer.
  bool has(const std::string& layer) const;
  /// What the values of a layer are; Unknown for one that there is not.
  Meaning meaningOf(const std::string& layer) const;
  /// The file of a layer, relative to the dataset; the first of these extensions that there is (none named: of any that
  /// holds its values, npy before others; of depths a .png is a picture alone). "" for none. For layers with several
  /// folders (correspondence) the one whose folder is named.
  std::string file(const DatasetShot& shot, const std::string& layer, const std::vector<std::string>& extensions = {},
    const std::string& folder = {}) const;
  /// Of a file, to be read. Throws InputError where the manifest does not list it, or with another size.
  std::string pathOf(const std::string& file) const;
  /// All files of a picture, of all layers, as the manifest lists them.
  std::vector<DatasetFile> filesOf(const DatasetShot& shot) const;
  /// What the manifest says of a file, camera and frame of the shots' ones; throws InputError where it does not list
  /// it.
  DatasetFile listed(const std::string& file) const;
  /// The whole file; throws InputError where it is not the one that the manifest lists.
  std::string bytesOf(const std::string& file) const;
  /// Throws InputError where the shot has no file of the layer, or one of another size than the camera has.
  std::unique_ptr<RowReader> open(
    const DatasetShot& shot, const std::string& layer, const std::vector<std::string>& extensions = {}) const;
  /// The same, whole.
  ImageData read(
    const DatasetShot& shot, const std::string& layer, const std::vector<std::string>& extensions = {}) const;
  /// Values of the layer `boxes`, `amodal`; throws where the shot has none.
  std::vector<BoxRecord> boxes(const DatasetShot& shot) const;
  AmodalMasks amodal(const DatasetShot& shot) const;

  /// Of all objects; none of datasets that do not say them (poses.json).
  std::vector<PoseRecord> poses(int frame) const;
  /// The first frame of the run, selected or not; -1 for a dataset without pictures.
  int firstFrame() const { return this->FirstFrame; }
  /// Points of the layer `tracks`. Throws InputError where there are none.
  std::vector<TrackPoint> trackPoints() const;

  bool knowsMetres() const { return this->MetresPerUnit > 0; }
  /// Metres of a scene unit; throws UsageError where neither dataset nor selection say it.
  double metres() const;
  /// Seconds of a frame: frame / frames per second. Throws UsageError where the dataset does not say a rate.
  double seconds(int frame) const;
  /// Cameras whose pictures are rectified with each other in all frames, left one first.
  std::vector<RectifiedPair> rectifiedPairs() const;
  /// Of each shot, by its index: the camera that its disparities are to, of the dataset's cameras, selected or not, the
  /// nearest with which it is a rectified pair at its frame, of several the first by name; "" for none.
  std::vector<std::string> disparityPartners() const;

private:
  class Poses;
  void readShots(const DatasetSelection& selection);
  void readFiles();
  void chooseUnit(double given);
  DatasetFile describedFile(std::uint32_t number) const;
  std::string nameOf(const std::string& camera) const;
  std::string Folder;
  SceneOfMany Scene;
  Manifest TheManifest;
  std::string ManifestHash;
  std::vector<DatasetShot> Shots;
  std::vector<ObjectRecord> Objects;
  std::vector<ClassRecord> Classes;
  double MetresPerUnit = 0;
  int FirstFrame = -1;
  std::unique_ptr<class FileTable> Files;
  std::unique_ptr<Poses> AllPoses;
};

/// The camera's matrix in a format's pixels. Throws UsageError for a model without one.
DGTKEXPORT_EXPORT Eigen::Matrix3d intrinsicsOf(const CameraRecord& camera, PixelCentre centre);
/// x_camera from x_world, x right, y down, z forward; scene units.
DGTKEXPORT_EXPORT Rigid3 cameraFromWorld(const CameraRecord& camera);
/// x_world from x_camera with OpenGL's axes: x right, y up, z back.
DGTKEXPORT_EXPORT Rigid3 worldFromCameraGL(const CameraRecord& camera);
/// The rows of a pose's 4 x 4 matrix.
DGTKEXPORT_EXPORT std::array<std::vector<double>, 4> matrixRows(const Rigid3& pose);
/// Unit quaternion (w, x, y, z), w >= 0, of a rotation matrix.
DGTKEXPORT_EXPORT Eigen::Vector4d quaternionOf(const Eigen::Matrix3d& rotation);
/// Whether K alone says how the camera projects.
DGTKEXPORT_EXPORT bool isPinhole(const CameraRecord& camera);
/// The model's distortion coefficients, empty for none.
DGTKEXPORT_EXPORT std::vector<double> distortionOf(const CameraRecord& camera);
/// What a camera is that is no plain pinhole: "pinhole with distortion with a rolling shutter".
DGTKEXPORT_EXPORT std::string lensText(const CameraRecord& camera);
/// Throws a UsageError that names camera and format for what isPinhole() denies.
DGTKEXPORT_EXPORT void requirePinholes(const DatasetView& dataset, const std::string& format);
/// The same of a skew, for formats that hold two focal lengths and a principal point alone.
DGTKEXPORT_EXPORT void requireNoSkew(const DatasetView& dataset, const std::string& format);

/// The name of a class for readers that find none where it is empty, as it is of objects without a class.
DGTKEXPORT_EXPORT std::string namedClass(const std::string& name);

/// Names that are safe in every format: letters, digits, '_' and '-' of ASCII; unique among those that were asked for,
/// also where upper and lower case are one, as in the files of some systems.
class DGTKEXPORT_EXPORT SafeNames
{
public:
  /// The name of an original, the same for the same.
  std::string of(const std::string& original);
  /// From now on no original has this name; of safe characters.
  void reserve(const std::string& name);
  /// Of one that was asked for before; throws std::out_of_range otherwise.
  const std::string& known(const std::string& original) const { return this->Given.at(original); }

private:
  std::map<std::string, std::string> Given;
  std::set<std::string> Taken; ///< in lower case
};

/// Of the cameras of a dataset, in their order.
DGTKEXPORT_EXPORT std::shared_ptr<const SafeNames> safeNamesOf(const DatasetView& dataset);

} // namespace dgtk

#endif
