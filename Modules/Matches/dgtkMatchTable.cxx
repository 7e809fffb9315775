// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMatchTable.h"

#include "dgtkEditorLanguage.h"
#include "dgtkTruthPanel.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int decimals = 3; // of pixels, in the table; the tool tip and files have all

QString shortText(double value) { return std::isnan(value) ? exactText(value) : QString::number(value, 'f', decimals); }

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
  const auto [x, y] = std::pair(match.from.x(), match.from.y());
  const auto [u, v] = std::pair(match.to.pixel.x(), match.to.pixel.y());
  const QString kind = visibilityText(static_cast<std::uint32_t>(match.to.visibility));
  const QString cells[] = { textOf(pair.from), shortText(x), shortText(y), textOf(pair.to), shortText(u), shortText(v),
    kind, pair.object };
  const QString tips[] = { cells[0], exactText(x), exactText(y), cells[3], exactText(u), exactText(v), kind,
    pair.object };
  for (int column = 0; column < this->columnCount(); ++column)
  {
    auto* item = new QTableWidgetItem(cells[column]);
    item->setToolTip(tips[column]);
    this->setItem(row, column, item);
  }
}

void MatchTable::take(Step step)
{
  if (!step.rows.empty())
  {
    this->Steps.resize(this->Done);
    this->Steps.push_back(std::move(step));
    this->redo();
  }
}

void MatchTable::undo()
{
  if (this->canUndo())
  {
    --this->Done;
    this->apply(this->Steps[this->Done], false);
  }
}

void MatchTable::redo()
{
  if (this->canRedo())
  {
    ++this->Done;
    this->apply(this->Steps[this->Done - 1], true);
  }
}

void MatchTable::apply(const Step& step, bool forward)
{
  std::vector<MatchRow> pairs;
  auto taken = step.rows.begin();
  const bool come = step.added == forward;
  const std::size_t count = come ? this->Pairs.size() + step.rows.size() : this->Pairs.size();
  auto kept = this->Pairs.begin();
  for (std::size_t row = 0; row < count; ++row)
  {
    const bool here = taken != step.rows.end() && taken->first == int(row);
    if (here && come)
    {
      pairs.push_back(taken->second);
    }
    else
    {
      if (!here)
      {
        pairs.push_back(std::move(*kept));
      }
      ++kept;
    }
    taken += here ? 1 : 0;
  }
  this->Pairs = std::move(pairs);
  this->showStep(step, come);
  emit this->pairsChanged();
}

/// Only rows that come or go are touched: a list may be long.
void MatchTable::showStep(const Step& step, bool come)
{
  if (come)
  {
    const bool atEnd = step.rows.front().first == this->rowCount();
    if (atEnd)
    {
      this->setRowCount(int(this->Pairs.size()));
    }
    for (const auto& [row, pair] : step.rows)
    {
      if (!atEnd)
      {
        this->insertRow(row);
      }
      this->fill(row, pair);
    }
    this->resizeColumnsToContents();
    this->scrollToItem(this->item(step.rows.back().first, 0));
  }
  else if (this->Pairs.empty())
  {
    this->setRowCount(0);
  }
  else
  {
    std::for_each(step.rows.rbegin(), step.rows.rend(), [this](const auto& gone) { this->removeRow(gone.first); });
  }
}

void MatchTable::add(const std::vector<MatchRow>& pairs)
{
  Step step;
  int row = this->rowCount();
  for (const MatchRow& pair : pairs)
  {
    step.rows.emplace_back(row++, pair);
  }
  this->take(std::move(step));
}

void MatchTable::mark(const std::vector<bool>& outdated)
{
  bool changed = false;
  for (int row = 0; row < this->rowCount(); ++row)
  {
    if (outdated[std::size_t(row)] != this->isMarked(row))
    {
      this->fill(row, this->Pairs[std::size_t(row)]);
      changed = true;
      QTableWidgetItem* const first = this->item(row, 0);
      if (outdated[std::size_t(row)])
      {
        first->setIcon(this->style()->standardIcon(QStyle::SP_MessageBoxWarning));
        first->setToolTip(tr("The scene does not have this pair now. Click it, then Add pair, to find it again."));
      }
    }
  }
  if (changed)
  {
    this->resizeColumnToContents(0); // the signs need room
  }
}

bool MatchTable::isMarked(int row) const { return !this->item(row, 0)->icon().isNull(); }

void MatchTable::removeSelected()
{
  Step step{ false, {} };
  for (const QModelIndex& index : this->selectionModel()->selectedRows())
  {
    step.rows.emplace_back(index.row(), this->Pairs[std::size_t(index.row())]);
  }
  std::sort(step.rows.begin(), step.rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  this->take(std::move(step));
}

void MatchTable::clearAll()
{
  Step step{ false, {} };
  for (const MatchRow& pair : this->Pairs)
  {
    step.rows.emplace_back(int(step.rows.size()), pair);
  }
  this->take(std::move(step));
}

void MatchTable::forgetAll()
{
  this->Pairs.clear();
  this->Steps.clear();
  this->Done = 0;
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
