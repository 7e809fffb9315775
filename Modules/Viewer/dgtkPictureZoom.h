// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureZoom_h
#define dgtkPictureZoom_h

#include "dgtkViewerModule.h"

#include <Eigen/Core>

namespace dgtk
{

/// Which part of a picture a pane shows; several panes share one, so that the same pixel stands at the same distance
/// from the middle of each. Image points: pixels, (0, 0) the top left corner of the image, + 0.5 the centre of a pixel.
/// Widget points: (0, 0) the top left corner of the widget; sizes in the same unit.
class DGTKVIEWER_EXPORT PictureZoom
{
public:
  double scale() const { return this->Scale; }                   ///< widget units for an image pixel
  const Eigen::Vector2d& center() const { return this->Center; } ///< image point in the middle of the widget

  /// The whole image, in its middle; smallest(), largest() follow from it.
  void fit(const Eigen::Vector2d& image, const Eigen::Vector2d& widget);
  /// A scale, limited; the image point that is at `at` stays there.
  void zoomTo(double scale, const Eigen::Vector2d& at, const Eigen::Vector2d& widget);
  void zoomBy(double factor, const Eigen::Vector2d& at, const Eigen::Vector2d& widget)
  {
    this->zoomTo(this->Scale * factor, at, widget);
  }
  /// The image follows the mouse; its middle can be moved to its border, not farther.
  void pan(const Eigen::Vector2d& way);
  /// Brings an image point into sight by the least motion.
  void reveal(const Eigen::Vector2d& point, const Eigen::Vector2d& widget);

  Eigen::Vector2d toImage(const Eigen::Vector2d& at, const Eigen::Vector2d& widget) const
  {
    return this->Center + (at - widget / 2) / this->Scale;
  }
  Eigen::Vector2d toWidget(const Eigen::Vector2d& point, const Eigen::Vector2d& widget) const
  {
    return widget / 2 + (point - this->Center) * this->Scale;
  }

private:
  void keepInside();

  double Scale = 1;
  double Fitting = 1;
  Eigen::Vector2d Center{ 0, 0 };
  Eigen::Vector2d Image{ 1, 1 };
};

} // namespace dgtk

#endif
