// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneDescription_h
#define dgtkSceneDescription_h

#include "dgtkSceneModule.h"

#include "dgtkCameraEntry.h"
#include "dgtkLightKind.h"
#include "dgtkRollingShutter.h"
#include "dgtkSensorParameters.h"
#include "dgtkTrack.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// Frame numbers in files: 0 to largestFrame.
constexpr int largestFrame = 999999;

/// Numbers of a .scene key-frame line that have no effect on what the line stands for (the rotation of a light, of a
/// camera's look-at point); kept so that the scene can be written back.
struct UnusedKeys
{
  Track<Quaternion> orientation;
  Track<Eigen::Vector3d> scale{ Eigen::Vector3d(1, 1, 1) };
};

/// What replaces properties of a model's material. Colours sRGB in [0, 1].
struct MaterialOverride
{
  std::string material; ///< name of a material of the model, or "*": all of them
  std::optional<Track<Eigen::Vector3d>> ambient;
  std::optional<Track<Eigen::Vector3d>> diffuse;
  std::optional<Track<Eigen::Vector3d>> specular;
  std::optional<Track<Eigen::Vector3d>> emission;
  std::optional<Track<double>> shininess; ///< Phong exponent, [0, 128]
  std::optional<Track<double>> opacity;   ///< [0, 1]
  std::optional<std::string> texture;     ///< picture file relative to the scene's folder; "": none
  std::optional<Track<double>> metallic;  ///< [0, 1]; this or roughness makes the material a physically based one
  std::optional<Track<double>> roughness; ///< [0, 1], perceptual: the square root of the microfacets' width
  std::optional<std::string> normalMap;   ///< tangent-space normals as glTF has them; picture file or ""
  std::optional<std::string> bump;        ///< heights, black low; picture file or ""
  std::optional<Track<double>> bumpScale; ///< scene units between black and white
  std::optional<std::string> metallicRoughnessMap; ///< blue times metallic, green times roughness; picture file or ""
  std::optional<std::string> emissionMap;          ///< times the emission, sRGB; picture file or ""
  std::optional<std::string> occlusionMap;         ///< red times the light of the environment; picture file or ""
};

/// The picture files of a material, in the order of materialTextures (dgtkModel.h).
constexpr std::array<std::optional<std::string> MaterialOverride::*, 6> materialPictures{ &MaterialOverride::texture,
  &MaterialOverride::normalMap, &MaterialOverride::bump, &MaterialOverride::metallicRoughnessMap,
  &MaterialOverride::emissionMap, &MaterialOverride::occlusionMap };

/// Which motion of its model an object shows. With these defaults a model that has a motion plays its first one from
/// frame 0 on, over and over; a model without motion is not affected.
/// Model frame at scene frame f: first(sequence) + offset + max(0, f - start) / scene fps * sequence fps * rate.
struct AnimationDescription
{
  std::string sequence; ///< name, or number from 0 when no sequence has that name; "": the first
  double start = 0;     ///< scene frame at which it begins; before, it stands at its first shown frame
  double offset = 0;    ///< model frames after the sequence's first, >= 0
  double rate = 1;      ///< speed; 1 is the model's own, 0 stands still; >= 0
  bool loop = true;     ///< begin again at the end; otherwise hold the last frame
};

/// A point of an object that has a name: where it is on the object, or the vertex of the model that it goes with.
struct KeypointDescription
{
  std::string name;
  Eigen::Vector3d position{ 0, 0, 0 }; ///< object coordinates: before scale and placement
  std::optional<std::uint32_t> vertex; ///< instead: from 0, of the vertices of the model's file
};

