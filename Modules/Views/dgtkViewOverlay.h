// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewOverlay_h
#define dgtkViewOverlay_h

#include "dgtkViewHandles.h"

#include <QLineF>
#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

namespace dgtk
{

/// What is drawn over a view: boxes about what is selected, handles, the numbers of a drag. Lets the mouse through.
class ViewOverlay : public QWidget
{
  Q_OBJECT

public:
  explicit ViewOverlay(QWidget* view);

  void showLines(std::vector<QLineF> lines);
  void showHandles(std::vector<HandleShape> shapes);
  /// The one under the mouse, or held by it.
  void highlight(const std::optional<Handle>& handle);
  /// Beside the pointer; "" for nothing.
  void showText(const QString& text, const QPoint& at);
  /// About the whole view.
  void showFrame(bool on);

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  std::vector<QLineF> Lines; ///< about what is selected
  std::vector<HandleShape> Shapes;
  std::optional<Handle> Bright;
  QString Text;
  QPoint At;
  bool Frame = false;
};

} // namespace dgtk

#endif
