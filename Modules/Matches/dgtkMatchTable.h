// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMatchTable_h
#define dgtkMatchTable_h

#include "dgtkSparseText.h"

#include <QString>
#include <QTableWidget>

#include <cstddef>
#include <string>
#include <utility>
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

/// The collected pairs. Delete removes the selected ones. Every change is a step that can be undone.
class MatchTable : public QTableWidget
{
  Q_OBJECT

public:
  explicit MatchTable(QWidget* parent);

  const std::vector<MatchRow>& pairs() const { return this->Pairs; }
  void add(const std::vector<MatchRow>& pairs);
  /// Marks the pairs (one each) that the scene does not have so any more; they stay what they are.
  void mark(const std::vector<bool>& outdated);
  bool isMarked(int row) const;
  void removeSelected();
  void clearAll();
  /// Also what could be undone.
  void forgetAll();
  bool canUndo() const { return this->Done > 0; }
  bool canRedo() const { return this->Done < this->Steps.size(); }
  void undo();
  void redo();
  /// The pairs as files have them, those of the same views together.
  std::string text() const;

signals:
  void pairsChanged();

protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  /// Pairs that came or went together, by their rows afterwards or before.
  struct Step
  {
    bool added = true;
    std::vector<std::pair<int, MatchRow>> rows; ///< ascending
  };
  void fill(int row, const MatchRow& pair);
  void take(Step step);
  void apply(const Step& step, bool forward);
  void showStep(const Step& step, bool come);

  std::vector<MatchRow> Pairs;
  std::vector<Step> Steps;
  std::size_t Done = 0; ///< steps that are not undone
};

} // namespace dgtk

#endif
