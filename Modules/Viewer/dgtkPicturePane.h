// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPicturePane_h
#define dgtkPicturePane_h

#include "dgtkPictureView.h"

#include <QFrame>

class QBoxLayout;
class QSpinBox;

namespace dgtk
{

class LegendBar;
class NameCombo;

/// A picture with what it shows: camera and layer above, legend below.
class PicturePane : public QFrame
{
  Q_OBJECT

public:
  /// Object names: pane.<number>, and within it camera, layer, surface, picture.<number>.
  PicturePane(int number, PictureSync& sync, QWidget* parent);

  int number() const { return this->Number; }
  PictureView& view() const { return *this->View; }
  void setDataset(const std::shared_ptr<const DatasetPictures>& dataset);
  QString camera() const;
  QString layer() const;
  /// Without a signal; unknown names are passed over.
  void choose(const QString& camera, const QString& layer);
  /// The width at which the names of all its cameras and layers are whole; `stacked`: the camera above the layer.
  int wholeWidth(bool stacked) const;
  void setStacked(bool on);
  int surface() const;
  /// `chosen`: the user's range and not the picture's own.
  void showPicture(const ShownPointer& shown, bool chosen);
  /// The numbers under the crosshair; "" for none.
  QString value(const DatasetPictures& dataset) const;
  QString world(const DatasetPictures& dataset) const;

signals:
  void changed();
  void rangeAsked(const std::optional<dgtk::PictureRange>& range);

private:
  void fillLayers();
  void showSurface();

  int Number;
  PictureSync& Sync;
  std::shared_ptr<const DatasetPictures> Dataset;
  QBoxLayout* Head = nullptr;
  NameCombo* Camera;
  NameCombo* Layer;
  int CameraWidth = 0; ///< of all names, whole
  int LayerWidth = 0;  ///< likewise
  QSpinBox* Surface;
  PictureView* View;
  LegendBar* Legend;
};

} // namespace dgtk

#endif
