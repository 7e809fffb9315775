// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPairValues.h"

#include <cmath>
#include <limits>

namespace dgtk
{

int channelsOf(PairValue value)
{
  switch (value)
  {
    case PairValue::Position:
    case PairValue::Displacement:
      return 2;
    case PairValue::Motion:
      return 3;
    default:
      return 1;
  }
}

void pairRows(const PixelRect& rect, const double* pixels, PairValue value, double* values, const double* own)
{
  const auto width = static_cast<std::size_t>(rect.width);
  const std::size_t count = width * static_cast<std::size_t>(rect.height);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = pixels[2 * i];
    const double y = pixels[2 * i + 1];
    const double ownX = own != nullptr ? own[2 * i] : rect.x + double(i % width) + 0.5;
    const double ownY = own != nullptr ? own[2 * i + 1] : rect.y + double(i / width) + 0.5;
    switch (value)
    {
      case PairValue::Position:
        *values++ = x;
        *values++ = y;
        break;
      case PairValue::Displacement:
        *values++ = x - ownX;
        *values++ = y - ownY;
        break;
      case PairValue::FromLeft:
        *values++ = ownX - x;
        break;
      default:
        *values++ = x - ownX;
    }
  }
}

double baselineRounding(const View& a, const View& b)
{
  return 4 * std::numeric_limits<double>::epsilon() *
         (a.camera_from_world.translation.norm() + b.camera_from_world.translation.norm());
}

double rectifiedBaseline(const View& a, const View& b)
{
  const auto linear = [](const View& view) { return view.instants ? std::nullopt : view.model->linear(); };
  const auto own = linear(a);
  const auto other = linear(b);
  if (!own || !other || !own->perspective || !other->perspective || a.model->width() != b.model->width() ||
      a.model->height() != b.model->height())
  {
    return 0;
  }
  Eigen::Matrix3d difference = own->K - other->K;
  difference(0, 2) = 0;
  constexpr double same = 1e-9;
  const Eigen::Matrix3d rotation = a.camera_from_world.rotation - b.camera_from_world.rotation;
  // centre of b in the frame of a
  const Eigen::Vector3d centre =
    a.camera_from_world * Eigen::Vector3d(-b.camera_from_world.rotation.transpose() * b.camera_from_world.translation);
  const double rounding = baselineRounding(a, b);
  const bool rectified = difference.cwiseAbs().maxCoeff() <= same * own->K(0, 0) &&
                         rotation.cwiseAbs().maxCoeff() <= same && std::abs(centre.x()) > rounding &&
                         centre.tail<2>().cwiseAbs().maxCoeff() <= same * std::abs(centre.x()) + rounding;
  return rectified ? centre.x() : 0;
}

} // namespace dgtk
