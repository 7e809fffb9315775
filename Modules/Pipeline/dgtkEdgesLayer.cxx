// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayers.h"

#include "dgtkSurfaceRows.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::uint8_t objectEdge = 255;
constexpr std::uint8_t depthEdge = 128;
constexpr double tolerance = 0.01; // of the smaller depth

/// A pixel's surface: its point and the plane of its triangle in the camera frame.
struct PixelPlane
{
  std::uint32_t object = 0;
  Eigen::Vector3d point{ 0, 0, 0 };
  Eigen::Vector3d normal{ 0, 0, 0 };

  bool holds(const Eigen::Vector3d& other, double slack) const
  {
    return std::abs(this->normal.dot(other - this->point)) <= slack;
  }
};

std::uint8_t edgeBetween(const PixelPlane& a, const PixelPlane& b)
{
  if (a.object != b.object)
  {
    return objectEdge;
  }
  const double slack = tolerance * std::min(a.point.z(), b.point.z());
  return a.object != 0 && !a.holds(b.point, slack) && !b.holds(a.point, slack) ? depthEdge : 0;
}

LayerSpec edgesSpec()
{
  return { "edges", PixelType::UInt8, 1, "1", "image", "0",
    "255: a 4-neighbour has another object id; 128: one of the same object lies off this pixel's tangent plane, and "
    "this pixel off its, by more than 1 % of the smaller depth" };
}

/// Two rows are known at a time; a row is written when the one below it is.
class EdgesPass : public LayerPass
{
public:
  explicit EdgesPass(const JobContext& context)
    : State(context.state)
    , TheView(context.view)
  {
  }

  void band(const Band& band, LayerSink& sink) override
  {
    for (int y = band.rect.y; y < band.rect.y + band.rect.height; ++y)
    {
      std::vector<PixelPlane> below = this->planes(band, y);
      if (y == 0)
      {
        this->Marks.assign(below.size(), 0);
      }
      else
      {
        std::vector<std::uint8_t> marks(below.size(), 0);
        for (std::size_t x = 0; x < below.size(); ++x)
        {
          const std::uint8_t edge = edgeBetween(this->Above[x], below[x]);
          this->Marks[x] = std::max(this->Marks[x], edge);
          marks[x] = edge;
        }
        this->flush(y - 1, sink);
        this->Marks.swap(marks);
      }
      for (std::size_t x = 1; x < below.size(); ++x)
      {
        const std::uint8_t edge = edgeBetween(below[x - 1], below[x]);
        this->Marks[x - 1] = std::max(this->Marks[x - 1], edge);
        this->Marks[x] = std::max(this->Marks[x], edge);
      }
      this->Above.swap(below);
    }
  }

  void finish(LayerSink& sink) override { this->flush(this->TheView.model->height() - 1, sink); }

private:
  std::vector<PixelPlane> planes(const Band& band, int y) const
  {
    const PixelRect rect{ 0, y, band.rect.width, 1 };
    const Hit* hits = band.hits.data() + std::size_t(y - band.rect.y) * rect.width;
    SurfaceRows surface;
    computeSurfaceRows(*this->State, this->TheView, rect, hits, false, surface);
    std::vector<PixelPlane> row(static_cast<std::size_t>(rect.width));
    for (std::size_t x = 0; x < row.size(); ++x)
    {
      if (!std::isfinite(surface.t[x]))
      {
        continue;
      }
      const CameraRay ray = this->TheView.model->rayThrough({ double(x) + 0.5, y + 0.5 });
      row[x].object = hits[x].object;
      row[x].point = ray.origin + surface.t[x] * ray.direction;
      row[x].normal = x > 0 && hits[x] == hits[x - 1] ? row[x - 1].normal : this->normalOf(hits[x]);
    }
    return row;
  }

  Eigen::Vector3d normalOf(const Hit& hit) const
  {
    Eigen::Vector3d corners[3];
    triangleInWorld(*this->State, hit, corners);
    return this->TheView.camera_from_world.rotation *
           (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  }

  void flush(int y, LayerSink& sink) const
  {
    Rows rows(PixelType::UInt8, 1, static_cast<int>(this->Marks.size()), y, 1);
    std::copy(this->Marks.begin(), this->Marks.end(), rows.row<std::uint8_t>(y));
    sink.rows(0, rows);
  }

  std::shared_ptr<const SceneState> State;
  View TheView;
  std::vector<PixelPlane> Above;
  std::vector<std::uint8_t> Marks; // of the row of Above
};

class EdgesLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "edges", { "png", "npy" }, "discontinuities of object ids and of depth" };
  }
  LayerNeeds needs(const GeneratorRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { edgesSpec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { imageOutput(plan, stage, job, edgesSpec(), planned.formats) };
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<EdgesPass>(context);
  }
};
} // namespace

LayerList edgesLayers() { return { std::make_shared<EdgesLayer>() }; }

} // namespace dgtk
