// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPieces.h"

#include "dgtkColorMap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace dgtk
{
namespace
{

constexpr double maxDepthRatio = 4;    // largest to smallest depth on an edge that is not cut
constexpr double cutRatio = 2;         // depths of neighbouring cuts
constexpr double roundingPixels = 2e4; // extent * focal length / depth: above it, rounding exceeds 1/512 pixel
constexpr double leastReach = 2;       // extent / depth that is always left to OpenGL

struct Corner
{
  Eigen::Vector3d x_in_view;
  Eigen::Vector3d weights; ///< barycentric
  double depth = 0;
};

double reach(const RasterCamera& camera) { return std::max(leastReach, roundingPixels / camera.focal); }

class Cutter
{
public:
  Cutter(const PieceRange& range, const RasterCamera& camera, Pieces& pieces)
    : Range(range)
    , Camera(camera)
    , Out(pieces)
    , Closest(range.extent / reach(camera))
  {
  }

  void run()
  {
    std::uint32_t begin = 0;
    for (std::uint32_t t = 0; t < this->Range.count; ++t)
    {
      if (this->difficult(t))
      {
        this->cut(t);
        if (t > begin)
        {
          this->Out.others.emplace_back(begin, t - begin);
        }
        begin = t + 1;
      }
    }
    if (begin < this->Range.count)
    {
      this->Out.others.emplace_back(begin, this->Range.count - begin);
    }
  }

private:
  const Eigen::Vector3d& position(std::uint32_t triangle, int corner) const
  {
    return this->Range.geometry
      ->positions[this->Range.model->triangles[this->Range.first + triangle][std::size_t(corner)]];
  }

  bool difficult(std::uint32_t triangle)
  {
    const Eigen::Vector4d row = -this->Range.view_from_object.row(2).transpose();
    double least = 1e300;
    double largest = -1e300;
    for (int k = 0; k < 3; ++k)
    {
      const double depth = row.head<3>().dot(this->position(triangle, k)) + row.w();
      least = std::min(least, depth);
      largest = std::max(largest, depth);
    }
    if (largest < this->Camera.near || least > this->Camera.far)
    {
      return false;
    }
    if (least >= this->Camera.near && largest <= maxDepthRatio * least && least >= this->Closest)
    {
      return false;
    }
    return this->maySee(triangle);
  }

  bool maySee(std::uint32_t triangle)
  {
    unsigned int outsideAll = 15;
    for (int k = 0; k < 3; ++k)
    {
      Corner& corner = this->Corners[std::size_t(k)];
      corner.x_in_view = this->Range.view_from_object.topLeftCorner<3, 3>() * this->position(triangle, k) +
                         this->Range.view_from_object.topRightCorner<3, 1>();
      corner.depth = -corner.x_in_view.z();
      corner.weights = Eigen::Vector3d::Unit(k);
      const Eigen::Vector4d clip = this->Camera.clip_from_view * corner.x_in_view.homogeneous();
      outsideAll &= (clip.x() > clip.w() ? 1u : 0u) | (-clip.x() > clip.w() ? 2u : 0u) |
                    (clip.y() > clip.w() ? 4u : 0u) | (-clip.y() > clip.w() ? 8u : 0u);
    }
    return outsideAll == 0;
  }

  /// The point of an edge at a depth. Both triangles of the edge compute the same.
  static Corner between(const Corner& a, const Corner& b, double depth)
  {
    const double t = (depth - a.depth) / (b.depth - a.depth);
    Corner result;
    result.x_in_view = a.x_in_view + t * (b.x_in_view - a.x_in_view);
    result.weights = a.weights + t * (b.weights - a.weights);
    result.depth = depth;
    return result;
  }

  /// Appends the cuts of an edge, and its end, nearer to farther; without its beginning unless that is cut off by the
  /// near plane.
  void appendEdge(const Corner& a, const Corner& b, std::vector<Corner>& chain) const
  {
    const double near = this->Camera.near;
    if (b.depth < near)
    {
      return;
    }
    if (a.depth < near)
    {
      chain.push_back(between(a, b, near));
    }
    const double from = std::max(a.depth, near);
    if (b.depth > maxDepthRatio * from)
    {
      double depth = near * cutRatio;
      while (depth < b.depth)
      {
        if (depth > from)
        {
          chain.push_back(between(a, b, depth));
        }
        depth *= cutRatio;
      }
    }
    chain.push_back(b);
  }

  void cut(std::uint32_t triangle)
  {
    std::array<Corner, 3> sorted = this->Corners;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Corner& a, const Corner& b) { return a.depth < b.depth; });
    this->Left.clear();
    this->Right.clear();
    if (sorted[0].depth >= this->Camera.near)
    {
      this->Left.push_back(sorted[0]);
      this->Right.push_back(sorted[0]);
    }
    this->appendEdge(sorted[0], sorted[2], this->Left);
    this->appendEdge(sorted[0], sorted[1], this->Right);
    this->appendEdge(sorted[1], sorted[2], this->Right);
    // The two chains end in the same corner; triangles between them, always onwards where the next point is nearer.
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < this->Left.size() || j + 1 < this->Right.size())
    {
      const bool left = j + 1 >= this->Right.size() ||
                        (i + 1 < this->Left.size() && this->Left[i + 1].depth <= this->Right[j + 1].depth);
      const Corner& next = left ? this->Left[i + 1] : this->Right[j + 1];
      this->emit(triangle, this->Left[i], next, this->Right[j]);
      ++(left ? i : j);
    }
  }

  void emit(std::uint32_t triangle, const Corner& a, const Corner& b, const Corner& c)
  {
    const Eigen::Vector3d ab = b.weights - a.weights;
    const Eigen::Vector3d ac = c.weights - a.weights;
    const double area = ab.y() * ac.z() - ab.z() * ac.y();
    if (area == 0)
    {
      return;
    }
    const Corner* turned[3] = { &a, area > 0 ? &b : &c, area > 0 ? &c : &b };
    const auto& indices = this->Range.model->triangles[this->Range.first + triangle];
    const bool colored = !this->Range.model->colors.empty() || this->Range.model->colorMap;
    for (const Corner* corner : turned)
    {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      Eigen::Vector2d uv = Eigen::Vector2d::Zero();
      Eigen::Vector4d color = Eigen::Vector4d::Zero();
      for (std::size_t k = 0; k < 3; ++k)
      {
        normal += corner->weights[Eigen::Index(k)] * this->Range.geometry->normals[indices[k]].cast<double>();
        if (!this->Range.model->uvs.empty())
        {
          uv += corner->weights[Eigen::Index(k)] * this->Range.model->uvs[indices[k]];
        }
        if (colored)
        {
          const auto own = vertexColor(*this->Range.model, indices[k]);
          color += corner->weights[Eigen::Index(k)] * Eigen::Vector4d(own[0], own[1], own[2], own[3]);
        }
      }
      for (int c3 = 0; c3 < 3; ++c3)
      {
        this->Out.positions.push_back(float(corner->x_in_view[c3]));
        this->Out.normals.push_back(float(normal[c3]));
      }
      this->Out.uvs.push_back(float(uv.x()));
      this->Out.uvs.push_back(float(uv.y()));
      for (int channel = 0; colored && channel < 4; ++channel)
      {
        this->Out.colors.push_back(std::uint8_t(std::lround(color[channel])));
      }
      this->Out.triangles.push_back(float(triangle));
    }
  }

  const PieceRange& Range;
  const RasterCamera& Camera;
  Pieces& Out;
  double Closest; // depth below which OpenGL would round too much
  std::array<Corner, 3> Corners;
  std::vector<Corner> Left;
  std::vector<Corner> Right;
};

} // namespace

bool mayNeedPieces(const PieceRange& range, const RasterCamera& camera)
{
  return camera.perspective && range.largest >= camera.near && range.least <= camera.far &&
         (range.least < camera.near || range.largest > maxDepthRatio * range.least ||
           range.least < range.extent / reach(camera));
}

void makePieces(const PieceRange& range, const RasterCamera& camera, Pieces& pieces)
{
  pieces.positions.clear();
  pieces.normals.clear();
  pieces.uvs.clear();
  pieces.colors.clear();
  pieces.triangles.clear();
  pieces.others.clear();
  Cutter(range, camera, pieces).run();
}

} // namespace dgtk
