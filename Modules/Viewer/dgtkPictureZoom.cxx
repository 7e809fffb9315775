// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureZoom.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr double largestScale = 128;
constexpr double smallestShare = 0.5; // of the scale that shows the whole image
} // namespace

void PictureZoom::fit(const Eigen::Vector2d& image, const Eigen::Vector2d& widget)
{
  this->Image = image.cwiseMax(1.0);
  this->Fitting = std::min(largestScale, widget.cwiseMax(1.0).cwiseQuotient(this->Image).minCoeff());
  this->Scale = this->Fitting;
  this->Center = this->Image / 2;
}

void PictureZoom::zoomTo(double scale, const Eigen::Vector2d& at, const Eigen::Vector2d& widget)
{
  const Eigen::Vector2d point = this->toImage(at, widget);
  this->Scale = std::clamp(scale, std::min(1.0, this->Fitting * smallestShare), largestScale);
  this->Center = point - (at - widget / 2) / this->Scale;
  this->keepInside();
}

void PictureZoom::pan(const Eigen::Vector2d& way)
{
  this->Center -= way / this->Scale;
  this->keepInside();
}

void PictureZoom::reveal(const Eigen::Vector2d& point, const Eigen::Vector2d& widget)
{
  const Eigen::Vector2d half = (widget / 2 / this->Scale - Eigen::Vector2d(1, 1)).cwiseMax(0.0);
  this->Center = this->Center.cwiseMax(point - half).cwiseMin(point + half);
  this->keepInside();
}

void PictureZoom::keepInside() { this->Center = this->Center.cwiseMax(0.0).cwiseMin(this->Image); }

} // namespace dgtk
