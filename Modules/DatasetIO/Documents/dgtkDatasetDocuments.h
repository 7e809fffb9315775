// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetDocuments_h
#define dgtkDatasetDocuments_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayer.h"
#include "dgtkRollingShutter.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// The text documents of a dataset. Every `...Text` function is a pure function of its argument: lists are sorted where
// their order means nothing, numbers are the shortest that read back to the same double, nothing depends on clock,
// machine or locale. Every `read...` function throws an InputError that names the file and the place.

namespace dgtk
{

/// One camera at one frame, as in cameras.json.
struct CameraRecord
{
  std::string name;
  int frame = 0;
  int width = 0; ///< pixels
  int height = 0;
  /// Pixels from camera axes (x right, y down, z forward); pixel centres are at + 0.5.
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  bool hasK = true;                                ///< false: no matrix says how the model projects
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity(); ///< x_camera = R x_world + t
  Eigen::Vector3d t = Eigen::Vector3d::Zero();     ///< scene units
  std::string model = "pinhole";
  std::map<std::string, std::vector<double>> numbers; ///< further parameters of the model, such as "distortion"
  std::map<std::string, std::string> files; ///< likewise; relative to the dataset, and once read as they can be opened
  RollingShutter rollingShutter;            ///< R and t are at the frame's own time
  double near = 0;                          ///< scene units, camera z
  double far = 0;
};

/// One object, as in objects.json.
struct ObjectRecord
{
  std::uint32_t id = 0; ///< value of the `objects` layer, >= 1
  std::string name;
  std::string objectClass;   ///< "class" in the file; may be empty
  std::uint32_t classId = 0; ///< value of the `classes` layer, >= 1
  std::string model;         ///< path relative to the dataset, or the name of a built-in model
  std::uint64_t triangles = 0;
  bool isStatic = false;  ///< the same world matrix and no deformation at all frames of the scene
  bool deforming = false; ///< its vertices move in its own frame
  /// 64 hexadecimal digits, of its triangles and their look at the scene's first frame: equal for objects of equal
  /// model. "": not known, in the first datasets.
  std::string geometry;
  std::string geometryFile; ///< a PLY file of it, relative to the dataset; "": none
};

/// A class of objects, as in objects.json. Only id and name are always known.
struct ClassRecord
{
  std::uint32_t id = 0; ///< value of the `classes` layer, >= 1
  std::string name;
  std::string supercategory;
  std::optional<bool> thing;                ///< what can be counted; false: stuff
  std::optional<std::array<int, 3>> color;  ///< sRGB, 0 to 255
  std::vector<std::string> keypoints;       ///< names
  std::vector<std::array<int, 2>> skeleton; ///< pairs of `keypoints`, from 1
};

/// Where an object is at a frame, as in poses.json.
struct PoseRecord
{
  int frame = 0;
  std::uint32_t id = 0;
  bool visible = true; ///< otherwise it is not there at this frame
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity(); ///< x_world = matrix (x_object, 1)
  bool rigid = false; ///< x_world = R diag(scale) x_object + t; otherwise R and scale are not known
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity(); ///< proper; a mirrored object has scale.x < 0
  Eigen::Vector3d t = Eigen::Vector3d::Zero();     ///< scene units
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

/// A file that the dataset was made from.
struct InputRecord
{
  std::string path; ///< relative to the dataset
  std::uint64_t bytes = 0;
  std::string sha256; ///< 64 hexadecimal digits
};

/// A file of the dataset.
struct DatasetFile
{
  std::string path; ///< relative to the dataset, with '/'
  std::uint64_t bytes = 0;
  std::string sha256; ///< 64 hexadecimal digits
  std::string layer;  ///< "" for documents such as cameras.json
  std::string camera; ///< "" likewise
  int frame = -1;     ///< -1 likewise
};

/// Keys of objects.json; also the names of the layers whose values they list.
constexpr const char* objectsKey = "objects";
constexpr const char* classesKey = "classes";
/// Documents beside the manifest.
constexpr const char* posesName = "poses.json";

/// The meaning of a layer whose manifest does not say one: as its unit, frame, value for nothing and channels have it.
DGTKDATASETIO_EXPORT Meaning impliedMeaning(const LayerSpec& spec);

/// A layer and a format that it was written in.
struct LayerRecord
{
  LayerSpec spec;
  std::string format;
};

/// A layer of which pictures have no file, and what they lack.
struct EmptyRecord
{
  std::string layer;
  std::size_t pictures = 0; ///< without a file
  std::size_t of = 0;       ///< pictures of the dataset
  std::string needs;        ///< what a picture needs to have one
};

struct Manifest
{
  std::string version;                                      ///< of DGTk
  std::string requestHash;                                  ///< the one that Journal was given
  std::vector<std::pair<std::string, std::string>> request; ///< option and value, in this order
  std::string units;                                        ///< of the scene; "" when it does not say
  double metresPerUnit = 0;                                 ///< 0: not known
  double fps = 0;                                           ///< frames a second: frame / fps is its time; 0: not known
  std::map<std::string, std::string> info; ///< of the dataset: "name", "license" ...; those that are known
  std::vector<InputRecord> inputs;
  std::vector<LayerRecord> layers;
  std::vector<EmptyRecord> empty;
  std::vector<std::string> warnings; ///< lines
  std::vector<DatasetFile> files;    ///< written sorted by path
};

DGTKDATASETIO_EXPORT std::string camerasText(std::vector<CameraRecord> cameras);
/// `classes` are those that the scene fixes; those of the objects are added.
DGTKDATASETIO_EXPORT std::string objectsText(
  std::vector<ObjectRecord> objects, const std::vector<ClassRecord>& classes = {});
DGTKDATASETIO_EXPORT std::string posesText(std::vector<PoseRecord> poses);
DGTKDATASETIO_EXPORT std::string manifestText(Manifest manifest);

DGTKDATASETIO_EXPORT std::vector<CameraRecord> readCameras(const std::string& path);
DGTKDATASETIO_EXPORT std::vector<ObjectRecord> readObjects(const std::string& path);
/// The classes in objects.json, also those that no object has; by their numbers.
DGTKDATASETIO_EXPORT std::vector<ClassRecord> readClasses(const std::string& path);
DGTKDATASETIO_EXPORT std::vector<PoseRecord> readPoses(const std::string& path);
DGTKDATASETIO_EXPORT Manifest readManifest(const std::string& path);
/// The manifest of the dataset in a folder. Throws InputError also when a link stands in place of it or of a file that
/// it lists, or of a folder that leads there: what is read of a dataset is in its folder. Files may be missing.
DGTKDATASETIO_EXPORT Manifest readManifestIn(const std::string& folder);

/// Writes DIR/`name` atomically and describes it for the manifest (layer, camera and frame as given).
DGTKDATASETIO_EXPORT DatasetFile writeDocument(const std::string& folder, const std::string& name,
  const std::string& text, const std::string& layer = {}, const std::string& camera = {}, int frame = -1);

/// The thesis's calibration of an image (section 4.3.1).
struct Calibration
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity(); ///< from unit cube, homogeneous, from camera (OpenGL axes)
  Eigen::Matrix<double, 3, 4> Rt = Eigen::Matrix<double, 3, 4>::Zero(); ///< from world
  int x = 0;                                                            ///< viewport, pixels
  int y = 0;
  int width = 0;
  int height = 0;

  /// Pixels from world, homogeneous, y up from the bottom edge: viewport matrix * K * [R|t] (equation 4.5).
  Eigen::Matrix<double, 3, 4> cameraMatrix() const;
};

/// K is the projection without its third row and fourth column, [R|t] the viewing matrix without its last row. An
/// orthographic projection, whose homogeneous coordinate is constant, keeps the form: K then has the fourth column in
/// place of the third, and [R|t] the viewing matrix's last row in place of its third.
DGTKDATASETIO_EXPORT Calibration makeCalibration(
  const Eigen::Matrix4d& projection, const Eigen::Matrix4d& modelView, int width, int height);
DGTKDATASETIO_EXPORT std::string calibrationText(const Calibration& calibration);
DGTKDATASETIO_EXPORT Calibration readCalibration(const std::string& path);

} // namespace dgtk

#endif
