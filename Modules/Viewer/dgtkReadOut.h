// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadOut_h
#define dgtkReadOut_h

#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QLabel;
class QTableWidget;

namespace dgtk
{

/// The numbers at the pixel under the crosshair, a row a pane.
class ReadOut : public QWidget
{
  Q_OBJECT

public:
  using Row = std::array<QString, 4>; ///< camera, layer, value, world point

  explicit ReadOut(QWidget* parent);

  void showRows(const std::optional<QPoint>& pixel, const std::vector<Row>& rows);
  /// Lines of cells with tabs between them.
  QString text() const;

private:
  void fitColumns();

  QLabel* Pixel;
  QTableWidget* Table;
};

} // namespace dgtk

#endif
