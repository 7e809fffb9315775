// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraEntry_h
#define dgtkCameraEntry_h

#include "dgtkCameraModel.h"
#include "dgtkJson.h"

#include <cstddef>

namespace dgtk
{

/// A parameter of a camera model: a key of its cameras in scene files and in cameras.json.
struct CameraParameter
{
  enum class Kind
  {
    Numbers,
    Matrix, ///< K; it need not be given
    File    ///< name of a file, relative to the scene or dataset
  };
  std::string name;
  std::string unit;                                                           ///< "" for none
  std::string help;                                                           ///< one line
  Range range = { -1e15, 1e15, false, false, "a number from -1e15 to 1e15" }; ///< of each number
  std::vector<double> usual = {};          ///< where it is not given; empty: it has to be
  std::vector<std::size_t> counts = { 1 }; ///< how many numbers it may be: one, or a list of so many
  bool moves = false;                      ///< it is one number and may have key frames
  Kind kind = Kind::Numbers;
  bool saidByK = false; ///< with K it is not given
};

/// Those that scenes know of every camera: a model that has one takes it from here, whole.
DGTKCAMERA_EXPORT CameraParameter fieldOfViewParameter(); ///< "fovY", degrees, vertical
DGTKCAMERA_EXPORT CameraParameter aspectParameter();      ///< "aspect", width / height of the view; 0: square pixels
DGTKCAMERA_EXPORT CameraParameter viewHeightParameter();  ///< "viewHeight", scene units
DGTKCAMERA_EXPORT CameraParameter matrixParameter();      ///< "K", pixels

/// What the file of a model defines: `const CameraEntry camera<Name>`.
struct CameraEntry
{
  /// Besides size, pose, near and far; none is called like a key that all cameras have. In the order of scene files.
  std::vector<CameraParameter> parameters;
  /// Called with numbers of the right count and range for each of `parameters` that K does not say, given or usual, and
  /// with the files. Hands them to CameraModel's constructor. Throws UsageError for what does not go together.
  std::shared_ptr<const CameraModel> (*make)(const CameraParameters& parameters);

  /// Null when there is none of the name.
  DGTKCAMERA_EXPORT const CameraParameter* find(const std::string& name) const;
};

/// One row of the registry of camera models.
struct CameraRow
{
  std::string model; ///< "pinhole": as in scene files and cameras.json, and CameraModel::name()
  std::string description;
  const CameraEntry* entry;
};
DGTKCAMERA_EXPORT const std::vector<CameraRow>& cameraRows();

/// Adds a model of a program of its own, before anything asks for cameras: `const bool added = addCamera({ "fisheye",
/// "equidistant", &entry });` beside the entry is a row. The entry lives as long as the program. False, and nothing
/// added, for a model that is there already.
DGTKCAMERA_EXPORT bool addCamera(const CameraRow& row);

/// The entry of a model; null for one that is not known.
DGTKCAMERA_EXPORT const CameraEntry* findCamera(const std::string& model);

/// A camera of a model: parameters that are not given have their usual values. Throws UsageError for a model that is
/// not known, a size, count or number out of range, a parameter that the model does not have or that is missing, and
/// what its make() refuses.
DGTKCAMERA_EXPORT std::shared_ptr<const CameraModel> makeCamera(
  const std::string& model, const CameraParameters& parameters);

/// "4, 5 or 8": how many numbers a parameter may be, as errors say it.
DGTKCAMERA_EXPORT std::string countsText(const CameraParameter& parameter);

} // namespace dgtk

#endif