/// A model placed in the scene. world_from_object = world_from_parent * T(position) * R(orientation) * S(scale).
struct ObjectDescription
{
  std::string name;      ///< unique among objects
  std::string className; ///< semantic class, free text; may be empty
  std::string model;     ///< path as written, relative to the scene's folder
  std::string parent;    ///< name of an object; "": the world
  /// An object that is not visible at a frame is not there, but for its id, and still carries its children; one that is
  /// never visible has no id.
  Track<bool> visible{ true };
  Track<Eigen::Vector3d> position{ Eigen::Vector3d(0, 0, 0) };
  Track<Quaternion> orientation;
  Track<Eigen::Vector3d> scale{ Eigen::Vector3d(1, 1, 1) }; ///< no component 0
  AnimationDescription animation;
  std::vector<MaterialOverride> materials; ///< applied in this order
  /// Texture variant: name (with or without folder and extension) or number from 0 of one of the model's textures,
  /// which then replaces the texture of all its textured materials; "": as the model says.
  std::string skin;
  std::vector<KeypointDescription> keypoints; ///< names are unique
  long line = 0;                              ///< in the file it was read from; 0 unknown
};

/// Meanings as in LightState.
struct LightDescription
{
  std::string name; ///< unique among lights
  LightKind kind = LightKind::Point;
  Track<bool> enabled{ true };
  Track<Eigen::Vector3d> position{ Eigen::Vector3d(0, 0, 0) };
  Track<Eigen::Vector3d> target{ Eigen::Vector3d(0, 0, 0) };
  Track<Eigen::Vector3d> ambient{ Eigen::Vector3d(0, 0, 0) };
  Track<Eigen::Vector3d> diffuse{ Eigen::Vector3d(1, 1, 1) };
  Track<Eigen::Vector3d> specular{ Eigen::Vector3d(1, 1, 1) };
  Eigen::Vector3d attenuation{ 1, 0, 0 }; ///< constant, linear, quadratic; >= 0, not all 0
  Track<double> coneAngle{ 30 };          ///< degrees, half the opening, (0, 90]
  Track<double> exponent{ 1 };            ///< [0, 128]
  Track<double> intensity{ 1 };           ///< >= 0
  bool shadows = false;                   ///< objects cast shadows
  int shadowSize = 2048;                  ///< texels a side of its shadow map, [16, 16384]
  UnusedKeys unused;
  long line = 0;
};

/// Light that comes from everywhere. Of `image`, an equirectangular picture, the centre column lies towards -z (upAxis
/// z: towards +y), columns to the right towards +x, the top row towards the up axis.
struct EnvironmentDescription
{
  std::string image;      ///< path as written, relative to the scene's folder; "": there is no environment
  double intensity = 1;   ///< times its radiance, >= 0
  double rotation = 0;    ///< degrees, counter-clockwise about the up axis, seen from above
  bool background = true; ///< it is seen where there is no object
};

/// exp(-density (distance - start)) of a surface's colour is left at a distance beyond `start`.
struct FogDescription
{
  Track<Eigen::Vector3d> color{ Eigen::Vector3d(0.5, 0.5, 0.5) }; ///< sRGB in [0, 1]
  Track<double> density;                                          ///< 1 / scene units; 0: there is no fog
  Track<double> start;                                            ///< scene units from the camera
};

/// Motion blur: the colour of a frame is the mean over an interval of time.
struct ShutterDescription
{
  double open = 0;    ///< frames relative to the frame, [-1000, 1000]
  double close = 0;   ///< >= open
  int exposures = 16; ///< pictures that are averaged, [1, 65536]
  /// Whether colour is of another time than the frame's.
  bool blurs() const { return this->close > this->open || this->open != 0; }
};

/// Depth of field of a thin lens.
struct LensDescription
{
  double aperture = 0;       ///< diameter of the entrance pupil, scene units; 0: a pinhole
  Track<double> focus{ 10 }; ///< depth of the plane in focus, scene units, > 0
  int exposures = 64;        ///< pictures that are averaged, [1, 65536]
  bool blurs() const { return this->aperture > 0; }
};

/// A parameter that a camera model has besides those of every camera: numbers, of which a single one may move, or a
/// file.
struct CameraValue
{
  std::vector<Track<double>> numbers;
  std::string file; ///< path as written, relative to the scene's folder
};

