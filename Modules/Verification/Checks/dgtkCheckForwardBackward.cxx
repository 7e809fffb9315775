// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dgtk
{

namespace
{
/// Pixels, beyond the rounding of float32 files: the loop is as exact as the flow.
constexpr double loopTolerance = 1e-9;
/// Square pixels: where the four pixels around a target come from a smaller area, their roundings weigh too much.
constexpr double leastArea = 0.02;
/// Roundings of one flow forth and four flows back, which the way through them makes larger.
constexpr double roundingFactor = 8;
/// Share: no four pixels may lie on one triangle anywhere, where triangles are as small as pixels.
constexpr double mostOpenLoops = 1;

/// The map of the plane of a triangle from the unit square of four pixels' centres to their places in the other image:
/// what two linear cameras see of a plane is related by one (Heckbert 1989).
class SquareToQuad
{
public:
  /// `corner[i + 2 * j]` is the place of the square's corner (i, j).
  explicit SquareToQuad(const Eigen::Vector2d corner[4])
    : Origin(corner[0])
  {
    const Eigen::Vector2d right = corner[1] - corner[3];
    const Eigen::Vector2d down = corner[2] - corner[3];
    const Eigen::Vector2d excess = corner[0] - corner[1] + corner[3] - corner[2];
    this->Area = right.x() * down.y() - right.y() * down.x();
    this->G = (excess.x() * down.y() - excess.y() * down.x()) / this->Area;
    this->H = (right.x() * excess.y() - right.y() * excess.x()) / this->Area;
    this->U = corner[1] - corner[0] + this->G * corner[1];
    this->V = corner[2] - corner[0] + this->H * corner[2];
  }
  double area() const { return std::abs(this->Area); }
  Eigen::Vector2d operator()(double u, double v) const
  {
    return (this->Origin + u * this->U + v * this->V) / (1 + this->G * u + this->H * v);
  }

private:
  Eigen::Vector2d Origin;
  Eigen::Vector2d U;
  Eigen::Vector2d V;
  double Area = 0;
  double G = 0;
  double H = 0;
};

/// Where the flow back takes a point of the later image, by the four pixels around it, all on one triangle.
class WayBack
{
public:
  WayBack(const PictureFile& back, const Surfaces& seen)
    : Back(back)
    , Seen(seen)
  {
  }
  /// Nothing where there are no four such pixels. `rounding` receives the largest of their files' roundings, and grows
  /// as many times as the way back stretches: where things have become smaller, their neighbours come from far apart;
  /// and where the four come from a thin quadrangle, its plane is known as much less well as it is thin.
  std::optional<Eigen::Vector2d> operator()(const Eigen::Vector2d& p, const Hit& hit, double& rounding) const
  {
    const int x = static_cast<int>(std::floor(p.x() - 0.5));
    const int y = static_cast<int>(std::floor(p.y() - 0.5));
    if (!(x >= 0 && y >= 0 && x + 1 < this->Back.width() && y + 1 < this->Back.height()))
    {
      return std::nullopt;
    }
    Eigen::Vector2d corner[4];
    for (int i = 0; i < 4; ++i)
    {
      const int column = x + i % 2;
      const int row = y + i / 2;
      const std::size_t at = this->Seen.index(column, row);
      const Eigen::Vector2d flow = this->Back.at2(column, row);
      if (this->Seen.hits[at] != hit || this->Seen.marks[at] != Mark::Same || !flow.allFinite())
      {
        return std::nullopt;
      }
      corner[i] = centreOf(column, row) + flow;
      rounding = std::max(rounding, this->Back.rounding(flow.cwiseAbs().maxCoeff()));
    }
    const double stretch = std::max({ (corner[1] - corner[0]).norm(), (corner[3] - corner[2]).norm(),
      (corner[2] - corner[0]).norm(), (corner[3] - corner[1]).norm() });
    const SquareToQuad map(corner);
    rounding *= std::max({ 1.0, stretch, stretch * stretch / map.area() });
    return map.area() < leastArea ? std::nullopt : std::optional(map(p.x() - 0.5 - x, p.y() - 0.5 - y));
  }

private:
  const PictureFile& Back;
  const Surfaces& Seen;
};
} // namespace

void checkForwardBackward(Picture& picture, Results& results)
{
  Dataset& dataset = picture.dataset();
  const CameraRecord* next = dataset.camera(picture.camera(), picture.frame() + 1);
  const std::vector<std::string> suffixes{ ".npy", ".flo", ".exr" };
  if (!next || dataset.find(picture.camera(), "flow_forward", picture.frame(), suffixes).empty() ||
      dataset.find(picture.camera(), "flow_backward", picture.frame() + 1, suffixes).empty())
  {
    return;
  }
  Picture later(dataset, *next);
  if (!picture.eye().linear() || !later.eye().linear() || picture.time().rolls())
  {
    return;
  }
  const PicturePointer forward = picture.image("flow_forward", suffixes);
  const PicturePointer back = later.image("flow_backward", suffixes);
  const PicturePointer classes = picture.quietly([&] { return picture.image("flow_forward", { ".png" }); });
  picture.preparePoints();
  const Surfaces& now = picture.surfaces();
  const WayBack wayBack(*back, later.surfaces());
  const Meter meter = meterRows(picture.pool(), picture.height(), loopTolerance,
    [&](int y, Meter& row)
    {
      for (int x = 0; x < picture.width(); ++x)
      {
        const Hit& hit = now.hits[now.index(x, y)];
        const Eigen::Vector2d flow = forward->at2(x, y);
        if (hit.object == 0 || !flow.allFinite() || (classes && classes->at(x, y) != 1))
        {
          continue;
        }
        double rounding = forward->rounding(flow.cwiseAbs().maxCoeff());
        const std::optional<Eigen::Vector2d> returned = wayBack(centreOf(x, y) + flow, hit, rounding);
        if (!returned)
        {
          row.skip();
          continue;
        }
        const double error = (*returned - centreOf(x, y)).norm() - roundingFactor * rounding;
        row.add(std::max(0.0, error) / picture.eye().farness(picture.point(x, y)),
          [&]
          {
            return forward->offender(x, y, numbersText(flow.data(), 2),
              "a flow from where " + back->file() + " returns, not to " + numbersText(returned->data(), 2));
          });
      }
    });
  results.add({ "flow", "pixel", { forward->file(), back->file() }, mostOpenLoops }, meter);
}

} // namespace dgtk
