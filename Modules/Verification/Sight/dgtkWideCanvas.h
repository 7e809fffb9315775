// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWideCanvas_h
#define dgtkWideCanvas_h

#include "dgtkPicture.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace dgtk
{

/// Pixels and the borders of the smallest box around them.
struct Extent
{
  std::uint64_t pixels = 0;
  std::array<double, 4> box{ infinite, infinite, -infinite, -infinite };
  void add(double x0, double y0, double x1, double y1)
  {
    this->box = { std::min(this->box[0], x0), std::min(this->box[1], y0), std::max(this->box[2], x1),
      std::max(this->box[3], y1) };
  }
  void addPixel(int x, int y)
  {
    ++this->pixels;
    this->add(x, y, x + 1, y + 1);
  }
  void add(const Extent& other)
  {
    this->pixels += other.pixels;
    this->add(other.box[0], other.box[1], other.box[2], other.box[3]);
  }
  bool empty() const { return this->box[0] > this->box[2]; }
};

/// What objects cover around a picture: of a canvas of three times the picture's width and height with the picture in
/// its middle, but for the picture's own pixels. Of a linear camera without rolling shutter the triangles are drawn, in
/// double precision; of others the rays that there are ask for all surfaces.
class WideCanvas
{
public:
  explicit WideCanvas(Picture& picture);

  Extent around(std::uint32_t object) const;
  struct Bounds
  {
    Extent least;
    Extent most;
  };
  /// The same without and with the pixels whose rays within EdgeReach do not all say the same.
  Bounds boundsAround(std::uint32_t object) const;

private:
  struct Face;
  struct Band;
  std::vector<Face> faces(std::uint32_t object) const;
  void draw(std::uint32_t object, const Face& face, Band& band) const;
  Band drawn(std::uint32_t object, const std::vector<Face>& faces, int y, int rows) const;
  bool isMet(std::uint32_t object, const Eigen::Vector2d& pixel) const;
  void findAlongRays();
  const Sight& sightAt(const Eigen::Vector2d& pixel) const;
  /// body(x, y) for the canvas's pixels in rows [y, y + rows).
  template <typename Body>
  void forPixels(int y, int rows, const Body& body) const;
  /// What find(y, rows) finds in the bands of the canvas, side by side.
  template <typename Find>
  auto ofBands(const Find& find) const;

  Picture& Owner;
  bool Drawn;
  std::map<double, std::shared_ptr<const Sight>> Sights; ///< of a rolling shutter, by time
  std::vector<Extent> Along;                             ///< by object id - 1, where nothing is drawn
};

} // namespace dgtk

#endif