/// A camera. Poses are given either by eye, lookAt and up, or, when `posed`, by position and orientation.
struct CameraDescription
{
  std::string name;                 ///< unique among cameras; fit for a folder's name
  std::string model = "pinhole";    ///< one of cameraRows(); it says which of the parameters below the camera has
  int width = 0;                    ///< own image size, pixels; 0: the request's, or 640 x 480
  int height = 0;                   ///< 0 exactly when width is
  double aspect = 0;                ///< width / height of the view as of gluPerspective; 0: square pixels. Not with K
  Track<double> fovY{ 60 };         ///< without K: vertical field of view, degrees, (0, 180)
  std::optional<Eigen::Matrix3d> K; ///< pixels of the own image size, which must then be given
  Track<double> viewHeight{ 2 };    ///< orthographic: height of the image in scene units, > 0
  std::map<std::string, CameraValue> parameters; ///< further ones of the model, by name; others have their usual value
  double near = 0.1;                             ///< > 0
  double far = 1000;                             ///< > near
  Track<Eigen::Vector3d> eye{ Eigen::Vector3d(0, 0, 10) };
  Track<Eigen::Vector3d> lookAt{ Eigen::Vector3d(0, 0, 0) };
  Track<Eigen::Vector3d> up{ Eigen::Vector3d(0, 1, 0) };
  bool posed = false;
  Track<Eigen::Vector3d> position{ Eigen::Vector3d(0, 0, 0) };
  Track<Quaternion> orientation; ///< world_from_camera; camera axes x right, y down, z forward
  ShutterDescription shutter;
  RollingShutter rollingShutter;
  LensDescription lens;                   ///< pinhole only
  std::optional<SensorParameters> sensor; ///< none: the default sensor
  UnusedKeys unusedEye;
  UnusedKeys unusedLookAt;
  long line = 0;
  bool blurs() const { return this->shutter.blurs() || this->lens.blurs(); }
};

/// One entry of the list of things in the order of the file.
struct SceneItem
{
  enum class Kind
  {
    Object,
    Light,
    Camera
  };
  Kind kind = Kind::Object;
  std::size_t index = 0; ///< into objects, lights or cameras
  bool operator==(const SceneItem& o) const { return this->kind == o.kind && this->index == o.index; }
};

enum class UpAxis
{
  Y,
  Z
};

/// Class numbers: 0 is the background's.
constexpr int largestClassId = 65535;

/// A class of objects with the number that it has in every scene.
struct ClassDescription
{
  std::string name;                              ///< "": of objects without a class
  int id = 0;                                    ///< 1 to largestClassId, unique
  std::string supercategory = {};                ///< a class of classes, free text; may be empty
  std::optional<bool> thing = {};                ///< what can be counted; false: stuff, such as sky
  std::optional<std::array<int, 3>> color = {};  ///< sRGB, 0 to 255
  std::vector<std::string> keypoints = {};       ///< names; not empty: those that its objects may have
  std::vector<std::array<int, 2>> skeleton = {}; ///< pairs of `keypoints`, from 1
};

/// A scene as written. The world is right-handed; upAxis changes nothing but the `up` that a camera has by default.
struct DGTKSCENE_EXPORT SceneDescription
{
  std::string file;   ///< where it was read from; "" when made by program
  std::string folder; ///< relative paths start here; "": the current folder

  std::vector<ObjectDescription> objects;
  std::vector<LightDescription> lights;
  std::vector<CameraDescription> cameras;
  /// As the file lists them, those of each kind in their own order; empty: objects, lights, cameras.
  std::vector<SceneItem> order;

