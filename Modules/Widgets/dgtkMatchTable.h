// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMatchTable_h
#define dgtkMatchTable_h

// Private to Widgets.

#include "dgtkSparseText.h"

#include <QString>
#include <QTableWidget>

#include <string>
#include <vector>

namespace dgtk
{

/// A pair of matching points that was collected.
struct MatchRow
{
  SparseView from;
  SparseView to;
  SparseMatch match;
  QString object; ///< whose surface it is
};

/// The collected pairs. Delete removes the selected ones.
class MatchTable : public QTableWidget
{
  Q_OBJECT

public:
  explicit MatchTable(QWidget* parent);

  const std::vector<MatchRow>& pairs() const { return this->Pairs; }
  void add(const std::vector<MatchRow>& pairs);
  void removeSelected();
  void clearAll();
  /// The pairs as files have them, those of the same views together.
  std::string text() const;

signals:
  void pairsChanged();

protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  void fill(int row, const MatchRow& pair);

  std::vector<MatchRow> Pairs;
};

} // namespace dgtk

#endif
