// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Pixels.
constexpr double LoopTolerance = 1e-3;
/// Pixels: a flow that bends by more is not interpolated.
constexpr double MostBend = 2e-4;

/// Bilinear interpolation of the flow back at p, where one triangle of the object covers the 4 x 4 pixels around.
/// False where it does not, or where the flow is not straight enough to be interpolated.
bool interpolate(
  const PictureFile& back, const Surfaces& seen, const Eigen::Vector2d& p, const Hit& hit, Eigen::Vector2d& flow)
{
  const int x0 = static_cast<int>(std::floor(p.x() - 0.5));
  const int y0 = static_cast<int>(std::floor(p.y() - 0.5));
  if (x0 < 1 || y0 < 1 || x0 + 2 >= back.width() || y0 + 2 >= back.height())
  {
    return false;
  }
  for (int y = y0 - 1; y <= y0 + 2; ++y)
  {
    for (int x = x0 - 1; x <= x0 + 2; ++x)
    {
      const std::size_t i = seen.index(x, y);
      if (seen.hits[i] != hit || seen.marks[i] != Mark::Same || !back.at2(x, y).allFinite())
      {
        return false;
      }
    }
  }
  const auto at = [&](int i, int j) { return back.at2(x0 + i, y0 + j); };
  const auto bend = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
  { return (a - 2 * b + c).cwiseAbs().maxCoeff(); };
  const double most = std::max({ bend(at(-1, 0), at(0, 0), at(1, 0)), bend(at(0, 1), at(1, 1), at(2, 1)),
    bend(at(0, -1), at(0, 0), at(0, 1)), bend(at(1, 0), at(1, 1), at(1, 2)) });
  if (most > MostBend)
  {
    return false;
  }
  const double u = p.x() - 0.5 - x0;
  const double v = p.y() - 0.5 - y0;
  flow = (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
  return true;
}
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
  const PicturePointer forward = picture.image("flow_forward", suffixes);
  const PicturePointer back = later.image("flow_backward", suffixes);
  const PicturePointer classes = picture.quietly([&] { return picture.image("flow_forward", { ".png" }); });
  const Surfaces& now = picture.surfaces();
  const Surfaces& then = later.surfaces();
  const Meter meter = meterRows(picture.pool(), picture.height(), LoopTolerance,
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
        Eigen::Vector2d returned;
        if (!interpolate(*back, then, centreOf(x, y) + flow, hit, returned))
        {
          row.skip();
          continue;
        }
        row.add((flow + returned).norm(),
          [&]
          {
            const Eigen::Vector2d expected = -returned;
            return forward->offender(
              x, y, numbersText(flow.data(), 2), numbersText(expected.data(), 2) + " from " + back->file());
          });
      }
    });
  results.add("flow", "pixel", meter);
}

} // namespace dgtk
