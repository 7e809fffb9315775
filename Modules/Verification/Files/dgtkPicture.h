// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPicture_h
#define dgtkPicture_h

#include "dgtkDataset.h"
#include "dgtkMeter.h"
#include "dgtkTimedSight.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Pixels: as close to an edge, either of two surfaces may have been recorded.
constexpr double edgeReach = 1.0 / 64;
/// Part of the depth by which a float64 depth may differ from that of its triangle's plane. Two computations in double
/// precision differ by some 1e-14, times as much as the view grazes the triangle.
constexpr double wideDepthTolerance = 1e-9;
/// The same of a float32 depth, which is rounded by up to 6e-8 of itself.
constexpr double narrowDepthTolerance = 1e-7;
inline double depthTolerance(const PictureFile& depth)
{
  return depth.type() == PixelType::Float64 ? wideDepthTolerance : narrowDepthTolerance;
}

/// Wrong values of a few rows after which no pixel is looked around any more: the layer is wrong as a whole.
constexpr std::uint64_t usualPatience = 256;

/// Value of parts and triangles where there is nothing; a 16-bit file cannot hold it.
constexpr std::uint32_t noId = 0xFFFFFFFFu;

/// How the surface of a pixel was found.
enum class Mark : std::uint8_t
{
  Same, ///< Embree's own hit agrees with the files
  Edge, ///< a surface within EdgeReach, or coincident with Embree's, agrees
  Wrong ///< none does
};

/// The surfaces at the centres of a picture's pixels.
struct Surfaces
{
  int width = 0;
  std::vector<Hit> own;  ///< Embree's
  std::vector<Hit> hits; ///< what agrees with depth, objects, parts and triangles of the files
  std::vector<Mark> marks;
  std::size_t index(int x, int y) const { return std::size_t(y) * this->width + x; }
};

/// One camera at one frame.
class Picture
{
public:
  Picture(Dataset& dataset, const CameraRecord& record);

  Dataset& dataset() const { return this->Owner; }
  const std::string& camera() const { return this->Record.name; }
  int frame() const { return this->Record.frame; }
  int width() const { return this->Record.width; }
  int height() const { return this->Record.height; }
  /// At the picture's own time.
  const Sight& sight() const { return *this->Time->middle(); }
  const Eye& eye() const { return this->sight().eye(); }
  /// At the time of a pixel; the camera frame of all that is said of it.
  const Sight& sight(int x, int y) const
  {
    return this->Time->rolls() ? *this->Sights[std::size_t(y) * std::size_t(this->width()) + std::size_t(x)]
                               : this->sight();
  }
  const TimedSight& time() const { return *this->Time; }
  ThreadPool& pool() const { return this->Owner.pool(); }

  /// The first of the suffixes that exists, null for none. Throws InputError for a damaged file.
  PicturePointer image(const std::string& layer, const std::vector<std::string>& suffixes);
  /// Values of a layer: .npy, else .exr, .pfm or .dgd.
  PicturePointer values(const std::string& layer);
  /// Ids of a layer: .npy, else .png or .ppm.
  PicturePointer ids(const std::string& layer);
  bool has(const std::string& layer) const;
  /// A layer that is not the subject of the check: null also where it is damaged.
  template <typename Read>
  PicturePointer quietly(const Read& read)
  {
    try
    {
      return read();
    }
    catch (const std::exception&)
    {
      return nullptr;
    }
  }

  const Surfaces& surfaces();
  /// What files of parts and triangles say of a hit.
  std::uint32_t partId(const Hit& hit) const;
  std::uint32_t triangleId(const Hit& hit) const;
  /// The point seen by a pixel, camera frame: at the file's depth where it is float64, else at the triangle's. Only
  /// where surfaces().hits has an object.
  Eigen::Vector3d point(int x, int y) const;
  /// Surfaces first met within EdgeReach of a pixel's centre, or coincident with those; object 0 for none.
  std::vector<Hit> nearby(int x, int y) const;
  /// Whether some triangle at this range at a pixel's centre ends within EdgeReach of it: on the border of a texel that
  /// is there and one that is not, rays beside the centre may all miss what the one through it meets.
  bool isEdgeAt(int x, int y, double range) const;
  /// To be called before point() is used by several threads.
  void preparePoints();

private:
  struct Claims;
  bool agrees(const Claims& claims, const Hit& hit, int x, int y) const;
  bool findNearby(const Claims& claims, int x, int y, Hit& hit) const;
  /// A triangle with a cut-out texture whose edge runs here: rays fall on either side of it in a texture that repeats.
  bool findCutOut(const Claims& claims, int x, int y, Hit& hit) const;
  /// Whether a triangle ends within EdgeReach of a pixel's centre.
  bool endsAt(const Hit& hit, int x, int y) const;
  /// The same, and nothing hides it.
  bool isOnEdge(const Hit& hit, int x, int y) const;
  /// Embree's hits.
  std::vector<Hit> ownHits() const;
  void resolveRow(const Claims& claims, int y, int& patience);

  Dataset& Owner;
  CameraRecord Record;
  std::shared_ptr<const TimedSight> Time;
  std::vector<std::shared_ptr<const Sight>> Sights; ///< of pixels with times of their own
  std::map<std::string, PicturePointer> Images;
  std::unique_ptr<Surfaces> TheSurfaces;
  PicturePointer Depth;
};

} // namespace dgtk

#endif
