// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTestScene_h
#define dgtkTestScene_h

#include "dgtkRasterSource.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk::test
{

/// Builds models by hand.
class ModelBuilder
{
public:
  ModelBuilder();
  /// Starts a part; triangles that follow belong to it. Returns its material for changes.
  Material& part(const Material& material = {});
  int texture(std::shared_ptr<const Image> image, const TextureWraps& wrap = {});
  /// Corners counter-clockwise from outside; texture coordinates (0, 0), (1, 0), (1, 1), (0, 1) times `repeat`.
  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d,
    double repeat = 1);
  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Unit sphere around the origin, `steps` from pole to pole, normals of the sphere.
  void sphere(int steps);
  std::shared_ptr<const Model> finish(bool uvs = true);

private:
  std::shared_ptr<Model> Made;
  std::shared_ptr<Geometry> Rest;
};

Instance instanceOf(std::shared_ptr<const Model> model, const Eigen::Vector3d& at = { 0, 0, 0 },
  const Eigen::Matrix3d& linear = Eigen::Matrix3d::Identity());
Material flat(const Eigen::Vector3d& color); ///< shows `color` whatever the lights
Material matte(const Eigen::Vector3d& color);

/// Camera at `eye` looking at `target`, y up.
View viewOf(std::shared_ptr<const CameraModel> model, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
  double near = 0.1, double far = 1000);
PixelRect whole(const View& view);
/// Sees [-4/3, 4/3] x [-1, 1] of z = 0 at 64 x 48.
View frontView(int width = 64, int height = 48);
std::shared_ptr<SceneState> stateOf(std::vector<std::shared_ptr<const Model>> models);

/// First hit of the ray through the pixel's centre by brute force in double precision; `margin` is the distance of the
/// centre from the nearest edge (pixels) among the triangles that the ray meets or nearly meets.
struct Reference
{
  Hit hit;
  double depth = 0;
  double margin = 0;
};

/// The triangles of a scene in the camera frame.
class RayCaster
{
public:
  RayCaster(const SceneState& state, const View& view);
  Reference cast(int x, int y) const;

private:
  struct Corners
  {
    Hit hit;
    Eigen::Vector3d at[3];
    Eigen::Vector2d low; ///< box in the image, where all corners are in front of the camera
    Eigen::Vector2d high;
    bool boxed = false;
  };
  View Seen;
  std::vector<Corners> Triangles;
};

/// One engine for all tests of the process.
RasterSource& source();
/// What makes colours: source(), unless usePictures() said "ray".
PictureSource& pictures();
void usePictures(const std::string& renderer);
VisibilityBuffer render(std::shared_ptr<const SceneState> state, const View& view);
ColorBuffer renderColor(
  std::shared_ptr<const SceneState> state, const View& view, int samples = 1, VisibilityBuffer* hits = nullptr);
Eigen::Vector3d colorAt(const ColorBuffer& colors, int x, int y);

/// Ids differ from the exact ones only where an edge passes within 1/128 pixel of the centre: rasterizers round
/// vertices to 1/256 pixel.
constexpr double edgeTolerance = 1.0 / 128;
/// Compares every `step`th pixel with RayCaster; returns how many differ and fails where that is not explained by
/// EdgeTolerance.
int comparedWithRays(const SceneState& state, const View& view, const VisibilityBuffer& hits, int step = 1);

/// Saves a picture under the system's temporary folder when DGTK_SAVE_PICTURES is set.
void savePicture(const std::string& name, const ColorBuffer& colors);
void savePicture(const std::string& name, const VisibilityBuffer& hits);

} // namespace dgtk::test

#endif