  std::vector<int> extraKeyFrames;   ///< ascending; key frames at which no track has a key
  double fps = 25;                   ///< scene frames a second, > 0
  Track<Eigen::Vector3d> background; ///< sRGB in [0, 1]
  EnvironmentDescription environment;
  FogDescription fog;
  std::string units;        ///< name of the unit of length, free text
  double metresPerUnit = 0; ///< as written; 0: as `units` has it, see metresOfUnit()
  /// What a dataset of it says of itself, by the words of datasetWords(); texts that are not empty.
  std::map<std::string, std::string> dataset;
  UpAxis upAxis = UpAxis::Y;
  std::uint64_t seed = 0; ///< below 2^53
  /// Fixed numbers of the classes; empty: numbered in the order of the objects. Otherwise every class of an object is
  /// among them.
  std::vector<ClassDescription> classes;
  std::string classFile; ///< where `classes` stand, as written, relative to the folder; "": in the scene

  /// The number that `classes` give to a class; 0 when there is none.
  int classIdOf(const std::string& className) const;
  /// Every key frame of every track and extraKeyFrames, ascending, without repetition.
  std::vector<int> keyFrames() const;
  int firstFrame() const; ///< first key frame; 0 without key frames
  int lastFrame() const;  ///< last key frame; 0 without key frames
  /// `file`, or "scene" for one that is in no file: what errors begin with.
  std::string title() const;
  /// `order`, filled in.
  std::vector<SceneItem> items() const;
  /// Metres in a scene unit; 0 where neither the number nor the name of the unit says it.
  double metres() const;
  /// `path` (of a model or texture) as it can be opened: absolute ones as they are, others below `folder`.
  std::string resolve(const std::string& path) const;
};

/// Metres in a unit of length of this name ("mm", "metres", "inch" ...); 0 for one that is not known.
DGTKSCENE_EXPORT double metresOfUnit(const std::string& name);
/// The keys of a scene's `dataset`.
DGTKSCENE_EXPORT const std::vector<std::string>& datasetWords();

/// What makeCamera() makes a camera of at a frame, in an image of this size; K of another size is scaled per axis.
/// Files are below `folder`.
DGTKSCENE_EXPORT CameraParameters cameraParameters(
  const CameraDescription& camera, double frame, int width, int height, const std::string& folder = {});

/// Whether a camera's model has a parameter of this name.
DGTKSCENE_EXPORT bool hasParameter(const CameraDescription& camera, const std::string& name);
/// Those of a model's parameters that stand in CameraDescription::parameters; none for a model that is not known.
DGTKSCENE_EXPORT std::vector<CameraParameter> ownParameters(const std::string& model);

/// Reads a .scene or .json file, by extension (case-insensitive), with its file of classes, and validates it. Models
/// are not opened. Throws InputError with file, line and key path.
DGTKSCENE_EXPORT SceneDescription readScene(const std::string& path);

/// Writes a scene, by extension, atomically; relative paths are rewritten relative to the new file's folder. Throws
/// InputError for what the format cannot say or what is not valid, naming object and property, and MachineError; what
/// stood under the name before is then untouched.
DGTKSCENE_EXPORT void writeScene(const SceneDescription& scene, const std::string& path);

/// The canonical .json text: keys in a fixed order, only values that are not the default, shortest numbers that read
/// back the same; ends with a newline. Relative paths are rewritten relative to `newFolder` ("" is the current one).
DGTKSCENE_EXPORT std::string toJson(const SceneDescription& scene, const std::string& newFolder);

/// The .scene text. Throws InputError for what .scene cannot say.
DGTKSCENE_EXPORT std::string toThesisScene(const SceneDescription& scene, const std::string& newFolder);

/// Throws InputError, with scene.file and the line where known, unless every value is in its range, names are unique,
/// parents exist without cycle, and `order` lists everything once. Names must be present.
DGTKSCENE_EXPORT void validate(const SceneDescription& scene);

/// Gives every object, light and camera without a name one of its own: <stem of the model>-<n>, Light<n>, Camera<n>.
DGTKSCENE_EXPORT void nameAll(SceneDescription& scene);

} // namespace dgtk

#endif
