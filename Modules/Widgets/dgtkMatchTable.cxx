// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMatchTable.h"

#include "dgtkTruthPanel.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>

#include <algorithm>

namespace dgtk
{

namespace
{
QString textOf(const SparseView& view)
{
  return QString::fromStdString(view.camera) + '@' + QString::number(view.frame);
}
} // namespace

MatchTable::MatchTable(QWidget* parent)
  : QTableWidget(0, 8, parent)
{
  this->setObjectName("matchTable");
  this->setHorizontalHeaderLabels(
    { tr("From"), tr("x"), tr("y"), tr("To"), tr("x'"), tr("y'"), tr("Visibility"), tr("Object") });
  this->setSelectionBehavior(SelectRows);
  this->setEditTriggers(NoEditTriggers);
  this->setAlternatingRowColors(true);
  this->setWordWrap(false);
  this->resizeColumnsToContents();
  this->horizontalHeader()->setStretchLastSection(true);
  this->verticalHeader()->setDefaultSectionSize(this->fontMetrics().height() + 6);
}

void MatchTable::fill(int row, const MatchRow& pair)
{
  const SparseMatch& match = pair.match;
  const QString cells[] = { textOf(pair.from), exactText(match.from.x()), exactText(match.from.y()), textOf(pair.to),
    exactText(match.to.pixel.x()), exactText(match.to.pixel.y()), visibilityText(static_cast<int>(match.to.visibility)),
    pair.object };
  for (int column = 0; column < this->columnCount(); ++column)
  {
    auto* item = new QTableWidgetItem(cells[column]);
    item->setToolTip(cells[column]);
    this->setItem(row, column, item);
  }
}

void MatchTable::add(const std::vector<MatchRow>& pairs)
{
  int row = this->rowCount();
  this->Pairs.insert(this->Pairs.end(), pairs.begin(), pairs.end());
  this->setRowCount(int(this->Pairs.size()));
  for (const MatchRow& pair : pairs)
  {
    this->fill(row++, pair);
  }
  this->resizeColumnsToContents();
  this->scrollToBottom();
  emit this->pairsChanged();
}

void MatchTable::removeSelected()
{
  std::vector<int> rows;
  for (const QModelIndex& index : this->selectionModel()->selectedRows())
  {
    rows.push_back(index.row());
  }
  std::sort(rows.rbegin(), rows.rend());
  for (const int row : rows)
  {
    this->Pairs.erase(this->Pairs.begin() + row);
    this->removeRow(row);
  }
  if (!rows.empty())
  {
    emit this->pairsChanged();
  }
}

void MatchTable::clearAll()
{
  this->Pairs.clear();
  this->setRowCount(0);
  emit this->pairsChanged();
}

std::string MatchTable::text() const
{
  std::vector<SparseSet> sets;
  for (const MatchRow& pair : this->Pairs)
  {
    auto at = std::find_if(
      sets.begin(), sets.end(), [&](const SparseSet& set) { return set.from == pair.from && set.to == pair.to; });
    if (at == sets.end())
    {
      at = sets.insert(sets.end(), { pair.from, pair.to, {} });
    }
    at->matches.push_back(pair.match);
  }
  std::string text;
  for (const SparseSet& set : sets)
  {
    text += sparseText(set);
  }
  return text;
}

void MatchTable::paintEvent(QPaintEvent* event)
{
  QTableWidget::paintEvent(event);
  if (this->Pairs.empty())
  {
    QPainter painter(this->viewport());
    painter.setPen(this->palette().color(QPalette::Disabled, QPalette::Text));
    painter.drawText(this->viewport()->rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
      tr("Click a point of a picture, then Add pair. Open reads a list that was saved."));
  }
}

void MatchTable::keyPressEvent(QKeyEvent* event)
{
  if (event->matches(QKeySequence::Delete))
  {
    this->removeSelected();
    return;
  }
  QTableWidget::keyPressEvent(event);
}

} // namespace dgtk
