// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVisibility_h
#define dgtkVisibility_h

#include "dgtkVisibilityModule.h"

#include "dgtkLayer.h"
#include "dgtkSceneState.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

class ThreadPool;

/// What the ray through a pixel's centre meets first. object: id, 0 nothing; triangle: index into Model::triangles.
struct Hit
{
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;
  bool operator==(const Hit& o) const { return this->object == o.object && this->triangle == o.triangle; }
  bool operator!=(const Hit& o) const { return !(*this == o); }
};

/// The hits of a rectangle of an image. Integers only; every value is derived from them by exact arithmetic.
struct VisibilityBuffer
{
  PixelRect rect;        ///< in image pixels
  std::vector<Hit> hits; ///< rect.width * rect.height, rows top to bottom

  void resize(const PixelRect& r)
  {
    this->rect = r;
    this->hits.resize(std::size_t(r.width) * r.height);
  }
  /// x, y in image pixels, inside rect.
  Hit& at(int x, int y) { return this->hits[std::size_t(y - this->rect.y) * this->rect.width + (x - this->rect.x)]; }
  const Hit& at(int x, int y) const
  {
    return this->hits[std::size_t(y - this->rect.y) * this->rect.width + (x - this->rect.x)];
  }
};

/// Colours of a rectangle of an image: RGB float32, display-referred (sRGB-encoded) in [0, 1], rows top to bottom.
struct ColorBuffer
{
  PixelRect rect;
  std::vector<float> rgb;

  void resize(const PixelRect& r)
  {
    this->rect = r;
    this->rgb.resize(std::size_t(r.width) * r.height * 3);
  }
};

/// An engine that fills visibility buffers. One scene state and one view at a time; not thread-safe.
class DGTKVISIBILITY_EXPORT VisibilitySource
{
public:
  virtual ~VisibilitySource() = default;
  /// "raster" or "ray".
  virtual std::string name() const = 0;
  /// Prepares for a scene and a view; what did not change since the last call is kept. `state` must stay alive.
  virtual void setScene(std::shared_ptr<const SceneState> state, const View& view) = 0;
  /// Fills `hits` for `rect`, which must be a canonical tile of the image (see TileGrid). The result depends on scene,
  /// view and pixel only.
  virtual void render(const PixelRect& rect, VisibilityBuffer& hits) = 0;
};

/// An engine that also gives colours.
class DGTKVISIBILITY_EXPORT ColorSource : public VisibilitySource
{
public:
  /// Fills `colors` with `samples` x `samples` samples a pixel averaged by a box. With hits != nullptr and samples ==
  /// 1, colour and hits come from the same pass, as they were drawn: a pixel's colour and its labels cannot disagree,
  /// but beside edges the labels may be others than those of render(). (With samples > 1 the hits are render()'s.)
  void renderColor(const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits)
  {
    this->drawColor(rect, samples, colors, hits)();
  }
  /// renderColor() in two steps: draws, and returns what remains to be done until `colors` and `hits` are filled. That
  /// may be called once on any thread, while this source draws other things; the buffers must live until then.
  virtual std::function<void()> drawColor(
    const PixelRect& rect, int samples, ColorBuffer& colors, VisibilityBuffer* hits) = 0;
};

/// Asks whether something stands between two points. Thread-safe after setScene. Pixels of views with `instants` are
/// looked at in the scene of their own times, not in that of setScene.
class DGTKVISIBILITY_EXPORT OcclusionQuery
{
public:
  virtual ~OcclusionQuery() = default;
  virtual void setScene(std::shared_ptr<const SceneState> state) = 0;
  /// All surfaces along the ray through `pixel`, near to far within the view's near and far; coincident ones in the
  /// order of (object, triangle).
  virtual void allHits(const View& view, const Eigen::Vector2d& pixel, std::vector<Hit>& hits) const = 0;
  /// The same of many at once; `hits` has as many lists. Quicker; those that follow each other should be neighbours.
  virtual void allHits(
    const View& view, const Eigen::Vector2d* pixels, std::size_t count, std::vector<Hit>* hits) const = 0;
  /// First surface strictly between the camera and a point of `target` at `x_in_world`; object 0 when there is none.
  /// The target triangle itself never hides the point.
  virtual Hit occluder(const View& view, const Eigen::Vector3d& x_in_world, const Hit& target) const = 0;
  /// The same of many points at once, each of its target. Quicker; those that follow each other should be neighbours.
  virtual void occluders(
    const View& view, const Eigen::Vector3d* x_in_world, const Hit* targets, std::size_t count, Hit* found) const = 0;
  /// The same for a view with `instants`, each point at its own frame, in the scene of that time.
  virtual void occludersAt(const View& view, const double* frames, const Eigen::Vector3d* x_in_world,
    const Hit* targets, std::size_t count, Hit* found) const = 0;
};

/// The fixed grid of canonical tiles on which every image is drawn, whatever tile size is asked for: tiles are anchored
/// at the image's top-left corner and depend on the image size only, so no request can move a vertex by a rounding
/// error. An image of at most 4 Mpixel and 4096 pixels a side is one canonical tile; larger ones are cut into tiles of
/// 2048 x 512 (the last column and row are cut off at the image's edge).
class DGTKVISIBILITY_EXPORT TileGrid
{
public:
  TileGrid(int width, int height);
  int columns() const { return this->Columns; }
  int rows() const { return this->RowCount; }
  PixelRect tile(int column, int row) const;

private:
  int Width;
  int Height;
  int TileWidth;
  int TileHeight;
  int Columns;
  int RowCount;
};

} // namespace dgtk

#endif
