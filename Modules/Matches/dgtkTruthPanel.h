// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTruthPanel_h
#define dgtkTruthPanel_h

#include "dgtkLiveTruth.h"
#include "dgtkMatchesModule.h"

#include <QString>
#include <QTreeWidget>

#include <string>

namespace dgtk
{

/// A number with the digits that tell it from all others.
DGTKMATCHES_EXPORT QString exactText(double value);
/// The channels of a value; "-" where there is none.
DGTKMATCHES_EXPORT QString exactText(const PixelValue& value, const QString& separator);

/// What the lists of layers call one: the dataset's name, but for draftLayer.
QString layerText(const std::string& layer);

/// Everything known about the pixel under the mouse. Control+C copies it.
class DGTKMATCHES_EXPORT TruthPanel : public QTreeWidget
{
  Q_OBJECT

public:
  explicit TruthPanel(QWidget* parent);
  /// `units`: of the scene, may be empty.
  void showTruth(const QString& view, const PixelTruth& truth, const QString& units);
  void forgetTruth();
  /// The rows as lines; "" while there are no values.
  QString text() const;

protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  void setRow(const QString& name, const QString& value, const QString& tip = {});
  void showValues(const PixelTruth& truth, const QString& units);
  void finishRows();
  int Next = 0; ///< row that setRow() fills
  bool HasTruth = false;
};

} // namespace dgtk

#endif
