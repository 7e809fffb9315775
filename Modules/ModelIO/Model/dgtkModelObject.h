// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelObject_h
#define dgtkModelObject_h

#include "dgtkModelBuilder.h"

#include <algorithm>
#include <cfloat>

namespace dgtk
{

/// False for NaN and for what single precision cannot hold.
inline bool isDrawable(const Eigen::Vector3d& v)
{
  return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= double(FLT_MAX);
}

/// Makes room for `more` elements: exactly, when there is one object, and geometrically for many.
template <typename T>
void makeRoom(std::vector<T>& v, std::size_t more)
{
  if (v.capacity() - v.size() < more)
  {
    v.reserve(std::max(v.size() + more, v.capacity() + v.capacity() / 2));
  }
}

/// The object that a ModelBuilder is collecting.
struct ModelObject
{
  struct Surface
  {
    std::uint32_t firstCorner;
    std::uint32_t corners;
    std::uint32_t firstTriangle;
    std::uint32_t triangles;
    SurfaceStyle style;
    Eigen::Vector3d normal; ///< unit length, or 0 for a surface without area
    double area;            ///< twice its area
    bool isPlaced;          ///< a corner has a texture coordinate
  };
  std::string name;
  std::uint32_t firstVertex = 0;
  double crease = 61;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Corner> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into corners
  std::vector<Surface> surfaces;
  std::vector<Eigen::Vector3d> polygon;          ///< scratch
  std::vector<std::array<std::uint32_t, 3>> cut; ///< scratch

  std::uint32_t local(const Corner& corner) const { return corner.vertex - this->firstVertex; }
};

} // namespace dgtk

#endif
