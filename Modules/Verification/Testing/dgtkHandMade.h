// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHandMade_h
#define dgtkHandMade_h

#include "dgtkDataset.h"
#include "dgtkDatasetDocuments.h"
#include "dgtkTestSupport.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk::test
{

/// A dataset whose files a test writes number by number. Pictures are 8 x 6, the camera looks from the world's origin
/// along z: what is at (x, y, z) is seen at (100 x / z + 4.5, 100 y / z + 2.5), the centre of pixel (4, 2) at x = y =
/// 0.
class HandMade
{
public:
  static constexpr int width = 8;
  static constexpr int height = 6;

  /// An object "oN" for each Wavefront model, N from 1; `more`: further keys of each, after a comma. Cameras of these
  /// names at frame 0.
  explicit HandMade(const std::vector<std::string>& models, const std::vector<std::string>& more = {},
    const std::vector<std::string>& cameras = { "a" });

  /// A camera at frame 0, to be changed.
  CameraRecord& camera(std::size_t index = 0) { return this->Cameras[index]; }
  /// What objects.json says of an object, to be changed.
  ObjectRecord& object(std::size_t index) { return this->Objects[index]; }
  /// The first camera again, at frame 1.
  CameraRecord& later();
  /// "a/normal/000000.npy", of these values; `narrow`: of float32.
  void image(const std::string& name, int channels, const std::function<double(int x, int y, int channel)>& value,
    bool narrow = false);
  void file(const std::string& name, const std::string& text);

  /// What `check` says in the row of a layer.
  Residual verify(const std::string& check, const std::string& layer);
  /// For what a check is made of.
  std::unique_ptr<Dataset> dataset();

private:
  TemporaryFolder Folder;
  std::vector<CameraRecord> Cameras;
  std::vector<ObjectRecord> Objects;
  Manifest TheManifest;
};

/// A triangle as a Wavefront model.
std::string triangleModel(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const std::string& face = "f 1 2 3");
/// One that fills all pictures at a depth.
std::string wallModel(double depth);

} // namespace dgtk::test

#endif
